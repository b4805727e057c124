"""The university's laboratory: its integration, its errors, its forms, its secrecy."""

import json
from dataclasses import astuple, replace

import numpy as np
import pytest

import probation
from probation_studies.blind.laboratories import university
from probation_studies.blind.laboratories.university.catalogue_names import CATALOGUE_NAMES, catalogue_name
from probation_studies.blind.laboratories.university.causes import COMMON, OUTSIDE, Run
from probation_studies.blind.laboratories.university.design import Specimen, draw_design
from probation_studies.blind.laboratories.university.errors import strain_response
from probation_studies.blind.laboratories.university.histories import FINER, loops, relaxation
from probation_studies.blind.laboratories.university.known_causes import left_when_told
from probation_studies.blind.laboratories.university.modal_law import Material, base_course, integrate
from probation_studies.blind.laboratories.university.oracle import Candidate, consult, discriminability
from probation_studies.blind.laboratories.university.planting import plant
from probation_studies.blind.laboratories.university.signals import added, bench_of, course_of, specimen_response

PLAIN = Material(2000.0, 5.0, 2.0)
WITH_COMPANION = Material(3000.0, 1.1, 1.8, (0.00464, 0.0367))


def _engine(material):
    if material.companion is None:
        return probation.Law(
            unrelaxed_modulus=material.modulus, tau_max=material.time, hardening_modulus=material.hardening
        )
    return probation.Law(
        unrelaxed_modulus=material.modulus,
        alpha=material.time,
        hardening_modulus=material.hardening,
        companion=probation.Weissenberg(*material.companion),
    )


@pytest.mark.parametrize("material", [PLAIN, WITH_COMPANION])
def test_its_integrator_agrees_with_the_engine(material):
    """To 1e-4 of the largest stress, along a path with an unloading where the companion relation allows it."""
    time = np.linspace(0.0, 150.0, 1201)
    strain = 0.005 * time + 0.02 * np.sin(0.05 * time)
    if material.companion is None:
        strain -= 0.4 * np.maximum(0.0, 0.02 - np.abs(time - 80.0) / 200.0)
    ours = integrate(time, [base_course(material, time, strain)])[0]
    theirs = _engine(material).stress(time, strain, scheme="exact")
    assert np.max(np.abs(ours - theirs)) < 1e-4 * np.max(np.abs(theirs))


def test_errors_of_the_strain_go_through_the_law_as_differences_say():
    random = np.random.default_rng(1)
    time = np.linspace(0.0, 60.0, 121)
    strain = 0.006 * time
    noise = 1e-5 * random.standard_normal(len(time))
    stress = integrate(time, [base_course(PLAIN, time, each) for each in (strain, strain + noise)])
    carried = strain_response(PLAIN, time, strain) @ noise
    assert np.linalg.norm(stress[1] - stress[0] - carried) < 0.03 * np.linalg.norm(carried)


