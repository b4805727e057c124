"""From measured strain to what drives the law."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.interpolate import make_smoothing_spline

import probation
from probation import Noise, Record
from probation.histories.necking import NECKING_SETS
from probation.smoothing.excitation import excite
from probation.smoothing.penalised_spline import Basis
from probation.smoothing.segments import find_jumps


def record(time, strain, control="displacement-rate", **more):
    return Record("a", time, strain, np.zeros_like(time), control=control, **more)


def jump_history(noise, seed=0):
    """Rate 1e-3, ten times more from 100 s on; 2000 samples to 200 s."""
    time = np.linspace(0.0, 200.0, 2001)
    strain = np.where(time < 100.0, 1e-3 * time, 0.1 + 1e-2 * (time - 100.0))
    return time, strain + noise * np.random.default_rng(seed).normal(size=time.size)


@pytest.mark.parametrize("noise", [0.0, 2e-5, 1e-4])
def test_a_commanded_jump_is_found_where_it_is(noise):
    time, strain = jump_history(noise)
    jumps = find_jumps(time, strain, noise)
    assert len(jumps) == 1
    assert abs(time[jumps[0]] - 100.0) <= 0.3


@pytest.mark.parametrize("seed", range(5))
def test_a_smooth_noisy_history_has_no_jumps(seed):
    time = np.linspace(0.0, 200.0, 1501)
    strain = 0.9 * (1.0 - np.cos(np.pi * time / 200.0)) + 1e-4 * np.random.default_rng(seed).normal(size=1501)
    assert find_jumps(time, strain, 1e-4) == []


@pytest.mark.parametrize("samples", [201, 301])
def test_a_bend_of_few_noisy_samples_is_no_jump(samples):
    """Slopes on either side of a window differ by ten standard errors, but a cubic describes them as well."""
    history = NECKING_SETS["P2"]
    time = np.linspace(0.0, history.duration, samples)
    for seed in range(20):
        strain = history.true_strain(time) + 1e-3 * np.random.default_rng(seed).normal(size=samples)
        assert find_jumps(time, strain, 1e-3) == []


def test_a_jump_in_much_noise_is_found_in_wider_windows():
    """Noise 2e-3 and a jump from 1.7e-3 to 1.7e-2 1/s: within four samples, every time."""
    time = np.linspace(0.0, 80.0, 1501)
    strain = np.where(time < 40.02, 1.7e-3 * time, 1.7e-3 * 40.02 + 1.7e-2 * (time - 40.02))
    for seed in range(20):
        (jump,) = find_jumps(time, strain + 2e-3 * np.random.default_rng(seed).normal(size=1501), 2e-3)
        assert abs(time[jump] - 40.02) <= 4.0 * time[1]


def of_rates(time, starts, rates):
    """Strain of a rate that is constant between instants."""
    ends = np.append(starts[1:], time[-1])
    return sum(
        rate * np.clip(time - start, 0.0, end - start) for start, end, rate in zip(starts, ends, rates, strict=True)
    )


@pytest.mark.parametrize("noise", [8e-6, 1e-4])
def test_a_ramp_of_fewer_samples_than_a_window_has_both_its_ends(noise):
    """At rest, strained by 0.05 within six samples of 29 s, then on at a tenth of the rate."""
    time = 29.0 * np.arange(312)
    strain = of_rates(time, 29.0 * np.array([0.0, 17.6, 23.1]), [0.0, 3.1e-4, 3.1e-5])
    for seed in range(10):
        noisy = strain + noise * np.random.default_rng(seed).standard_normal(312)
        assert find_jumps(time, noisy, noise) == [18, 23]


def test_the_turning_points_of_short_unloadings_are_found():
    """Three unloadings of five samples between loadings of fifty: without them the record seems to load throughout."""
    time, turns = np.arange(200.0), np.array([0.0, 50.3, 55.4, 105.2, 110.3, 160.1, 165.4])
    strain = of_rates(time, turns, [1e-3, -2e-3, 1e-3, -2e-3, 1e-3, -2e-3, 1e-3])
    for seed in range(10):
        found = find_jumps(time, strain + 1e-4 * np.random.default_rng(seed).standard_normal(200), 1e-4)
        assert len(found) == 6
        assert np.all(np.abs(np.array(found) - turns[1:]) <= 1.0)


@pytest.mark.parametrize("noise", [3e-5, 7e-5])
def test_the_turning_points_of_a_short_unloading_are_found_where_they_fall_on_samples(noise):
    """Two unloadings of 21 samples, as many as a window has, from 3.3e-4 a sample to as much down and up again."""
    time = np.arange(1300.0)
    strain = 3.3e-4 * np.interp(time, [0, 450, 471, 880, 901, 1299], [0, 450, 429, 838, 817, 1215])
    for seed in range(20):
        found = find_jumps(time, strain + noise * np.random.default_rng(seed).standard_normal(1300), noise)
        assert len(found) == 4
        assert np.all(np.abs(np.array(found) - [450, 471, 880, 901]) <= 1)


@pytest.mark.parametrize("lag", [2.0, 5.0])
def test_a_machine_that_lags_behind_one_jump_makes_no_second_one(lag):
    """The rate follows by a time constant of two or five samples."""
    time = np.arange(400.0)
    since = np.maximum(time - 200.0, 0.0)
    strain = 1e-4 * time + 9e-4 * (since + lag * np.expm1(-since / lag))
    for seed in range(10):
        assert len(find_jumps(time, strain + 1e-5 * np.random.default_rng(seed).standard_normal(400), 1e-5)) == 1


@pytest.mark.parametrize("lasting", [1e-3, 1.0, 2.0, 3.0])
@pytest.mark.parametrize("begin", [346.0, 346.4, 346.8])
def test_a_step_of_the_strain_has_a_jump_at_either_end(begin, lasting):
    """By 5e-3 within one to four samples, as where a strip slips; the rate is the same before and after.

    A corner between two samples is put at one of them: that looks like a little noise.
    """
    time = np.arange(440.0)
    strain = 1.1e-3 * time + 5e-3 * np.clip((time - begin) / lasting, 0.0, 1.0)
    for seed in range(5):
        noisy = strain + 3e-5 * np.random.default_rng(seed).standard_normal(440)
        first, last = find_jumps(time, noisy, 3e-5)
        assert begin - 1.0 < first <= begin + 0.5
        assert begin + lasting - 0.5 <= last < begin + lasting + 1.0
        assert 2.5e-5 < excite(Record("slips", time, noisy, 20.0 + 0.0 * time)).strain_noise < 8e-5


def test_a_pause_of_the_readings_is_no_step():
    time = np.concatenate([np.arange(200.0), np.arange(212.0, 400.0)])
    for seed in range(5):
        assert not find_jumps(time, 1e-3 * time + 3e-5 * np.random.default_rng(seed).standard_normal(len(time)), 3e-5)


@pytest.mark.parametrize("lag", [2.0, 5.0])
def test_a_controller_that_overshoots_makes_no_second_jump(lag):
    """The rate begins beyond the new one by half of the change, and comes back within a time constant."""
    time = np.arange(400.0)
    since = np.maximum(time - 200.0, 0.0)
    strain = 1e-4 * time + 9e-4 * since - 4.5e-4 * lag * np.expm1(-since / lag)
    for seed in range(10):
        assert len(find_jumps(time, strain + 1e-5 * np.random.default_rng(seed).standard_normal(400), 1e-5)) == 1


LAW = probation.Law(unrelaxed_modulus=2000.0, tau_max=30.0, hardening_modulus=1.0)


def late_start(seed, noise, wait=20.3, rate=5e-4, samples=401):
    """200 s: at rest first, then strained; with the force that goes with it, its noise 0.02 MPa."""
    rng = np.random.default_rng(seed)
    fine = np.linspace(0.0, 200.0, 20 * (samples - 1) + 1)
    strain = rate * np.maximum(fine - wait, 0.0)
    stress = LAW.stress(fine, strain, scheme="sa2")[::20] + 0.02 * rng.standard_normal(samples)
    return fine[::20], strain[::20] + noise * rng.standard_normal(samples), stress


@pytest.mark.parametrize(("wait", "often"), [(5.3, 10), (20.3, 20)])
def test_the_force_shows_the_end_of_a_wait_that_noise_hides_in_the_strain(wait, often):
    """Strain noise of 1e-3 is four steps between samples; the force rises by 0.5 MPa from one sample to the next.

    Ten samples of the shorter wait know their slope to 1.1e-4 a sample, of a change of 2.5e-4.
    """

    def within_a_sample(jumps):
        return len(jumps) == 1 and abs(0.5 * jumps[0] - wait) <= 1.0

    drawn = [late_start(seed, 1e-3, wait) for seed in range(20)]
    assert sum(within_a_sample(find_jumps(time, strain, 1e-3, stress)) for time, strain, stress in drawn) >= often
    assert sum(within_a_sample(find_jumps(time, strain, 1e-3)) for time, strain, _ in drawn) < often / 2


def test_a_force_that_comes_late_does_not_move_a_jump_that_the_strain_shows():
    """A lag of 3 s, six samples; the strain's noise of 2e-5 places its jump to a tenth of a sample."""
    time, strain, stress = late_start(0, 2e-5)
    (jump,) = find_jumps(time, strain, 2e-5, np.interp(time - 3.0, time, stress))
    assert abs(time[jump] - 20.3) <= time[1]


