"""Readings that are none: spikes of a logger, gaps that were filled with a number; and coarse ones."""

from dataclasses import replace

import numpy as np
import pytest

import probation
from probation.records.as_tested import as_tested
from probation.records.noise import stress_noise
from probation.records.without_glitches import without_glitches

LAW = probation.Law(unrelaxed_modulus=1400.0, tau_max=25.0, hardening_modulus=4.0)
NOISE = 0.06


def record(strain, time, seed=1):
    random = np.random.default_rng(seed)
    stress = LAW.stress(time, strain, "exact") + NOISE * random.standard_normal(len(time))
    return probation.Record(id="pull", time=time, true_strain=strain, true_stress=stress)


def pull(count=300):
    time = np.linspace(0.0, 200.0, count)
    return record(0.002 * time, time)


def with_readings(one, wrong, field="true_stress"):
    values = getattr(one, field).copy()
    for index, value in wrong.items():
        values[index] = value
    return replace(one, **{field: values})


@pytest.mark.parametrize(
    ("wrong", "field"),
    [
        ({77: 99999.0}, "true_stress"),
        ({77: 300.0}, "true_stress"),
        ({77: -9999.0, 78: -9999.0}, "true_stress"),
        ({150: 0.0, 200: 0.0, 201: 0.0}, "true_stress"),
        ({299: -9999.0, 150: 0.0}, "true_stress"),
        ({220: 0.0}, "true_strain"),
    ],
    ids=["spike", "small spike", "two sentinels", "filled with 0", "at the end", "a strain of 0"],
)
def test_a_wrong_reading_is_left_out_and_said(wrong, field):
    sound = pull()
    cleaned, said = without_glitches(with_readings(sound, wrong, field))
    kept = np.delete(np.arange(len(sound)), list(wrong))
    assert np.array_equal(cleaned.time, sound.time[kept])
    assert np.array_equal(getattr(cleaned, field), getattr(sound, field)[kept])
    assert f"at {sound.time[min(wrong)]:.6g}" in said
    assert said.endswith(f"{len(wrong)} sample{'s were' if len(wrong) > 1 else ' was'} left out")


def test_a_spike_is_not_taken_for_a_break_and_the_fit_is_what_it_is_without_it():
    """Of 300 samples 222 went with it once, and 11021 MPa were within the noise."""
    sound = pull()
    spiked = probation.Campaign(name="spiked", records=(with_readings(sound, {77: 99999.0}),))
    (read,) = as_tested(spiked).records
    assert len(read) == len(sound) - 1
    assert len(read.warnings) == 1
    plain = probation.fit(probation.Campaign(name="sound", records=(sound,)))
    found = probation.fit(spiked)
    assert found.law.parameters == pytest.approx(plain.law.parameters, rel=2e-3)
    assert any("taken for no reading" in warning for warning in found.warnings)


def triangle(samples):
    time = np.arange(20.0 * samples)
    return record(0.05 * np.abs((time / samples + 1.0) % 2.0 - 1.0), time)


def steps(every, until=200):
    time = np.arange(until) * every
    return record(0.02 * np.floor(np.arange(until) / 50.0), time)


def relaxed():
    """A step, and samples ever farther apart."""
    time = np.concatenate([[0.0, 1.0], 1.0 + np.geomspace(0.5, 1000.0, 60)])
    return record(np.where(time > 0.5, 0.03, 0.0), time)


def hit():
    """An impact that is over within two samples."""
    time = np.arange(300.0)
    return record(0.05 * np.exp(-0.5 * ((time - 150.0) / 0.6) ** 2), time)


def let_go():
    """A force that is a third of itself for one sample, as of a grip that catches at once."""
    one = pull()
    return with_readings(one, {200: 0.33 * one.true_stress[200]})


def slipped():
    one = pull()
    return with_readings(one, {index: one.true_stress[index] - 10.0 for index in range(150, 300)})


@pytest.mark.parametrize(
    "one",
    [
        *(pull(), pull(30), triangle(3), triangle(5), triangle(20)),
        *(steps(1.0), steps(10.0), steps(30.0), relaxed(), hit(), slipped(), let_go()),
    ],
    ids=[
        *("pull", "few samples", "three to a turn", "five to a turn", "twenty to a turn"),
        *("steps", "long steps", "longer steps", "relaxation", "impact", "slip", "let go"),
    ],
)
def test_what_a_specimen_does_is_no_glitch(one):
    cleaned, said = without_glitches(one)
    assert cleaned is one
    assert not said
    noiseless = replace(one, true_stress=LAW.stress(one.time, one.true_strain, "exact"))
    assert without_glitches(noiseless)[0] is noiseless


def test_a_record_of_few_samples_keeps_them_all():
    few = with_readings(pull(10), {5: 999.0})
    assert without_glitches(few)[0] is few


def test_what_happens_often_is_not_by_accident():
    one = pull()
    often = with_readings(one, dict.fromkeys(range(20, 290, 20), 99.0 * float(np.max(one.true_stress))))
    assert without_glitches(often)[0] is often


def test_the_steps_of_coarse_readings_are_noise():
    """Between steps of 0.5 MPa most readings lie on the line of their neighbours: 2e-5 MPa were the noise once."""
    one = pull()
    coarse = replace(one, true_stress=0.5 * np.round(LAW.stress(one.time, one.true_strain, "exact") / 0.5))
    assert stress_noise(coarse) == pytest.approx(0.5 / np.sqrt(12.0), rel=0.3)
    assert stress_noise(one) == pytest.approx(NOISE, rel=0.2)
    assert stress_noise(replace(coarse, noise=probation.Noise(stress_MPa=0.02))) == 0.02
