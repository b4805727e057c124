"""Rows of nulls that were asked for a gap alone."""

import json

import pytest
from bench.null_alarms import HEAD, asked, row, scatter_from_replicates

from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.records.campaign import Campaign
from probation_studies.blind.laboratories import industry
from probation_studies.blind.layout import Layout
from probation_studies.blind.seal import seal_truth


@pytest.fixture(scope="module")
def layout(tmp_path_factory):
    """A null of each kind, the one with replicates an alarm, as an earlier run has noted."""
    folder = tmp_path_factory.mktemp("nulls")
    (folder / "truths").mkdir()
    lines = []
    for index, stratum in enumerate(("none", "replicates")):
        made = industry.make(11, index, "develop", stratum)
        made.write(folder / "campaigns" / made.name)
        seal_truth(made.truth.to_json()).write(folder / "truths" / f"{made.name}.json")
        lines.append(json.dumps({"campaign": made.name, "gap": stratum == "replicates", "commit": "c0ffee"}))
    (folder / "gaps.jsonl").write_text("\n".join(lines) + "\n")
    return Layout(folder)


def test_alarms_are_counted_apart_where_replicates_show_how_far_specimens_differ(layout):
    cells = dict(zip(HEAD, row("industry", asked(layout)).strip("| ").split(" | "), strict=True))
    assert (cells["laboratory"], cells["commit"], cells["seed"]) == ("industry", "c0ffee", "11")
    assert cells["specimens alike"].startswith("0 % of 1 ")
    assert cells["specimens differ"] == cells["scatter from replicates"] == "100 % of 1 (2 to 100)"


def test_replicates_are_those_that_the_fit_has_the_scatter_from(layout):
    for folder in layout.campaigns.iterdir():
        campaign = Campaign.load(folder)
        source = base_fit(campaign, plain_fit(campaign, "sa3", None)).scatter.source
        assert scatter_from_replicates(folder) == (source == "replicates")
