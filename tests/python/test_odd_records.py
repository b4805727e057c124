"""Records that are valid and odd: an answer or one line that names the record, and no warning of numpy's.

Warnings fail the suite, so that a test which passes has seen none.
"""

import numpy as np
import pytest

import probation
from probation import Campaign, Law, Record, calibrate_companion, certify, diagnose, excite, fit
from probation.effects.maxwell_element import maxwell_element

COUNT = 60
RATE = 5e-3


def response(time, strain, tau_max=5.0, noise=0.05):
    law = Law(unrelaxed_modulus=3000.0, tau_max=tau_max, hardening_modulus=2.5)
    return law.stress(time, strain, scheme="sa3") + noise * np.random.default_rng(3).standard_normal(len(time))


def record(kind, name="odd"):
    """One ramp, made odd in one way."""
    time = np.linspace(0.0, 200.0, COUNT)
    strain = RATE * time
    stress = response(time, strain)
    if kind == "no stress":
        stress = np.zeros(COUNT)
    elif kind == "constant stress":
        stress = np.full(COUNT, 5.0)
    elif kind == "no strain":
        strain = np.zeros(COUNT)
    elif kind == "constant strain":
        strain = np.full(COUNT, 0.1)
    elif kind == "strain 4":
        strain = 4.0 * time / 200.0
        stress = response(time, strain)
    elif kind == "strain 1e-9":
        strain = 1e-9 * time / 200.0
        stress = 3000.0 * strain
    elif kind == "1e-12 1/s":
        time, stress = strain / 1e-12, response(time, strain)
    elif kind == "1e4 1/s":
        time, stress = strain / 1e4, response(time, strain)
    elif kind == "no noise":
        stress = response(time, strain, noise=0.0)
    elif kind == "much noise":
        stress = stress + 500.0 * np.random.default_rng(4).standard_normal(COUNT)
    elif kind == "compressed":
        strain = -strain
        stress = response(time, strain)
    return Record(name, time, strain, stress, control="strain-rate")


def usual(name="usual"):
    time = np.linspace(0.0, 1000.0, COUNT)
    return Record(name, time, 1e-3 * time, response(time, 1e-3 * time), control="strain-rate")


USES = {
    "fit": lambda odd: fit(Campaign("x", (odd,))),
    "certify": lambda odd: certify(Campaign("x", (usual(), odd))),
    "companion": lambda odd: calibrate_companion(Campaign("x", (odd, usual()))),
    "diagnose": lambda odd: diagnose(Campaign("x", (odd,))),
    "crosscheck": lambda odd: probation.crosscheck(
        [odd], Law(unrelaxed_modulus=3000.0, tau_max=5.0, hardening_modulus=2.5)
    ),
}
ANSWERED = (
    "constant stress",
    "strain 4",
    "strain 1e-9",
    "1e-12 1/s",
    "1e4 1/s",
    "no noise",
    "much noise",
    "compressed",
)

UNINFORMED = ("much noise", "strain 1e-9")
"""Of a relaxation time."""


@pytest.mark.parametrize("kind", ["no stress", "no strain", "constant strain"])
@pytest.mark.parametrize("use", ["fit", "certify", "companion", "diagnose"])
def test_a_record_that_says_nothing_of_a_law_is_refused_by_name(use, kind):
    with pytest.raises(probation.InputError, match=r"^record 'odd': found a "):
        USES[use](record(kind))


@pytest.mark.parametrize("kind", ANSWERED)
@pytest.mark.parametrize("use", ["fit", "certify", "diagnose", "crosscheck"])
def test_an_odd_record_has_an_answer(use, kind):
    found = USES[use](record(kind))
    assert "nan" not in found.summary().lower()
    assert found.to_json()


@pytest.mark.parametrize("kind", [each for each in ANSWERED if each not in UNINFORMED])
def test_an_odd_record_is_calibrated_on(kind):
    found = USES["companion"](record(kind))
    assert "nan" not in found.summary().lower()


@pytest.mark.parametrize("kind", UNINFORMED)
def test_a_record_that_knows_no_relaxation_time_is_not_calibrated_on(kind):
    with pytest.raises(probation.InputError, match=r"^record 'odd': found no information on tau_max"):
        USES["companion"](record(kind))


@pytest.mark.parametrize("kind", [*ANSWERED, "no strain", "constant strain"])
def test_an_odd_record_has_a_rate(kind):
    assert np.all(np.isfinite(excite(record(kind)).rate))


def test_the_next_test_of_compressed_specimens_is_not_looked_for():
    found = diagnose(Campaign("x", (record("compressed"),)))
    assert found.next_test is None
    assert any("only tension tests are planned" in warning for warning in found.warnings)


def test_an_element_answers_to_what_is_no_strain():
    """A Haward-Thackray strain of 3000 goes through it as 3 does: it is linear."""
    time = np.linspace(0.0, 10.0, 30)
    one = maxwell_element(time, 3.0 * time, 2.0)
    np.testing.assert_allclose(maxwell_element(time, 3000.0 * time, 2.0), 1000.0 * one, rtol=1e-12)
