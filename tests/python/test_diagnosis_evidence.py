"""The evidence of an explanation is the integral that it claims to be."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import trapezoid
from scipy.special import logsumexp
from scipy.stats import truncnorm

from campaigns import linear_problem as problem
from probation.diagnosis.hypothesis import Hypothesis
from probation.diagnosis.probabilities import log_prior
from probation.effects.cause import Cause
from probation.inference import evidence as module
from probation.inference.discrepancy import Discrepancy
from probation.inference.evidence import evidence
from probation.inference.form_error import form_freedom
from probation.inference.laplace import Linearised
from probation.inference.refit import refit
from probation.settings.evidence import EVIDENCE

COUNT = 60
STRAIN = np.linspace(0.0, 1.0, COUNT)


def bump(low=-50.0, high=50.0, scale=1.0):
    """Stress + a sin(pi strain)."""
    return problem.effect(
        lambda view, values: values[0] * np.sin(np.pi * view.true_strain),
        problem.parameter("size", low, high, scale),
    )


def noisy(stress, seed=0):
    return stress + problem.SIGMA * np.random.default_rng(seed).standard_normal(len(stress))


def judged(views, effect=None, law=None, records=None, **options):
    """Evidence with the effect and of the base law alone."""
    chosen = law or problem.bar()
    base = problem.solved(chosen, views)
    discrepancy = Discrepancy.of(problem.whitened(base))
    alone = evidence(base, base, discrepancy, **options)
    if effect is None:
        return alone
    found = problem.solved(chosen, views, [Cause(effect, effect.forms[0], records)])
    return evidence(found, base, discrepancy, **options), alone


@pytest.fixture
def no_form_error(monkeypatch):
    """A form that is taken at its word."""
    exact = replace(EVIDENCE, form_errors=(0.0,), form_error_weights=(1.0,))
    monkeypatch.setattr(module, "EVIDENCE", exact)


def by_numbers(stress, low, high, scale):
    """Log of the integral of exp(-chi^2/2) times the prior over the modulus (in units of its start, 80 MPa) and the
    amplitude, on a fine grid of both."""
    column, shape = 80.0 * STRAIN / problem.SIGMA, np.sin(np.pi * STRAIN) / problem.SIGMA
    y = stress / problem.SIGMA
    follows = (column @ shape) / (column @ column)
    seen = shape - follows * column
    best, spread = (seen @ y) / (seen @ seen), 1.0 / np.linalg.norm(seen)
    near = np.clip(best, low, high)
    # Away from a bound the density falls within a deviation, or faster: as exp(-slope x).
    reach = min(spread, 1.0 / max(abs(best - near) / spread**2, 1e-300))
    amplitude = np.linspace(max(near - 14.0 * reach, low), min(near + 14.0 * reach, high), 2001)
    modulus = np.linspace(-9.0, 9.0, 201) / np.linalg.norm(column)
    middle = (column @ y) / (column @ column) - follows * amplitude
    values = middle[:, None] + modulus
    # |y - m column - a shape|^2, expanded.
    square = y @ y - 2.0 * (values * (column @ y) + (amplitude * (shape @ y))[:, None])
    square = square + values**2 * (column @ column) + (amplitude**2 * (shape @ shape))[:, None]
    square = square + 2.0 * values * amplitude[:, None] * (column @ shape)
    prior = truncnorm(low / scale, high / scale, scale=scale).logpdf(amplitude)
    least = square.min()
    density = trapezoid(np.exp(-0.5 * (square - least)), modulus, axis=1) * np.exp(prior)
    return np.log(trapezoid(density, amplitude)) - 0.5 * least


@pytest.mark.parametrize("size", [0.0, 1.0, 4.0])
def test_with_an_amplitude_of_either_sign_it_is_the_integral_by_quadrature(no_form_error, size):
    stress = noisy(100.0 * STRAIN + size * np.sin(np.pi * STRAIN))
    found, _ = judged(problem.views([stress]), bump(), unknown=False)
    assert found.log_evidence == pytest.approx(by_numbers(stress, -50.0, 50.0, 1.0), abs=1e-3)


@pytest.mark.parametrize("size", [0.1, 0.3, 4.0])
def test_with_a_positive_amplitude_what_lies_below_zero_is_cut_off(no_form_error, size):
    stress = noisy(100.0 * STRAIN + size * np.sin(np.pi * STRAIN), seed=1)
    found, _ = judged(problem.views([stress]), bump(low=0.0), unknown=False)
    assert found.log_evidence == pytest.approx(by_numbers(stress, 0.0, 50.0, 1.0), abs=1e-3)


@pytest.mark.parametrize("size", [-0.1, -0.3, -2.0, -6.0])
def test_a_positive_amplitude_that_wants_to_be_negative_is_integrated_from_its_bound(no_form_error, size):
    stress = noisy(100.0 * STRAIN + size * np.sin(np.pi * STRAIN), seed=1)
    found, alone = judged(problem.views([stress]), bump(low=0.0), unknown=False)
    assert found.log_evidence == pytest.approx(by_numbers(stress, 0.0, 50.0, 1.0), abs=1e-3)
    assert found.log_evidence < alone.log_evidence


def test_an_amplitude_near_its_upper_bound_is_cut_off_there(no_form_error):
    stress = noisy(100.0 * STRAIN + 3.0 * np.sin(np.pi * STRAIN), seed=1)
    found, _ = judged(problem.views([stress]), bump(high=3.1, scale=2.0), unknown=False)
    assert found.log_evidence == pytest.approx(by_numbers(stress, -50.0, 3.1, 2.0), abs=1e-3)


def test_of_the_base_law_it_is_the_gaussian_integral_over_its_flat_parameters():
    """Integral of exp(-chi^2/2) d(modulus/80): exp(-chi^2_min/2) sqrt(2 pi)/|J|."""
    stress = noisy(100.0 * STRAIN)
    alone = judged(problem.views([stress]))
    column = 80.0 * STRAIN / problem.SIGMA
    y = stress / problem.SIGMA
    least = y @ y - (column @ y) ** 2 / (column @ column)
    expected = -0.5 * least + 0.5 * np.log(2.0 * np.pi / (column @ column))
    assert alone.log_evidence == pytest.approx(expected, abs=1e-6)
    assert alone.form_error == 0.0


def test_the_forms_error_makes_it_the_density_of_correlated_data():
    """N(y; 0, I + J S J^T + B D B^T) by its dense matrix, S the priors (a wide one for the flat modulus), D for every
    error of the form, and their mixture."""
    size, wide, scale = 8.0, 1e3, 3.0
    wrong = 100.0 * STRAIN + size * np.sin(np.pi * STRAIN) ** 1.2
    views = problem.views([noisy(wrong), noisy(wrong, seed=1)])
    law, effect = problem.bar(), bump(scale=scale)
    base = problem.solved(law, views)
    found = problem.solved(law, views, [Cause(effect, effect.forms[0])])
    discrepancy = Discrepancy.of(problem.whitened(base))
    # Linear in both parameters: data and design over the noise, the modulus in units of 80 MPa.
    y = np.concatenate([view.data for view in views]) / problem.SIGMA
    design = np.tile(np.column_stack([80.0 * STRAIN, np.sin(np.pi * STRAIN)]) / problem.SIGMA, (2, 1))
    waves = np.zeros((len(y), len(discrepancy)))
    for own, rows, place in zip(discrepancy.columns, discrepancy.slices, discrepancy.places, strict=True):
        waves[rows, place] = own
    done = [
        EVIDENCE.rig_form_error**2 * float(np.sum((found.residual - base.residual)[rows] ** 2))
        for rows in discrepancy.slices
    ]
    scores = []
    for error, weight in zip(EVIDENCE.form_errors, EVIDENCE.form_error_weights, strict=True):
        variance = np.concatenate(
            [
                (EVIDENCE.form_rest * error) ** 2 * energy * share
                for energy, share in zip(done, discrepancy.spectrum, strict=True)
            ]
        )
        covariance = np.eye(len(y)) + (waves * variance) @ waves.T
        covariance += (design * [wide**2, scale**2]) @ design.T
        _, determinant = np.linalg.slogdet(covariance)
        density = -0.5 * float(y @ np.linalg.solve(covariance, y)) - 0.5 * determinant
        scores.append(density + np.log(wide * np.sqrt(2.0 * np.pi)) + np.log(weight))
    assert evidence(found, base, discrepancy).log_evidence == pytest.approx(logsumexp(scores), abs=2e-3)


def with_its_freedom(views, *effects):
    """Evidence of effects with the freedom of their forms."""
    law = problem.bar()
    base = problem.solved(law, views)
    found = problem.solved(law, views, [Cause(each, each.forms[0]) for each in effects])
    discrepancy = Discrepancy.of(problem.whitened(base))
    forms = form_freedom(found, problem.whitener(views))
    return evidence(found, base, discrepancy, forms=forms, unknown=False), found, forms.columns, discrepancy, base


def freedom_of(views, *effects):
    """The freedom of the forms of some effects, refitted."""
    found = problem.solved(problem.bar(), views, [Cause(each, each.forms[0]) for each in effects])
    return form_freedom(found, problem.whitener(views))


def test_the_freedom_of_a_form_is_integrated_over_exactly():
    """N(y; 0, I + J S J^T + B D B^T + s^2 F F^T) by its dense matrix, F the columns that the parameters cannot follow,
    and the mixture over s."""
    wide, scale = 1e3, 3.0
    views = problem.views([noisy(100.0 * STRAIN + 8.0 * np.sin(np.pi * STRAIN)) for _ in range(2)])
    judged, found, forms, discrepancy, base = with_its_freedom(views, bump(scale=scale))
    y = np.concatenate([view.data for view in views]) / problem.SIGMA
    design = np.tile(np.column_stack([80.0 * STRAIN, np.sin(np.pi * STRAIN)]) / problem.SIGMA, (2, 1))
    free = forms - design @ np.linalg.lstsq(design, forms)[0]
    done = EVIDENCE.rig_form_error**2 * discrepancy.energy(found.residual - base.residual)
    scores = []
    for error, weight in zip(EVIDENCE.form_errors, EVIDENCE.form_error_weights, strict=True):
        factor = discrepancy.factor((EVIDENCE.form_rest * error) ** 2 * done)
        covariance = np.eye(len(y)) + factor @ factor.T + error**2 * free @ free.T
        covariance += (design * [wide**2, scale**2]) @ design.T
        _, determinant = np.linalg.slogdet(covariance)
        density = -0.5 * float(y @ np.linalg.solve(covariance, y)) - 0.5 * determinant
        scores.append(density + np.log(wide * np.sqrt(2.0 * np.pi)) + np.log(weight))
    assert judged.log_evidence == pytest.approx(logsumexp(scores), abs=5e-3)


def test_several_integrals_at_once_are_each_by_itself():
    views = problem.views([noisy(100.0 * STRAIN + 8.0 * np.sin(np.pi * STRAIN), seed) for seed in range(2)])
    _, found, forms, discrepancy, _ = with_its_freedom(views, bump(scale=5.0))
    linearised = Linearised.of(found, discrepancy, forms)
    count, deviations = linearised.form_count, np.array([0.02, 0.3, 1.0])
    variances = np.random.default_rng(1).exponential(5.0, (3, len(discrepancy)))
    together = linearised.log_integrals(variances, count, deviations)
    apart = [
        linearised.with_last(count, size).log_integral(own) for size, own in zip(deviations, variances, strict=True)
    ]
    assert count > 0
    assert_allclose(together, apart, rtol=1e-12)
    alike = linearised.log_integrals(np.repeat(variances[:1], 3, axis=0), count, deviations)
    assert_allclose(linearised.log_integrals(variances[:1], count, deviations), alike, rtol=1e-12)


def test_the_freedom_is_along_the_effects_own_coordinate_alike_in_all_records():
    """Legendre's polynomials of the strain, times what of the effect the law's own parameters cannot follow."""
    views = problem.views([noisy(100.0 * STRAIN + 8.0 * np.sin(np.pi * STRAIN)) for _ in range(2)])
    _, found, forms, *_ = with_its_freedom(views, bump())
    done = found.parameters[-1] * np.sin(np.pi * STRAIN) / problem.SIGMA
    done -= (done @ STRAIN) / (STRAIN @ STRAIN) * STRAIN
    polynomials = np.polynomial.legendre.legvander(2.0 * STRAIN - 1.0, EVIDENCE.form_waves)[:, 1:]
    assert_allclose(forms, np.tile(EVIDENCE.rig_form_error * done[:, None] * polynomials, (2, 1)), atol=1e-7)
    of_the_force = replace(bump(), coordinate="force")
    other = with_its_freedom(views, of_the_force)[2]
    assert np.linalg.norm(other - forms) > 0.1 * np.linalg.norm(forms)


def test_the_rest_of_two_effects_is_free_as_they_are_by_what_each_does():
    """A fault of the rig has a quarter of a material's freedom; of both it is the mean variance, by their energies."""
    views = problem.views([noisy(100.0 * STRAIN + 8.0 * np.sin(np.pi * STRAIN) + 4.0 * np.sin(2.0 * np.pi * STRAIN))])
    rig = bump()
    material = problem.effect(
        lambda view, values: values[0] * np.sin(2.0 * np.pi * view.true_strain),
        problem.parameter("other_size", -50.0, 50.0, 1.0),
        name="other",
        kind="material",
    )
    assert freedom_of(views, rig).variance == EVIDENCE.rig_form_error**2
    assert freedom_of(views, material).variance == 1.0
    assert freedom_of(views).variance == 1.0
    assert EVIDENCE.rig_form_error**2 < freedom_of(views, rig, material).variance < 1.0


