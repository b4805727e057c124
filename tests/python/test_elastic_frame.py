"""The force that a frame and a specimen share."""

import numpy as np
import pytest

import probation
from probation.effects.cause import Cause
from probation.effects.large_forms import with_large_forms
from probation.effects.record_view import views_of
from probation.effects.registry import effects
from probation.inference.elastic_frame import ElasticFrame
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.inference.own_force import OwnForce
from probation.inference.screen import screen

LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=4.0, hardening_modulus=1.5)
COMPLIANCE = 0.01
TIME = np.concatenate([np.linspace(0.0, 5.0, 150, endpoint=False), np.linspace(5.0, 60.0, 250)])
TRAVEL = 0.4 * TIME / TIME[-1]


def stress_left(stress):
    """The law's stress of what a stress leaves of the travel to the specimen."""
    return LAW.stress(TIME, TRAVEL - COMPLIANCE * stress, "sa2")


def frame_at(stress):
    strain = TRAVEL - COMPLIANCE * stress
    return ElasticFrame.of(
        TIME, strain, np.full(len(TIME), -COMPLIANCE), lambda step: LAW.stress(TIME, strain + step, "sa2")
    )


def answer_about(_):
    return frame_at(np.zeros(len(TIME))).answer


def test_the_relaxation_is_read_off_the_law():
    frame = frame_at(np.zeros(len(TIME)))
    since = np.geomspace(0.2, 50.0, 30)
    read = np.exp(-since[:, None] / frame.relaxation_time) @ frame.modulus
    modes = LAW.spectrum
    expected = 1500.0 * np.exp(-since[:, None] / (4.0 * modes.relaxation_ratio)) @ modes.modal_weight
    hardening = 1.5 * 6.0  # d(e^2x - e^-x)/dx is 3 at no strain and 5.1 at 0.4
    assert np.max(np.abs(read - expected)) < 0.02 * expected[0] + hardening


def test_the_force_is_the_same_with_and_without_a_linear_specimen_and_takes_a_third_of_the_solves():
    solved, found = [], []
    for about in (lambda _: np.asarray, answer_about):
        count = 0

        def counted(stress):
            nonlocal count
            count += 1
            return stress_left(stress)

        start = LAW.stress(TIME, 0.5 * TRAVEL, "sa2")
        found.append(OwnForce(counted, start, about, settled=1e-4).stress)
        solved.append(count)
    left = np.abs(stress_left(found[1]) - found[1])
    assert np.max(left) < 2e-4 * np.max(found[1])
    assert found[0] == pytest.approx(found[1], abs=2e-3 * np.max(found[1]))
    assert solved[1] < solved[0] / 3


def test_the_answer_to_a_change_is_its_derivative():
    def with_modulus(modulus):
        law = probation.Law(unrelaxed_modulus=modulus, tau_max=4.0, hardening_modulus=1.5)

        def stress(y):
            return law.stress(TIME, TRAVEL - COMPLIANCE * y, "sa2")

        return stress, OwnForce(stress, LAW.stress(TIME, 0.5 * TRAVEL, "sa2"), answer_about)

    _, here = with_modulus(1500.0)
    more, above = with_modulus(1515.0)
    less, below = with_modulus(1485.0)
    slope = here.answer((more(here.stress) - less(here.stress)) / 30.0)
    assert slope == pytest.approx((above.stress - below.stress) / 30.0, rel=2e-3, abs=1e-6)


def test_a_frame_answers_to_a_hundredth_also_where_the_section_follows_from_its_strain():
    """The true stress is made with the recorded strain, of which a part is the frame's: it grows with that part."""

    def recorded(stress):
        return np.exp(COMPLIANCE * stress) * stress_left(stress)

    def about(stress):
        give = np.full(len(TIME), -COMPLIANCE)
        strain = TRAVEL - COMPLIANCE * stress
        return ElasticFrame.of(
            TIME,
            strain,
            give,
            lambda step: LAW.stress(TIME, strain + step, "sa2"),
            conversion=COMPLIANCE * stress,
            growth=COMPLIANCE * stress,
        ).answer

    own = OwnForce(recorded, LAW.stress(TIME, 0.5 * TRAVEL, "sa2"), about)
    change = 0.01 * own.stress
    answer = own.answer(change)
    missed = np.max(np.abs(about(own.stress)(change) - answer))
    assert missed < 0.01 * np.max(answer)
    assert missed < 0.2 * np.max(np.abs(frame_at(own.stress).answer(change) - answer))


def test_an_answer_is_the_same_whatever_was_asked_for_before():
    """What one answer has found is kept for the next; the last one begins anew, with as much as is kept."""
    own = OwnForce(stress_left, LAW.stress(TIME, 0.5 * TRAVEL, "sa2"), answer_about)
    asked = [np.sin((1.0 + k) * TIME / TIME[-1]) for k in range(12)]
    fresh = [OwnForce(stress_left, own.stress, answer_about).answer(each, 1e-6) for each in asked]
    for each, alone in zip(asked, fresh, strict=True):
        assert own.answer(each, 1e-6) == pytest.approx(alone, abs=1e-4 * float(np.max(np.abs(alone))))


def test_behind_a_soft_frame_a_screen_sees_other_effects_as_the_model_does():
    """Derivatives along amplitudes that change the force by less than it is sought to."""
    own = LAW.stress(TIME, 0.5 * TRAVEL, "sa2")
    record = probation.Record(id="soft", time=TIME, true_strain=TRAVEL, true_stress=own)
    views = views_of(probation.Campaign(name="one", records=(record,)), scheme="sa2")
    (compliance,) = with_large_forms(effects(["machine_compliance"]), views)
    soft = CampaignModel(DnlrLaw(LAW), views, [Cause(compliance, compliance.form("large_crosshead"))])
    at = soft.parameters(LAW.parameters, [COMPLIANCE])
    known = effects(["damage", "rate_dependent_relaxation", "prestress", "delayed_hardening"])
    columns = [each for each in screen(soft, at, known) if not each.cause.form.threshold]
    assert {each.cause.effect.name for each in columns} == {each.name for each in known}
    for column in columns:
        size = 20.0 * column.cause.form.amplitude.step(0.0)
        both = soft.with_causes([*soft.causes, column.cause])
        moved = both.residual(np.concatenate([at, [size, *column.values[1:]]]))
        expected = (moved - soft.residual(at)) / size
        assert column.slope == pytest.approx(expected, abs=0.02 * np.max(np.abs(expected)))
