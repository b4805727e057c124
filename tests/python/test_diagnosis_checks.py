"""What speaks for an explanation beside its probability: records left out, one amplitude for all, bounds."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import chi2

from campaigns import linear_problem as problem
from probation.diagnosis.checks import amplitude_consistency, checks, left_out_squares
from probation.diagnosis.closure import Closure
from probation.diagnosis.free_function import Dependence
from probation.diagnosis.hypothesis import Hypothesis
from probation.diagnosis.remainder import Remainder
from probation.diagnosis.remaining import leaves_too_much
from probation.diagnosis.result import Shrink
from probation.effects.cause import Cause
from probation.inference.evidence import Evidence
from probation.inference.model import CampaignModel

COUNT = 80
TIME = np.linspace(0.0, 100.0, COUNT)
ENDS = (1.0, 0.6, 1.4, 0.9)


def added(scale=1e3, low=-1e3):
    """Stress + a sqrt(strain); a prior so wide that it says nothing."""
    return problem.effect(
        lambda view, values: values[0] * np.sqrt(view.true_strain), problem.parameter("size", low, 1e3, scale)
    )


def recorded(sizes, seed=0):
    """Four ramps of a bar of 100 MPa, to which so much of the effect is added in each."""
    rng = np.random.default_rng(seed)
    strains = [end * TIME / 100.0 for end in ENDS]
    stresses = [
        100.0 * strain + size * np.sqrt(strain) + problem.SIGMA * rng.standard_normal(COUNT)
        for strain, size in zip(strains, sizes, strict=True)
    ]
    return problem.views(stresses, ENDS)


def explained(views, effect=None, records=None):
    """The hypothesis of the effect, and the base law's refit, with the records at it."""
    base = problem.solved(problem.bar(), views)
    chosen = effect or added()
    found = problem.solved(problem.bar(), views, [Cause(chosen, chosen.forms[0], records)])
    unasked = Evidence(0.0, 0.0, -np.inf, np.zeros((2, 2)))
    return Hypothesis(found, unasked), base, problem.whitened(base)


def test_a_record_left_out_is_predicted_as_by_a_fit_without_it():
    """Ordinary least squares on the other three, their parameters put into the fourth."""
    views = recorded((2.0, 2.0, 3.0, 2.0))
    hypothesis, _, whitened = explained(views)
    found = left_out_squares(hypothesis.refit, whitened)
    designs = [np.column_stack([view.true_strain, np.sqrt(view.true_strain)]) for view in views]
    for out, view in enumerate(views):
        kept = [index for index in range(4) if index != out]
        stacked, data = np.vstack([designs[i] for i in kept]), np.concatenate([views[i].data for i in kept])
        fitted = np.linalg.lstsq(stacked, data, rcond=None)[0]
        expected = np.sum((designs[out] @ fitted - view.data) ** 2) / problem.SIGMA**2
        assert found[out] == pytest.approx(expected, rel=1e-4)


def test_of_a_law_that_is_not_linear_it_is_what_a_refit_foretells_to_a_few_percent():
    """Stress = plateau (1 - exp(-strain/scale)), refitted without each record in turn."""
    rng = np.random.default_rng(1)
    law = problem.bar(
        lambda strain, p: p[0] * -np.expm1(-strain / p[1]), ("plateau_MPa", "scale"), (50.0, 0.3), (0, 0.01), (1e4, 9)
    )
    stresses = [
        40.0 * -np.expm1(-end * TIME / 100.0 / 0.2) + problem.SIGMA * rng.standard_normal(COUNT) for end in ENDS
    ]
    views = problem.views(stresses, ENDS)
    found = problem.solved(law, views)
    predicted = left_out_squares(found, problem.whitened(found))
    for out, view in enumerate(views):
        rest = problem.solved(law, [each for each in views if each is not view], start=found.parameters)
        residual = CampaignModel(law, [view]).residual(rest.parameters) / problem.SIGMA
        assert predicted[out] == pytest.approx(residual @ residual, rel=0.02)


def cochran(views):
    """Amplitudes by record beside one modulus, by least squares; Q of their distance from the weighted mean."""
    count = len(views)
    design = np.zeros((count * COUNT, count + 1))
    for index, view in enumerate(views):
        rows = slice(index * COUNT, (index + 1) * COUNT)
        design[rows, index] = np.sqrt(view.true_strain)
        design[rows, count] = view.true_strain
    design /= problem.SIGMA
    data = np.concatenate([view.data for view in views]) / problem.SIGMA
    covariance = np.linalg.inv(design.T @ design)
    own = (covariance @ design.T @ data)[:count]
    weight = np.linalg.inv(covariance[:count, :count])
    ones = np.ones(count)
    mean = (ones @ weight @ own) / (ones @ weight @ ones)
    return float((own - mean) @ weight @ (own - mean)), own


@pytest.mark.parametrize("sizes", [(3.0, 3.0, 3.0, 3.0), (3.0, 3.2, 2.7, 3.0), (4.0, 2.0, 3.0, 3.5)])
def test_cochrans_q_asks_whether_records_want_one_amplitude(sizes):
    views = recorded(sizes)
    hypothesis, _, whitened = explained(views)
    p_value, _ = amplitude_consistency(hypothesis, whitened)
    q, _ = cochran(views)
    assert p_value == pytest.approx(chi2.sf(q, 3), rel=1e-3)


