"""Each record of a campaign alone, with a constant tau_max: the rows of a table such as the paper's Table 2."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.calibration.rate_table import RateTable
from probation.calibration.regression import excess_scatter
from probation.errors import InputError
from probation.identify.fit import fit
from probation.identify.result import Fit
from probation.law.settings import LawSettings
from probation.records.campaign import Campaign
from probation.settings.companion import COMPANION

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray
    from probation.law.schemes import Scheme, SchemeName
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

Modulus = Literal["shared", "free"]
MODULI: tuple[Modulus, ...] = ("shared", "free")


@dataclass(frozen=True, eq=False)
class RecordRate:
    """The strain rate of one record.

    Attributes
    ----------
    rate : float
        Median of its modulus [1/s].
    slow, fast : float
        5th and 95th percentiles [1/s].
    """

    id: str
    rate: float
    slow: float
    fast: float

    @property
    def spread(self) -> float:
        """95th over 5th percentile [-]."""
        return self.fast / self.slow if self.slow > 0.0 else float("inf")


@dataclass(frozen=True, eq=False)
class RecordFits:
    """Every record fitted alone with a constant tau_max.

    Attributes
    ----------
    table : RateTable
        With the standard errors at a given E_u where it is shared.
    rates : tuple of RecordRate
    fits : tuple of Fit
        One per record; E_u held where it is shared.
    unrelaxed_modulus : float or None
        The shared one [MPa].
    unrelaxed_modulus_se : float
        Its standard error [MPa]; 0 where the campaign holds it.
    log_slope : ndarray, shape (n,)
        d ln tau_max / d ln E_u of each record: near -1, since the product is what is known.
    modulus_spread : float
        Scatter of ln E_u between the records beyond their standard errors [-].
    """

    table: RateTable
    rates: tuple[RecordRate, ...]
    fits: tuple[Fit, ...]
    unrelaxed_modulus: float | None
    unrelaxed_modulus_se: float
    log_slope: FloatArray
    modulus_spread: float


def record_rate(record: Record, excitation: Excitation) -> RecordRate:
    """The median and the spread of a record's strain rate, as the law sees it."""
    rate = np.abs(excitation.rate)
    low, high = COMPANION.rate_ends
    slow, middle, fast = np.percentile(rate, [low, 50.0, high]).tolist()
    if not middle > 0.0:
        raise InputError(f"record {record.id!r}: found a strain that hardly moves, expected a test at some strain rate")
    return RecordRate(record.id, middle, slow, fast)


def fit_records(
    campaign: Campaign,
    rates: tuple[RecordRate, ...],
    *,
    modulus: Modulus = "shared",
    scheme: Scheme | SchemeName = "sa3",
    progress: Callable[[int, int, str], None] | None = None,
) -> RecordFits:
    """Fit every record alone with a constant tau_max.

    With `modulus` "shared", E_u is the mean of the records' own, weighted by what each knows of it, and tau_max is
    identified again with E_u held there: E_u and tau_max of one record are all but collinear (-0.998 in experiment 1),
    so that tau_max at a given E_u is known ten to a hundred times better. With "free" each record keeps its own.

    Raises
    ------
    InputError
        If a parameter that is needed is held, or no record determines E_u.
    """
    settings = _constant_time(campaign)
    records = campaign.identify
    total = len(records) * (1 if modulus == "free" or "unrelaxed_modulus_MPa" in settings.fixed else 2)

    def fitted(record: Record, law: LawSettings, done: int) -> Fit:
        if progress is not None:
            progress(done, total, f"record {record.id} alone")
        return fit(
            Campaign(record.id, campaign.identified_on([record.id]), law),
            scheme,
            method="variable-projection",
            gap=False,
        )

    fits = tuple(fitted(record, settings, at) for at, record in enumerate(records))
    held = settings.fixed.get("unrelaxed_modulus_MPa")
    own = tuple(
        (fitted_record.law.unrelaxed_modulus, fitted_record.parameters["unrelaxed_modulus"].se)
        for fitted_record in fits
    )
    slope = np.array([_log_slope(fitted_record) for fitted_record in fits])
    shared, shared_se, spread = held, 0.0, 0.0
    if modulus == "shared" and held is None:
        log_mean, log_se, spread = _shared_log_modulus(campaign.name, own)
        shared, shared_se = float(np.exp(log_mean)), float(np.exp(log_mean) * log_se)
        together = replace(settings, fixed={**settings.fixed, "unrelaxed_modulus_MPa": shared})
        fits = tuple(fitted(record, together, len(records) + at) for at, record in enumerate(records))
    times = [fitted_record.parameters["tau_max"] for fitted_record in fits]
    for record, time in zip(records, times, strict=True):
        if time.se is None:
            raise InputError(
                f"record {record.id!r}: found no information on tau_max in it, expected a record past its elastic "
                "part; "
                'give it role = "held-out"'
            )
    table = RateTable(
        rates=np.array([rate.rate for rate in rates]),
        tau_max=np.array([time.value for time in times]),
        se=np.array([time.se for time in times]),
        hardening_modulus=np.array([fitted_record.law.hardening_modulus for fitted_record in fits]),
        labels=tuple(record.id for record in records),
        source=f"campaign {campaign.name}",
    )
    return RecordFits(table, rates, fits, shared, shared_se, slope, spread)


