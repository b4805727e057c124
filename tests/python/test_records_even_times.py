"""Times that were rounded when they were written, of even samples, are what they were."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import probation
from probation import Campaign, Record
from probation.records.even_times import even_times

LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.5)


def record(time):
    part = np.linspace(0.0, 1.0, len(time))
    return Record("r", time, 0.5 * part, 20.0 * part)


@given(
    st.floats(0.3, 0.95),
    st.integers(60, 400),
    st.sampled_from([1.0, 0.1, 0.01]),
    st.sampled_from([0.0, 12.0]),
)
def test_even_times_come_back_to_a_part_of_what_was_rounded(part, count, step, begin):
    """Whatever the sampling interval that a step is coarse for: to half a step over the whole record."""
    true = begin + step / part * np.arange(count)
    rounded = np.round(true / step) * step
    found, note = even_times(record(rounded))
    steps = np.round(np.diff(rounded) / step)
    if min(np.count_nonzero(steps == steps.min()), np.count_nonzero(steps > steps.min())) < 5:
        assert note == ""  # one longer distance may be a row that is missing
        return
    assert note.startswith(f"its times are rounded to {step:g} s; even steps of ")
    assert np.max(np.abs(found.time - true)) < 0.5 * step
    assert np.ptp(np.diff(found.time)) < 1e-9 * true[-1]


def test_times_that_were_not_even_or_not_rounded_stay():
    rng = np.random.default_rng(1)
    uneven = np.round(np.append(0.0, np.cumsum(rng.uniform(0.2, 1.0, 200))), 1)
    a_row_less = np.delete(np.arange(201.0), 120)
    stopped = np.append(np.arange(100.0), 99.5)
    clock = 1.7e9 + np.append(0.0, np.arange(1.0, 200.0) + rng.uniform(-0.3, 0.3, 199))
    free = np.cumsum(rng.uniform(0.2, 1.0, 200))
    for time in (uneven, 0.37 * np.arange(200), free, np.arange(200.0), a_row_less, stopped, clock):
        found, note = even_times(record(time))
        assert note == ""
        assert found.time.tolist() == time.tolist()


def test_rounded_times_are_no_gap_of_specimens_that_differ():
    """To 0.1 s, a third of the sampling interval: it was rate-dependent relaxation (86 %)."""
    rng = np.random.default_rng(42)
    records = []
    for index, rate in enumerate((8e-4, 2.5e-3, 8e-3)):
        time = np.linspace(0.0, 0.5 / rate, 200)
        stress = LAW.stress(time, rate * time) * (1.0 + 0.01 * rng.standard_normal())
        noisy = stress + 0.05 * rng.standard_normal(200)
        records.append(Record(f"r{index}", np.round(time, 1), rate * time, noisy))
    found = probation.diagnose(Campaign("rounded", tuple(records)), design=False)
    assert found.verdict == "no_gap"
    assert any(warning.startswith("r2: its times are rounded to 0.1 s") for warning in found.warnings)
