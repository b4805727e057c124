"""Screens of all effects, and laws that are not the engine's."""

import math
from dataclasses import replace

import numpy as np
import pytest

import probation
from probation.effects.cause import cause
from probation.effects.record_view import views_of
from probation.effects.registry import effect, effects
from probation.inference.callable_law import CallableLaw, maxwell_bar
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.inference.screen import screen
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel
from probation.records.record import Noise, Record

LAW = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
RATES = (1e-3, 5e-3, 2e-2)


def campaign(stress=None, samples=200):
    records = []
    for rate in RATES:
        time = np.linspace(0.0, 1.2 / rate, samples)
        strain = rate * time
        values = LAW.stress(time, strain) if stress is None else stress(time, strain)
        records.append(
            Record(id=f"at-{rate:g}", time=time, true_strain=strain, true_stress=values, noise=Noise(0.04, 0.0))
        )
    return probation.Campaign(name="ramps", records=tuple(records))


MODEL = CampaignModel(DnlrLaw(LAW), views_of(campaign()))


def test_columns_of_a_screen_are_the_jacobians_at_amplitude_zero():
    for column in screen(MODEL, MODEL.start, effects(["damage", "prestress", "machine_compliance", "self_heating"])):
        extended = MODEL.with_causes([column.cause])
        slope = extended.jacobian(extended.parameters(MODEL.start, column.values))[:, 3]
        assert np.linalg.norm(slope[column.rows] - column.slope) < 1e-3 * np.linalg.norm(slope)
        outside = np.delete(slope, np.arange(len(slope))[column.rows])
        assert np.all(outside == 0.0)


def test_a_screen_stands_on_the_effects_that_are_there():
    """A gain on top of an offset is the recorded stress with the offset in it."""
    offset = MODEL.with_causes([cause("force_offset")])
    parameters = offset.parameters(MODEL.start, (2.0,))
    column = screen(offset, parameters, [effect("force_gain")])[0]
    np.testing.assert_allclose(column.slope, offset.residual(parameters) + offset.data, rtol=1e-9, atol=1e-9)


def test_a_screen_has_every_form_in_every_place_it_may_sit():
    columns = screen(MODEL, MODEL.start, effects())
    placed = {(column.cause.effect.name, column.cause.form.name, column.cause.records) for column in columns}
    for each in effects():
        for form in each.forms:
            where = each.placements(form) if form.visible_in(MODEL.views) else ()
            assert ((each.name, form.name, None) in placed) == ("all" in where)
            for rate in RATES:
                assert ((each.name, form.name, (f"at-{rate:g}",)) in placed) == ("one" in where)
    assert all(np.all(np.isfinite(column.slope)) for column in columns)


def test_threads_make_the_same_screen():
    chosen = effects(["self_heating", "grip_slip", "spectrum_shape"])
    one, two = (screen(MODEL, MODEL.start, chosen, threads=threads) for threads in (1, 2))
    for a, b in zip(one, two, strict=True):
        np.testing.assert_array_equal(a.slope, b.slope)


def test_with_one_record_all_and_one_are_the_same_and_given_once():
    single = CampaignModel(DnlrLaw(LAW), MODEL.views[:1])
    columns = screen(single, single.start, effects(["force_offset", "grip_slip"]))
    assert [c.cause.records for c in columns if c.cause.form.name == "constant"] == [None]
    slips = {c.cause.form.name: c.cause.records for c in columns if c.cause.effect.name == "grip_slip"}
    here = ("at-0.001",)
    anywhere = ("recorded_section", "measured_section", "creeping", "creeping_with_pull")
    assert slips == {**dict.fromkeys(anywhere, here), "progressive": None}


def test_residuals_tell_where_nonlinear_parameters_begin():
    """A wave of 0.0123 Hz in one record and a slip at 0.62 of another: the starts lie beside them."""
    wave, slip = cause("periodic_disturbance", "stress", "at-0.001"), cause("grip_slip", None, "at-0.005")
    truth = MODEL.with_causes([wave, slip])
    parameters = truth.parameters(MODEL.start, (0.3, 0.0123, 1.0), (0.01, 0.62, 0.0))
    residual = MODEL.residual(MODEL.start) - (truth.residual(parameters) - MODEL.residual(MODEL.start))
    columns = screen(MODEL, MODEL.start, [wave.effect, slip.effect], residual=residual)
    frequencies = [c.values[1] for c in columns if c.cause.effect is wave.effect and c.cause.records == wave.records]
    assert frequencies[0] == pytest.approx(0.0123, rel=0.02)
    instants = [c.values[1] for c in columns if c.cause.effect is slip.effect and c.cause.records == slip.records]
    assert min(abs(instant - 0.62) for instant in instants[19:]) < 0.02