def spread_warnings(rates: tuple[RecordRate, ...]) -> list[str]:
    """Of records whose rate is not constant."""
    return [
        f"record {rate.id!r}: its strain rate runs from {rate.slow:.2g} to {rate.fast:.2g} 1/s (5 to 95 % of the "
        f"record, a factor of {rate.spread:.2g}): a constant tau_max there is an average over rates"
        for rate in rates
        if rate.spread > COMPANION.warned_spread
    ]


def _constant_time(campaign: Campaign) -> LawSettings:
    """The campaign's law without its companion relation."""
    if "tau_max_s" in campaign.law.fixed:
        raise InputError(
            f"campaign {campaign.name!r}: found tau_max_s in law.fixed, expected it free: its dependence on the rate "
            "is what is calibrated"
        )
    fixed = {name: value for name, value in campaign.law.fixed.items() if name != "alpha"}
    return replace(campaign.law, companion=None, fixed=fixed)


def _log_slope(alone: Fit) -> float:
    """D ln tau_max / d ln E_u along the valley of one record's fit; -1 where the fit does not tell."""
    modulus, time = alone.parameters["unrelaxed_modulus"], alone.parameters["tau_max"]
    if not modulus.se or not time.se:
        return -1.0
    at = {name: place for place, name in enumerate(alone.names)}
    correlation = float(alone.correlation[at["unrelaxed_modulus"], at["tau_max"]])
    return correlation * (time.se / time.value) / (modulus.se / modulus.value)


def _shared_log_modulus(name: str, own: tuple[tuple[float, float | None], ...]) -> tuple[float, float, float]:
    """Mean of ln E_u, its standard error, and the scatter between records beyond theirs (Paule & Mandel 1982)."""
    known = [(np.log(value), se / value) for value, se in own if se]
    if not known:
        raise InputError(
            f"campaign {name!r}: found no record that determines E_u, expected one, or unrelaxed_modulus_MPa in "
            "law.fixed"
        )
    values, errors = (np.array(side) for side in zip(*known, strict=True))
    scatter = 0.0
    for _ in range(50 if len(values) > 1 else 0):
        mean = float(np.average(values, weights=1.0 / (errors**2 + scatter**2)))
        before, scatter = scatter, excess_scatter(values - mean, errors, len(values) - 1)
        if abs(scatter - before) <= 1e-6 * scatter:
            break
    weights = 1.0 / (errors**2 + scatter**2)
    return float(np.average(values, weights=weights)), float(1.0 / np.sqrt(weights.sum())), scatter
