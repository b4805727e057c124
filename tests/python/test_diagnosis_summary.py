"""A diagnosis in words: where, which, how far, and what to do next."""

from dataclasses import replace

import pytest

from campaigns import made_up_diagnosis as made_up
from probation.detection.signatures import Drift
from probation.diagnosis.closure import Closure
from probation.diagnosis.headline import choices
from probation.diagnosis.result import CauseParameter, Checks, Explanation
from probation.diagnosis.signatures import changes_with
from probation.report.diagnosis_tables import MOST, where_table, which_table
from probation.report.diagnosis_words import (
    NOTHING,
    OUTSIDE,
    checks_text,
    closed,
    closed_interval,
    explanation_name,
    name_of,
    p_text,
    parameter_lines,
    parameter_text,
    short_ids,
    span_text,
)
from probation.wording import percent


@pytest.mark.parametrize("found", [made_up.self_heating(), made_up.no_gap(), made_up.unexplained()])
def test_the_summary_says_the_headline_first_and_stays_within_eighty_columns(found):
    first, *_ = found.summary().split("\n\n")
    assert " ".join(first.split()) == f"hdpe-2020: {found.headline}"
    assert max(len(line) for line in found.summary().splitlines()) <= 80


def test_where_which_how_far_and_the_next_test_follow_in_this_order():
    text = made_up.self_heating().summary()
    marks = ["Where the simulation", "Which effect explains", "How far the gap shrinks", "Next test:", "warning:"]
    places = [text.index(mark) for mark in marks]
    assert places == sorted(places)


def test_what_the_data_cannot_tell_from_the_best_bears_a_star():
    table, _ = which_table(made_up.self_heating())
    assert [row[1] for row in table.rows if row[0]] == ["self-heating", "structural softening"]


def test_explanations_below_one_percent_are_counted_and_not_listed():
    table, rest = which_table(made_up.self_heating(), MOST)
    assert [row[1] for row in table.rows][-1] == OUTSIDE
    assert rest == "… and 5 more explanations below 1 %"


def test_no_more_than_eight_regions_are_listed_on_a_terminal_and_all_on_the_page():
    found = made_up.self_heating()
    found = replace(found, located=found.located * 3)
    short, rest = where_table(found, MOST)
    assert len(short.rows) == MOST
    assert f"{len(found.located) - MOST} more regions" in rest
    assert len(where_table(found)[0].rows) == len(found.located)


def test_without_a_gap_the_errors_of_every_record_stand_there_with_nothing_to_close():
    text = made_up.no_gap().summary()
    assert NOTHING in text
    assert "no effect was added" in text
    assert "no gap to close" in text
    assert "Where" not in text


def test_a_verdict_that_hangs_on_the_noise_says_so():
    found = made_up.self_heating()
    shaky = replace(found, gap=replace(found.gap, p_value=0.001, p_value_low_noise=1e-5, p_value_high_noise=0.04))
    assert "This hangs on how well the noise is known: fewer than 0.01 % if it were 0.8" in " ".join(
        shaky.summary().split()
    )
    assert "This hangs" not in found.summary()


def test_explanations_are_called_by_their_titles():
    assert name_of(()) == NOTHING
    assert name_of(("unknown",)) == OUTSIDE
    assert name_of(("damage", "unknown")) == f"damage + {OUTSIDE}"
    assert name_of(("force_gain", "self_heating"), ("gain of the force", "self-heating")) == (
        "gain of the force + self-heating"
    )


def test_an_explanation_that_sits_in_some_records_says_in_which():
    found = made_up.self_heating()
    ids = [curves.id for curves in found.curves.values() if curves.role == "identify"]

    def named(records):
        return explanation_name(Explanation(("grip_slip",), ("slip in the grips",), ("f",), records, 0.1), found)

    assert named((ids[0],)) == f"slip in the grips, in {ids[0]} alone"
    assert named(tuple(ids[:2])) == "slip in the grips, in 2 of 5 records"
    assert named(tuple(ids)) == "slip in the grips"