def test_a_quietened_record_drives_a_compliant_machine_without_its_noise():
    """A dwell of a law with a companion relation: noise handed back to the strain would count as straining and let the
    stress relax. With it taken off, the prediction is that of the noise-free record, and the gap of 1 MPa is kept."""
    law = probation.Law(
        unrelaxed_modulus=3220.0, hardening_modulus=1.8, companion=probation.Weissenberg(0.00464, 0.0367)
    )
    time = np.linspace(0.0, 400.0, 800)
    strain = np.interp(time, [0.0, 100.0, 400.0], [0.0, 0.5, 0.5])
    clean = law.stress(time, strain) + 1.0 * np.sin(2.0 * np.pi * time / 400.0)
    noisy = clean + 0.04 * np.random.default_rng(0).standard_normal(800)
    found = []
    for stress in (clean, noisy):
        each = Record(
            id="dwell", time=time, true_strain=strain, true_stress=stress, control="strain-rate", noise=Noise(0.04, 0.0)
        )
        views = views_of(probation.Campaign(name="dwell", records=(each,)))
        model = CampaignModel(DnlrLaw(law), views, [cause("machine_compliance")])
        at = model.parameters(law.parameters, (1e-4,))
        quiet = model.quietened(model.start)
        found.append((model.predict(at)["dwell"], quiet.predict(at)["dwell"], quiet.views[0].nominal_data))
    (raw, _, nominal), (loud, soft, soft_nominal) = found
    assert np.max(np.abs(loud - raw)) > 1.0
    assert np.max(np.abs(soft - raw)) < 0.1
    assert np.sqrt(np.mean((soft_nominal - nominal) ** 2)) < 0.02


@pytest.mark.parametrize("seed", range(5))
def test_noise_alone_is_handed_back_to_no_strain_but_a_gap_and_a_specimen_of_its_own_are(seed):
    """Of a stiff law the slow part of the noise, times the modulus, is most of what a compliant machine does that the
    law does not do itself: a null of eight records was a gap with p = 6e-12, along what its own noise had made."""
    law = probation.Law(unrelaxed_modulus=2800.0, tau_max=57.0, hardening_modulus=0.6)
    time = np.linspace(0.0, 100.0, 300)
    clean = law.stress(time, 9e-4 * time)
    noise = 0.1 * np.random.default_rng(seed).standard_normal(300)
    level = NoiseModel.stationary("ramp", Arma(innovation=0.1), 300)
    specimen = replace(level, specimen=0.03 * clean[:, None])
    gap, stiffer = 0.5 * np.sin(2.0 * np.pi * time / 100.0), 1.04 * clean

    def handed_back(stress, noises):
        each = Record(id="ramp", time=time, true_strain=9e-4 * time, true_stress=stress, control="strain-rate")
        model = CampaignModel(DnlrLaw(law), views_of(probation.Campaign(name="ramp", records=(each,))))
        return model.quietened(model.start, noises).views[0].quiet_stress

    assert np.max(np.abs(handed_back(clean + noise, ()) - clean)) > 0.04
    assert np.max(np.abs(handed_back(clean + noise, [level]) - clean)) < 0.02
    assert np.max(np.abs(handed_back(clean + gap + noise, [level]) - clean - gap)) < 0.15
    assert np.max(np.abs(handed_back(stiffer + noise, [specimen]) - stiffer)) < 0.05


def test_a_planned_test_takes_other_data():
    view = MODEL.views[0].with_data(np.ones(200))
    assert np.all(view.data == 1.0)
    np.testing.assert_allclose(view.nominal_data, np.exp(-view.true_strain))
    with pytest.raises(probation.InputError, match=r"found data of shape \(5,\), expected \(200,\)"):
        view.with_data(np.ones(5))


def test_a_threshold_begins_at_the_largest_force_recorded():
    """The secant's amplitude is one over a nominal stress just below the record's largest."""
    columns = screen(MODEL, MODEL.start, [effect("force_saturation")])
    largest = max(np.max(view.nominal_data) for view in MODEL.views)
    assert columns[0].cause.records is None
    assert columns[0].values == (pytest.approx(1.0 / (0.995 * largest)),)
    assert np.max(columns[0].slope) <= 0.0
    assert np.min(columns[0].slope) < 0.0