def test_a_form_that_is_certainly_right_keeps_its_standard_errors():
    """Not those of an inverse that a freedom of next to no size has cost its digits."""
    views = problem.views([noisy(100.0 * STRAIN + 3e4 * np.sin(np.pi * STRAIN)) for _ in range(2)])
    judged = with_its_freedom(views, bump(low=-1e5, high=1e5, scale=3e4))[0]
    design = np.tile(np.column_stack([80.0 * STRAIN, np.sin(np.pi * STRAIN)]) / problem.SIGMA, (2, 1))
    assert judged.form_error < 1e-3
    assert_allclose(np.diag(judged.covariance), np.diag(np.linalg.inv(design.T @ design)), rtol=0.05)


def test_along_a_coordinate_of_one_value_a_form_has_no_freedom():
    """The rate, where it is one and the same."""
    views = problem.views([noisy(100.0 * STRAIN + 8.0 * np.sin(np.pi * STRAIN))])
    assert with_its_freedom(views, replace(bump(), coordinate="strain_rate"))[2].shape[1] == 0


def test_a_second_effect_must_beat_the_freedom_of_the_first():
    """What the first leaves is 15 % of it along its own coordinate. Taken at its word, it would need the second."""
    first = replace(bump(scale=20.0), kind="material")
    second = replace(
        problem.effect(
            lambda view, values: values[0] * np.sin(3.0 * np.pi * view.true_strain),
            problem.parameter("other_size", -50.0, 50.0, 2.0),
            name="second",
        ),
        kind="material",
    )
    wrong = 20.0 * np.sin(np.pi * STRAIN) * (1.0 + 0.15 * np.polynomial.legendre.legval(2.0 * STRAIN - 1.0, [0, 0, 1]))
    views = problem.views([noisy(100.0 * STRAIN + wrong, seed) for seed in range(2)])
    alone, pair = with_its_freedom(views, first)[0], with_its_freedom(views, first, second)[0]
    dearer = log_prior(("first",), 22) - log_prior(("first", "second"), 22)
    assert pair.log_evidence_exact > alone.log_evidence_exact + dearer + 10.0
    assert pair.log_evidence < alone.log_evidence + dearer


