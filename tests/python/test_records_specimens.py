"""`specimen_id` and `[specimens] scatter` of a campaign."""

from dataclasses import replace

import numpy as np
import pytest

from probation import Campaign, InputError, Record, Specimens
from probation.published.experiments import twin_campaign

ENTRY = '[[record]]\nid = "a"\nfile = "a.csv"\n'
CSV = "time_s,true_strain,true_stress_MPa\n" + "".join(f"{at},{0.01 * at},{0.1 * at}\n" for at in range(12))


@pytest.fixture
def load(tmp_path):
    (tmp_path / "a.csv").write_text(CSV, encoding="utf-8")

    def loaded(text):
        (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
        return Campaign.load(tmp_path)

    return loaded


def test_a_campaign_that_says_nothing_of_its_specimens_has_their_scatter_estimated(load):
    campaign = load(ENTRY)
    assert campaign.specimens == Specimens("estimate")
    assert campaign.records[0].specimen_id is None


def test_specimens_are_named_and_their_scatter_is_stated(load):
    campaign = load("[specimens]\nscatter = { tau = 0.03, area = 0 }\n" + ENTRY + 'specimen_id = "A3"\n')
    assert campaign.specimens.scatter == {"tau": 0.03, "area": 0.0}
    assert campaign.records[0].specimen_id == "A3"
    assert load('[specimens]\nscatter = "none"\n' + ENTRY).specimens.alike
    assert load("[specimens]\nscatter = { tau = 0 }\n" + ENTRY).specimens.alike


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ('scatter = "some"', r"row 2: found scatter = 'some' in \[specimens\], expected .*estimate.*none"),
        ("scatter = { tow = 0.1 }", r"row 2: found the unknown key .*tow.*\[specimens.scatter\].*tau"),
        (
            "scatter = { tau = 3 }",
            r"row 2: found tau = 3.0 in \[specimens.scatter\], expected .* 0 to 1 \(3",
        ),
        ("scater = 1", r"row 2: found the unknown key .*scater.*scatter"),
    ],
)
def test_what_is_wrong_about_specimens_is_named_by_its_row(load, line, message):
    with pytest.raises(InputError, match=message):
        load(f"[specimens]\n{line}\n" + ENTRY)


def test_specimens_survive_saving_and_belong_to_the_hash(tmp_path):
    made = Record("a", np.arange(12.0), 0.01 * np.arange(12), 0.1 * np.arange(12), specimen_id="A3")
    campaign = Campaign("x", (made,), specimens=Specimens({"area": 0.01}))
    campaign.save(tmp_path)
    back = Campaign.load(tmp_path)
    assert back.specimens == campaign.specimens
    assert back.records[0].specimen_id == "A3"
    assert replace(campaign, specimens=Specimens("none")).data_hash != campaign.data_hash


def test_virtual_experiments_have_specimens_that_are_alike():
    assert twin_campaign((1, 3)).specimens == Specimens("none")


@pytest.mark.parametrize("scatter", [None, 0.03, ["tau", 0.03]])
def test_a_scatter_that_is_neither_word_nor_table_is_refused(scatter):
    with pytest.raises(InputError, match="expected 'estimate', 'none' or a table"):
        Specimens(scatter)