def test_one_amplitude_for_all_is_rejected_as_often_as_its_p_value_says():
    found = [
        amplitude_consistency(*[explained(recorded((3.0,) * 4, seed))[at] for at in (0, 2)])[0] for seed in range(80)
    ]
    assert 0.02 < np.mean(np.array(found) < 0.1) < 0.2
    assert 0.35 < np.mean(found) < 0.65


def test_the_scatter_beyond_chance_is_told_in_parts_of_the_amplitude():
    """Standard deviation of the records' own amplitudes over the common one; chance adds little to it here."""
    views = recorded((10.0, 20.0, 30.0, 20.0))
    hypothesis, _, whitened = explained(views)
    p_value, scatter = amplitude_consistency(hypothesis, whitened)
    assert p_value < 1e-6
    assert scatter == pytest.approx(np.std(cochran(views)[1]) / hypothesis.refit.parameters[1], rel=0.02)


def test_a_true_effect_foretells_the_records_that_are_left_out_and_wants_one_amplitude():
    hypothesis, base, whitened = explained(recorded((10.0,) * 4))
    found = checks(hypothesis, base, whitened, 0.4)
    assert found.left_out == pytest.approx(1.0, abs=0.02)
    assert found.amplitude_p_value > 0.01
    assert found.remaining_p_value == 0.4
    assert found.notes == ()


def test_amplitudes_that_differ_are_noted_and_records_left_out_are_predicted_poorly():
    hypothesis, base, whitened = explained(recorded((20.0, -18.0, 19.0, -15.0)))
    found = checks(hypothesis, base, whitened, 0.4)
    assert found.left_out < 0.5
    assert found.amplitude_p_value < 1e-6
    assert any("amplitudes that differ" in note for note in found.notes)


def test_records_are_left_out_only_where_there_are_three_and_the_explanation_sits_in_all():
    two = problem.views([view.data for view in recorded((10.0,) * 4)[:2]], ENDS[:2])
    assert checks(*explained(two), 0.4).left_out is None
    alone = checks(*explained(recorded((10.0, 0.0, 0.0, 0.0)), records=("r1",)), 0.4)
    assert (alone.left_out, alone.amplitude_p_value) == (None, None)


def test_without_a_gap_nothing_can_be_predicted_better():
    assert checks(*explained(recorded((0.0,) * 4)), 0.4).left_out is None


def test_a_parameter_at_its_bound_is_noted_by_name():
    hypothesis, base, whitened = explained(recorded((-10.0,) * 4), added(low=0.0))
    assert "size ended at its lower bound" in checks(hypothesis, base, whitened, 0.4).notes


def test_a_record_that_says_nothing_of_the_amplitude_has_no_vote():
    """A specimen that is not strained, beside two that agree."""
    views = recorded((10.0,) * 4)
    still = problem.SIGMA * np.random.default_rng(5).standard_normal(COUNT)
    more = problem.views([*(view.data for view in views), still], (*ENDS, 0.0))
    few, many = (amplitude_consistency(*[explained(each)[at] for at in (0, 2)]) for each in (views, more))
    assert_allclose(many, few, rtol=1e-3)


@pytest.mark.parametrize(
    ("after", "noise", "smooth", "too_much"),
    [(0.88, 0.28, 0.27, True), (0.50, 0.15, 0.15, True), (0.88, 0.28, 0.80, False), (0.041, 0.040, None, False)],
)
def test_an_explanation_that_leaves_plainly_more_than_noise_explains_too_little(after, noise, smooth, too_much):
    """More than half as much again as the noise, and as what any smooth correction would leave."""

    def closed(left):
        closure = 1.0 - (left**2 - noise**2) / (2.0**2 - noise**2)
        return Closure(before_MPa=2.0, after_MPa=left, noise_MPa=noise, closure=closure, interval=None, how="")

    ceiling = None if smooth is None else closed(smooth)
    assert leaves_too_much(Shrink(closed(after), None, {}, (), ceiling)) is too_much


def test_an_explanation_that_leaves_a_good_part_of_the_gap_explains_too_little_whatever_that_is():
    """A wave took 0.986 MPa to 0.612, the noise being 0.1: no smooth correction does better, and it is no noise."""
    left = Closure(before_MPa=0.986, after_MPa=0.612, noise_MPa=0.101, closure=0.62, interval=None, how="")
    assert leaves_too_much(Shrink(left, None, {}, (), replace(left, after_MPa=0.6)))


@pytest.mark.parametrize(("explained", "too_much"), [(0.6, True), (0.4, False), (None, False)])
def test_what_is_a_function_of_what_was_recorded_is_no_noise(explained, too_much):
    """0.88 MPa, of which any smooth correction leaves 0.80: a function of the rate closes most of it, or less."""
    left = Closure(before_MPa=2.0, after_MPa=0.88, noise_MPa=0.26, closure=0.8, interval=None, how="")
    ceiling = replace(left, after_MPa=0.80)
    depends = (
        ()
        if explained is None
        else (Dependence("strain_rate", "the strain rate", None, "added", explained, "records"),)
    )
    remainder = Remainder(0.88, 0.26, depends, "")
    assert leaves_too_much(Shrink(left, None, {}, (), ceiling), remainder) is too_much