def test_waves_of_a_discrepancy_are_orthonormal_and_share_out_all_of_its_energy():
    views = problem.views([noisy(100.0 * STRAIN), noisy(100.0 * STRAIN, seed=1)])
    discrepancy = Discrepancy.of(problem.whitened(problem.solved(problem.bar(), views)))
    for columns, share in zip(discrepancy.columns, discrepancy.spectrum, strict=True):
        assert_allclose(columns.T @ columns, np.eye(columns.shape[1]), atol=1e-10)
        assert share.sum() == pytest.approx(1.0)
        assert np.all(share > 0.0)
    values = np.random.default_rng(0).standard_normal(2 * COUNT)
    assert_allclose(discrepancy.energy(values), [np.sum(values[:COUNT] ** 2), np.sum(values[COUNT:] ** 2)])


def test_a_record_without_information_changes_no_ratio_of_evidences():
    """A specimen that is not strained: neither the modulus nor the effect acts there."""
    stress, silent = noisy(100.0 * STRAIN + np.sin(np.pi * STRAIN)), noisy(np.zeros(COUNT), seed=2)
    few, alone = judged(problem.views([stress]), bump())
    more, beside = judged(problem.views([stress, silent], strains=(1.0, 0.0)), bump())
    assert more.log_evidence - beside.log_evidence == pytest.approx(few.log_evidence - alone.log_evidence, abs=1e-3)
    assert more.form_error == pytest.approx(few.form_error, abs=1e-4)


