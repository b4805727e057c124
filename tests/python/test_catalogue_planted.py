"""Effects planted by closed forms or integrations of this file, none of them the catalogue's own, and found again."""

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, solve_ivp

import probation
from probation.comparison.faults import considered
from probation.effects.catalogue.slack_strip import slack_intervals
from probation.effects.record_view import views_of
from probation.effects.registry import effect, effects
from probation.effects.visible import unloads, visible
from probation.law.modification import Modification
from probation.records.record import Noise, Record

LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.5)
SLOW, FAST = 2e-3, 1e-2
LOOPS = ((0.3, 0.22), (0.6, 0.5))
"""Strains from which, and to which, the strain is taken back."""


FINE = 8
"""Instants of the planted law per sample: a scheme's own error is no effect."""


def path(rate, corners):
    """Time and strain along straight pieces at one rate, on `FINE` instants per sample; corners are samples."""
    ends = np.array([0.0, *corners])
    counts = [FINE * max(round(150 * abs(step)), 1) for step in np.diff(ends)]
    strain = np.concatenate(
        [[0.0], *(np.linspace(a, b, n + 1)[1:] for a, b, n in zip(ends[:-1], ends[1:], counts, strict=True))]
    )
    return np.append(0.0, np.cumsum(np.abs(np.diff(strain)))) / rate, strain


def noisy(stress, seed):
    return stress + 0.04 * np.random.default_rng(seed).standard_normal(len(stress))


def record(name, time, strain, stress, seed, temperature=None):
    """Every `FINE`-th instant with noise, and with the temperature."""
    return Record(
        id=name,
        time=time[::FINE],
        true_strain=strain[::FINE],
        true_stress=noisy(stress[::FINE], seed),
        temperature=None if temperature is None else temperature[::FINE],
        noise=Noise(0.04, 0.0),
    )


def campaign(records):
    return probation.Campaign(name="planted", records=tuple(records), specimens=probation.Specimens("none"))


def loops(of_record, end=0.9):
    """Three rates, each with two returns; `of_record(law, time, strain)` gives the recorded stress."""
    corners = [*(strain for loop in LOOPS for strain in loop), end]
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, corners)
        made.append(record(f"at-{rate:g}", time, strain, of_record(LAW, time, strain), seed))
    return campaign(made)


def diagnosed(planted):
    return probation.diagnose(planted, design=False)


def named(planted, name, least=0.65):
    """The diagnosis, in which this effect must close nearly all of the gap alone: forms that are not the catalogue's
    leave a little, of which other effects may take their part. Outside what was calibrated evidence counts for less.
    """
    found = diagnosed(planted)
    first = found.effects[0]
    assert (first.name, first.named) == (name, True), found.headline
    assert first.probability > least
    assert first.alone > 0.9
    return found


def value(found, name):
    return next(each.value for each in found.best.parameters if each.name == name)


def largest(strain):
    return np.maximum.accumulate(strain)


def test_a_ripple_of_one_test_is_no_noise():
    """Three times as large as the noise, 17.6 periods: noise of five times its size, without a gap, until it was."""

    def of_record(law, time, strain):
        ripple = 0.12 * np.sin(2.0 * np.pi * 17.6 * time / time[-1]) if time[-1] > 300.0 else 0.0
        return law.stress(time, strain) + ripple

    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.9])
        made.append(replace(record(f"at-{rate:g}", time, strain, of_record(LAW, time, strain), seed), noise=Noise()))
    found = named(campaign(made), "periodic_disturbance")
    assert found.best.records == ("at-0.002",)
    assert found.curves["at-0.002"].noise_MPa == pytest.approx(0.04, rel=0.3)


def test_the_pitch_of_a_screw_is_no_noise():
    """Seven times the noise, once in an elongation of 0.12, at constant true strain rates: noise, until it was."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.9])
        turned = 2.0 * np.pi * np.expm1(strain) / 0.12
        wave = 0.3 * (np.sin(turned + 1.0) + 0.25 * np.sin(2.0 * turned + 0.5)) * np.exp(strain)
        made.append(replace(record(f"at-{rate:g}", time, strain, LAW.stress(time, strain) + wave, seed), noise=Noise()))
    found = named(campaign(made), "periodic_disturbance")
    assert found.best.forms == ("screw_force",)
    assert value(found, "period_elongation") == pytest.approx(0.12, rel=0.01)
    assert abs(value(found, "wave_MPa")) == pytest.approx(0.3, rel=0.1)
    for curve in found.curves.values():
        assert curve.noise_MPa == pytest.approx(0.04, rel=0.3)


def at_constant_speed(of_record):
    """Three speeds of the crosshead; `of_record(time, travel, stress)` gives what is read of travel and stress."""
    made = []
    for seed, speed in enumerate((SLOW, 5e-3, FAST)):
        time = np.linspace(0.0, 1.2 / speed, FINE * 200 + 1)
        travel = speed * time
        read, stress = of_record(time, travel, LAW.stress(time, np.log1p(travel)))
        made.append(record(f"at-{speed:g}", time, np.log1p(read), stress, seed))
    return campaign(made)


def test_a_frame_that_rings_is_a_wave_that_dies_out():
    """From the start of the slowest test on: a twentieth of it long, falling to a third in six periods."""

    def read(time, travel, stress):
        if time[-1] < 500.0:
            return travel, stress
        periods = time / (0.05 * time[-1])
        return travel, stress + 0.4 * np.exp(-periods / 6.0) * np.sin(2.0 * np.pi * periods) * (1.0 + travel)

    found = named(at_constant_speed(read), "periodic_disturbance")
    assert found.best.forms == ("ringing",)
    assert value(found, "lasting_periods") == pytest.approx(6.0, rel=0.2)


def test_mullins_softening():
    """Stress lost by 1 - e^(-x), x the strain below the largest so far over 0.06."""

    def softened(law, time, strain):
        lost = -0.06 * np.expm1((strain - largest(strain)) / 0.06)
        return law.stress(time, strain, modification=Modification(load_bearing_area=1.0 - lost))

    found = named(loops(softened), "mullins_softening")
    assert 0.03 < value(found, "softening") < 0.07


def test_back_stress():
    """Two of Chaboche's terms, each exact on its straight pieces."""

    def chaboche(strain, size, reach):
        held = [0.0]
        for step in np.diff(strain):
            held.append(np.sign(step) * size + (held[-1] - np.sign(step) * size) * np.exp(-abs(step) / reach))
        return np.array(held)

    def stressed(law, time, strain):
        back = chaboche(strain, 0.8, 0.03) + chaboche(strain, 0.4, 0.08)
        return law.stress(time, strain, modification=Modification(added_relaxed_stress=back))

    found = named(loops(stressed), "back_stress")
    assert value(found, "back_stress_MPa") == pytest.approx(1.2, rel=0.3)


def test_back_stress_of_the_plastic_strain():
    """Two of Chaboche's terms along the strain less stress over modulus, the stress being the law's own."""

    def stressed(law, time, strain):
        plastic = strain - law.stress(time, strain) / law.unrelaxed_modulus
        back = np.zeros(len(time))
        for size, reach in ((2.0, 0.02), (2.0, 0.1)):
            held = 0.0
            for index, step in enumerate(np.diff(plastic), start=1):
                held = np.sign(step) * size + (held - np.sign(step) * size) * np.exp(-abs(step) / reach)
                back[index] += held
        return law.stress(time, strain, modification=Modification(added_relaxed_stress=back))

    found = named(loops(stressed), "back_stress")
    assert value(found, "back_stress_MPa") == pytest.approx(4.0, rel=0.4)


