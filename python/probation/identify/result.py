"""What `probation.fit` found: parameters, what is known about them, and what is left of the records."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from probation._arrays import as_number, as_whole_number, one_of
from probation.errors import InputError
from probation.identify.band import StressBand, standard_error
from probation.identify.draws import METHODS as DRAWN_BY
from probation.identify.draws import Draws, normal_draws
from probation.inference.parameter import SYMBOLS, Parameter, outside_name
from probation.law.answer import law_answer
from probation.law.history import as_history
from probation.law.schemes import scheme_of
from probation.results.data import Stored, from_curves
from probation.results.frames import by_record, over_samples, rows_frame
from probation.results.labelled import LabelledMatrix
from probation.results.rendering import Result, rendered
from probation.settings.certificate import CERTIFICATE
from probation.settings.identification import IDENTIFICATION
from probation.wording import percentage

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from probation._arrays import FloatArray
    from probation.identify.profile import Profile
    from probation.identify.record_fit import RecordFit
    from probation.inference.gap import Gap
    from probation.law.history import AnyHistory
    from probation.law.modal import Law
    from probation.law.schemes import Scheme, SchemeName, Start

Intervals = Literal["standard-error", "profile"]
INTERVALS: tuple[Intervals, ...] = ("standard-error", "profile")

Method = Literal["least-squares", "variable-projection", "simplex"]
ErrorsOf = Literal["specimens", "material"]
METHODS: tuple[Method, ...] = ("least-squares", "variable-projection", "simplex")


@dataclass(frozen=True, eq=False)
class Fit(Result, Stored):
    """Parameters identified on a campaign, and what is known about them.

    Attributes
    ----------
    campaign : str
    law : Law
        With the identified parameters.
    scheme, start, method : str
    substeps : int
        Steps of the scheme from sample to sample.
    parameters : dict of str to Parameter
        By name: unrelaxed_modulus, tau_max or alpha, hardening_modulus.
    product : Parameter
        E_u times tau_max (or alpha): known far better than either.
    names : tuple of str
        Identified parameters, in the order of `correlation`.
    correlation : ndarray, shape (free, free)
    condition_number : float
        Of the scaled Jacobian.
    records : dict of str to RecordFit
    weighting : str
        How the fit residual was weighed: "plain", "autocorrelated", "varying" (its size along a
        record), "strain-noise", "strain-noise-frozen", or
        "plain, strain noise resampled" on records too long for a matrix.
    autocorrelated : bool
        Whether the fit residual is, which widens the standard errors.
    newey_west : bool
        Whether what is left of that after whitening widens them.
    profiles : dict of str to Profile
        Where the intervals are those of the profile likelihood.
    scheme_error_MPa : float
        How far the scheme is from SA3 at most: its own error, not the law's.
    scheme_shift : dict of str to float
        What that error does to the identified parameters, in standard errors, to first order.
    covariance : LabelledMatrix
        Of the identified parameters, by their names with units; NaN where the records do not determine one.
    log_likelihood : float
        ln L of the records, the noise as it was found; larger is better, on the same records only.
    noise_parameters : int
        How many parameters of the noise were estimated.
    warnings : tuple of str
    data_sha256 : str
    gap : Gap or None
        Whether the records hold more than noise; None where that was not tested.
    errors_of : {"specimens", "material"}
        Whose parameters the standard errors and intervals are of: the specimens' that were tested, or, where
        their scatter is known from replicates or stated, the material's mean.
    """

    SCHEMA: ClassVar[str] = "probation.fit/1"

    campaign: str
    law: Law
    scheme: SchemeName
    start: Start
    substeps: int
    method: Method
    parameters: dict[str, Parameter]
    product: Parameter
    names: tuple[str, ...]
    correlation: FloatArray
    condition_number: float
    records: dict[str, RecordFit]
    autocorrelated: bool
    weighting: str = "plain"
    newey_west: bool = False
    profiles: dict[str, Profile] = field(default_factory=dict)
    scheme_error_MPa: float = 0.0  # noqa: N815 - as it leaves the program
    scheme_shift: dict[str, float] = field(default_factory=dict)
    covariance: LabelledMatrix = field(default_factory=LabelledMatrix)
    log_likelihood: float = np.nan
    noise_parameters: int = 0
    warnings: tuple[str, ...] = field(default=())
    data_sha256: str = ""
    gap: Gap | None = None
    errors_of: ErrorsOf = "specimens"

    @from_curves
    def rms_MPa(self) -> float:
        """Root mean square of the fit residual over all samples."""
        return float(np.sqrt(np.mean(np.concatenate([record.fit_residual for record in self.records.values()]) ** 2)))

    @from_curves
    def noise_MPa(self) -> float:
        """Its high-frequency part."""
        weights = [len(record.time) for record in self.records.values()]
        return float(np.sqrt(np.average([record.noise_MPa**2 for record in self.records.values()], weights=weights)))

    @property
    def bias_MPa(self) -> float:
        """Its low-frequency part: what the law does not describe."""
        return float(np.sqrt(max(self.rms_MPa**2 - self.noise_MPa**2, 0.0)))

    def to_dataframe(self, what: Literal["curves", "parameters"] = "curves") -> Any:
        """As a pandas DataFrame.

        Parameters
        ----------
        what : {"curves", "parameters"}
            A row a sample of every record, measured and model; or a row a parameter.

        Raises
        ------
        InputError
            Where pandas is not installed, or for curves of a fit that was read from JSON without them.
        """
        if one_of(what, "what", ("curves", "parameters")) == "parameters":
            columns = ("parameter", "value", "se", "low95", "high95", "status", "unit")
            rows = [
                (outside_name(name), p.value, p.se, *(p.interval95 or (None, None)), p.status, p.unit)
                for name, p in self.parameters.items()
            ]
            return rows_frame([dict(zip(columns, row, strict=True)) for row in rows], columns)
        return by_record(self._curves())

    def to_xarray(self) -> Any:
        """Curves and sensitivities as an xarray Dataset over "sample" and "parameter".

        Records stand one after the other, with the coordinates "record" and "time_s" of every sample;
        "sensitivity_MPa" is the change of the stress per unit of a parameter.

        Raises
        ------
        InputError
            Where xarray is not installed, or for a fit that was read from JSON without its curves.
        """
        curves = over_samples(self._curves())
        return curves.assign(
            sensitivity_MPa=(
                ("sample", "parameter"),
                np.concatenate([record.sensitivity for record in self.records.values()]),
            )
        ).assign_coords(parameter=[outside_name(name) for name in self.law.parameter_names])

    def _curves(self) -> dict[str, dict[str, FloatArray]]:
        return {
            name: {
                "time_s": record.time,
                "true_strain": record.true_strain,
                "true_stress_MPa": record.true_stress,
                "model_stress_MPa": record.model_stress,
                "residual_MPa": record.fit_residual,
            }
            for name, record in self.records.items()
        }

    @property
    def samples(self) -> int:
        """Of all records."""
        return sum(record.samples for record in self.records.values())

    @property
    def effective_samples(self) -> float:
        """Independent samples that would say as much of the scatter: fewer where the fit residual is autocorrelated."""
        return sum(record.effective_samples for record in self.records.values())

    @property
    def degrees(self) -> float:
        """Of freedom: effective samples less identified parameters."""
        return max(self.effective_samples - len(self.names), 1.0)

    @property
    def scatter_MPa(self) -> float:
        """Standard deviation of measured samples around the law, from the fit residual."""
        return self.rms_MPa * float(np.sqrt(max(self.effective_samples / self.degrees, 1.0)))

    @property
    def aic(self) -> float:
        """Akaike's information criterion, parameters of the noise counted: the lower the better."""
        return 2.0 * (len(self.names) + self.noise_parameters) - 2.0 * self.log_likelihood

    @property
    def bic(self) -> float:
        """Schwarz's (Bayesian) information criterion, parameters of the noise counted: the lower the better."""
        count = len(self.names) + self.noise_parameters
        return count * float(np.log(self.samples)) - 2.0 * self.log_likelihood

    def predict(
        self,
        history: AnyHistory | ArrayLike,
        true_strain: ArrayLike | None = None,
        *,
        level: float = 0.95,
        scheme: Scheme | SchemeName = "sa3",
    ) -> StressBand:
        """The stress along a history, with its confidence and prediction bands.

        The confidence band is that of the law's stress if the law is right. It widens with the errors of the
        parameters, which autocorrelated noise widens. The prediction band is that of a measured sample: it has on top
        what scatters the fitted records around the law, their noise and what the law leaves out.

        Parameters
        ----------
        history : StrainHistory, or array_like, shape (n_times,) [s]
            Or two arrays, time and true strain.
        true_strain : array_like, shape (n_times,) [-], optional
        level : float
            Probability of each band, at each instant by itself.
        scheme : {"be2", "sa2", "sa3"}, `BE2`, `SA2` or `SA3`

        Returns
        -------
        StressBand

        Raises
        ------
        InputError
            For a history that is not possible, or a level that is no probability.
        """
        if not 0.0 < as_number(level, "level") < 1.0:
            raise InputError(f"level is {level!r}; expected a probability between 0 and 1, such as 0.95")
        driven = as_history(history, true_strain)
        stress, sensitivity = self.law.sensitivity(driven, scheme=scheme)
        return StressBand(
            name=self.campaign,
            time=driven.time,
            true_strain=driven.true_strain,
            true_stress=stress,
            standard_error=self.stress_error(sensitivity),
            scatter_MPa=self.scatter_MPa,
            level=float(level),
            degrees=self.degrees,
        )

    def stress_error(self, sensitivity: FloatArray) -> FloatArray:
        """Standard error of the law's stress by the uncertainty of its parameters, shape (n_times,) [MPa].

        Parameters
        ----------
        sensitivity : ndarray, shape (n_times, 3) [MPa per unit]
            Along `law.parameters`.
        """
        identified = [self.law.parameter_names.index(name) for name in self.names]
        return standard_error(sensitivity[:, identified], self.covariance.matrix)

    def sample(self, n: int = 1000, *, method: Literal["laplace", "emcee"] = "laplace", seed: int = 0) -> Draws:
        """Draws of the identified parameters from their posterior.

        Parameters
        ----------
        n : int
        method : {"laplace", "emcee"}
            "laplace": a normal distribution around the estimates with `covariance`, without what is negative. "emcee":
            the likelihood itself, flat priors, by the ensemble sampler of the package emcee; it solves the law some
            ten thousand times. It knows the noise as the fit has it, white or AR(1): where `newey_west` is true, its
            draws are narrower than `covariance`.
        seed : int

        Returns
        -------
        Draws
            `to_arviz()` and `to_dataframe()` hand them on.

        Raises
        ------
        InputError
            If the records do not determine a parameter; of "emcee" also where the package is not installed, or where
            strain noise weighs the residual.
        """
        if as_whole_number(n, "n") < 1:
            raise InputError(f"n is {n}; expected at least 1")
        number, how = as_whole_number(seed, "seed"), one_of(method, "method", DRAWN_BY)
        names = tuple(outside_name(name) for name in self.names)
        centre = np.array([getattr(self.law, name) for name in self.names])
        random = np.random.default_rng(number)
        if how == "laplace":
            return Draws(names, normal_draws(centre, self.covariance, n, random))
        from probation.identify.posterior import Posterior, walk  # noqa: PLC0415 - it solves the law again

        start = normal_draws(centre, self.covariance, max(IDENTIFICATION.walkers, 2 * len(names) + 2), random)
        posterior = Posterior.of(
            self.law,
            self.names,
            self.records.values(),
            self.weighting,
            scheme=scheme_of(self.scheme, self.start),
            substeps=self.substeps,
        )
        return Draws(names, walk(posterior, n, number, start))

    def plot(self, kind: Literal["curves", "corner"] = "curves") -> Figure:
        """The fit as a figure.

        Parameters
        ----------
        kind : {"curves", "corner"}
            Stress against strain with the fit residuals below; or the joint confidence of the parameters, two by two.

        Raises
        ------
        InputError
            For another kind; or for curves of a fit that was read from JSON without them.
        """
        one_of(kind, "kind", ("curves", "corner"))
        figure: Figure = rendered(self, "plot" if kind == "curves" else "corner")
        return figure

    @property
    def verdict(self) -> str:
        """One sentence."""
        poor = [p for p in self.parameters.values() if p.status not in ("identifiable", "held")]
        largest = max(record.largest_stress_MPa for record in self.records.values())
        part = percentage(self.bias_MPa / largest)
        noise = f"the noise being {self.noise_MPa:.3g} MPa"
        bias = f"the law leaves a bias of {self.bias_MPa:.3g} MPa ({part} % of the largest stress)"
        if self.gap is not None and not self.gap.in_fitted:
            quality = "the law describes the records to within their noise"
            if self.gap.hangs_on_scatter:
                quality += f" and their specimens' differences ({self.gap.scatter.text})"
                quality += "" if self.gap.trend is None else f"; but {self.gap.trend.text}"
        elif self.bias_MPa > CERTIFICATE.bias_over_noise * self.noise_MPa:
            quality = f"{bias}, {self.bias_MPa / self.noise_MPa:.0f} times the noise"
        elif self.bias_MPa > self.noise_MPa:
            quality = f"{bias}, comparable to the noise"
        elif self.gap is None:
            quality = f"the law leaves {self.rms_MPa:.3g} MPa, {noise}; whether that is more than noise was not tested"
        else:
            size = self.gap.size
            part = percentage(size.relative)
            quality = (
                f"the law leaves {size.rms_MPa:.3g} MPa in {size.record} ({part} % of the largest stress) that are not "
                f"noise, {noise}"
            )
        if not poor:
            return f"All parameters are identifiable; {quality}."
        names = ", ".join(f"{SYMBOLS[p.name]} ({p.status.replace('_', ' ')})" for p in poor)
        return f"Not all parameters are determined by these records: {names}; {quality}."

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects, `probation.fit/1` of docs/formats.md."""
        second = outside_name(self.law.parameter_names[1])
        identified = {name: p for name, p in self.parameters.items() if p.status != "held"}
        return {
            "campaign": self.campaign,
            "data_sha256": self.data_sha256,
            "verdict": self.verdict,
            "scheme": self.scheme,
            "start": self.start,
            "substeps": self.substeps,
            "method": self.method,
            "parameters": {outside_name(name): p.to_json() for name, p in identified.items()},
            "law": law_answer(self.law),
            "fixed": {outside_name(n): p.value for n, p in self.parameters.items() if p.status == "held"},
            "products": {f"unrelaxed_modulus_MPa*{second}": self.product.to_json()},
            "correlation": {"names": [outside_name(name) for name in self.names], "matrix": self.correlation},
            "covariance": self.covariance.to_dict(),
            "condition_number": self.condition_number,
            "log_likelihood": self.log_likelihood,
            "aic": self.aic,
            "bic": self.bic,
            "weighting": self.weighting,
            "intervals": "profile" if self.profiles else "standard-error",
            "autocorrelated": self.autocorrelated,
            "errors_of": self.errors_of,
            "residual": {"rms_MPa": self.rms_MPa, "noise_MPa": self.noise_MPa, "bias_MPa": self.bias_MPa},
            "scheme_error": {
                "max_MPa": self.scheme_error_MPa,
                "shift_in_se": {outside_name(name): shift for name, shift in self.scheme_shift.items()},
            },
            "gap": None if self.gap is None else self.gap.to_dict(),
            "records": {name: record.to_json() for name, record in self.records.items()},
            "warnings": list(self.warnings),
        }