@pytest.mark.parametrize("noise", [1e-4, 1e-3])
def test_a_force_that_yields_makes_no_jump_in_a_smooth_strain(noise):
    """A necking history: the stress bends at the yield point, the strain rate does not jump there."""
    history = NECKING_SETS["P2"]
    time = np.linspace(0.0, history.duration, 601)
    smooth = history.true_strain(time)
    stress = LAW.stress(time, smooth, scheme="sa3")
    for seed in range(20):
        rng = np.random.default_rng(seed)
        strain = smooth + noise * rng.standard_normal(601)
        assert find_jumps(time, strain, noise, stress + 0.02 * rng.standard_normal(601)) == []


def test_smoothing_recovers_the_rate_on_both_sides_of_a_jump():
    """Noise 2e-5: three-point differences err by 70 % of the slow rate; 95 % of the spline's rates are within 0.2 %."""
    time, strain = jump_history(2e-5)
    found = excite(record(time, strain))
    truth = np.where(time < found.time[found.jumps[0]], 1e-3, 1e-2)
    error = np.abs(found.strain_rate / truth - 1.0)
    assert np.quantile(error, 0.95) < 0.002
    assert found.differentiator.startswith("quintic smoothing spline")


def test_a_clean_history_is_left_alone():
    time = np.linspace(0.0, 10.0, 101)
    found = excite(record(time, 0.01 * time))
    assert found.strain_rate is None
    assert_allclose(found.true_strain, 0.01 * time)