def test_flow_that_is_easier_once_the_straining_has_turned():
    """Times shortened by 1 - 0.3/(1 + (p/0.04)^2), p the path since the last corner, as a time that runs faster."""

    def turned(law, time, strain):
        steps = np.diff(strain, prepend=0.0)
        corners = np.flatnonzero(np.diff(np.sign(steps[1:]))) + 1
        length = np.cumsum(np.abs(steps))
        shorter = np.ones(len(time))
        for first, last in pairwise([*corners, len(time)]):
            shorter[first:last] -= 0.3 / (1.0 + ((length[first:last] - length[first]) / 0.04) ** 2)
        own = np.append(0.0, np.cumsum(np.diff(time) * 0.5 * (1.0 / shorter[1:] + 1.0 / shorter[:-1])))
        return law.stress(own, strain)

    found = named(loops(turned), "back_stress")
    assert 0.2 < value(found, "log_time_loss") < 0.6


def test_hysteresis_of_the_load_cell():
    """On the way down an arch over the force, 2 % of the largest one high."""

    def read(law, time, strain):
        force = law.stress(time, strain) * np.exp(-strain)
        top = np.maximum.accumulate(force)
        arch = np.sin(np.pi * np.clip(force / np.maximum(top, 1e-9), 0.0, 1.0))
        return (force + 0.02 * top * arch) * np.exp(strain)

    found = named(loops(read), "cell_hysteresis")
    assert value(found, "reversibility_error") == pytest.approx(0.02, rel=0.4)


def test_friction_of_a_guide_in_both_directions():
    """Bouc and Wen: dz = (1 - |z| (0.7 sgn(z dF) + 0.3)) dF / r, 3 % of the largest force from way to way."""

    def read(law, time, strain):
        force = law.stress(time, strain) * np.exp(-strain)
        largest, slid = float(np.max(force)), [0.0]
        for step in np.diff(force) / (0.15 * largest):
            slid.append(slid[-1] + (1.0 - abs(slid[-1]) * (0.7 * np.sign(slid[-1] * step) + 0.3)) * step)
        return (force - 0.015 * largest * np.array(slid)) * np.exp(strain)

    found = named(loops(read), "cell_hysteresis")
    assert value(found, "reversibility_error") == pytest.approx(0.03, rel=0.4)


def test_a_guide_that_rubs_between_specimen_and_cell():
    """Stribeck's friction, 0.4 MPa at rest and a fifth less while it moves; the last sample before a turn has none."""

    def read(law, time, strain):
        speed = np.gradient(np.expm1(strain), time)
        friction = 0.4 * np.tanh(speed / 1e-5) * (0.8 + 0.2 * np.exp(-((speed / 4e-3) ** 2)))
        return law.stress(time, strain) + friction * np.exp(strain)

    found = named(loops(read), "guide_friction")
    assert 0.3 < value(found, "friction_MPa") < 0.4


def test_a_pull_rod_that_rubs_behind_its_seal():
    """Bouc and Wen: dz = (1 - |z| (0.7 sgn(z dF) + 0.3)) dF / r; 0.6 MPa either way."""

    def read(law, time, strain):
        force = law.stress(time, strain) * np.exp(-strain)
        slid = [0.0]
        for step in np.diff(force) / 0.15:
            part = 1.0 - abs(slid[-1]) * (0.7 * np.sign(slid[-1] * step) + 0.3)
            slid.append(float(np.clip(slid[-1] + part * step, -1.0, 1.0)))
        return (force + 0.6 * np.array(slid)) * np.exp(strain)

    found = named(loops(read), "guide_friction")
    assert found.best.forms == ("with_the_force",)
    assert value(found, "friction_MPa") == pytest.approx(0.6, rel=0.2)


def test_times_that_grow_as_the_chains_turn():
    """By 30 % of themselves per unit of stretch."""

    def slower(law, time, strain):
        growth = 1.0 + 0.3 * np.expm1(strain)
        own = np.append(0.0, np.cumsum(np.diff(time) * 0.5 * (1.0 / growth[1:] + 1.0 / growth[:-1])))
        return law.stress(own, strain)

    found = named(loops(slower), "orientation")
    assert found.best.forms[0].startswith("relaxation_time")


def test_a_modulus_that_grows_as_the_chains_turn():
    """By 6 % of itself per unit of stretch: the memory is linear in the strain that such a modulus makes of it."""

    def stiffer(law, time, strain):
        felt = strain + 0.06 * (np.expm1(strain) - strain)
        network = [law.hardening_modulus * (np.exp(2.0 * e) - np.exp(-e)) for e in (strain, felt)]
        return law.stress(time, felt) + network[0] - network[1]

    found = named(loops(stiffer), "orientation")
    assert found.best.forms[0].startswith("modulus")


def test_a_material_that_goes_on_ageing_while_it_is_tested():
    """Two minutes old at the start, in tests of four to ten minutes that slow down half way: times as its age^0.4."""

    def aged(law, time, strain):
        own = np.cumsum(np.append(0.0, np.diff(time) * (1.0 + 0.5 * (time[1:] + time[:-1]) / 120.0) ** -0.4))
        return law.stress(own, strain)

    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.9])
        time = time + np.where(strain > 0.45, 150.0, 0.0) * np.clip((strain - 0.45) / 0.02, 0.0, 1.0)
        made.append(record(f"at-{rate:g}", time, strain, aged(LAW, time, strain), seed))
    found = named(campaign(made), "ageing")
    assert value(found, "shift_rate") == pytest.approx(0.4, rel=0.2)
    assert value(found, "age_at_start_s") == pytest.approx(120.0, rel=0.4)


def test_a_stiff_specimen_unloads_within_a_hundredth_of_its_strain():
    """From a strain of 0.9 to no force and up again: Mullins softening is considered, and named."""

    def softened(law, time, strain):
        lost = -0.3 * np.expm1((strain - largest(strain)) / 0.01)
        return law.stress(time, strain, modification=Modification(load_bearing_area=1.0 - lost))

    made = []
    for seed, rate in enumerate((SLOW, FAST)):
        time, strain = path(rate, [0.6, 0.585, 0.9, 0.885, 1.0])
        made.append(record(f"at-{rate:g}", time, strain, softened(LAW, time, strain), seed))
    named(campaign(made), "mullins_softening")


def test_a_force_that_relaxes_while_a_noisy_strain_stands_is_no_unloading():
    """The noise takes the strain back by 0.4 %, of 10 % held, while two thirds of the force go."""
    time = np.linspace(0.0, 400.0, 801)
    strain = np.minimum(1e-2 * time, 0.1)
    stress = LAW.stress(time, strain)
    seen = strain + 1e-3 * np.random.default_rng(5).standard_normal(801)
    held = Record(id="hold", time=time, true_strain=seen, true_stress=noisy(stress, 1))
    assert stress[-1] < 0.5 * np.max(stress)
    assert not unloads(views_of(campaign([held])))


def test_a_process_that_relaxes_as_a_power_of_the_time():
    """The Riemann-Liouville integral of the strain rate, exact on straight pieces; ramps and a hold."""

    def stressed(time, strain):
        rate, added = np.diff(strain) / np.diff(time), np.zeros(len(time))
        for k in range(len(rate)):
            since = [np.maximum(time - corner, 0.0) ** 0.6 for corner in (time[k], time[k + 1])]
            added += rate[k] * (since[0] - since[1]) / 0.6
        return LAW.stress(time, strain) + 6.0 * 100.0**0.4 * added

    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.8])
        made.append(record(f"at-{rate:g}", time, strain, stressed(time, strain), seed))
    time = np.linspace(0.0, 800.0, 8 * 250 + 1)
    strain = np.minimum(5e-3 * time, 0.4)
    made.append(record("hold", time, strain, stressed(time, strain), 9))
    found = named(campaign(made), "slow_process")
    assert value(found, "power") == pytest.approx(0.4, abs=0.1)


