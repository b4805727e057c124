"""The materials-testing institute: its solver, its errors, its causes, its secrecy."""

import json
from dataclasses import replace

import numpy as np
import pytest

import probation
from probation.effects.registry import effects
from probation_studies.blind.laboratories import institute
from probation_studies.blind.laboratories.institute.causes import BEYOND, COMMON
from probation_studies.blind.laboratories.institute.instruments import draw_instruments
from probation_studies.blind.laboratories.institute.modal import (
    RATIO,
    WEIGHT,
    Course,
    Polymer,
    on_grid,
    plain,
    solve,
)
from probation_studies.blind.laboratories.institute.names import NAMES, name_of
from probation_studies.blind.laboratories.institute.oracle import Placed, consult, discriminability
from probation_studies.blind.laboratories.institute.planting import plant
from probation_studies.blind.laboratories.institute.programmes import carry_out, cycles, hold
from probation_studies.blind.laboratories.institute.series import draw_series
from probation_studies.blind.laboratories.institute.sight import Sight, added, course_of, shown

PLAIN = Polymer(2000.0, 5.0, 2.0)
WITH_COMPANION = Polymer(3000.0, 1.1, 1.8, (0.00464, 0.0367))


def _engine(polymer):
    given = {"unrelaxed_modulus": polymer.modulus, "hardening_modulus": polymer.hardening}
    if polymer.companion is None:
        return probation.Law(tau_max=polymer.time, **given)
    return probation.Law(alpha=polymer.time, companion=probation.Weissenberg(*polymer.companion), **given)


def _ramp(count):
    time = np.linspace(0.0, 100.0, count)
    return time, on_grid(time), on_grid(0.006 * time)


def test_a_ramp_has_its_closed_form_and_the_scheme_its_third_order():
    """E p tau rate (1 - exp(-t/tau)), and the network's memory exp(-t/tau)/tau of exp(2 eps) and exp(-eps)."""
    elastic = Polymer(2000.0, 5.0, 0.0)
    tau = 5.0 * RATIO[:, None]
    error = []
    for count in (101, 201, 401):
        time, grid, strain = _ramp(count)
        exact = (2000.0 * 0.006 * WEIGHT[:, None] * tau * -np.expm1(-time / tau)).sum(axis=0)
        found = solve(grid, [plain(elastic, grid, strain), plain(PLAIN, grid, strain)])
        late = time >= 20.0
        growing = 0.0
        for part, power in ((1.0, 0.012), (-1.0, -0.006)):  # R = G (exp(2 eps) - exp(-eps)) by every exponential
            memory = (np.exp(power * time) - np.exp(-time / tau)) / (1.0 + power * tau)
            growing = growing + part * 2.0 * (WEIGHT[:, None] * memory).sum(axis=0)
        assert np.max(np.abs(found[0] - exact)) < 1e-3 * exact.max()
        error.append(np.max(np.abs(found[1] - exact - growing)[late]))
    orders = np.log2(np.array(error[:-1]) / error[1:])
    assert np.all(np.abs(orders - 3.0) < 0.15), orders


def test_grading_makes_the_start_seven_times_better():
    time, grid, strain = _ramp(401)
    course = plain(Polymer(2000.0, 5.0, 0.0), grid, strain)
    tau = 5.0 * RATIO[:, None]
    exact = (12.0 * WEIGHT[:, None] * tau * -np.expm1(-time / tau)).sum(axis=0)
    graded, even = (np.max(np.abs(solve(grid, [course], graded=each)[0] - exact)) for each in (True, False))
    assert graded < even / 6.0


@pytest.mark.parametrize("polymer", [PLAIN, WITH_COMPANION])
def test_its_solver_agrees_with_the_engine(polymer):
    """To 1e-4 of the largest stress, along a path with an unloading where the companion relation allows it."""
    time = np.linspace(0.0, 150.0, 1201)
    strain = 0.005 * time + 0.02 * np.sin(0.05 * time)
    if polymer.companion is None:
        strain -= 0.4 * np.maximum(0.0, 0.02 - np.abs(time - 80.0) / 200.0)
    grid = on_grid(time)
    found = solve(grid, [plain(polymer, grid, on_grid(strain))])[0]
    expected = _engine(polymer).stress(time, strain, scheme="exact")
    assert np.max(np.abs(found - expected)) < 1e-4 * np.max(np.abs(expected))