@pytest.mark.parametrize(
    ("name", "unit", "value", "se", "bound", "text"),
    [
        ("heating_degC_per_MPa", "°C/MPa", 0.4981, 0.012, None, "heating 0.498 ± 0.012 °C/MPa"),
        ("cooling_rate_per_s", "1/s", 0.0041, 0.0003, None, "cooling rate 0.00410 ± 0.00030 1/s"),
        ("drift_MPa_per_s", "MPa/s", 0.5, None, None, "drift 0.5 MPa/s (not determined)"),
        ("slip_strain", "", 0.0123, 0.0004, None, "slip strain 0.01230 ± 0.00040"),
        ("lag_s", "s", 3.0, None, "upper", "lag 3 s (at its upper bound)"),
    ],
)
def test_a_parameter_reads_as_words_with_its_unit_behind(name, unit, value, se, bound, text):
    assert parameter_text(CauseParameter("x", name, unit, (), value, se, bound)) == text


def test_checks_say_what_speaks_for_and_what_against():
    def said(*checks, effects=("damage",)):
        return checks_text(Explanation(effects, effects, ("f",), (), 0.5, (), Checks(*checks)))

    assert said(0.994, 0.4, 0.3) == [
        "predicts 99 % of the gap in records left out",
        "one strength suits all records",
        "what is left may be noise and the form's error",
    ]
    assert said(0.5, 1e-4, 1e-4)[0] == "predicts only 50 % of the gap in records left out"
    assert said(-0.1, 1e-4, 1e-4) == [
        "predicts records left out no better than the base law",
        "each record wants another strength",
        "a gap is left in addition",
    ]
    assert said(None, None, 1e-4, effects=("unknown",)) == []


def test_notes_call_parameters_by_words():
    parameter = CauseParameter("self_heating", "cooling_rate_per_s", "1/s", (), 1.0, None, "upper")
    note = "cooling_rate_per_s ended at its upper bound"
    checks = Checks(None, None, 0.3, (note,))
    said = checks_text(Explanation(("self_heating",), ("self-heating",), ("f",), (), 0.5, (parameter,), checks))
    assert said[-1] == "cooling rate ended at its upper bound"


def test_probabilities_and_shares_are_whole_percents_that_never_lie_about_certainty():
    probabilities = (0.0, 0.004, 0.02, 0.912, 0.996, 1.0)
    assert [percent(each) for each in probabilities] == ["0 %", "< 1 %", "2 %", "91 %", "> 99 %", "100 %"]
    assert [p_text(p) for p in (0.0213, 0.0)] == ["0.021", "< 0.0001"]


def test_closure_has_the_digits_that_its_interval_allows():
    """Half-widths of 5 %, 0.5 % and 0.05 %: no, one and two decimals; beyond the noise it may pass 100 %."""
    assert closed(Closure(1, 0.1, 0.1, 0.9512, (0.90, 1.0), "")) == "95 %"
    assert closed(Closure(1, 0.1, 0.1, 0.9512, (0.945, 0.955), "")) == "95.1 %"
    assert closed(Closure(1, 0.1, 0.1, 1.00021, (0.9997, 1.0007), "")) == "100.02 %"
    assert closed_interval(Closure(1, 2, 0.1, -0.5, (-0.6, -0.4), "")) == "−60 to −40 %"
    assert closed(Closure(0.1, 0.1, 0.1, None, None, "")) == "no gap to close"


def test_ranges_have_two_digits_of_their_length():
    assert span_text((97.04, 220.0)) == "97 to 220"
    assert span_text((80.2, 1000.0)) == "80 to 1000"
    assert span_text((0.5822, 1.32)) == "0.58 to 1.32"