def test_a_joint_that_seats_itself_far_in_one_record():
    """4 % of travel go into a joint as 1 - (1 - n / 6 MPa)^2 up to a nominal stress of 6 MPa, in one of three ramps."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.8])
        stress = LAW.stress(time, strain)
        part = np.clip(stress * np.exp(-strain) / 6.0, 0.0, 1.0)
        taken = 0.04 * (1.0 - (1.0 - np.maximum.accumulate(part)) ** 2) if seed == 1 else 0.0
        seen = np.log(np.exp(strain) + taken)
        made.append(record(f"at-{rate:g}", time, seen, stress * np.exp(seen - strain), seed))
    found = named(campaign(made), "strain_offset")
    assert found.best.records == ("at-0.005",)


def test_moisture_between_tests():
    """E_u falls by 6 % from each of five tests to the next; rates in no order."""
    made = []
    for index, rate in enumerate((5e-3, SLOW, FAST, 3e-3, 7e-3)):
        time, strain = path(rate, [0.9])
        softened = replace(LAW, unrelaxed_modulus=LAW.unrelaxed_modulus * (1.0 - 0.06 * index))
        made.append(record(f"test-{index + 1}", time, strain, softened.stress(time, strain), index))
    found = named(campaign(made), "change_between_tests")
    assert value(found, "log_modulus_loss") == pytest.approx(-np.log(0.76), rel=0.1)


def test_a_specimen_that_creeps_out_of_its_grips():
    """In one of three ramps, from 0.3 of its time on, by 0.02 x / (1 + x), x the time since over 0.06 of it all."""
    made = []
    for index, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.9])
        since = np.maximum(time / time[-1] - 0.3, 0.0) / 0.06
        gone = 0.02 * since / (1.0 + since) if index == 1 else np.zeros_like(time)
        made.append(record(f"at-{rate:g}", time, strain, np.exp(gone) * LAW.stress(time, strain - gone), index))
    found = named(campaign(made), "grip_slip")
    assert found.best.records == ("at-0.005",)
    assert 0.015 < value(found, "slip_strain") < 0.025


def ramps(of_record):
    """Four ramps to 0.9, the third of which is only predicted; `of_record(index, time, strain)` has the stress."""
    made = []
    for index, rate in enumerate((6e-3, 8e-3, 1e-2, 1.4e-2)):
        time, strain = path(rate, [0.9])
        made.append(record(f"at-{rate:g}", time, strain, of_record(index, time, strain), index))
    made[2] = replace(made[2], role="held-out")
    return campaign(made)


def test_a_range_of_the_force_that_ends_in_every_test_at_another_stress():
    """One force, sections of four specimens: one effect in all records, with a size of its own in each of them.

    The record that was held out has it, too, and so does not refute it.
    """
    sections = (0.98, 1.0, 1.01, 1.03)

    def clipped(index, time, strain):
        return np.minimum(LAW.stress(time, strain), 22.0 / sections[index] * np.exp(strain))

    found = named(ramps(clipped), "force_saturation")
    assert found.verdict == "explained"
    limits = [1.0 / each.value for each in found.best.parameters if each.name == "inverse_limit_per_MPa"]
    np.testing.assert_allclose(sorted(limits), [22.0 / 1.03, 22.0, 22.0 / 0.98], rtol=0.005)
    assert found.shrink.held_out.after_MPa < 0.6 * found.shrink.held_out.before_MPa


@pytest.mark.parametrize("width", [0.004, 0.006], ids=["within some samples", "within more"])
def test_slips_in_every_test_at_instants_of_their_own(width):
    """Each specimen slips a little; the one that was held out much later.

    Of its instant the others say nothing, and so it does not refute them.
    """
    sizes, parts = (0.006, 0.007, 0.006, 0.005), (0.3, 0.36, 0.6, 0.28)

    def slipped(index, time, strain):
        gone = sizes[index] / (1.0 + np.exp((parts[index] - time / time[-1]) / width))
        return np.exp(gone) * LAW.stress(time, strain - gone)

    found = named(ramps(slipped), "grip_slip")
    assert found.verdict == "explained"
    assert found.best.records == ("at-0.006", "at-0.008", "at-0.014")


@pytest.mark.parametrize("stated", [True, False])
def test_a_specimen_that_slips_again_and_again(stated):
    """Five times in one test: not one slip, and no noise of 0.3 MPa, which it was until then."""
    sizes, parts = (0.002, 0.003, 0.0015, 0.0025, 0.002), (0.2, 0.35, 0.5, 0.66, 0.85)

    def slipped(index, time, strain):
        gone = sum(size * (time > part * time[-1]) for size, part in zip(sizes, parts, strict=True))
        gone = gone if index == 1 else 0.0 * strain
        return np.exp(gone) * LAW.stress(time, strain - gone)

    planted = ramps(slipped)
    if not stated:
        planted = campaign(replace(each, noise=Noise()) for each in planted.records)
    found = named(planted, "grip_slip")
    assert found.best.records == (planted.records[1].id,)
    assert found.best.forms[0].startswith("several")


def test_a_specimen_that_creeps_out_of_its_grips_by_the_pull():
    """At a rate as the fourth power of the force: mostly where the network hardens."""

    def crept(index, time, strain):
        gone = np.zeros(len(time))
        for _ in range(20 if index == 1 else 0):  # of the force that the specimen has
            stress = LAW.stress(time, strain - gone)
            rate = (stress * np.exp(-(strain - gone)) / 20.0) ** 4
            gone = 6e-5 * cumulative_trapezoid(rate, time, initial=0.0)
        return np.exp(gone) * LAW.stress(time, strain - gone)

    found = named(ramps(crept), "grip_slip")
    assert found.best.forms == ("creeping_with_pull",)
    assert value(found, "power_of_pull") == pytest.approx(4.0, rel=0.15)


def test_an_extensometer_whose_knives_slip():
    """What it reads jumps three times, either way; the specimen knows nothing of it."""
    made = []
    for index, rate in enumerate((6e-3, 8e-3, 1e-2)):
        time, strain = path(rate, [0.9])
        jumps = sum(size * (time > part * time[-1]) for size, part in ((0.004, 0.2), (-0.006, 0.45), (0.003, 0.7)))
        read = strain + jumps if index == 1 else strain
        made.append(record(f"at-{rate:g}", time, read, LAW.stress(time, strain), index))
    found = named(campaign(made), "grip_slip")
    assert found.best.forms == ("knives_measured_section",)
    assert found.best.records == ("at-0.008",)
    assert value(found, "part_of_jumps") == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize("size", [0.019, -0.035])
def test_a_strain_that_is_zeroed_wrongly_where_the_section_was_measured_apart(size):
    """The true stress is right. Taken for one that was made with the recorded strain, it accused the load cell."""

    def zeroed(law, time, strain):
        return law.stress(time, strain - size * (time[-1] > 300.0))

    found = named(loops(zeroed), "strain_offset")
    assert found.best.forms == ("shift_measured_section",)
    assert found.best.records == ("at-0.002",)
    assert value(found, "strain_zero_error") == pytest.approx(size, rel=0.03)


def test_damage_that_ends_early_by_the_work_that_was_done():
    """No strain tells it: the work at a strain differs by a factor of three from rate to rate."""

    def damaged(index, time, strain):
        area, stress = np.ones(len(strain)), LAW.stress(time, strain)
        for _ in range(30):  # of what the damaged section carries
            done = cumulative_trapezoid(area * stress, strain, initial=0.0)
            area = 1.0 - 0.05 * (-np.expm1(-done / 6.0))
        return area * stress

    found = named(ramps(damaged), "damage")
    assert found.best.forms == ("by_work",)
    assert value(found, "saturation_work_MPa") == pytest.approx(6.0, rel=0.1)


def softly_ending(stress, strain, end):
    """The reading is F_c (1 - exp(-(F / F_c)^6))^(1/6), F the force per initial section and F_c its `end`."""
    used = np.maximum(stress * np.exp(-strain) / end, 1e-12)
    return stress / used * (-np.expm1(-(used**6))) ** (1.0 / 6.0)


def test_an_amplifier_that_ends_softly():
    """In one record, a tenth above the largest force."""

    def softened(index, time, strain):
        stress = LAW.stress(time, strain)
        end = 1.1 * np.max(stress * np.exp(-strain))
        return softly_ending(stress, strain, end) if index == 0 else stress

    assert named(ramps(softened), "force_saturation").best.records == ("at-0.006",)


def test_an_amplifier_that_ends_softly_in_every_test():
    """At one force, and so at another stress in each of four sections."""
    sections = (0.95, 1.0, 1.02, 1.06)

    def softened(index, time, strain):
        return softly_ending(LAW.stress(time, strain), strain, 27.0 / sections[index])

    found = named(ramps(softened), "force_saturation")
    assert found.best.records == ("at-0.006", "at-0.008", "at-0.014")
    assert found.shrink.identify.after_MPa < 1.3 * 0.04


def test_a_characteristic_that_bends_in_every_test():
    """One cell reads 0.2 % more per MPa of nominal stress, whatever the largest force."""

    def bent(index, time, strain):
        stress = LAW.stress(time, strain)
        return stress * (1.0 + 0.002 * stress * np.exp(-strain))

    found = named(ramps(bent), "force_gain")
    assert (found.best.records, found.best.forms) == (("at-0.006", "at-0.008", "at-0.014"), ("characteristic",))
    assert value(found, "gain_bend_at_10MPa") == pytest.approx(0.02, rel=0.3)


def test_a_characteristic_that_bends():
    """One record's cell reads 1 % less at half of the largest force, and 3.5 % less at all of it."""

    def bent(index, time, strain):
        stress = LAW.stress(time, strain)
        used = stress * np.exp(-strain) / np.max(stress * np.exp(-strain))
        return stress * (1.0 - 0.005 * used - 0.03 * used**2) if index == 0 else stress

    found = diagnosed(ramps(bent))
    assert (found.best.effects, found.best.records, found.best.forms) == (("force_gain",), ("at-0.006",), ("bending",))
    assert ("force_saturation",) in found.answer_set  # an end that is far off bends, too
    assert value(found, "gain_bend") == pytest.approx(-0.035, rel=0.1)