def test_feedbacks_hardly_depend_on_the_grid():
    """Half the step moves what they add by less than 3 %."""
    for cause in COMMON:
        if cause.name not in ("stress-activated flow", "self-heating"):
            continue
        for form in cause.forms:
            found = []
            for number in (1601, 3201):
                time = np.linspace(0.0, 150.0, number)
                run = Run(PLAIN, time, 0.006 * time, 150.0 / 400)
                setting = _setting()
                shape = form.draw(np.random.default_rng(3), setting)
                course = course_of(run, (form.act(run, cause.scale, shape),))
                stress = integrate(time, [run.course, course])
                found.append((stress[1] - stress[0])[:: (number - 1) // 400])
            assert np.linalg.norm(found[1] - found[0]) < 0.03 * np.linalg.norm(found[1]), form.name


def _setting():
    return draw_design(np.random.default_rng(8), unloading=True, replicated=False).setting


@pytest.fixture(scope="module")
def looped():
    """A record with loops: four steps per sample."""
    setting = replace(_setting(), rate=0.006, strain=0.6, duration=110.0, time=5.0, drop=0.01, flow_stress=20.0)
    programme = loops(0.006, 0.6, 0.01, 3)
    knots = np.cumsum([0.0, *(length for _, length in programme.segments)])
    values = np.cumsum([0.0, *(rate * length for rate, length in programme.segments)])
    time = np.linspace(0.0, programme.duration, 240 * FINER + 1)
    return Run(PLAIN, time, np.interp(time, knots, values), programme.duration / 240), setting


@pytest.mark.parametrize("cause", [*COMMON, *OUTSIDE], ids=lambda cause: cause.name)
def test_every_form_of_a_cause_adds_something_finite_that_grows_with_its_amplitude(cause, looped):
    run, setting = looped
    random = np.random.default_rng(2)
    assert len(cause.forms) >= 2
    for form in cause.forms:
        shape = form.draw(random, setting)
        small, large = added(run, [(form.act(run, a * cause.scale, shape),) for a in (0.5, 1.0)]).T
        assert np.all(np.isfinite(large)), form.name
        assert 0.0 < np.linalg.norm(small) < np.linalg.norm(large), form.name


@pytest.fixture(scope="module")
def campaigns():
    quick = {"none": 3, "replicates": 2, "single": 2, "pair": 1, "outside": 2}  # small ones
    return {name: university.make(40, quick[name], stratum=name) for name in university.STRATA}


@pytest.mark.parametrize("stratum", university.STRATA)
def test_a_campaign_of_each_stratum_is_made_and_read_and_says_nothing(stratum, campaigns, tmp_path):
    sealed = campaigns[stratum]
    truth = json.loads(sealed.truth.to_json())
    read = probation.Campaign.load(sealed.write(tmp_path / sealed.name))
    assert truth["stratum"] == ("none" if stratum == "replicates" else stratum)
    assert (truth["scatter"] is None) == (truth["replicates"] == 1)
    assert 3 <= len(read.records) <= 9
    for record, made in zip(read.records, sealed.records, strict=True):
        assert np.allclose(record.true_stress, made.true_stress, rtol=1e-11, atol=0.0)
        assert 300 <= len(record.time) <= 1500
        assert 5.0 < np.max(record.true_stress) < 400.0
        assert record.true_strain[0] != 0.0
    expected = {"single": 1, "pair": 2, "outside": 1}.get(stratum, 0)
    assert len(truth["causes"]) == expected
    assert truth["explanation"] == sorted(catalogue_name(each["kind"]) for each in truth["causes"])
    assert ("unknown" in truth["explanation"]) == (stratum == "outside")
    assert sum(truth["oracle"]["posterior"].values()) == pytest.approx(1.0, abs=0.05)
    for cause in truth["causes"]:
        assert cause["detectability"] >= 1.5
        assert 0.0 <= cause["left_by_best_other"] <= cause["detectability"] * 1.001
        assert all(0.0 <= each <= 1.0 for each in cause["discriminability"].values())
    said = (tmp_path / sealed.name / "campaign.toml").read_text().lower()
    assert not any(word in said for word in ("stratum", "truth", "seed", *CATALOGUE_NAMES.values()))
    assert ('scatter = "none"' in said) == (truth["scatter"] is None)


def test_a_campaign_is_the_same_for_the_same_seed(campaigns):
    again = university.make(40, 2, stratum="single")
    assert again.truth.to_json() == campaigns["single"].truth.to_json()
    assert again.truth.to_json() != university.make(40, 2, "calibrate", "none").truth.to_json()


def test_what_a_null_leaves_of_the_engine_is_white_of_variance_one():
    """The engine's exact scheme along the recorded strain, whitened by the covariance of all errors."""
    for seed in range(3, 30):
        design = draw_design(np.random.default_rng(seed), unloading=False, replicated=False)
        if design.material.companion is None and design.errors.strain < 3e-4:
            break
    bench = bench_of(design)
    random = np.random.default_rng(7)
    engine = _engine(design.material)
    for k, test in enumerate(bench.tests):
        time, strain = test.run.time[::FINER], test.run.strain[::FINER]
        n = len(time)
        stress = integrate(test.run.time, [test.run.course])[0][::FINER] + design.errors.draw_stress(random, n)
        quantum = design.errors.quantum
        stress = quantum * np.round(stress / quantum)
        seen = strain + design.errors.strain * design.errors.averaging(n) @ random.standard_normal(n)
        white = bench.whitened(k, stress - engine.stress(time, seen, scheme="exact"))
        assert abs(white @ white / n - 1.0) < 6.0 * np.sqrt(2.0 / n)


def test_a_specimen_deviates_as_the_covariance_has_it():
    """To first order: up to a tenth, deviations being some per cent."""
    design = draw_design(np.random.default_rng(12), unloading=False, replicated=True)
    bench = bench_of(design)
    test, deviating = bench.tests[0], bench.specimens[0]
    other = base_course(test.specimen.of(design.material), test.run.time, test.run.strain)
    mean, stress = integrate(test.run.time, [test.run.course, other])[:, ::FINER]
    stress = stress * (1.0 + test.specimen.area)
    left = stress - mean - deviating @ np.array(astuple(test.specimen))
    assert test.specimen.modulus != 0.0
    assert np.linalg.norm(left) < 0.1 * np.linalg.norm(stress - mean)


def test_discriminability_is_what_the_method_says():
    """95 % takes a detectability of 2.8 at 90 degrees and 18.9 at 10."""
    assert discriminability(2.8, 0.0) == pytest.approx(0.95, abs=0.01)
    assert discriminability(18.9, np.cos(np.radians(10.0))) == pytest.approx(0.95, abs=0.01)


def test_an_oracle_is_not_disturbed_by_what_no_record_shows():
    """A candidate whose signal is round-off alone."""
    candidates = [Candidate(name, name, 1.0, outside=False) for name in ("a", "b")]
    gram = np.array([[25.0, 1e-4], [1e-4, -1e-24]])
    clean = np.array([25.0, 1e-4])
    found = consult(np.random.default_rng(0), candidates, gram, clean, clean, ("a",))
    assert sum(found.posterior.values()) == pytest.approx(1.0, abs=1e-3)


def test_holds_hold_and_loops_return():
    assert relaxation(0.01, 0.2, 30.0).segments[-1] == (0.0, 30.0)
    assert sum(rate * length for rate, length in loops(0.01, 0.5, 0.02, 3).segments) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("seed", "split", "stratum"), [(-1, "develop", "none"), (0, "train", "none"), (0, "develop", "mimic")]
)
def test_bad_arguments_are_named(seed, split, stratum):
    with pytest.raises(probation.InputError, match=r"split|stratum|seed, index"):
        university.make(seed, 0, split, stratum)


@pytest.fixture(scope="module")
def predicted():
    """A bench with two held-out records, specimens that differ, and self-heating."""
    random = np.random.default_rng(6)
    bench = bench_of(draw_design(random, unloading=False, replicated=True))
    planted = plant(random, bench, next(each for each in COMMON if each.name == "self-heating"), 40.0)
    return bench, [planted]


def _taken_up(bench, planted, parameters, amplitude):
    """Errors that the base law's parameters and the amplitude of the cause take up, in every record."""
    found = {}
    for test in bench.design.tests:
        cause = added(test.run, [planted[0].act(test.run, None)])[:, 0]
        found[test.id] = specimen_response(test)[:, :3] @ parameters + amplitude * cause
    return found


def test_what_a_refit_takes_up_is_left_in_no_record_and_a_held_out_specimen_is_not_known(predicted):
    """What is left of a held-out record is its specimen's response to its deviations, to the refit's rounding."""
    bench, planted = predicted
    errors = _taken_up(bench, planted, np.array([0.01, -0.02, 0.03]), 0.2)
    size = {name: np.sqrt(np.mean(each**2)) for name, each in errors.items()}

    def left(specimen):
        tests = tuple(replace(test, specimen=specimen if test.held_out else Specimen()) for test in bench.design.tests)
        told = replace(
            bench,
            design=replace(bench.design, tests=tests),
            tests=tuple(test for test in tests if not test.held_out),
        )
        return left_when_told(told, planted, [errors[test.id] for test in bench.tests], errors)

    nothing = left(Specimen())
    assert nothing.keys() == size.keys()
    assert all(nothing[name] < 1e-6 * size[name] for name in size)
    own = Specimen(0.02, 0.0, 0.0, 0.01)
    for name, found in left(own).items():
        test = next(each for each in bench.design.tests if each.id == name)
        expected = np.sqrt(np.mean((specimen_response(test) @ np.array(astuple(own))) ** 2)) if test.held_out else 0.0
        assert found == pytest.approx(expected, rel=1e-6, abs=1e-6 * size[name])


def test_a_truth_says_what_a_told_refit_leaves_of_every_record():
    """Specimens alike: the noise of the force, of several hundred samples; of a held-out record, too."""
    truth = json.loads(university.make(1312, 7, stratum="pair").truth.to_json())
    left, records = truth["left_when_told_MPa"], truth["records"]
    assert left.keys() == records.keys()
    assert {each["role"] for each in records.values()} == {"identify", "held-out"}
    noise = np.hypot(truth["noise"]["stress"], truth["noise"]["quantum"] / np.sqrt(12.0))
    assert np.array(list(left.values())) == pytest.approx(noise, rel=0.15)