def test_feedbacks_hardly_depend_on_the_grid():
    """Half the step moves what stress and heat add by less than 2 %."""
    test = _series({"cycles"}).tests[0]
    for cause in COMMON:
        if cause.name not in ("activation by stress", "heat of deformation"):
            continue
        for form in cause.forms:
            shape = form.draw(np.random.default_rng(3))
            found = []
            for every in (2, 1):
                nodes = test.time[::2][::every], test.strain[::2][::every]
                path = replace(test.path, time=on_grid(nodes[0]), strain=on_grid(nodes[1]))
                coarse = replace(test, path=path)
                course = course_of(coarse, [form.change(coarse, cause.scale, shape)])
                stress = solve(path.time, [course, coarse.course])
                found.append((stress[0] - stress[1])[:: 3 - every])
            assert np.linalg.norm(found[1] - found[0]) < 0.02 * np.linalg.norm(found[1]), form.name


def _series(needs, seed=8, **wanted):
    random = np.random.default_rng(seed)
    while True:
        found = draw_series(random, frozenset(needs), replicated=wanted.get("replicated", False))
        nodes = len(found.tests[0].time[::2])
        if nodes % 2 and all(getattr(found, name) == value for name, value in wanted.items() if name != "replicated"):
            return found


@pytest.fixture(scope="module")
def everything():
    """A series in which every cause can show."""
    return _series({"cycles", "deep", "temperatures", "order"})


@pytest.mark.parametrize("cause", [*COMMON, *BEYOND], ids=lambda cause: cause.name)
def test_every_form_adds_something_finite_that_grows_with_its_amplitude(cause, everything):
    assert len(cause.forms) >= 2
    for form in cause.forms:
        shape = form.draw(np.random.default_rng(2))
        sizes = []
        for part in (0.01, 0.1, 1.0):
            columns = [added(test, [form.change(test, part * cause.scale, shape)])[:, 0] for test in everything.tests]
            assert all(np.all(np.isfinite(each)) for each in columns), form.name
            sizes.append(np.linalg.norm(np.concatenate(columns)))
        assert 0.0 < sizes[0] < sizes[2], form.name
        assert sizes[0] < 0.2 * sizes[2], form.name  # it vanishes with its amplitude


@pytest.mark.parametrize("form", [0, 1], ids=["Arruda and Boyce", "Gent"])
def test_what_is_said_of_a_cause_is_that_of_the_amplitude_in_the_records(form):
    """Limited chains grow with a high power of their amplitude: steps in proportion would overshoot ever further."""
    sight = Sight(_series(set(), 38))
    planted = plant(np.random.default_rng(form), sight, next(each for each in COMMON if "limited" in each.name), 70.0)
    assert planted.size == pytest.approx(70.0, rel=0.11)
    columns = [added(test, planted.change(test, k))[:, 0] for k, test in enumerate(sight.tests)]
    assert np.linalg.norm(sight.left(sight.whitened(columns))) == pytest.approx(planted.size, rel=1e-9)


def test_its_names_are_the_catalogues_and_three_causes_have_none():
    assert set(NAMES) == {cause.name for cause in COMMON}
    assert {each.name for each in effects()} - set(NAMES.values()) == {"ageing", "guide_friction"}
    assert set(NAMES.values()) <= {each.name for each in effects()}
    assert [name_of(cause.name) for cause in BEYOND] == ["unknown"] * 3


