"""The strain-periodic component: a gap that is periodic in the strain. Serrated flow, a neck that sticks and slips, a
wavy scale; a screw, whose turns are alike in the elongation, not in the true strain.

A wavy scale has one frequency. Teeth have as many as there are samples to show them: a noise model that grows to hold
the first few still knows nothing of their comb.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from scipy.fft import next_fast_len, rfft
from scipy.special import gammaincc

from probation.detection.lines_and_steps import left_by_slow_waves, running_median, speed_wander_in
from probation.detection.tail import smallest_of_many
from probation.detection.without_lines import without_one_line_each
from probation.noise.smooth_basis import waves
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.noise.whitening import Whitened


FREQUENCIES_PER_SPACING = 4
"""Frequencies per natural spacing at which power is known."""


GRID = 16
"""Cells per period of the shortest wave whose power is taken: it loses 1 % in them."""


Coordinate = Literal["true_strain", "elongation"]
COORDINATES: tuple[Coordinate, ...] = get_args(Coordinate)
"""In which something may be periodic: the elongation is nominal strain, e^(true strain) - 1, as a screw moves."""


def along(coordinate: Coordinate, true_strain: FloatArray) -> FloatArray:
    """A coordinate of the samples, shape (n,) [-]."""
    return np.expm1(true_strain) if coordinate == "elongation" else true_strain


def shown(periods: FloatArray, samples: int) -> NDArray[np.bool_]:
    """Whether a record of so many samples shows so many periods, shape (n,): there are enough, each is long enough."""
    return (2.0 * periods >= DETECTION.slowest_line) & (periods * DETECTION.shortest_strain_period <= samples)


@dataclass(frozen=True)
class StrainPeriodic:
    """The strongest strain-periodic component of a record, or of all together.

    Attributes
    ----------
    record : str or None
        None for all.
    coordinate : {"true_strain", "elongation"}
        In which it is periodic.
    harmonics : int
        So many of them showed it.
    period : float
        Of the coordinate [-].
    p_value : float
        Over all periods of all records, in both coordinates.
    power : float
        In units of the noise's.
    tried : float
        Periods that could be discriminated among those that were tried, in both coordinates.
    """

    record: str | None
    coordinate: Coordinate
    harmonics: int
    period: float
    p_value: float
    power: float
    tried: float

    @property
    def log_share(self) -> float:
        """Log of the part of the tried periods within which this one is known: what its choice costs an explanation.

        A wave of energy L, 2 * power, over an extent E of its coordinate is known to 0.55 / (E sqrt(L)) in frequency
        (Rife and Boorstyn 1974); Laplace's integral over a flat prior of `tried` / E is that times sqrt(2 pi).
        """
        return float(min(np.log(1.38 / (self.tried * np.sqrt(2.0 * self.power))), 0.0))


def find_strain_periodic(whitened: Whitened) -> tuple[StrainPeriodic, ...]:
    """The strongest part of every record, and of all together, that is periodic in the strain, by p-value.

    As `find_lines`, over the recorded true strain and over the elongation: where the strain rate changes, teeth of one
    pitch are no line in time. What is a material's has one period in all records, so that their powers add up, as do
    those of its harmonics.

    Parameters
    ----------
    whitened : Whitened
    """
    best: dict[str | None, StrainPeriodic] = {}
    for coordinate in COORDINATES:
        for candidate in _along(coordinate, whitened):
            if candidate.record not in best or candidate.p_value < best[candidate.record].p_value:
                best[candidate.record] = candidate
    return tuple(sorted(best.values(), key=lambda component: component.p_value))


def _along(coordinate: Coordinate, whitened: Whitened) -> Iterator[StrainPeriodic]:
    """The strongest part of every record and of all together for each number of harmonics, in one coordinate."""
    places = [along(coordinate, record.true_strain) for record in whitened.records]
    longest = max(float(np.ptp(place)) for place in places)
    spectra = [
        _Spectrum.of(whitened, index, place, longest)
        for index, place in enumerate(places)
        if len(place) >= DETECTION.fewest_for_lines * DETECTION.slowest_line
        and float(np.ptp(place)) > DETECTION.least_strain_share * longest > 0.0
    ]
    if not spectra:
        return
    most = max(spectrum.count for spectrum in spectra)
    families = len(COORDINATES) * len(DETECTION.harmonics) * (len(spectra) + 1)
    for harmonics in DETECTION.harmonics:
        step = DETECTION.oversampling * harmonics
        frequency = np.arange(step * DETECTION.slowest_line // 2, step * most // DETECTION.shortest_strain_period) / (
            step * longest
        )
        together, terms = np.zeros(len(frequency)), np.zeros(len(frequency))
        names: list[str | None] = []
        strongest = []
        for spectrum in spectra:
            power, count = spectrum.comb(frequency, harmonics)
            together, terms = together + power, terms + count
            names.append(spectrum.record)
            strongest.append(_strongest(frequency, power, count, step, families))
        if len(spectra) > 1:
            names.append(None)
            strongest.append(_strongest(frequency, together, terms, step, families))
        for name, found in zip(names, strongest, strict=True):
            if found is not None:
                yield StrainPeriodic(name, coordinate, harmonics, *found)


def strain_periodic_waves(whitened: Whitened) -> tuple[FloatArray, float]:
    """Whitened waves of the most certain strain period, and what the choice of its period costs.

    Its period and the harmonics of that, of one phase in all records where it is in all, as they are and growing with
    the strain; they fall as those of a saw tooth.

    Parameters
    ----------
    whitened : Whitened

    Returns
    -------
    columns : ndarray, shape (N, m)
        The energies of all sum to 1; none if no period is certain.
    log_share : float
        See `StrainPeriodic.log_share`; 0 if none is certain.
    """
    component = _certain(whitened)
    # At a constant rate a wave in time is one in the strain, too: only what a line in time leaves is certain.
    if component is None or _certain(without_one_line_each(whitened, DETECTION.strain_periodic_level)) is None:
        return np.zeros((len(whitened), 0)), 0.0
    orders = np.arange(1, DETECTION.harmonics[-1] + 1)
    largest = max(float(np.max(np.abs(record.true_strain))) for record in whitened.records)
    parts = []
    for record in whitened.records:
        phase = 2.0 * np.pi / component.period * np.outer(along(component.coordinate, record.true_strain), orders)
        within = 1.0 if component.record in (None, record.name) else 0.0
        wave = within * np.hstack([np.cos(phase), np.sin(phase)])
        parts.append(np.hstack([wave, wave * (record.true_strain / largest)[:, None]]))
    columns = whitened.whiten(parts)
    share = np.tile(orders**-2.0, 4)
    size = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    return np.asarray(columns / size * np.sqrt(share / share.sum())), component.log_share


def _certain(whitened: Whitened) -> StrainPeriodic | None:
    """The most certain one, if its p-value is low enough."""
    found = find_strain_periodic(whitened)
    return found[0] if found and found[0].p_value < DETECTION.strain_periodic_level else None


def likely_periods(strains: Sequence[FloatArray], values: Sequence[FloatArray], most: int = 3) -> list[float]:
    """Periods in the strain of the highest peaks of power that records share, slow waves taken out.

    Of samples as they are, in no particular units: where searches begin.

    Parameters
    ----------
    strains, values : sequence of ndarray, shape (n_r,)
        By record.
    most : int
        Peaks.
    """
    longest = max(float(np.ptp(strain)) for strain in strains)
    if not longest > 0.0:
        return []
    spacing = 1.0 / (FREQUENCIES_PER_SPACING * longest)
    count = max(len(strain) for strain in strains) * FREQUENCIES_PER_SPACING // DETECTION.shortest_strain_period + 1
    total = np.zeros(count)
    for strain, own in zip(strains, values, strict=True):
        slow = waves(len(own), DETECTION.slowest_line)
        total += _power(strain, own - slow @ (slow.T @ own), spacing, count)
    total[: FREQUENCIES_PER_SPACING * DETECTION.slowest_line // 2] = 0.0
    periods = []
    for _ in range(most):
        top = int(np.argmax(total))
        if total[top] > 0.0:
            periods.append(1.0 / (top * spacing))
        total[max(top - FREQUENCIES_PER_SPACING, 0) : top + FREQUENCIES_PER_SPACING + 1] = 0.0
    return periods


@dataclass(frozen=True, eq=False)
class _Spectrum:
    """Power of one record over a coordinate, in units of the noise's, at multiples of a fine spacing.

    Attributes
    ----------
    record : str
    count : int
        Samples.
    extent, spacing : float
        Of the coordinate [-], and of the frequencies, one over that.
    power : ndarray, shape (k,)
    """

    record: str
    count: int
    extent: float
    spacing: float
    power: FloatArray

    @classmethod
    def of(cls, whitened: Whitened, index: int, place: FloatArray, longest: float) -> _Spectrum:
        """Over the noise model or the power of the neighbouring frequencies, whichever is larger."""
        record = whitened.records[index]
        extent = float(np.ptp(place))
        left, white = left_by_slow_waves(whitened, index, DETECTION.slowest_line)
        most = _height(np.abs(left))
        left = np.clip(left, -most, most)
        spacing = 1.0 / (FREQUENCIES_PER_SPACING * longest)
        count = int(len(record) / (DETECTION.shortest_harmonic * extent * spacing)) + 1
        power = _power(place, left, spacing, count)
        level = running_median(
            power, DETECTION.line_neighbours * FREQUENCIES_PER_SPACING // DETECTION.oversampling
        ) / np.log(2.0)
        level = np.maximum(level, 1.0)
        for column in speed_wander_in(whitened, index, white).T:
            level += _power(place, column, spacing, count)
        return cls(record.name, len(record), extent, spacing, power / level)

    def comb(self, frequency: FloatArray, harmonics: int) -> tuple[FloatArray, FloatArray]:
        """Power at each frequency and its harmonics, as far as they are resolved, and how many those are."""
        power, terms = np.zeros(len(frequency)), np.zeros(len(frequency))
        periods = frequency * self.extent
        seen = shown(periods, self.count)
        for order in range(1, harmonics + 1):
            place = np.rint(order * frequency / self.spacing).astype(np.intp)
            resolved = seen & (place < len(self.power))
            power[resolved] += self.power[place[resolved]]
            terms += resolved
        return power, terms


def _height(size: FloatArray) -> float:
    """Of the fourth largest peak, those within half a shortest period of a larger one not counted."""
    size = size.copy()
    for _ in range(DETECTION.fewest_teeth - 1):
        top = int(np.argmax(size))
        size[max(top - DETECTION.shortest_strain_period // 2, 0) : top + DETECTION.shortest_strain_period // 2 + 1] = (
            0.0
        )
    return float(size.max())


def _power(strain: FloatArray, values: FloatArray, spacing: float, count: int) -> FloatArray:
    """|sum v e^(-2 pi i f s)|^2 / n at the first multiples f of a spacing; samples shared out to a fine even grid."""
    even = next_fast_len(int(GRID * count), real=True)
    place = (strain - strain.min()) * spacing * even
    cell = place.astype(np.intp)
    part = place - cell
    cells = np.bincount(cell, (1.0 - part) * values, even) + np.bincount(cell + 1, part * values, even)
    power: FloatArray = np.abs(rfft(cells)[:count]) ** 2 / len(values)
    return power


def _strongest(
    frequency: FloatArray, power: FloatArray, terms: FloatArray, step: int, families: int
) -> tuple[float, float, float, float] | None:
    """The least probable sum of so many exponential variables, among all frequencies of so many families.

    Its period, p-value and power, and how many periods were tried.
    """
    tried = int(np.count_nonzero(terms))
    if not tried:
        return None
    # Of those with as many terms the largest is the least probable.
    with_as_many = (np.flatnonzero(terms == count) for count in np.unique(terms[terms > 0.0]))
    largest = np.array([places[np.argmax(power[places])] for places in with_as_many])
    chances = gammaincc(terms[largest], power[largest])
    best = np.lexsort((-power[largest], chances))[0]
    p_value = smallest_of_many(float(chances[best]), tried * families)
    at = largest[best]
    return 1.0 / float(frequency[at]), p_value, float(power[at]), len(COORDINATES) * tried / step