@pytest.mark.parametrize("excess", [0.08, -0.06])
def test_a_wrong_gauge_length_in_one_test(excess):
    """What the specimen saw is the recorded elongation over 1 + a; its force is over the section of the recording."""
    made = []
    for index, rate in enumerate((SLOW, 3e-3, 5e-3, FAST)):
        time, seen = path(rate, [0.6])
        strain = np.log1p((1.0 + excess) * np.expm1(seen)) if index == 1 else seen
        made.append(record(f"at-{rate:g}", time, strain, LAW.stress(time, seen) * np.exp(strain - seen), index))
    found = named(campaign(made), "strain_gain")
    assert found.best.records == ("at-0.003",)
    assert value(found, "strain_gain_error") == pytest.approx(excess, rel=0.03)


def test_arms_of_an_extensometer_that_swing():
    """The gain falls with the square of the opening, by 5 % at the largest one, in one of four tests."""
    made = []
    for index, rate in enumerate((SLOW, 3e-3, 5e-3, FAST)):
        time, seen = path(rate, [0.6])
        opening = np.expm1(seen)
        strain = np.log1p(opening * (1.0 - 0.05 * (opening / opening[-1]) ** 2)) if index == 2 else seen
        made.append(record(f"at-{rate:g}", time, strain, LAW.stress(time, seen) * np.exp(strain - seen), index))
    found = named(campaign(made), "strain_gain")
    assert (found.best.records, found.best.forms) == (("at-0.005",), ("bending",))


def test_voids_that_open_around_a_strain_and_stay():
    """The section grows by 6 % as tanh around a strain of 0.3, and does not shrink on the way back."""

    def voided(law, time, strain):
        grown = 0.03 * (np.tanh((largest(strain) - 0.3) / 0.12) + np.tanh(0.3 / 0.12))
        return law.stress(time, strain) * np.exp(grown)

    named(loops(voided), "volume_change")


def test_strain_induced_crystallisation():
    """Crystals take over beyond a strain of 0.5 as a power of the way beyond it, and stay on the way back."""

    def crystallised(law, time, strain):
        beyond = np.maximum(largest(strain) - 0.5, 0.0)
        return law.stress(time, strain, modification=Modification(added_relaxed_stress=6.0 * beyond**1.5))

    named(loops(crystallised, end=1.2), "strain_induced_crystallisation")


def strip(law, time, strain):
    """Force of a strip that buckles at once: where it would push, its own strain is that without stress.

    The modes by backward Euler; its own strain by Newton's method.
    """
    weight, tau = law.spectrum.modal_weight, law.tau_max * law.spectrum.relaxation_ratio
    carried, own, stress = np.zeros(len(tau)), 0.0, [0.0]
    decay = 1.0 / (1.0 + (time[1] - time[0]) / tau)

    def at(new):
        relaxed = law.hardening_modulus * (np.exp(2.0 * new) - np.exp(-new))
        return decay * (carried + law.unrelaxed_modulus * weight * (new - own)) + (1.0 - decay) * weight * relaxed

    for wanted in strain[1:]:
        new = wanted
        if at(new).sum() < 0.0:
            for _ in range(4):
                slope = (at(new + 1e-7).sum() - at(new - 1e-7).sum()) / 2e-7
                new -= at(new).sum() / slope
        carried, own = at(new), new
        stress.append(max(carried.sum(), 0.0))
    return np.array(stress)


@pytest.mark.parametrize(("time_s", "exponent", "most"), [(1.0, 0.5, 1.15), (2.0, 0.6, 1.15), (1.0, 0.35, 1.25)])
def test_a_stretched_exponential_in_place_of_the_spectrum(time_s, exponent, most):
    """All of E_u relaxes as exp(-(t / t_0)^b): at a constant rate the stress is its integral. Begun from a small part
    of the modulus, the search ended at one and a half times the noise, where a slow process leaves less.
    """
    hardening = probation.Law(unrelaxed_modulus=1e-6, tau_max=8.0, hardening_modulus=2.5)
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.9])
        fine = np.linspace(0.0, time[-1] ** 0.25, 20001) ** 4
        memory = cumulative_trapezoid(np.exp(-((fine / time_s) ** exponent)), fine, initial=0.0)
        stress = 1500.0 * rate * np.interp(time, fine, memory) + hardening.stress(time, strain)
        made.append(record(f"at-{rate:g}", time, strain, stress, seed))
    found = diagnosed(campaign(made))
    assert found.best.effects == ("spectrum_shape",), found.headline
    assert found.shrink.identify.after_MPa < most * 0.04


def test_a_strip_that_goes_slack():
    found = diagnosed(loops(strip))
    assert found.effects[0].name == "slack_strip", found.headline
    assert value(found, "slack_part") > 0.9


def test_a_stout_strip_that_carries_a_part_of_the_compression():
    """It is never slack: the force goes on below zero, by three fifths of what the law says."""

    def stout(law, time, strain):
        stress = law.stress(time, strain)
        return np.where(stress < 0.0, 0.6 * stress, stress)

    planted = loops(stout)
    assert not any(slack_intervals(view) for view in views_of(planted))
    found = named(planted, "slack_strip")
    assert value(found, "slack_part") == pytest.approx(0.4, abs=0.03)


def test_triaxiality_of_a_neck():
    """Bridgman's factor; the outline's curvature grows and is lost again as the shoulder passes."""
    made = []
    for seed, grips in enumerate((0.5, 1.0, 2.0)):
        time = np.linspace(0.0, 200.0 / grips, 180 * FINE + 1)
        passed = grips * time / 200.0
        strain = 0.35 * passed + 0.5 / (1.0 + np.exp(-(passed - 0.4) / 0.06))
        strain -= strain[0]
        beyond = np.maximum(strain - 0.1, 1e-3) / 0.15
        ratio = 0.8 * beyond / (1.0 + beyond**2)
        factor = (1.0 + 2.0 / ratio) * np.log1p(ratio / 2.0)
        made.append(record(f"grips-{grips:g}", time, strain, factor * LAW.stress(time, strain), seed))
    named(campaign(replace(each, control="displacement-rate") for each in made), "neck_triaxiality")