@pytest.mark.parametrize("companion", [None, (0.00464, 0.0367)])
def test_what_a_null_leaves_of_the_engine_is_white_of_variance_one(companion):
    """The engine along the recorded strain, whitened by all errors; within six standard errors."""
    seed = 20
    while True:
        series = _series(set(), seed)
        if series.polymer.companion == companion:
            break
        seed += 1
    sight, random = Sight(series), np.random.default_rng(7)
    read = []
    for test in sight.tests:
        samples = test.path.samples
        time = test.time[::2][samples]
        strain, force = (each[samples] for each in shown(test, [], test.stress))
        strain = series.instruments.read_strain(random, time, strain)
        stress = series.instruments.read_force(random, time, force) * np.exp(strain)
        read.append(stress - _engine(series.polymer).stress(time, strain, scheme="exact"))
    white = sight.whitened(read)
    assert abs(white @ white / len(white) - 1.0) < 6.0 * np.sqrt(2.0 / len(white))
    assert abs(white[1:] @ white[:-1] / len(white)) < 6.0 / np.sqrt(len(white))


def test_the_noise_of_the_force_has_the_spectrum_that_is_stated():
    """Below the corner frequency the power is more than white by the corner over the frequency, within a third."""
    instruments = replace(draw_instruments(np.random.default_rng(1), 20.0, np.inf), corner=20.0, stress_step=1e-9)
    time, random = np.linspace(0.0, 1.0, 512), np.random.default_rng(5)
    power = 0.0
    for _ in range(300):
        force = instruments.read_force(random, time, np.zeros(512))
        power = power + np.abs(np.fft.rfft(force * np.hanning(512))) ** 2 / 300.0
    power = power / (instruments.stress**2 * np.sum(np.hanning(512) ** 2))
    for turns in (4, 8, 20, 80):
        near = power[turns - turns // 4 : turns + turns // 4 + 1].mean()
        assert near == pytest.approx(1.0 + 20.0 / turns, rel=0.35)


def test_the_servo_frame_overshoots_and_electromechanical_ones_do_not():
    """Speed over its command after the start, the wander of some tenths of a per cent aside."""
    largest = {}
    for servo in (True, False):
        path = carry_out(
            np.random.default_rng(4), hold(0.01, 0.5, 40.0), 400, servo=servo, logged=False, preload=0.0, longest=2.0
        )
        largest[servo] = np.max(np.diff(path.strain[::2]) / np.diff(path.time[::2])) / 0.01
    assert 1.02 < largest[True] < 1.5
    assert 0.98 < largest[False] < 1.02


def test_a_preloaded_record_starts_relaxed_at_its_strain():
    path = carry_out(
        np.random.default_rng(4), cycles(0.002, 0.3, 0.01, 2), 300, servo=False, logged=True, preload=1e-3, longest=15.0
    )
    stress = solve(path.time, [plain(Polymer(2000.0, 15.0, 2.0), path.time, path.strain)])[0][path.first]
    assert path.time[::2][path.first] == 0.0
    assert path.strain[::2][path.first] == pytest.approx(1e-3)
    assert stress == pytest.approx(2.0 * 3e-3, abs=2e-4)


@pytest.fixture(scope="module")
def campaigns():
    quick = {"none": 35, "replicates": 36, "single": 13, "pair": 47, "outside": 39}  # small ones
    return {name: institute.make(77, quick[name], stratum=name) for name in institute.STRATA}


@pytest.mark.parametrize("stratum", institute.STRATA)
def test_a_campaign_of_each_stratum_is_made_and_read_and_says_nothing(stratum, campaigns, tmp_path):
    made = campaigns[stratum]
    truth = json.loads(made.truth.to_json())
    read = probation.Campaign.load(made.write(tmp_path / made.name))
    assert truth["stratum"] == stratum
    for record, written in zip(read.records, made.records, strict=True):
        assert np.allclose(record.true_stress, written.true_stress, rtol=1e-11, atol=0.0)
        assert np.all(np.diff(record.time) > 0.0)
        assert 0.5 < np.max(record.true_stress) < 400.0
        assert truth["records"][record.id]["samples"] == len(record.time)
    assert len(truth["causes"]) == {"single": 1, "pair": 2, "outside": 1}.get(stratum, 0)
    assert truth["explanation"] == sorted(name_of(each["kind"]) for each in truth["causes"])
    assert ("unknown" in truth["explanation"]) == (stratum == "outside")
    assert truth["sampling_detectability"] <= 1.0
    assert sum(truth["oracle"]["posterior"].values()) == pytest.approx(1.0, abs=0.05)
    assert truth["oracle"]["resolvable"] == (truth["oracle"]["right"] >= 0.95)
    for cause in truth["causes"]:
        assert 3.6 <= cause["detectability"] <= 120.0
        assert 0.0 <= cause["left_by_best_other"] <= cause["detectability"] * 1.001
        assert all(0.0 <= each <= 1.0 for each in cause["discriminability"].values())
    said = (tmp_path / made.name / "campaign.toml").read_text().lower()
    assert not any(word in said for word in ("stratum", "truth", "seed", *NAMES, *NAMES.values()))
    assert ('scatter = "none"' in said) == (truth["scatter"] is None)
    assert (truth["scatter"] is not None) == (stratum == "replicates") or stratum not in ("none", "replicates")


def test_a_campaign_is_the_same_for_the_same_arguments(campaigns):
    again = institute.make(77, 13, stratum="single")
    assert again.truth.to_json() == campaigns["single"].truth.to_json()
    assert all(
        np.array_equal(one.true_stress, other.true_stress)
        for one, other in zip(again.records, campaigns["single"].records, strict=True)
    )
    assert institute.make(77, 13, "calibrate", "single").truth.to_json() != again.truth.to_json()


def test_the_oracle_names_what_is_plain_and_not_what_is_alike():
    """Signals at right angles, of 10: right in nearly all repeats. Of cosine 0.999: in about half of them."""
    for cosine, low, high in ((0.0, 0.97, 1.0), (0.999, 0.3, 0.75)):
        signals = np.array([[1.0, 0.0], [cosine, np.sqrt(1.0 - cosine**2)]])
        candidates = [Placed(name, name, None, 1.0, signal) for name, signal in zip("ab", signals, strict=True)]
        acting = 10.0 * signals[0]
        found = consult(np.random.default_rng(1), candidates, acting, np.zeros(2), ("a",), "unknown")
        assert low <= found.right <= high
        assert found.resolvable == (cosine == 0.0)
        assert ("a",) in found.answer_set
    apart = [Placed(name, name, None, 1.0, signal) for name, signal in zip("ab", np.eye(2), strict=True)]
    nothing = consult(np.random.default_rng(1), apart, np.zeros(2), np.zeros(2), (), "unknown")
    assert nothing.right > 0.97
    assert nothing.answer_set == ((),)


@pytest.mark.parametrize(("size", "degrees"), [(2.8, 90.0), (6.4, 30.0), (18.9, 10.0)])
def test_discriminability_is_95_percent_at_the_published_sizes(size, degrees):
    assert discriminability(size, float(np.cos(np.radians(degrees)))) == pytest.approx(0.95, abs=0.005)


@pytest.mark.parametrize(
    ("seed", "split", "stratum"), [(-1, "develop", "none"), (0, "train", "none"), (0, "develop", "mimic")]
)
def test_bad_arguments_are_named(seed, split, stratum):
    with pytest.raises(probation.InputError, match=r"split|stratum|seed, index"):
        institute.make(seed, 0, split, stratum)


def test_a_course_that_starts_loaded_relaxes_as_its_modes_do():
    time = np.linspace(0.0, 10.0, 401)
    grid = on_grid(time)
    still = np.zeros(len(grid))
    course = Course(still, np.full(len(grid), np.log(5.0)), still, still + 2000.0, start=WEIGHT * 3.0)
    expected = (3.0 * WEIGHT[:, None] * np.exp(-time / (5.0 * RATIO[:, None]))).sum(axis=0)
    found = solve(grid, [course])[0]
    assert np.allclose(found[40:], expected[40:], atol=2e-4)
