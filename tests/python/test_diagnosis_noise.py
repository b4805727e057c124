"""The noise that a diagnosis used, record by record: in its JSON, its summary and its page."""

import json
from dataclasses import replace

import pytest

from campaigns.few_records import NOISE, few_records
from probation import diagnose
from probation.diagnosis.result import Diagnosis
from probation.records.record import Noise

STATED = 0.5
"""Far above what the records scatter by [MPa]."""


@pytest.fixture(scope="module")
def found():
    """A record without a word of its noise, one that states more than it has, one that states less; one predicted."""
    made = few_records(held_out=("unloading",))
    stated = {
        "middle": Noise(stress_MPa=STATED, strain=2e-5),
        "fast": Noise(stress_MPa=1e-6),
    }
    records = tuple(replace(each, noise=stated.get(each.id, Noise())) for each in made.records)
    return diagnose(replace(made, records=records), effects=["damage"], design=False)


def test_every_record_has_the_noise_of_its_stress_and_its_strain(found):
    records = json.loads(found.to_json())["records"]
    assert {name: each["role"] for name, each in records.items()} == {
        "slow": "identify",
        "middle": "identify",
        "fast": "identify",
        "unloading": "held-out",
    }
    given = {name: (each["noise_given"], each["strain_noise_given"]) for name, each in records.items()}
    assert given == {name: (name == "middle", name == "middle") for name in records}
    assert records["middle"]["noise_MPa"] == pytest.approx(STATED)
    assert records["middle"]["strain_noise"] == 2e-5
    for name in ("slow", "fast", "unloading"):
        assert records[name]["noise_MPa"] == pytest.approx(NOISE, rel=0.2)
        assert records[name]["strain_noise"] < 1e-6


def test_it_comes_back_from_json_and_stands_in_the_summary_and_on_the_page(found, tmp_path):
    assert Diagnosis.from_json(found.to_json()).to_dict()["records"] == found.to_dict()["records"]
    assert Diagnosis.from_json(found.to_json()).summary() == found.summary()
    found.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    for text in (found.summary(), page):
        assert "The noise of the records" in text
        assert "0.5 (given)" in text
        assert "2e-05 (given)" in text
        assert text.count("(estimated)") == 6