@pytest.mark.parametrize("name", ["neck_triaxiality", "volume_change"])
def test_what_follows_from_the_material_is_not_said_of_one_test_alone(name):
    """A draught in one of three tests was a neck in that test alone, with 100 %."""
    of_material = effect(name)
    assert {place for form in of_material.forms for place in of_material.placements(form)} == {"all"}


@pytest.mark.parametrize(("growth", "necks"), [(0.0, False), (1.0, True)])
def test_a_section_whose_elongation_goes_ever_faster_under_grips_at_one_speed_is_in_a_neck(growth, necks):
    """Its true strain need not: at one speed the rate of that falls where nothing necks."""
    part = np.linspace(0.0, 1.0, 200 * FINE + 1)
    strain = np.log1p(1.5 * (part + growth * part**4) / (1.0 + growth))
    made = record("grips", 300.0 * part, strain, LAW.stress(300.0 * part, strain), 0)
    assert ("neck_triaxiality" in seen([replace(made, control="displacement-rate")])) == necks


def test_a_neck_whose_own_strain_rate_is_kept_is_considered():
    """Davidenkov and Spiridonova's factor in video-controlled tests: other effects of the section may do as well."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.9])
        beyond = np.maximum(strain - 0.15, 0.0) / 0.25
        factor = 1.0 + 0.25 * 0.5 * beyond * np.exp(1.0 - beyond)
        made.append(record(f"at-{rate:g}", time, strain, factor * LAW.stress(time, strain), seed))
    found = diagnosed(campaign(made))
    assert ("neck_triaxiality",) in found.answer_set, found.headline


def saw(strain, period, first):
    """Straight up to 0, down to -1 at once, one pitch over the strain."""
    pitch = (strain - first) / period
    return pitch - np.floor(pitch) - 1.0


def serrated(size, firsts=(0.03, 0.03, 0.03), added=lambda time, strain: 0.0, above=0.0):
    """Three rates; drops of up to `size` in true stress grow in proportion to the strain from 0.2 on, up to 0.5.

    `above`: which part of them stands above the law.
    """
    made = []
    for seed, (rate, first) in enumerate(zip((SLOW, 5e-3, FAST), firsts, strict=True)):
        strain = np.linspace(0.0, 1.0, 400 * FINE + 1)
        time = strain / rate
        grown = np.clip((strain - 0.2) / 0.3, 0.0, 1.0)
        teeth = 0.0 if first is None else size * grown * (saw(strain, 0.06, first) + above)
        made.append(record(f"at-{rate:g}", time, strain, LAW.stress(time, strain) + teeth + added(time, strain), seed))
    return campaign(made)


@pytest.mark.parametrize("firsts", [(0.03, 0.03, 0.03), (0.03, 0.05, 0.07)], ids=["in step", "out of step"])
def test_serrated_flow(firsts):
    """Whether the drops of three specimens are at one strain or not: their pitch is the material's."""
    found = named(serrated(0.3, firsts), "serrated_flow")
    assert value(found, "period_strain") == pytest.approx(0.06, rel=0.01)
    drop = value(found, "drop_MPa") * -np.expm1((value(found, "onset_strain") - 0.8) / value(found, "growth_strain"))
    assert drop * np.exp(0.8 * value(found, "power_of_stretch")) == pytest.approx(0.3, rel=0.1)
    assert set(found.best.records) == {"at-0.002", "at-0.005", "at-0.01"}


def test_serrated_flow_that_rises_above_the_law():
    """Type A: bands that stop until they are unlocked; the stress rises, and falls back."""
    found = named(serrated(0.3, above=1.0), "serrated_flow")
    assert set(found.best.forms) == {"recurring_rises"}
    assert value(found, "period_strain") == pytest.approx(0.06, rel=0.01)


def test_serrated_flow_at_one_rate():
    """An alloy is serrated within a range of rates only."""
    found = named(serrated(0.5, (None, 0.03, None)), "serrated_flow")
    assert found.best.records == ("at-0.005",)


def without_teeth(found):
    return not any("serrated_flow" in each for each in found.answer_set)


def test_waves_in_time_are_no_serrated_flow():
    """At one rate they are periodic in the strain, too, but a wave is no saw; and at three rates they have no pitch."""

    def wave(time, strain):
        return 0.3 * np.sin(2.0 * np.pi * time / 15.0 + 0.4) * np.exp(strain)

    for firsts, added in (
        ((None,) * 3, wave),
        ((None,) * 3, lambda time, strain: wave(time, strain) if time[-1] == 200.0 else 0.0),
    ):
        found = diagnosed(serrated(0.0, firsts, added))
        assert found.effects[0].name == "periodic_disturbance", found.headline
        assert without_teeth(found)


def test_loops_without_teeth_are_no_serrated_flow():
    """Neither where the law describes them nor where Mullins softening opens them, six times at one distance."""

    def softened(law, time, strain):
        lost = -0.06 * np.expm1((strain - largest(strain)) / 0.06)
        return law.stress(time, strain, modification=Modification(load_bearing_area=1.0 - lost))

    corners = [each for turn in np.arange(1, 7) * 0.14 for each in (turn, turn - 0.05)]
    for of_record in (softened, lambda law, time, strain: law.stress(time, strain)):
        made = []
        for seed, rate in enumerate((SLOW, 5e-3, FAST)):
            time, strain = path(rate, [*corners, 0.9])
            made.append(record(f"at-{rate:g}", time, strain, of_record(LAW, time, strain), seed))
        found = diagnosed(campaign(made))
        assert (found.verdict == "no_gap") == (of_record is not softened), found.headline
        assert without_teeth(found)


def with_waits(read, faulty=(0, 1, 2)):
    """Three rates; half-way the strain waits for as long as 1.5 loadings; `read(part of time, strain, stress)`."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        corners = np.cumsum([0.0, 0.45 / rate, 0.675 / rate, 0.45 / rate])
        time = np.append(0.0, np.concatenate([np.linspace(a, b, 70 * FINE + 1)[1:] for a, b in pairwise(corners)]))
        strain = np.interp(time, corners, [0.0, 0.45, 0.45, 0.9])
        stress = LAW.stress(time, strain)
        stress = read(time / time[-1], strain, stress) if seed in faulty else stress
        made.append(record(f"at-{rate:g}", time, strain, stress, seed))
    return campaign(made)


@pytest.mark.parametrize("faulty", [(1,), (0, 1, 2)], ids=["in one test", "in every test"])
def test_a_force_that_jumps_at_one_part_of_a_test(faulty):
    found = named(with_waits(lambda part, e, s: s + 0.5 * np.exp(e) * (part > 0.8), faulty), "force_offset")
    assert found.best.forms == ("jump",)
    assert len(found.best.records) == len(faulty)
    assert value(found, "offset_MPa") == pytest.approx(0.5, rel=0.05)
    assert value(found, "instant_of_record") == pytest.approx(0.8, abs=0.01)


def test_a_force_that_jumps_within_cycles():
    """Upwards, by 0.5 MPa of force, in one test of three, while it is loaded for the second time."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.3, 0.2, 0.6, 0.45, 0.9])
        jump = 0.5 * np.exp(strain) * (np.arange(len(time)) > 0.4 * len(time)) * (seed == 1)
        made.append(record(f"at-{rate:g}", time, strain, LAW.stress(time, strain) + jump, seed))
    found = named(campaign(made), "force_offset")
    assert (found.best.forms, found.best.records) == (("jump",), ("at-0.005",))
    assert value(found, "offset_MPa") == pytest.approx(0.5, rel=0.05)


def test_what_a_material_does_at_a_reversal_is_no_jump_of_the_force():
    """A back stress that turns at once, by 0.8 MPa: no jump is sought where the rate jumps."""
    turned = loops(lambda law, time, strain: law.stress(time, strain) + 0.8 * (np.gradient(strain) >= 0.0))
    found = diagnosed(turned)
    assert found.verdict != "no_gap"
    assert all("jump" not in each.forms for each in found.explanations)


