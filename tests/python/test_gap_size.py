"""How large a gap is beside the stress: below a tolerance it does not matter, and no cause is named."""

import json

import pytest

from campaigns.few_records import few_records, offset
from probation import InputError, diagnose
from probation.identify.fit import gap_of


@pytest.fixture(scope="module")
def small():
    """0.03 MPa in one of four records of 30 to 45 MPa; the noise is 0.01 MPa."""
    return diagnose(few_records(offset(0.03, "middle"), noise=0.01), design=False)


def test_a_gap_that_does_not_matter_is_said_to_and_no_cause_is_named(small):
    assert small.verdict == "explained"
    assert small.gap.p_value < 1e-6
    assert not small.matters
    assert small.headline.startswith("A gap that does not matter: ")
    assert "force" not in small.headline
    assert "so that it does not matter" in " ".join(small.summary().split())


def test_the_cause_stays_in_the_answer(small):
    answer = json.loads(small.to_json())
    assert answer["causes"][0]["effects"] == ["force_offset"]
    size = answer["gap"]["size"]
    assert size["matters"] is False
    assert size["tolerance"] == 0.001
    assert size["relative"] < size["relative_interval95"][1] < 0.001
    assert size["of_certificate_tolerance"] == pytest.approx(size["relative"] / 0.05)


def test_with_a_smaller_tolerance_it_matters():
    found = diagnose(few_records(offset(0.03, "middle"), noise=0.01), tolerance=1e-4, design=False)
    assert found.matters
    assert "offset of the force" in found.headline.lower()


@pytest.mark.parametrize("tolerance", [0.0, -0.01])
def test_a_tolerance_is_positive(tolerance):
    with pytest.raises(InputError, match="a positive fraction of the largest stress"):
        diagnose(few_records(), tolerance=tolerance)


def test_a_gap_has_the_size_that_was_put_in():
    """2 MPa over the initial section of a record that is not fitted, so that no parameter takes up a part of it."""
    found = gap_of(few_records(offset(2.0, "middle"), held_out=("middle",)))
    size = found.sizes["middle"]
    assert size.rms_MPa == pytest.approx(4.09, rel=0.01)  # 2 MPa times the root mean square of the stretch
    assert size.interval_MPa[0] < size.rms_MPa < size.interval_MPa[1]
    assert size.interval_MPa[1] - size.interval_MPa[0] < 0.1 * size.rms_MPa
    assert found.size == size


def test_the_interval_holds_what_is_there_when_nothing_is():
    """0 lies in all of 20 intervals of 95 % of 5 nulls, but for one or two."""
    sizes = [size for seed in range(5) for size in gap_of(few_records(seed=seed)).sizes.values()]
    assert sum(size.interval_MPa[0] > 0.0 for size in sizes) <= 2