def test_a_shape_of_which_the_data_say_nothing_costs_nothing():
    """Its prior integrates to 1, be it normal or flat between bounds (to within what stands in for it)."""
    views = problem.views([noisy(100.0 * STRAIN + 2.0 * np.sin(np.pi * STRAIN))])
    expected = judged(views, bump())[0].log_evidence
    normal = problem.parameter("shape", 0.1, 10.0, 0.4, centre=1.0, log=True)
    flat = problem.parameter("shape", -3.0, 3.0, float("inf"))
    for shape, allowed in ((normal, 0.01), (flat, 0.1)):
        effect = problem.effect(
            lambda view, values: values[0] * np.sin(np.pi * view.true_strain),
            problem.parameter("size", -50.0, 50.0, 1.0),
            shape,
        )
        assert judged(views, effect)[0].log_evidence == pytest.approx(expected, abs=allowed)


def test_the_right_effect_beats_the_base_law_where_it_acts_and_pays_for_its_room_where_it_does_not():
    """Without an effect the amplitude's integral is about its posterior over its prior width: below 1."""
    with_it, alone = judged(problem.views([noisy(100.0 * STRAIN + 2.0 * np.sin(np.pi * STRAIN))]), bump())
    assert with_it.log_evidence > alone.log_evidence + 5.0
    losses = []
    for seed in range(20):
        with_it, alone = judged(problem.views([noisy(100.0 * STRAIN, seed)]), bump(scale=3.0))
        losses.append(alone.log_evidence - with_it.log_evidence)
    assert np.mean(losses) > 1.0