def test_an_offset_of_the_force_that_creeps_off():
    """1.2 MPa, of which two fifths go, along two exponentials that differ by a factor 4."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.9])
        gone = 0.2 * (2.0 - np.exp(-time / 20.0) - np.exp(-time / 80.0))
        stress = LAW.stress(time, strain) + 1.2 * (1.0 - gone) * np.exp(strain)
        made.append(record(f"at-{rate:g}", time, strain, stress, seed))
    found = named(campaign(made), "force_offset")
    assert value(found, "offset_MPa") == pytest.approx(1.2, rel=0.05)


def test_specimens_that_age_from_test_to_test():
    """Relaxation times grow as the power 0.9 of the age: Struik's shift rate."""
    made = []
    for seed, (rate, age) in enumerate(zip((FAST, SLOW, 5e-3, SLOW, FAST), (1.0, 3.0, 6.0, 10.0, 16.0), strict=True)):
        time, strain = path(rate, [0.6])
        law = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0 * age**0.9, hardening_modulus=2.5)
        made.append(record(f"after-{age:g}-days", time, strain, law.stress(time, strain), seed))
    found = named(campaign(made), "change_between_tests")
    assert value(found, "log_time_gain") == pytest.approx(0.9 * np.log(16.0), rel=0.1)


def eyring(law, time, strain, activation):
    """Stress of a law whose relaxation times are divided by sinh(x)/x, x = |s| / activation: exponentials, in steps."""
    part, times = law.spectrum.modal_weight, law.spectrum.relaxation_ratio * law.tau_max
    network = law.hardening_modulus * (np.exp(2.0 * strain) - np.exp(-strain))
    own, stress = np.zeros(len(part)), np.zeros(len(time))
    for n, step in enumerate(np.diff(time)):
        x = max(abs(stress[n]) / activation, 1e-6)
        faster = times * x / np.sinh(x)
        kept = np.exp(-step / faster)
        flow = law.unrelaxed_modulus * part * (strain[n + 1] - strain[n]) / step * faster
        own = own * kept + (part * 0.5 * (network[n] + network[n + 1]) + flow) * (1.0 - kept)
        stress[n + 1] = own.sum()
    return stress


@pytest.mark.parametrize("stiffness", [1.0, 0.01])
def test_flow_that_a_part_of_the_stress_makes_easy(stiffness):
    """At a quarter of the yield stress, of a stiff polymer (10 MPa) as of a soft one, whose gain at 20 MPa is large."""
    law = probation.Law(unrelaxed_modulus=1500.0 * stiffness, tau_max=8.0, hardening_modulus=2.5 * stiffness)
    records = []
    for seed, rate in enumerate((1e-3, 5e-3, 3e-2)):
        time, strain = path(rate, [0.9])
        stress = eyring(law, time, strain, 6.0 * stiffness)[::FINE]
        noisy = stress + 0.04 * stiffness * np.random.default_rng(seed).standard_normal(len(stress))
        records.append(Record(f"at-{rate:g}", time[::FINE], strain[::FINE], noisy))
    named(campaign(records), "stress_activated_flow")


@pytest.mark.parametrize("stiffness", [1.0, 20.0])
def test_a_specimen_that_is_clamped_under_stress(stiffness):
    """4 % of the largest stress when the record starts: 1.2 MPa of a polymer, 24 MPa of what is as stiff as a metal.

    Every mode carries its part, and relaxes.
    """
    law = probation.Law(unrelaxed_modulus=1500.0 * stiffness, tau_max=8.0, hardening_modulus=2.5 * stiffness)
    part, times = law.spectrum.modal_weight, law.spectrum.relaxation_ratio * law.tau_max
    records = []
    for seed, rate in enumerate((1e-3, 5e-3, 3e-2)):
        time, strain = path(rate, [0.9])
        stress = law.stress(time, strain, scheme="sa3")
        if seed == 1:
            stress = stress + 1.2 * stiffness * np.exp(-np.divide.outer(time, times)) @ part
        stress = stress[::FINE] + 0.04 * stiffness * np.random.default_rng(seed).standard_normal(len(stress[::FINE]))
        records.append(Record(f"at-{rate:g}", time[::FINE], strain[::FINE], stress))
    found = named(campaign(records), "prestress")
    assert found.best.records == ("at-0.005",)
    assert found.best.parameters[0].value == pytest.approx(1.2 * stiffness, rel=0.15)


def test_a_test_that_was_slower_than_its_true_strain_says():
    """The strain of one of three tests is a rate times the time, 5 % more than the specimen had."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.9])
        faulty = 1.05 if seed == 1 else 1.0
        stress = LAW.stress(time, strain / faulty, scheme="sa3") * np.exp(strain - strain / faulty)
        made.append(record(f"at-{rate:g}", time, strain, stress, seed))
    found = named(campaign(made), "strain_gain")
    assert found.best.records == ("at-0.005",)
    assert found.best.forms == ("true_strain",)
    assert value(found, "strain_gain_error") == pytest.approx(0.05, rel=0.1)


@pytest.mark.parametrize("section", ["recorded", "measured"])
def test_a_strain_that_was_zeroed_when_the_specimen_was_under_load(section):
    """One test was pulled by 0.004 before its readings were zeroed and recorded; whatever relaxed by then had relaxed.

    Its rate jumps to the tenfold: at one rate it would be a strain that lags. The true stress was made of the force and
    the recorded strain, or with a section that was measured.
    """
    records = []
    for seed, rate in enumerate((1e-3, 1e-3, 3e-2)):
        time, strain = path(rate, [0.9])
        first = int(np.searchsorted(strain, 0.004)) if seed == 1 else 0
        if seed == 1:
            jump = strain[first + 40 * FINE]
            time = np.interp(strain, [0.0, jump, 0.9], np.array([0.0, jump, jump + 0.1 * (0.9 - jump)]) / rate)
        stress = LAW.stress(time, strain, scheme="sa3")
        if section == "recorded":
            stress = stress * np.exp(-strain[first])
        time, strain, stress = (each[first:][::FINE] for each in (time, strain, stress))
        noisy = stress + 0.04 * np.random.default_rng(seed).standard_normal(len(stress))
        records.append(Record(f"test-{seed}", time - time[0], strain - strain[0], noisy))
    found = named(campaign(records), "prestress")
    assert found.best.records == ("test-1",)
    assert value(found, "prestress_MPa") / value(found, "preload_modulus_MPa") == pytest.approx(0.004, rel=0.3)


def test_a_network_of_short_chains():
    """The inverse Langevin function by Cohen's rational form, three chains of 1.9 links."""
    root = np.sqrt(1.9)

    def locked(law, time, strain):
        stretch = np.exp(strain)
        pull = lambda x: x * (x / root) * (3.0 - (x / root) ** 2) / (1.0 - (x / root) ** 2)  # noqa: E731
        network = 0.5 * (pull(stretch) - pull(stretch**-0.5))
        gaussian = 2.5 * (stretch**2 - 1.0 / stretch)
        return law.stress(time, strain) - gaussian + network

    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.28])
        made.append(record(f"at-{rate:g}", time, strain, locked(LAW, time, strain), seed))
    found = named(campaign(made), "finite_extensibility")
    assert value(found, "inverse_extensibility") == pytest.approx(1.0 / (5.0 * 1.9), rel=0.05)


def test_zeros_of_the_force_in_more_records_than_an_explanation_has_effects():
    """Each of five tests has a zero of its own: one effect, told in all five."""
    zeros = (1.0, -0.7, 0.5, -0.9, 0.8)
    made = []
    for seed, (zero, rate) in enumerate(zip(zeros, (SLOW, 3e-3, 5e-3, 8e-3, FAST), strict=True)):
        time, strain = path(rate, [0.6])
        stress = LAW.stress(time, strain) + zero * np.exp(strain)
        made.append(record(f"at-{rate:g}", time, strain, stress, seed))
    found = named(campaign(made), "force_offset")
    assert len(found.best.records) == 5
    assert found.shrink.identify.after_MPa < 1.2 * 0.04
    told = found.to_dict()["causes"][0]["parameters"].values()
    values = {each["records"][0]: each["value"] for each in told}
    assert [values[each.id] for each in made] == pytest.approx(zeros, abs=0.02)