def test_a_given_rate_is_used():
    time = np.linspace(0.0, 10.0, 101)
    found = excite(record(time, 0.01 * time, strain_rate=np.full(101, 0.01)))
    assert_allclose(found.strain_rate, 0.01)
    assert found.differentiator == "rate given with the record"


def test_loading_and_unloading_have_their_directions():
    time = np.linspace(0.0, 20.0, 401)
    strain = 0.01 * np.minimum(time, 20.0 - time)
    found = excite(record(time, strain))
    assert set(found.direction[:200]) == {1.0}
    assert set(found.direction[200:]) == {-1.0}


def test_a_smooth_reversal_has_no_single_direction():
    time = np.linspace(0.0, 20.0, 401)
    assert set(excite(record(time, 0.1 * np.sin(np.pi * time / 20.0))).direction) == {0.0}
    assert set(excite(record(time, 0.01 * time, control="cyclic")).direction) == {0.0}


def test_a_grip_that_slackens_for_a_while_is_heard():
    """Strain up to 0.1, back by 0.0005, then on: less than a turn, but no noise either."""
    time = np.linspace(0.0, 30.0, 301)
    strain = np.interp(time, [0.0, 10.0, 20.0, 30.0], [0.0, 0.1, 0.0995, 0.2])
    found = excite(record(time, strain), "raw")
    back = np.diff(strain) < 0.0
    assert np.all(found.direction[back] != 1.0)
    assert np.all(found.direction[~back] == 1.0)


