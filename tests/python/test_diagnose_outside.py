"""Campaigns of an independent virtual laboratory, whose truth is known: see the README of their folder."""

import json
import re
from dataclasses import replace
from functools import partial
from itertools import count

import pytest

from campaigns.measured import DATA
from probation import Campaign, Specimens, diagnose
from probation.diagnosis.search import Search

OUTSIDE = DATA / "outside"
pytestmark = pytest.mark.skipif(not OUTSIDE.is_dir(), reason="the campaigns are not beside the checkout")


def diagnosed(name, scatter="none"):
    campaign = replace(Campaign.load(OUTSIDE / name), specimens=Specimens(scatter))
    return diagnose(campaign, design=False)


@pytest.mark.parametrize("scatter", ["none", "estimate"])
@pytest.mark.parametrize("name", ["null-noisy-strain", "null-noisy-strain-jump"])
def test_noise_of_the_strain_is_no_gap(name, scatter):
    """Nothing is wrong but a strain noise of 5e-4, through a smoother and a law of 2000 MPa."""
    found = diagnosed(name, scatter)
    assert found.verdict == "no_gap"
    assert found.best.effects == ()
    assert any("calibrated on other campaigns" in warning for warning in found.warnings)


@pytest.mark.parametrize("scatter", ["none", "estimate"])
@pytest.mark.parametrize(
    ("name", "truth"),
    [
        ("damage-full-search-loses-it", "damage"),
        ("relaxation-full-search-loses-it", "rate_dependent_relaxation"),
        ("delayed-hardening-in-strain", "delayed_hardening"),
    ],
)
def test_a_search_over_all_effects_finds_what_explains_the_records_to_their_noise(name, truth, scatter):
    """Specimens are alike; where that is not said, the answer is the same, and would be if they were known to be."""
    found = diagnosed(name, scatter)
    assert found.verdict == "explained"
    assert found.best.effects == (truth,)
    assert found.shrink.identify.after_MPa < 1.1 * found.noise_MPa
    assert found.to_dict()["gap_if_alike"]
    said = "if they were alike there would be a gap as well (causes were not tried again)"
    summary = " ".join(found.summary().split())
    assert (said in summary) == (scatter == "estimate")
    # The error that a prediction makes is another one than scatter allows, however large that is.
    assert found.shrink.held_out.closure > 0.95
    assert ("No part of a record departs" in summary) != bool(found.located)
    assert not re.search(r"\d{12}", summary)


def ended(monkeypatch, clock):
    """A search for a truth that shows only jointly with another effect, ended after 20 s of a clock."""
    monkeypatch.setattr("probation.diagnosis.budget.monotonic", clock)
    campaign = replace(Campaign.load(OUTSIDE / "relaxation-full-search-loses-it"), specimens=Specimens("none"))
    return diagnose(campaign, design=False, budget=20.0)


def late(monkeypatch, at):
    """A clock on which all time has passed once a search comes to one of its steps."""
    passed, step = [0.0], getattr(Search, at)

    def passing(*arguments):
        passed[0] = 20.0
        return step(*arguments)

    monkeypatch.setattr(Search, at, passing)
    return lambda: passed[0]


def at_every_look(_):
    """A clock that goes on by 0.2 s whenever it is asked; single effects take more than 80 s of it."""
    return count(0.0, 0.2).__next__


@pytest.mark.parametrize(
    "clock",
    [at_every_look, partial(late, at="_singles"), partial(late, at="_further")],
    ids=["among first steps", "before first steps", "before last steps"],
)
def test_a_search_that_is_ended_says_that_and_is_sure_of_nothing(clock, monkeypatch):
    found, truth = ended(monkeypatch, clock(monkeypatch)), "rate_dependent_relaxation"
    assert "nothing that was tried explains it" in found.headline
    end = r"; the budget of 20 s ended the search: \d+ of 29 effects were not refitted to the end\.$"
    assert re.search(end, found.headline)
    assert max(each.probability for each in found.effects if each.name not in (truth, "unknown")) < 0.9
    assert found.best.probability < 0.9
    assert (truth,) in found.answer_set
    assert (truth,) in [each.effects for each in found.skipped]
    assert sum(each.probability for each in found.explanations) == pytest.approx(1.0)


def test_a_search_that_is_ended_among_combinations_keeps_the_cause_that_it_has_found(monkeypatch):
    found = ended(monkeypatch, late(monkeypatch, "_rivals_jointly"))
    assert found.best.effects == ("rate_dependent_relaxation",)
    assert found.headline.startswith("Of what was tried, rate-dependent relaxation explains the gap")
    assert found.headline.endswith("the budget of 20 s ended the search: not all was tried jointly.")


def test_specimens_that_differ_are_no_gap():
    """Three rates, three specimens each, that differ by 2 % in E_u and 3 % in alpha and G, and nothing else."""
    found = diagnosed("null-replicates", "estimate")
    assert found.verdict == "no_gap"
    assert found.best.effects == ()
    assert found.shrink.identify.after_MPa < 1.1 * found.noise_MPa
    assert "specimens differ by" in found.headline
    answer = json.loads(found.to_json())
    assert answer["gap_if_alike"]
    for name, true in {"unrelaxed_modulus_MPa": 0.02, "alpha": 0.03, "hardening_modulus_MPa": 0.03}.items():
        low, high = answer["scatter"][name]["interval95"]
        assert low < true < high
        assert low < answer["scatter"][name]["relative"] < high
        assert answer["scatter"][name]["specimens"] == 9


def test_what_specimens_differ_by_is_no_fault_of_the_load_cell():
    """Self-heating in all records, and the same scatter."""
    found = diagnosed("heating-replicates", "estimate")
    assert found.verdict == "explained"
    assert found.best.effects == ("self_heating",)
    assert found.to_dict()["gap_if_alike"]
    assert found.shrink.identify.after_MPa < 1.1 * found.noise_MPa
