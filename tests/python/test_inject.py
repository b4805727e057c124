"""Faults put into records: what a channel would have read, by hand."""

import ast
from pathlib import Path

import numpy as np
import pytest

from probation_studies.blind import inject as module
from probation_studies.blind.inject import Injection, inject

TIME = np.linspace(0.0, 10.0, 101)
STRAIN = np.log1p(0.02 * TIME)  # a crosshead at constant speed
FORCE = 30.0 * (1.0 - np.exp(-TIME))
STRESS = FORCE * (1.0 + 0.02 * TIME)


def recorded(fault, size):
    time, strain, stress = inject(TIME, STRAIN, STRESS, Injection("a", fault, size))
    return time, np.expm1(strain), stress * np.exp(-strain)


def test_an_offset_and_a_drift_are_added_to_the_force():
    for fault, added in (("force_offset", np.full(101, 2.0)), ("force_drift", 0.2 * TIME)):
        time, elongation, force = recorded(fault, 2.0)
        assert force == pytest.approx(FORCE + added)
        assert elongation == pytest.approx(0.02 * TIME)
        assert np.array_equal(time, TIME)


def test_a_section_that_is_a_twentieth_too_small_makes_all_stress_a_twentieth_too_large():
    assert recorded("force_gain", 0.05)[2] == pytest.approx(1.05 * FORCE)


def test_a_late_force_is_that_of_some_samples_ago():
    force = recorded("force_strain_lag", 0.3)[2]
    assert force[3:] == pytest.approx(FORCE[:-3])
    assert force[:3] == pytest.approx(FORCE[0])


def test_slack_is_travelled_before_the_specimen_sees_anything():
    """At 0.02 per second a slack of 0.01 takes half a second: five samples of no force, then the same test."""
    time, elongation, force = recorded("slack", 0.01)
    assert len(time) == 106
    assert elongation[5:] == pytest.approx(0.02 * TIME + 0.01)
    assert force[5:] == pytest.approx(FORCE)
    assert np.diff(time) == pytest.approx(0.1)
    assert force[:5] == pytest.approx(0.0, abs=0.05)


def test_the_frame_gives_way_in_proportion_to_the_force():
    assert recorded("machine_compliance", 1e-3)[1] == pytest.approx(0.02 * TIME + 1e-3 * FORCE)


def test_an_unknown_fault_is_named():
    with pytest.raises(ValueError, match="found the fault 'gremlin'"):
        inject(TIME, STRAIN, STRESS, Injection("a", "gremlin", 1.0))


def test_the_log_says_what_was_done_with_its_unit():
    assert Injection("a", "slack", 0.01, 7).to_dict() == {
        "record": "a", "fault": "slack", "size": 0.01, "seed": 7, "unit": "",
    }  # fmt: skip


def test_injecting_shares_no_code_with_what_is_tested():
    tree = ast.parse(Path(module.__file__).read_text(encoding="utf-8"))
    imports = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    imports |= {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    assert imports == {"__future__", "dataclasses", "numpy"}
