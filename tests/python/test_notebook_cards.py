"""What a notebook shows: a card that says the verdict first and takes nothing from a file as markup."""

import re
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser

import numpy as np
import pytest

import probation
from campaigns import made_up_diagnosis as made_up
from campaigns.few_records import LAW, few_records
from probation.histories import named_history
from probation.report.renderers import RENDERERS
from probation.simulation import simulate
from probation_studies.paper.relations import RATE_TABLE


@cache
def shown(name):
    makers = {
        "record": lambda: few_records().records[0],
        "campaign": lambda: few_records(held_out=("fast",)),
        "law": lambda: LAW,
        "fit": lambda: probation.fit(few_records()),
        "certificate": lambda: probation.certify(few_records(names=("slow", "middle"), held_out=("middle",)), "sa2"),
        "diagnosis": made_up.self_heating,
        "diagnosis without a gap": made_up.no_gap,
        "calibration": lambda: probation.calibrate_companion(RATE_TABLE),
        "simulation": lambda: simulate(LAW, named_history("ramp")),
    }
    return makers[name]()


NAMES = (
    "record",
    "campaign",
    "law",
    "fit",
    "certificate",
    "diagnosis",
    "diagnosis without a gap",
    "calibration",
    "simulation",
)


class Balanced(HTMLParser):
    """Refuses markup that is not closed in order, and collects the text."""

    def __init__(self):
        super().__init__()
        self.open, self.text, self.tags = [], [], set()

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.tags.add(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] != "style":
            self.text.append(data)


def read(html):
    parser = Balanced()
    parser.feed(html)
    assert parser.open == []
    return parser


@pytest.mark.parametrize("name", NAMES)
def test_a_card_is_whole_small_and_fetches_nothing(name):
    html = shown(name)._repr_html_()
    found = read(html)
    assert len(html) < 60_000
    assert not found.tags & {"script", "link", "img", "iframe"}
    assert not re.search(r"https?://|url\(", html)


@pytest.mark.parametrize(
    ("name", "verdict"),
    [
        ("fit", lambda fit: fit.verdict),
        ("certificate", lambda found: found.headline),
        ("diagnosis", lambda found: found.headline),
        ("calibration", lambda found: found.verdict),
    ],
)
def test_the_verdict_comes_before_every_table(name, verdict):
    text = "".join(read(shown(name)._repr_html_()).text)
    said = verdict(shown(name))
    assert said in text
    assert text.index(said) < 200


@pytest.mark.parametrize("name", NAMES)
def test_a_repr_is_one_short_line(name):
    line = repr(shown(name))
    assert "\n" not in line
    assert len(line) < 200
    assert line[0] == "<" or name == "law"


def test_text_from_files_is_no_markup_in_a_card():
    record = replace(few_records().records[0], id="<script>alert(1)</script>", specimen_id="a<b", warnings=("<i>&",))
    campaign = probation.Campaign(name='"><img src=x>\u202e', records=(record,))
    for html in (record._repr_html_(), campaign._repr_html_(), probation.fit(campaign)._repr_html_()):
        found = read(html)
        assert not found.tags & {"script", "img", "i"}
        assert "\u202e" not in html
    assert "<i>&" in "".join(read(record._repr_html_()).text)
    assert "\n" not in repr(campaign)


def test_a_fit_without_curves_has_a_card_without_a_drawing():
    fit = shown("fit")
    again = type(fit).from_json(fit.to_json())
    assert "<svg" in fit._repr_html_()
    assert "<svg" not in again._repr_html_()
    assert repr(again) == repr(fit)


def test_many_records_are_counted_and_not_listed():
    time = np.linspace(0.0, 10.0, 20)
    records = [probation.Record(f"r{at}", time, 0.01 * time, time) for at in range(40)]
    text = "".join(read(probation.Campaign("many", tuple(records))._repr_html_()).text)
    assert "40 records to identify on" in text
    assert "… and 35 more" in text


def test_a_card_does_not_load_matplotlib():
    import subprocess  # noqa: PLC0415
    import sys  # noqa: PLC0415

    code = (
        "import sys, probation; law = probation.Law(unrelaxed_modulus=900.0, tau_max=8.0, hardening_modulus=3.0);"
        "law._repr_html_(); assert 'matplotlib' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("name", [name for name, each in RENDERERS.items() if "summary" in each])
def test_every_result_has_a_card_and_a_line(name):
    module, _, kind = name.rpartition(".")
    found = getattr(__import__(f"probation.{module}", fromlist=[kind]), kind)
    assert hasattr(found, "_repr_html_")
    assert found.__repr__.__qualname__ == "InOneLine.__repr__"


def test_what_holds_curves_has_a_short_repr():
    campaign = few_records(names=("slow", "middle"))
    found = probation.fit(campaign, "sa2", gap=False)
    record = campaign.records[0]
    for each in (
        found.predict(record.time, record.true_strain),
        found.records["slow"],
        found.law.spectrum,
        probation.excite(record),
        probation.named_history("ramp"),
        probation.Reference.of(campaign),
    ):
        assert "\n" not in repr(each)
        assert len(repr(each)) < 700
        assert repr(each).startswith(f"{type(each).__name__}(")
    assert "time=<array of 150>" in repr(found.records["slow"])