@pytest.mark.parametrize("faulty", [(1,), (0, 1, 2)], ids=["in one test", "in every test"])
def test_a_gain_that_drifts_while_a_test_runs(faulty):
    """The bridge of the cell settles at 3 % more, by a time constant as long as a test: 1.9 % are reached."""
    found = named(with_waits(lambda part, e, s: s * (1.0 - 0.03 * np.expm1(-part)), faulty), "force_gain")
    assert found.best.forms == ("drifting",)
    assert value(found, "gain_drift") == pytest.approx(0.019, rel=0.15)


def test_a_zero_that_a_cell_comes_to_while_it_warms():
    """From nothing to 1.5 MPa by two time constants, a tenth and a third of each test."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [0.6])
        part = time / time[-1]
        zero = 1.5 - 0.9 * np.exp(-part / 0.1) - 0.6 * np.exp(-part / 0.33)
        made.append(record(f"at-{rate:g}", time, strain, LAW.stress(time, strain) + zero * np.exp(strain), seed))
    assert named(campaign(made), "force_drift").best.forms == ("settling",)


def test_a_specimen_that_comes_warm_into_its_chamber():
    """By 12 degrees in one of four tests, and half of them are gone after a fifth of it; Arrhenius with 70 kJ/mol."""
    made = []
    for seed, rate in enumerate((SLOW, 3e-3, 5e-3, FAST)):
        time, strain = path(rate, [0.6])
        warmer = 12.0 * 2.0 ** (-5.0 * time / time[-1]) if seed == 1 else np.zeros(len(time))
        factor = np.exp(70e3 / 8.314 * (1.0 / (296.15 + warmer) - 1.0 / 296.15))
        stress = LAW.stress(time, strain, modification=Modification(relaxation_time_factor=factor))
        made.append(record(f"at-{rate:g}", time, strain, stress, seed))
    assert "at-0.003" in named(campaign(made), "temperature_drift").best.records


def test_a_strain_that_went_through_a_filter():
    """Of second order: 3 s and 0.5 s one after the other, by backward Euler; the machine starts and stops gently."""
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time = np.linspace(0.0, 0.5 / rate, 2401)
        strain = 0.25 - 0.25 * np.cos(2.0 * np.pi * rate * time)
        shown = strain
        for constant in (3.0, 0.5):
            kept, late = 1.0 / (1.0 + (time[1] - time[0]) / constant), [0.0]
            for at in shown[1:]:
                late.append(kept * late[-1] + (1.0 - kept) * at)
            shown = np.array(late)
        stress = LAW.stress(time, strain) * np.exp(shown - strain)  # of the force and the strain that is shown
        made.append(record(f"at-{rate:g}", time, shown, stress, seed))
    found = named(campaign(made), "force_strain_lag")
    assert "large_strain_filter" in found.best.forms
    assert value(found, "strain_lag_s") == pytest.approx(3.5, rel=0.1)


def at_temperature(celsius, rate=5e-3, seed=0):
    """Arrhenius with 70 kJ/mol for the times; E_u and G fall by 0.2 and 0.4 % a degree."""
    time, strain = path(rate, [0.8])
    law = probation.Law(
        unrelaxed_modulus=2000.0 * (1.0 - 0.002 * (celsius - 23.0)),
        tau_max=8.0 * np.exp(70e3 / 8.314 * (1.0 / (celsius + 273.15) - 1.0 / 296.15)),
        hardening_modulus=2.5 * (1.0 - 0.004 * (celsius - 23.0)),
    )
    declared = np.full(len(time), celsius)
    return record(f"at-{celsius:g}", time, strain, law.stress(time, strain), seed, temperature=declared)


def test_declared_temperatures_give_a_coefficient_and_no_drift():
    found = named(
        campaign(at_temperature(c, seed=k) for k, c in enumerate((15.0, 23.0, 40.0))), "temperature_dependence"
    )
    assert value(found, "softening_per_degC") == pytest.approx(70e3 / 8.314 / 299.15**2, rel=0.03)
    assert "emperature dependence" in found.headline


def measured_warming(softening=0.07, hottest=9.0, scatter=0.05, delay=0.0):
    """Three rates; the faster the test, the warmer it gets, along a curve of its own; thermometers scatter, or lag."""
    made = []
    for seed, (rate, part) in enumerate(((SLOW, 0.17), (5e-3, 0.45), (FAST, 1.0))):
        time, strain = path(rate, [0.9])
        rise = part * hottest * np.sin(0.5 * np.pi * strain / 0.9) ** 2
        factors = Modification(relaxation_time_factor=np.exp(-softening * rise), hardening_factor=1.0 - 0.003 * rise)
        read = 23.0 + follows(time, rise, delay) + scatter * np.random.default_rng(9 + seed).standard_normal(len(time))
        stress = LAW.stress(time, strain, modification=factors)
        made.append(record(f"at-{rate:g}", time, strain, stress, seed, temperature=read))
    return campaign(made)


def follows(time, rise, delay):
    """A thermometer with a time constant: y' = (rise - y) / delay."""
    if delay == 0.0:
        return rise
    ends = time[0], time[-1]
    return solve_ivp(lambda t, y: (np.interp(t, time, rise) - y) / delay, ends, [0.0], t_eval=time, rtol=1e-8).y[0]


def arrhenius(warming):
    """ln of the times' factor for 70 kJ/mol at 23 °C."""
    return 70e3 / 8.314 * (1.0 / (296.15 + warming) - 1.0 / 296.15)


def wlf(warming):
    """The same with C1 = 8.86 / 2 and C2 = 101.6 K: a times ten within 29 K."""
    return -np.log(10.0) * 4.43 * warming / (101.6 + warming)


def heated(log_time, *, stored="nothing", stiffness_loss=0.0, loss_time=np.inf):
    """Four rates; heat over 1.9 MPa/K warms, the room cools; modes step by step, the middle of a step by iteration.

    The work is turned into heat but for what is `stored`: nothing of it, the elastic energy of the stress, or the
    network's work. E_u and G fall by `stiffness_loss` a degree.
    """
    weight, times = LAW.spectrum.modal_weight, LAW.tau_max * LAW.spectrum.relaxation_ratio
    made = []
    for seed, rate in enumerate((1e-3, 3e-3, 5e-3, FAST)):
        time, strain = path(rate, [1.0])
        carried, warming, stress, h = np.zeros(len(times)), 0.0, [0.0], time[1]
        for begin, end in pairwise(strain):
            network = LAW.hardening_modulus * (np.exp(begin + end) - np.exp(-0.5 * (begin + end)))
            middle = warming
            for _ in range(3):
                left = 1.0 - stiffness_loss * middle
                part = h / (times * np.exp(log_time(middle)))
                new = carried * np.exp(-part) - np.expm1(-part) * weight * left * (
                    LAW.unrelaxed_modulus * (end - begin) / part + network
                )
                mean, rise = 0.5 * (carried + new).sum(), (new - carried).sum()
                work = {
                    "nothing": mean * (end - begin),
                    "elastic": mean * (end - begin - rise / LAW.unrelaxed_modulus),
                    "network": (mean - left * network) * (end - begin),
                }[stored]
                after = (warming * (1.0 - 0.5 * h / loss_time) + work / 1.9) / (1.0 + 0.5 * h / loss_time)
                middle = 0.5 * (warming + after)
            carried, warming = new, after
            stress.append(carried.sum())
        made.append(record(f"at-{rate:g}", time, strain, np.array(stress), seed))
    return campaign(made)