def test_long_record_names_are_shortened_only_where_they_stay_different():
    ids = ["a", "x" * 20 + "-first-" + "y" * 20, "x" * 20 + "-second-" + "y" * 20, "specimen " + "z" * 40]
    short = short_ids(ids)
    assert short["a"] == "a"
    assert short[ids[1]] == ids[1]
    assert len(short[ids[3]]) <= 30
    assert len(set(short.values())) == 4


def test_parameters_of_a_combination_stand_under_their_effects_with_the_record_of_a_fault():
    def parameter(effect, name, records, value):
        return CauseParameter(effect, name, "MPa", records, value, 0.1)

    every = ("ramp-0.001", "ramp-0.003", "ramp-0.006", "dwell", made_up.LONG)
    pair = Explanation(
        effects=("force_offset", "prestress"),
        titles=("offset of the force", "prestress"),
        forms=("constant", "relaxing"),
        records=every,
        probability=0.5,
        parameters=(
            parameter("prestress", "stress_MPa", every, 2.0),
            parameter("prestress", "start_MPa", every, 1.0),
            parameter("force_offset", "offset_MPa", ("dwell",), 3.0),
        ),
    )
    assert parameter_lines(pair, made_up.self_heating()) == [
        "prestress:",
        "stress 2.00 ± 0.10 MPa",
        "start 1.00 ± 0.10 MPa",
        "offset of the force, in dwell:",
        "offset 3.00 ± 0.10 MPa",
    ]
    alone = replace(pair, parameters=pair.parameters[:2])
    assert parameter_lines(alone, made_up.self_heating()) == ["stress 2.00 ± 0.10 MPa", "start 1.00 ± 0.10 MPa"]


def test_a_list_of_explanations_names_each_once_and_brackets_combinations():
    sets = [("unknown",), ("unknown", "volume_change"), ("volume_change",), ("unknown",)]
    unknown = "an effect outside the catalogue"
    assert choices(sets) == f"{unknown}, (change of volume and {unknown}) or change of volume"


def test_a_chance_near_one_is_no_number_with_an_exponent():
    found = made_up.no_gap()
    text = replace(found, gap=replace(found.gap, p_value=0.998)).summary()
    assert "1e+02" not in text
    assert "here it is more than 99 %" in " ".join(text.split())


@pytest.mark.parametrize(
    ("by_noise", "by_scatter", "text"),
    [
        ({"log_rate": 1e-9, "order": 0.2}, {"log_rate": 1e-4, "order": 0.5}, "with the strain rate"),
        ({"log_rate": 1e-9, "order": 1e-6}, {"log_rate": 0.3, "order": 0.5}, "from record to record"),
        (
            {"log_rate": 1e-9, "temperature": 1e-9},
            {"log_rate": 1e-3, "temperature": 1e-4},
            "with the strain rate or with the temperature",
        ),
    ],
)
def test_a_parameter_is_said_to_follow_only_what_the_scatter_between_records_allows(by_noise, by_scatter, text):
    assert changes_with(Drift("tau_max_s", {}, {}, 1e-9, by_noise, by_scatter, {})) == text


def test_an_explanation_that_leaves_something_is_not_said_to_leave_only_noise():
    best = made_up.self_heating().best
    beyond = replace(best, effects=("self_heating", "unknown"))
    assert "what is left may be noise and the form's error" in checks_text(best)
    assert "what is left may be noise and the form's error" not in checks_text(beyond)


def test_ranges_have_no_negative_zero():
    assert span_text((-1e-5, 0.22)) == "0.00 to 0.22"


def test_without_a_gap_no_parameters_are_shown_since_no_cause_was_fitted():
    """Each is weighed from an amplitude of zero: "0.00 ± 0.12 MPa" and "at its lower bound" would say otherwise."""
    fitted = made_up.self_heating()
    starred = tuple(each.effects for each in fitted.explanations)
    table, _ = which_table(replace(fitted, answer_set=starred))
    assert "its parameters" in table.headings
    table, _ = which_table(replace(made_up.no_gap(), answer_set=starred))
    assert "its parameters" not in table.headings