def hump(size):
    return noisy(100.0 * STRAIN + size * np.exp(-(((STRAIN - 0.4) / 0.15) ** 2)))


def test_an_unknown_effect_is_seen_in_a_smooth_gap_and_not_in_white_noise():
    alone = judged(problem.views([hump(5.0), noisy(100.0 * STRAIN, seed=9)]))
    assert alone.log_evidence_unknown > alone.log_evidence + 20.0
    for seed in range(10):
        alone = judged(problem.views([noisy(100.0 * STRAIN, seed), noisy(100.0 * STRAIN, seed + 100)]))
        assert alone.log_evidence_unknown < alone.log_evidence


def test_beside_the_right_effect_nothing_unknown_is_needed():
    found, alone = judged(problem.views([noisy(100.0 * STRAIN + 8.0 * np.sin(np.pi * STRAIN))]), bump(scale=5.0))
    assert found.log_evidence > found.log_evidence_unknown
    assert found.log_evidence > alone.log_evidence_unknown


def test_an_unknown_effect_that_was_not_asked_for_has_no_evidence():
    assert judged(problem.views([hump(5.0)]), unknown=False).log_evidence_unknown == -np.inf


def test_standard_errors_are_those_of_generalised_least_squares(no_form_error):
    """(J^T J + 1/s^2)^-1 where the form is taken at its word; wider where it is not."""
    stress = noisy(100.0 * STRAIN + 8.0 * np.sin(np.pi * STRAIN))
    found, _ = judged(problem.views([stress]), bump(scale=2.0))
    design = np.column_stack([80.0 * STRAIN, np.sin(np.pi * STRAIN)]) / problem.SIGMA
    assert_allclose(found.covariance, np.linalg.inv(design.T @ design + np.diag([0.0, 0.25])), rtol=1e-5)


