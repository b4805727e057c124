"""Does each scheme converge at the order that docs/law.md states: be2 2, sa2 2, sa3 3?

Errors are measured at fixed times well away from starts and jumps, against references that share nothing
with the engine: the memory integral of eq. (6) by Gauss-Legendre quadrature, or scipy's DOP853.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import probation
from reference import literal, paper

E_U, TAU, G = paper.E_U, paper.TAU_MAX, paper.G
ORDERS = pytest.mark.parametrize(("scheme", "order"), [("be2", 2), ("sa2", 2), ("sa3", 3)])
DURATION, AT = 60.0, (20.0, 40.0, 60.0)


def law(**changed):
    return probation.Law(**({"unrelaxed_modulus": E_U, "tau_max": TAU, "hardening_modulus": G} | changed))


def errors(base, scheme, grids, strain, truth, **options):
    """Largest error at AT on each of the grids; every grid holds these times."""
    found = []
    for time in grids:
        given = {name: value(time) if callable(value) else value for name, value in options.items()}
        history = probation.StrainHistory(time, strain(time), **({"jumps": None} | given))
        stress = base.stress(history, scheme=scheme)
        at = [int(np.abs(time - t).argmin()) for t in AT]
        found.append(np.abs(stress[at] - truth).max())
    return np.array(found)


def measured(found):
    """Order between the first and the last grid, each step halved from one to the next."""
    return np.log2(found[0] / found[-1]) / (len(found) - 1)


def uniform(n, levels=4):
    return [np.linspace(0.0, DURATION, n * 2**level + 1) for level in range(levels)]


def uneven(n, levels=4):
    """Random steps with ratios below 2 in each third, refined by halving."""
    thirds = [paper.uneven(n, DURATION / 3, seed) + k * DURATION / 3 for k, seed in enumerate((1, 2, 3))]
    grids = [np.concatenate([thirds[0], thirds[1][1:], thirds[2][1:]])]
    for _ in range(levels - 1):
        grids.append(paper.halved(grids[-1]))
    return grids


@pytest.fixture(scope="module")
def constant_tau():
    def reduced(s):
        return s / TAU

    return [literal.memory_integral(paper.smooth_strain, paper.smooth_rate, reduced, t, E_U, G) for t in AT]


@ORDERS
def test_constant_tau_on_even_steps(scheme, order, constant_tau):
    found = errors(law(), scheme, uniform(300), paper.smooth_strain, constant_tau)
    assert measured(found) > order - 0.05
    assert found[-1] < (1e-6 if order == 3 else 2e-4)


@ORDERS
def test_constant_tau_on_uneven_steps(scheme, order, constant_tau):
    found = errors(law(), scheme, uneven(150), paper.smooth_strain, constant_tau)
    assert measured(found) > order - 0.12


@pytest.mark.parametrize("start", ["exponential", "backward_euler"])
def test_the_start_of_be2_does_not_spoil_its_order(start, constant_tau):
    found = errors(law(), probation.BE2(start=start), uniform(300), paper.smooth_strain, constant_tau)
    assert measured(found) > 1.9


@pytest.mark.parametrize("grids", [uniform(300), uneven(150)], ids=["even", "uneven"])
@pytest.mark.parametrize("given", [True, False], ids=["given rate", "sampled rate"])
@ORDERS
def test_constant_weissenberg_number(scheme, order, given, grids):
    """tau_max = 0.03 / rate: reduced time is the strain over 0.03, the kernel in closed form for all modes.

    Of sampled rates, three-point differences good to h^2, sa3 is asked no more than order 2.
    """
    companion = probation.PowerLaw(0.03, -1.0)

    def reduced(s):
        return paper.smooth_strain(s) / 0.03

    truth = [literal.memory_integral(paper.smooth_strain, paper.smooth_rate, reduced, t, E_U, G) for t in AT]
    options = {"strain_rate": paper.smooth_rate} if given else {}
    base = law(tau_max=None, companion=companion)
    found = errors(base, scheme, grids, paper.smooth_strain, truth, **options)
    assert measured(found) > (order if given else 2) - 0.12


@ORDERS
@pytest.mark.parametrize("form", ["weissenberg", "exponential"])
def test_the_papers_companion_relations(scheme, order, form):
    """Eqs. (11), (12) written out again for DOP853 at 1e-12; 8 modes over 1.5 decades keep it quick."""
    modes, decades = 8, 1.5
    relation = {
        "weissenberg": (
            probation.Weissenberg(0.00464, 0.0367),
            lambda r: (0.00464 * np.log10(r) + 0.0367) / r,
        ),
        "exponential": (
            probation.Exponential(27.24, -2.1),
            lambda r: 27.24 * np.exp(-2.1 * np.log10(1000.0 * r)),
        ),
    }
    companion, tau_max = relation[form]
    ratio, p = literal.spectrum(modes, decades)

    def flow(t, s):
        rate, e_ht = paper.smooth_rate(t), literal.hardening_strain(paper.smooth_strain(t))
        return p * E_U * rate - (s - p * G * e_ht) / (ratio * tau_max(rate))

    run = solve_ivp(flow, (0.0, DURATION), np.zeros(modes), "DOP853", rtol=1e-12, atol=1e-12, t_eval=AT)
    base = law(tau_max=None, companion=companion, modes=modes, decades=decades)
    found = errors(base, scheme, uniform(300), paper.smooth_strain, run.y.sum(axis=0), strain_rate=paper.smooth_rate)
    assert measured(found) > order - 0.05


def test_cvode_with_given_rates_integrates_the_cubic_and_converges_with_it():
    """The cubic through strains and rates is good to h^4, its rate to h^3; CVODE adds its tolerance only."""

    def reduced(s):
        return s / TAU

    truth = [literal.memory_integral(paper.smooth_strain, paper.smooth_rate, reduced, t, E_U, G) for t in AT]
    found = errors(law(), "cvode", uniform(30, 2), paper.smooth_strain, truth, strain_rate=paper.smooth_rate)
    assert measured(found) > 2.9
    assert found[-1] < 3e-4


# A kinked path


def kinked(time):
    """0.01 1/s to 10 s, then -0.004 1/s."""
    return np.where(time <= 10.0, 0.01 * time, 0.1 - 0.004 * (time - 10.0))


@pytest.fixture(scope="module")
def kinked_truth():
    expected = literal.mp_segments([0.0, 10.0, *AT], kinked(np.array([0.0, 10.0, *AT])), E_U, G, TAU)
    return expected[2:]


@pytest.mark.parametrize("jumps", [[10.0], "auto"], ids=["told", "found"])
@ORDERS
def test_a_restart_at_the_kink_recovers_the_order(scheme, order, jumps, kinked_truth):
    """Eq. (7) on either side in 40 digits."""
    found = errors(law(), scheme, uniform(300), kinked, kinked_truth, jumps=jumps)
    assert measured(found) > order - 0.1


def kinked_rate(time):
    return np.where(time <= 10.0, 0.01, -0.004)


def test_without_a_restart_be2_falls_to_first_order_and_is_a_hundred_times_worse(kinked_truth):
    """Where the history has its own rates: its weights no longer add h e' up to the strain."""
    options = {"strain_rate": kinked_rate}
    plain = errors(law(), "be2", uniform(300), kinked, kinked_truth, jumps=None, **options)
    better = errors(law(), "be2", uniform(300), kinked, kinked_truth, jumps=[10.0], **options)
    assert measured(plain) < 1.1
    assert measured(better) > 1.9
    assert plain[-1] > 100.0 * better[-1]


def test_sampled_rates_let_be2_cross_a_kink_without_a_restart(kinked_truth):
    """One difference quotient on strain and stress: what it gets wrong at the kink adds up to nothing."""
    assert measured(errors(law(), "be2", uniform(300), kinked, kinked_truth, jumps=None)) > 1.9


def test_a_kink_between_samples_is_forgotten_by_the_end():
    """The samples cannot tell where in the step the rate jumped; ten tau_max later it hardly matters."""
    grids = [np.r_[0.0, time[1:-1] + 0.37 * (time[1] - time[0]), time[-1]] for time in uniform(300, 3)]
    for time in grids:
        time.sort()
    for scheme in ("be2", "sa2", "sa3"):
        worst = []
        for time in grids:
            stress = law().stress(time, kinked(time), scheme)
            truth = law().stress(np.unique(np.r_[time, 10.0]), kinked(np.unique(np.r_[time, 10.0])), "exact")
            worst.append(np.abs(stress[-1] - truth[-1]))
        assert worst[-1] < 0.01