def test_a_python_function_is_put_on_probation_by_the_same_machinery():
    """A Maxwell bar: its closed form on a ramp, its sensitivities, and the effects that it can follow."""
    bar = maxwell_bar(modulus=800.0, relaxation_time=12.0)
    model = CampaignModel(bar, MODEL.views, [cause("force_offset", records="at-0.005")])
    assert model.parameter_names == ("modulus_MPa", "relaxation_time_s", "force_offset[at-0.005].offset_MPa")
    parameters = model.parameters(bar.start, (0.4,))
    view = model.views[1]
    stress = -800.0 * 5e-3 * 12.0 * np.expm1(-view.time / 12.0)
    recorded = model.predict(parameters)["at-0.005"]
    np.testing.assert_allclose(recorded, stress + 0.4 * np.exp(view.true_strain), rtol=1e-10, atol=1e-10)
    rows = model.rows("at-0.005")
    slopes = model.jacobian(parameters)[rows]
    np.testing.assert_allclose(slopes[:, 0], stress / 800.0, rtol=1e-6, atol=1e-9)
    by_time = -800.0 * 5e-3 * (np.expm1(-view.time / 12.0) + view.time / 12.0 * np.exp(-view.time / 12.0))
    np.testing.assert_allclose(slopes[:, 1], by_time, rtol=1e-5, atol=1e-7)
    np.testing.assert_allclose(slopes[:, 2], np.exp(view.true_strain), rtol=1e-7)


def test_a_law_is_asked_only_for_what_it_can_follow():
    bar = maxwell_bar()
    model = CampaignModel(bar, MODEL.views)
    screened = {column.cause.effect.name for column in screen(model, model.start, effects())}
    assert {"force_offset", "machine_compliance", "damage", "structural_softening"} <= screened
    assert not screened & {"self_heating", "spectrum_shape", "rate_dependent_relaxation", "prestress"}
    with pytest.raises(probation.InputError, match="self_heating: the law does not understand feedbacks"):
        model.with_causes([cause("self_heating")])


def test_a_maxwell_bar_ages_and_is_damaged():
    """Times beyond the record: the integral of E exp(a e^(-e/0.1)), times the area left at a strain of 1.2."""
    bar = maxwell_bar(modulus=800.0, relaxation_time=1e8)
    causes = [cause("structural_softening", "modulus"), cause("damage", "growing")]
    model = CampaignModel(bar, MODEL.views, causes)
    found = model.predict(model.parameters(bar.start, (0.3, 0.1), (0.2, 1.0)))["at-0.005"]
    strain = np.linspace(0.0, 1.2, 200_001)
    stress = 800.0 * np.trapezoid(np.exp(0.3 * np.exp(-strain / 0.1)), strain)
    assert found[-1] == pytest.approx(math.exp(-0.24) * stress, rel=2e-4)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"starts": (1.0, 2.0)}, r"starts has 2 entries"),
        ({"starts": (-1.0,)}, r"k: found the start -1.0"),
        ({"capabilities": frozenset({"colour"})}, r"capabilities: found \['colour'\]"),
    ],
)
def test_a_badly_described_function_is_refused(changed, message):
    described = {
        "function": lambda time, strain, parameters, modification: parameters[0] * strain,
        "names": ("k",), "starts": (1.0,), "lower": (0.0,), "upper": (9.0,),
    }  # fmt: skip
    with pytest.raises(probation.InputError, match=message):
        CallableLaw(**(described | changed))


def test_a_function_that_gives_no_stress_is_told_so():
    law = CallableLaw(lambda time, strain, parameters, modification: strain[:5], ("k",), (1.0,), (0.0,), (9.0,))
    with pytest.raises(probation.InputError, match=r"function\(time, true_strain, …\) has 5 samples; expected 200"):
        law.stress(MODEL.views[0], law.start)


def test_what_was_recorded_is_smoothed_once_whatever_the_specimen_saw():
    """A view of another strain has the same force: the same array."""
    view = MODEL.views[0]
    other = view.quietened(view.true_strain).driven(0.8 * view.true_strain)
    assert other.smooth_nominal_data is view.smooth_nominal_data
    assert view.with_data(2.0 * view.data).driven(view.true_strain).smooth_nominal_data[-1] == pytest.approx(
        2.0 * view.smooth_nominal_data[-1], rel=0.05
    )