def test_refining_keeps_the_samples_and_the_straight_lines():
    time, strain = np.array([0.0, 1.0, 3.0]), np.array([0.0, 0.2, 0.3])
    time, strain = np.concatenate([time, 3 + np.arange(1.0, 9)]), np.concatenate([strain, 0.3 + 0.01 * np.arange(1, 9)])
    fine = excite(record(time, strain), "raw").refined(4)
    assert_allclose(fine.time[::4], time)
    assert_allclose(fine.true_strain[::4], strain)
    assert_allclose(fine.true_strain, np.interp(fine.time, time, strain), atol=1e-15)
    assert len(fine.direction) == len(fine.time) - 1


def test_refining_with_rates_follows_a_cubic_exactly():
    """e = t^3 / 1000, e' = 3 t^2 / 1000 at the samples: the Hermite cubic is the history itself."""
    time = np.linspace(0.0, 10.0, 21)
    fine = excite(record(time, time**3 / 1000.0, strain_rate=3 * time**2 / 1000.0), "raw").refined(5)
    assert_allclose(fine.true_strain, fine.time**3 / 1000.0, atol=1e-15)
    assert_allclose(fine.strain_rate, 3 * fine.time**2 / 1000.0, atol=1e-14)


@pytest.mark.parametrize("samples", [101, 1001, 8001])
def test_a_noisy_ramp_is_smoothed_to_a_straight_line(samples):
    """Six degrees of freedom or so are left of the noise: sqrt(6 / n) of it, three times that at the ends."""
    time = np.linspace(0.0, 400.0, samples)
    noise = 1e-4 * np.random.default_rng(2).normal(size=samples)
    found = excite(record(time, 0.005 * time + noise), "spline")
    assert np.sqrt(np.mean((found.true_strain - 0.005 * time) ** 2)) < 3e-4 * np.sqrt(6.0 / samples)
    assert np.quantile(np.abs(found.strain_rate / 0.005 - 1.0), 0.95) < 0.01


def necking_record(noise, samples=301, seed=0, *, uneven=False):
    """Experiment 3's strain, eq. (A-1) with set P2; also its true rate."""
    history = NECKING_SETS["P2"]
    time = np.linspace(0.0, history.duration, samples)
    if uneven:
        inner = np.random.default_rng([seed, 5]).uniform(-0.4, 0.4, samples - 2) * time[1]
        time[1:-1] += inner
    strain = history.true_strain(time)
    noisy = strain + noise * np.random.default_rng(seed).normal(size=samples)
    return record(time, noisy), strain, history.strain_rate(time)


@pytest.mark.parametrize("method", ["spline", "quintic-spline"])
@pytest.mark.parametrize("uneven", [False, True])
def test_operators_are_what_the_smoother_does_at_fixed_smoothness(uneven, method):
    measured, _, _ = necking_record(1e-4, 121, uneven=uneven)
    found = excite(measured, method)
    assert_allclose(found.strain_operator() @ measured.true_strain, found.true_strain, atol=1e-13)
    assert_allclose(found.rate_operator() @ measured.true_strain, found.strain_rate, atol=1e-13)


@pytest.mark.parametrize("uneven", [False, True])
@pytest.mark.parametrize("penalty", [3e4, 3e6])
def test_the_cubic_spline_is_scipys_smoothing_spline(uneven, penalty):
    """With a knot at every other sample, to a thousandth; scipy's penalty is in s^3, here time runs from 0 to 1.

    Moving one sample by 1e-3 gives one column of the operators.
    """
    measured, _, _ = necking_record(1e-4, 121, uneven=uneven)
    time = measured.time
    basis = Basis.of(time, 2, 60)
    operators = basis.operators(1.0 / (1.0 + penalty / (time[-1] - time[0]) ** 3 * basis.penalties))
    base = make_smoothing_spline(time, measured.true_strain, lam=penalty)
    assert_allclose(operators.strain @ measured.true_strain, base(time), atol=1e-5)
    for sample in (0, 1, 57, 120):
        moved = measured.true_strain.copy()
        moved[sample] += 1e-3
        spline = make_smoothing_spline(time, moved, lam=penalty)
        column, slopes = (spline(time) - base(time)) / 1e-3, (spline(time, 1) - base(time, 1)) / 1e-3
        assert_allclose(operators.strain[:, sample], column, atol=1e-3 * np.abs(operators.strain).max())
        assert_allclose(operators.rate[:, sample], slopes, atol=5e-3 * np.abs(operators.rate).max())