@pytest.mark.parametrize(
    ("log_time", "how"),
    [
        (arrhenius, {}),
        (arrhenius, {"stored": "elastic", "stiffness_loss": 0.003, "loss_time": 300.0}),
        (arrhenius, {"stored": "network", "stiffness_loss": 0.005, "loss_time": 200.0}),
        (wlf, {"stored": "elastic", "loss_time": 500.0}),
    ],
    ids=["all work", "but elastic energy", "but the network's", "wlf"],
)
def test_self_heating_by_other_laws_of_temperature(log_time, how):
    """Up to 15 K: named, and leading without partners."""
    found = named(heated(log_time, **how), "self_heating")
    assert found.best.effects == ("self_heating",)
    assert found.best.probability > 0.7
    assert found.shrink.identify.after_MPa < 1.1 * 0.04
    # Loss of ln tau per degree over heat capacity: Arrhenius 0.0960, WLF 0.1004 per K.
    slope = -(log_time(1e-3) / 1e-3) / 1.9
    assert value(found, "log_time_loss_per_MPa") == pytest.approx(slope, rel=0.15)


def test_heat_that_changes_no_times_makes_no_gap():
    assert diagnosed(heated(lambda warming: 0.0)).verdict == "no_gap"


def test_a_measured_rise_drives_self_heating():
    """The rise need not be predicted: the coefficient per degree is what is left to find."""
    found = named(measured_warming(), "self_heating")
    assert found.best.forms == ("as_measured",)
    assert value(found, "softening_per_degC") == pytest.approx(0.07, rel=0.05)
    # The work by the trapezoidal rule, half a degree per MPa of it.
    fast = measured_warming().record("at-0.01")
    work = np.trapezoid(fast.true_stress, fast.true_strain)
    [said] = [each for each in found.best.checks.notes if each.startswith("at-0.01 ")]
    warmed, most = map(float, re.findall(r"([\d.]+) °C", said))
    assert warmed == pytest.approx(9.0, abs=0.15)
    assert most == pytest.approx(0.5 * work, abs=0.06)


def test_a_thermometer_that_is_late_does_not_acquit_self_heating():
    """By 15 s, a sixth of the fast test: what it shows late drives the law, and the delay is found."""
    found = named(measured_warming(delay=15.0), "self_heating")
    assert found.best.forms == ("measured_late",)
    assert value(found, "delay_s") == pytest.approx(15.0, rel=0.1)
    assert value(found, "softening_per_degC") == pytest.approx(0.07, rel=0.1)


def test_a_rise_that_is_small_beside_the_scatter_of_its_readings_drives_self_heating():
    """Half a degree, read to 0.15: seen by its many readings. It leads; rivals have further forms, and the rest.

    Readings that have to be smoothed as much tell no delay of a few seconds from none.
    """
    found = named(measured_warming(softening=0.1, hottest=0.5, scatter=0.15), "self_heating", least=0.4)
    assert found.best.forms in (("as_measured",), ("measured_late",))
    assert value(found, "softening_per_degC") == pytest.approx(0.1, rel=0.3)


def test_a_measured_temperature_that_stays_acquits_self_heating():
    """The same stress, but the thermometer says that nothing warmed: another cause has to be found."""
    planted = measured_warming()
    still = [
        replace(each, temperature=23.0 + 0.05 * np.random.default_rng(5).standard_normal(len(each)))
        for each in planted.records
    ]
    found = diagnosed(replace(planted, records=tuple(still)))
    assert all("self_heating" not in each.effects for each in found.explanations)


def cavitated(*, poisson=None, measured_section=False, scatter=2e-4):
    """Three rates; the volume grows by 15 % from 0.2 on; the true stress takes it for constant, or has it right.

    The transverse strain is measured with this noise; with a Poisson ratio it says something else.
    """
    made = []
    for seed, rate in enumerate((SLOW, 5e-3, FAST)):
        time, strain = path(rate, [1.0])
        grown = -0.15 * np.expm1(-((np.maximum(strain - 0.2, 0.0) / 0.3) ** 2))
        across = 0.5 * (grown - strain) if poisson is None else -poisson * strain
        noise = scatter * np.random.default_rng(7 + seed).standard_normal(len(time))
        stress = LAW.stress(time, strain) * (1.0 if measured_section else np.exp(grown))
        made.append(
            replace(record(f"at-{rate:g}", time, strain, stress, seed), transverse_strain=(across + noise)[::FINE])
        )
    return campaign(made)


def test_the_noise_of_a_measured_transverse_strain_hides_no_growth_of_the_volume():
    """1e-3 of video would be 0.1 MPa of stress, twice its noise: it was the triaxiality of a neck, with 99 %."""
    found = named(cavitated(scatter=1e-3), "volume_change")
    assert value(found, "overlooked_part") == pytest.approx(1.0, abs=0.05)


def test_a_measured_growth_of_the_volume_explains_the_stress():
    found = named(cavitated(), "volume_change")
    assert found.best.forms == ("as_measured",)
    assert value(found, "overlooked_part") == pytest.approx(1.0, abs=0.05)
    # e^0.15 less the little that 1.0 leaves open; 95 % of the samples lie below that of the last.
    assert any(
        "at-0.01 was measured to change its volume by up to 15." in note or "up to 14." in note
        for note in found.best.checks.notes
    )


def test_a_measured_volume_that_stays_acquits_its_growth():
    """The same stress, but the transverse strain is half the strain all along: another cause has to be found."""
    found = diagnosed(cavitated(poisson=0.5))
    assert found.verdict != "no_gap"
    assert not any("volume_change" in each.effects for each in found.explanations)


def test_a_width_that_shrinks_more_than_half_the_strain_judges_no_volume():
    """Of a film that grows narrower than thinner the width alone says nothing of the volume, for or against it."""
    assert "volume_change" in seen(cavitated(poisson=0.55).records)
    assert "volume_change" not in seen(cavitated(poisson=0.5).records)


def test_a_section_that_was_measured_leaves_nothing_to_explain():
    """The volume grew, and the true stress was made of the section as it was."""
    assert diagnosed(cavitated(measured_section=True)).verdict == "no_gap"


def seen(records):
    """Names of the effects that these records could show."""
    return {each.name for each in visible(effects(), views_of(campaign(records)))}


def test_effects_are_considered_only_where_records_could_show_them():
    time, strain = path(5e-3, [0.4])
    plain = record("ramp", time, strain, LAW.stress(time, strain), 0)
    shown = seen([plain])
    assert {"damage", "rate_dependent_hardening", "force_drift", "machine_compliance"} <= shown
    assert not shown & {
        "temperature_dependence",
        "mullins_softening",
        "back_stress",
        "change_between_tests",
        "cell_hysteresis",
        "guide_friction",
        "slack_strip",
    }
    assert "neck_triaxiality" in shown
    time, strain = path(5e-3, [0.08])
    short = record("short", time, strain, LAW.stress(time, strain), 0)
    assert "neck_triaxiality" not in seen([short])
    assert {"mullins_softening", "back_stress"} <= seen(
        loops(lambda law, time, strain: law.stress(time, strain)).records
    )
    warm = [replace(plain, id=f"at-{c}", temperature=np.full(len(plain), c)) for c in (20.0, 40.0)]
    assert "temperature_dependence" in seen(warm)
    assert "temperature_drift" in seen(warm)  # within a record


def test_an_effect_that_was_asked_for_and_cannot_show_is_said_to_be_skipped():
    time, strain = path(5e-3, [0.4])
    plain = campaign([record("ramp", time, strain, LAW.stress(time, strain), 0)])
    found = probation.diagnose(plain, effects=["mullins_softening", "damage"], design=False)
    assert [each.why for each in found.skipped] == [
        "mullins_softening: no record could show it; "
        "it shows in unloading and reloading below the largest strain so far"
    ]


def test_a_comparison_asks_for_nothing_that_both_campaigns_have_alike():
    """A strip goes slack in each; a hysteresis of the load cell may be new, where there is a way back to show it."""
    slack = views_of(loops(strip))
    assert slack_intervals(slack[0])
    names = {each.name for each in visible(considered(), slack)}
    assert "cell_hysteresis" in names
    assert not names & {"slack_strip", "neck_triaxiality"}
    time, strain = path(5e-3, [0.4])
    ramp = views_of(campaign([record("ramp", time, strain, LAW.stress(time, strain), 0)]))
    assert "cell_hysteresis" not in {each.name for each in visible(considered(), ramp)}
