"""`probation.plan`: what planned tests will say of the law, asked before any of them is done."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from probation.design.effect_design import Design
from probation.design.isolability import isolability
from probation.design.planned_record import as_predicted, white_noise
from probation.design.planned_strain import imposed, planned_excitation, planned_record, propagated
from probation.effects.record_view import views_of
from probation.effects.registry import effects as known_effects
from probation.effects.visible import visible
from probation.errors import InputError
from probation.inference.information import correlation, estimated
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.inference.parameter import UNITS, by_inside_name, outside_name
from probation.law.answer import law_answer
from probation.law.modal import engine_law
from probation.law.schemes import SchemeName
from probation.parallel import at_once, without_blas_threads
from probation.progress import Part, shows_progress
from probation.records.campaign import Campaign
from probation.results.data import Stored
from probation.results.rendering import Result, rendered

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.design.isolability_result import Isolability
    from probation.design.planned_strain import History
    from probation.inference.parameter import Parameter
    from probation.law.modal import Law
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

SCHEME: SchemeName = "sa3"


@dataclass(frozen=True)
class PlannedTest:
    """One of the tests, as it was planned.

    Attributes
    ----------
    id, history : str
        Its name, and what is imposed, for people.
    duration : float [s]
    largest_strain : float [-]
        True strain of the largest modulus.
    stress_noise : float [MPa]
    strain_noise : float [-]
    smoothing : str
        How the strain will be smoothed, one of `excitation.METHODS`; "raw": not at all.
    """

    id: str
    history: str
    samples: int
    duration: float
    largest_strain: float
    stress_noise: float
    strain_noise: float
    smoothing: str

    def to_dict(self) -> dict[str, object]:
        """For JSON."""
        return {
            "id": self.id,
            "history": self.history,
            "samples": self.samples,
            "duration_s": self.duration,
            "largest_true_strain": self.largest_strain,
            "noise_MPa": self.stress_noise,
            "strain_noise": self.strain_noise,
            "smoothing": self.smoothing,
        }


@dataclass(frozen=True, eq=False)
class Plan(Result, Stored):
    """What planned tests will say.

    Attributes
    ----------
    law : Law
        At whose parameters the question is asked.
    scheme : str
    tests : tuple of PlannedTest
    parameters : dict of str to Parameter
        By name those that are identified of unrelaxed_modulus, tau_max or alpha, hardening_modulus; the law's value,
        with the standard error and the 95 % interval that a fit of all tests together is expected to have if the law
        is right.
    product : Parameter
        E_u times tau_max (or alpha).
    names : tuple of str
        What is identified, in the order of `correlation`.
    correlation : ndarray, shape (n_names, n_names)
        Of the estimates; 0 where a parameter is not determined.
    isolability : Isolability
        Which effects these tests could detect, and which they could discriminate.
    seed : int
    warnings : tuple of str
    """

    SCHEMA: ClassVar[str] = "probation.plan/1"

    law: Law
    scheme: SchemeName
    tests: tuple[PlannedTest, ...]
    parameters: dict[str, Parameter]
    product: Parameter
    names: tuple[str, ...]
    correlation: FloatArray
    isolability: Isolability
    seed: int
    warnings: tuple[str, ...] = ()

    @property
    def verdict(self) -> str:
        """One sentence on the parameters, one on the effects."""
        text: str = rendered(self, "verdict")
        return text

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects, `probation.plan/1`."""
        second = outside_name(self.law.parameter_names[1])
        return {
            "verdict": self.verdict,
            "scheme": self.scheme,
            "seed": self.seed,
            "law": law_answer(self.law),
            "tests": [test.to_dict() for test in self.tests],
            "parameters": {outside_name(name): parameter.to_json() for name, parameter in self.parameters.items()},
            "products": {f"unrelaxed_modulus_MPa*{second}": self.product.to_json()},
            "correlation": {"names": [outside_name(name) for name in self.names], "matrix": self.correlation},
            "isolability": self.isolability.to_dict(),
            "warnings": self.warnings,
        }