def test_operators_are_blocks_between_jumps():
    """The sample at the jump serves no other one; a shift of all samples is a shift, and a ramp a ramp."""
    time, strain = (each[::4] for each in jump_history(2e-5))
    found = excite(record(time, strain))
    (jump,) = found.jumps
    operator, rate = found.strain_operator(), found.rate_operator()
    assert_allclose(operator @ strain, found.true_strain, atol=1e-12)
    assert_allclose(rate @ strain, found.strain_rate, atol=1e-12)
    assert not operator[:jump, jump + 1 :].any()
    assert not rate[jump + 1 :, :jump].any()
    assert not np.delete(operator[:, jump], jump).any()
    assert_allclose(operator.sum(axis=1), 1.0, atol=1e-9)
    assert_allclose(rate @ time, 1.0, atol=1e-9)


def test_a_jump_between_two_samples_spoils_neither_side():
    """At 100.04 s, noise 1e-6: the sample at 100 s is off the fast line by 9e-3 x 0.04 = 3.6e-4."""
    time = np.linspace(0.0, 200.0, 2001)
    strain = np.where(time < 100.04, 1e-3 * time, 0.10004 + 1e-2 * (time - 100.04))
    strain += 1e-6 * np.random.default_rng(1).normal(size=time.size)
    found = excite(record(time, strain))
    (jump,) = found.jumps
    assert_allclose(found.strain_rate[: jump + 1], 1e-3, rtol=1e-3)
    assert_allclose(found.strain_rate[jump + 1 :], 1e-2, rtol=1e-4)
    assert_allclose(found.true_strain, strain, atol=6e-6)


def test_refined_histories_have_operators_too():
    """Both straight lines and cubics are linear in the samples; at a jump the engine's own side is taken."""
    time, strain = jump_history(2e-5)
    for method in ("raw", "spline"):
        fine = excite(record(time[::8], strain[::8]), method).refined(3)
        assert_allclose(fine.strain_operator() @ strain[::8], fine.true_strain, atol=1e-12)
        if method == "spline":
            assert_allclose(fine.rate_operator() @ strain[::8], fine.strain_rate, atol=1e-12)
        else:
            assert fine.rate_operator() is None


def test_strain_as_measured_has_no_operator_and_a_given_rate_does_not_depend_on_it():
    time = np.linspace(0.0, 10.0, 101)
    raw = excite(record(time, 0.01 * time), "raw")
    assert raw.strain_operator() is None
    assert raw.rate_operator() is None
    given = excite(record(time, 0.01 * time, strain_rate=np.full(101, 0.01)))
    assert given.strain_operator() is None
    assert not given.rate_operator().any()


def test_standard_errors_are_those_of_white_noise_through_the_operators():
    """A central difference of white noise s at spacing h scatters by s / (h sqrt 2)."""
    time = np.linspace(0.0, 10.0, 101)
    raw = excite(record(time, 0.01 * time, noise=Noise(strain=1e-4)), "raw")
    assert_allclose(raw.strain_se, 1e-4)
    assert_allclose(raw.rate_se[1:-1], 1e-4 / 0.1 / np.sqrt(2.0))