def test_a_form_that_misses_the_truths_by_a_tenth_is_given_wider_standard_errors():
    material = replace(bump(scale=30.0), kind="material")
    right, _ = judged(problem.views([noisy(100.0 * STRAIN + 30.0 * np.sin(np.pi * STRAIN))]), material)
    wrong = 100.0 * STRAIN + 30.0 * np.sin(np.pi * STRAIN) ** 1.3
    missed, _ = judged(problem.views([noisy(wrong)]), material)
    assert missed.form_error > 2.0 * right.form_error
    assert missed.covariance[1, 1] > 4.0 * right.covariance[1, 1]


def test_a_parameter_at_its_bound_has_no_standard_error():
    stress = noisy(100.0 * STRAIN - 6.0 * np.sin(np.pi * STRAIN))
    found, _ = judged(problem.views([stress]), bump(low=0.0))
    assert found.covariance[1, 1] == 0.0
    assert found.covariance[0, 0] > 0.0


def test_a_search_that_ended_early_has_no_evidence_for_the_steps_it_did_not_take():
    """The objective's value counts, not what the linearised law would make of it: 0.5 |y - J d|^2 left out."""
    stress = noisy(100.0 * STRAIN + 4.0 * np.sin(np.pi * STRAIN))
    seen, effect = problem.views([stress]), bump()
    base = problem.solved(problem.bar(), seen)
    discrepancy = Discrepancy.of(problem.whitened(base))
    found = problem.solved(problem.bar(), seen, [Cause(effect, effect.forms[0], None)])
    start = np.append(base.parameters, 0.0)
    stuck = refit(found.problem, start, most_steps=0)
    assert found.not_reached == pytest.approx(0.0, abs=0.05)
    assert stuck.not_reached == pytest.approx(_objective(stuck) - _objective(found), rel=1e-3)
    alone = Hypothesis(base, evidence(base, base, discrepancy))
    here, there = (
        Hypothesis(each, evidence(each, base, discrepancy)).as_reached(alone).evidence for each in (stuck, found)
    )
    assert there.log_evidence_exact - here.log_evidence_exact == pytest.approx(stuck.not_reached, rel=0.02)
    assert here.log_evidence < there.log_evidence


def _objective(found):
    """Half of chi^2 + prior; the amplitude's prior has the standard deviation of 1."""
    return 0.5 * (found.chi_square + found.parameters[-1] ** 2)