@shows_progress
@without_blas_threads
def plan(
    law: Law,
    histories: Mapping[str, History],
    *,
    noise: float | Mapping[str, float],
    strain_noise: float | Mapping[str, float] = 0.0,
    hold: Mapping[str, float] | None = None,
    effects: Iterable[str] | None = None,
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> Plan:
    """Say what planned tests will tell of the law, before any of them is done.

    The law's sensitivities along the histories, weighed by the inverse covariance of the noise, give the standard
    errors of its parameters (generalised least squares, all tests together), and the lengths and angles of what effects
    add to the stress. Both are taken at the law's parameters; a guess of them is enough.

    Parameters
    ----------
    law : Law
    histories : mapping of str to history
        By test, in the order in which they will be done. A history is an `ImposedHistory` (from `named_history`, or
        ``read_history(path).history``) or two arrays, time [s] and true strain, each of shape (n_samples,): its
        instants are the samples that will be taken. Along an imposed stress the law gives the strain.
    noise : float or mapping of str to float [MPa]
        Standard deviation of the white noise of the true stress, for all tests or by test.
    strain_noise : float or mapping of str to float [-]
        Standard deviation of the white noise of the measured strain, for all tests or by test. It is propagated by the
        smoother that `fit` would take, and by the law, to the stress. Then a test has at most 3000 samples.
    hold : dict of str to float, optional
        Parameters that will not be identified, by name with unit ("unrelaxed_modulus_MPa"), and the values they keep.
    effects : iterable of str, optional
        All that are known if left out.
    seed : int
        Of the noise on which it is found how strongly a noisy strain will be smoothed.
    threads : int, optional
        Effects worked on at once, in copies of this process (`fork`), on Linux; by default one.
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Returns
    -------
    Plan

    Raises
    ------
    InputError
        For a history or a noise that is not possible, naming the test; for an unknown effect or parameter; if every
        parameter is held.
    ConvergenceError
        Where the law cannot carry an imposed stress.

    Examples
    --------
    >>> law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
    >>> ramps = {f"{rate} 1/s": probation.named_history("ramp", rate=rate, strain=1.5) for rate in (0.001, 0.02)}
    >>> probation.plan(law, ramps, noise=0.5).parameters["tau_max"].se.round(3)
    0.006
    """
    engine_law(law)
    law, held = _holding(law, hold or {})
    chosen, advance = known_effects(effects), progress or (lambda part: None)
    # What will be recorded: histories, noise, and the strain as it will drive the law.
    tests = imposed(histories, law)
    stress_noise = _by_test("noise", noise, tests, "MPa")
    given_strain_noise = _by_test("strain_noise", strain_noise, tests, "", zero=True)
    records = [planned_record(name, tests[name], stress_noise[name], given_strain_noise[name]) for name in tests]
    campaign, rng, excitations = Campaign("plan", tuple(records)), np.random.default_rng(seed), {}
    for count, record in enumerate(records):
        excitations[record.id] = planned_excitation(record, rng)
        advance(Part(0.3 * (count + 1) / len(records), f"smoothed {record.id}"))
    # The law on it, and the covariance of the noise of its stress.
    views = views_of(campaign, excitations=excitations, scheme=SCHEME)
    model = CampaignModel(DnlrLaw(law, held), views)
    noises = [
        replace(white, propagated=propagated(excitations[view.id], law, SCHEME))
        for view, white in zip(views, white_noise(views, list(stress_noise.values())), strict=True)
    ]
    # How well its parameters will be known.
    predicted = as_predicted(model, model.start)
    design = Design.of(predicted, model.start, noises)
    covariance, lost = design.covariance()
    advance(Part(0.5, "comparing effects"))
    # Which effects can be detected and discriminated: those that were named, or all that such records could show.
    if effects is None:
        chosen = visible(chosen, predicted.views)
    effect_isolability = isolability(
        model,
        model.start,
        noises,
        chosen,
        threads=at_once(threads),
        progress=lambda part: advance(Part(0.5 + 0.5 * part, "comparing effects")),
    )
    advance(1.0)
    return Plan(
        law=law,
        scheme=SCHEME,
        tests=tuple(
            _described(record, history.name, excitations[record.id])
            for record, history in zip(records, tests.values(), strict=True)
        ),
        **_known(law, held, covariance, lost, len(design.tangent)),
        names=tuple(name for name in law.parameter_names if name not in held),
        correlation=correlation(covariance),
        isolability=effect_isolability,
        seed=seed,
        warnings=_extrapolations(law, excitations),
    )


def _by_test(
    name: str, given: float | Mapping[str, float], tests: Iterable[str], unit: str, *, zero: bool = False
) -> dict[str, float]:
    """One number per test.

    Raises
    ------
    InputError
        For a test that is missing or not there, or a number that is not positive (or 0, where `zero` says so).
    """
    ids = list(tests)
    by_test = dict(given) if isinstance(given, Mapping) else dict.fromkeys(ids, given)
    if set(by_test) != set(ids):
        raise InputError(f"{name}: found numbers for {', '.join(by_test)}, expected one for each of {', '.join(ids)}")
    expected = ("a number of at least 0" if zero else "a positive number") + (f" [{unit}]" if unit else "")
    numbers = {}
    for test in ids:
        try:
            numbers[test] = float(by_test[test])
        except (TypeError, ValueError):
            numbers[test] = np.nan
        if not (0.0 < numbers[test] < np.inf or (zero and numbers[test] == 0.0)):
            raise InputError(f"{name} of {test!r}: found {by_test[test]!r}, expected {expected}")
    return numbers


def _described(record: Record, history: str, excitation: Excitation) -> PlannedTest:
    return PlannedTest(
        id=record.id,
        history=history,
        samples=len(record),
        duration=float(record.time[-1] - record.time[0]),
        largest_strain=float(record.true_strain[np.argmax(np.abs(record.true_strain))]),
        stress_noise=record.noise.stress_MPa or 0.0,
        strain_noise=record.noise.strain or 0.0,
        smoothing=excitation.method,
    )


def _holding(law: Law, hold: Mapping[str, float]) -> tuple[Law, tuple[str, ...]]:
    """The law with what is held, and the names of that."""
    held = {name: float(value) for name, value in by_inside_name(hold, law.parameter_names, "hold").items()}
    if len(held) == len(law.parameter_names):
        raise InputError("hold: found every parameter held, expected one left to identify")
    return replace(law, **held) if held else law, tuple(held)  # type: ignore[arg-type]


def _known(
    law: Law, held: Collection[str], covariance: FloatArray, lost: NDArray[np.bool_], samples: int
) -> dict[str, Any]:
    """The parameters that are identified, and the product of E_u and tau_max, with expected errors."""
    free = np.array([name not in held for name in law.parameter_names])
    every, gone = np.zeros((len(free), len(free))), np.zeros(len(free), dtype=bool)
    every[np.ix_(free, free)], gone[free] = covariance, lost
    values, degrees = law.parameters, max(samples - int(free.sum()), 1)

    def expected(name: str, value: float, variance: float, gone: np.bool_, unit: str) -> Parameter:
        se = None if gone else float(np.sqrt(max(variance, 0.0)))
        relative = np.inf if se is None or not value else se / abs(value)
        return estimated(name, float(value), se, relative, degrees, unit)

    parameters = {
        name: expected(name, values[at], every[at, at], gone[at], UNITS[name])
        for at, name in enumerate(law.parameter_names)
        if free[at]
    }
    slope = np.array([values[1], values[0], 0.0])
    unit = "MPa·s" if law.companion is None else "MPa"
    product = expected("product", values[0] * values[1], slope @ every @ slope, gone[:2].any(), unit)
    return {"parameters": parameters, "product": product}


def _extrapolations(law: Law, excitations: Mapping[str, Excitation]) -> tuple[str, ...]:
    """Where the companion relation is asked outside the rates it was calibrated on."""
    if law.companion is None:
        return ()
    warned = ((name, law.companion.extrapolation(excitation.rate)) for name, excitation in excitations.items())
    return tuple(f"{name}: {text}" for name, text in warned if text)