@pytest.mark.parametrize("seed", range(5))
def test_a_small_jump_in_much_noise_is_found_and_placed_by_all_the_samples_around(seed):
    """From 1.25e-3 to 1.5e-3 1/s at 300.4 s, noise 6e-4: lines through 150 samples on either side place it to 0.6 s.

    A corner of slope change v is placed to noise / v times sqrt(8 / n) by n samples on either side.
    """
    time = np.arange(0.0, 600.0, 1.0)
    strain = 1.25e-3 * time + 0.25e-3 * np.maximum(time - 300.4, 0.0)
    (jump,) = find_jumps(time, strain + 6e-4 * np.random.default_rng(seed).normal(size=time.size), 6e-4)
    assert abs(time[jump] - 300.4) <= 4.0 * 6e-4 / 0.25e-3 * np.sqrt(8.0 / 150.0)


def test_the_strain_at_a_jump_is_that_of_its_sample_where_both_sides_miss_it():
    """Noise 2.7e-4; both sides' lines, carried on to the sample, miss the strain there by up to 5e-3."""
    time = np.arange(0.0, 160.0, 0.4)
    strain = np.where(time < 83.14, 2e-2 * time, 2e-2 * 83.14 + 2e-3 * (time - 83.14))
    for seed in range(5):
        found = excite(record(time, strain + 2.7e-4 * np.random.default_rng(seed).normal(size=time.size)))
        (jump,) = found.jumps
        assert abs(found.true_strain[jump] - strain[jump]) < 4.0 * 2.7e-4


@pytest.mark.parametrize(("often", "lag"), [(0.25, 0.0), (0.25, 0.6), (2.0, 0.0), (2.0, 3.0)])
def test_the_error_at_a_jump_holds_what_a_machines_lag_rounds_there(often, lag):
    """Also where the corner lies beside the sample that it is put at; noise 5e-4.

    Without an error of its own for where the corner is, that of the strain is 2.3 and 1.9 times what is said of it.
    """
    time = np.arange(0.0, 100.0 * often, often)
    after = np.maximum(time - 50.3 * often, 0.0)
    turned = after - lag * (1.0 - np.exp(-after / lag)) if lag else after
    strain = (2e-3 * time - 1.8e-3 * turned) / often
    ratios = []
    for seed in range(40):
        noisy = strain + 5e-4 * np.random.default_rng(seed).normal(size=time.size)
        found = excite(record(time, noisy, noise=Noise(strain=5e-4)))
        ratios += [(found.true_strain[jump] - strain[jump]) / found.strain_se[jump] for jump in found.jumps]
    assert len(ratios) >= 40
    assert 0.4 < np.sqrt(np.mean(np.square(ratios))) < 1.3


@pytest.mark.parametrize("seed", range(6))
def test_where_a_crosshead_changes_its_speed_the_rate_jumps_though_the_true_strain_bends_elsewhere(seed):
    """At a constant speed the nominal strain is straight, the true strain bends, and before the change by more than
    behind it. A jump was put six samples early, as the beginning of a lag (p = 1e-153 of a null); another one sample
    late, at the corner of the stress, since no parabolas described the strain on either side."""
    rng = np.random.default_rng(seed)
    even = np.sort(np.append(52.1 * np.arange(400.0), 2180.3))
    uneven = np.concatenate([[0.0], np.cumsum(rng.uniform(18.0, 50.0, 200))])
    uneven = np.insert(uneven, 27, uneven[26] + 3.0)
    for time, at, fast, slow, noise in ((even, 42, 3.8e-4, 4.2e-5, 1e-5), (uneven, 26, 8e-4, 8e-5, 6e-6)):
        strain = np.log1p(fast * np.minimum(time, time[at]) + slow * np.maximum(time - time[at], 0.0))
        noisy = strain + noise * rng.standard_normal(len(time))
        for late in (0, 1):  # a corner of the stress one sample behind is refuted by the strain
            since = time - time[at + late]
            yields, relaxes = (
                20.0 - 5.0 * np.exp(-time / 150.0),
                20.0 - 3.0 * -np.expm1(-np.maximum(since, 0.0) / 400.0),
            )
            stress = np.where(since < 0.0, yields + 5e-3 * since, relaxes) + 0.02 * rng.standard_normal(len(time))
            assert find_jumps(time, noisy, noise, stress) == [at], late
