"""Engineering stress or strain under the heading of a true one: the commonest mistake, and no damage."""

from dataclasses import replace

import numpy as np
import pytest

from campaigns.few_records import damage, few_records
from probation import ConvergenceError
from probation.diagnosis.diagnose import diagnose


def engineering(record, column):
    """The same with one column as a machine's program writes it."""
    if column == "stress":
        return replace(record, true_stress=record.true_stress * np.exp(-record.true_strain))
    return replace(record, true_strain=np.expm1(record.true_strain))


def asked(campaign):
    found = diagnose(campaign, effects=["damage"], design=False, threads=1)
    return [warning for warning in found.warnings if "engineering" in warning]


@pytest.mark.parametrize("column", ["stress", "strain"])
def test_a_column_that_another_measure_explains_is_asked_for_first(column):
    campaign = few_records()
    wrong = replace(campaign, records=tuple(engineering(record, column) for record in campaign.records))
    found = diagnose(wrong, effects=["damage"], design=False, threads=1)
    assert found.verdict != "no_gap"
    assert found.warnings[0].startswith(f"is the {column} engineering {column}?")
    assert f'"engineering_{column}"' in found.warnings[0]


@pytest.mark.parametrize("fault", [None, damage(0.05), damage(0.3)], ids=["nothing", "damage", "more of it"])
def test_other_faults_are_not_asked_about(fault):
    assert not asked(few_records(fault))


def test_a_law_that_cannot_be_solved_there_asks_nothing(monkeypatch):
    def unsolvable(*_):
        raise ConvergenceError("no solution")

    monkeypatch.setattr("probation.diagnosis.other_measure.refit", unsolvable)
    assert not asked(few_records(damage(0.05)))
