"""What a campaign's data can show: signals whitened by every noise, without what the base law's parameters take up.

The noise of the recorded stress minus the law along the recorded strain: the cell's white and slow noise, and the
strain's own, through the law's response to it (J Sigma J^T; its part by way of a companion's rate is left out), and
where specimens are repeated their deviations, as the law's tangents times their standard deviations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from scipy.linalg import block_diag, solve_triangular

from probation_studies.blind.laboratories.industry.bench import BenchTest, Law, Programme, Scales, base_stress
from probation_studies.blind.laboratories.industry.causes.form import Form, Shape
from probation_studies.blind.laboratories.industry.instruments import Instruments, slow_covariance
from probation_studies.blind.laboratories.industry.memory import SQUARE_ROOT, FloatArray, haward_thackray

_NODES = 100


@dataclass(frozen=True)
class Acting:
    """A cause at work.

    Attributes
    ----------
    cause : str
    form : Form
    amplitude : float
    shape : dict
    """

    cause: str
    form: Form
    amplitude: float
    shape: Shape


def tested(programme: Programme, law: Law, scales: Scales, acting: Sequence[Acting]) -> tuple[FloatArray, FloatArray]:
    """Travel and force of a test with causes, without noise."""
    test = BenchTest(programme, law, scales)
    for each in acting:
        each.form.act(test, each.amplitude, each.shape)
    return test.run()


def residual(programme: Programme, law: Law, scales: Scales, acting: Sequence[Acting]) -> FloatArray:
    """Recorded true stress minus the base law along the recorded strain, without noise [MPa]."""
    with np.errstate(all="ignore"):  # trials of too large a size end as not finite
        travel, force = tested(programme, law, scales, acting)
    if not np.all(travel > -0.9):
        return np.full(len(travel), np.nan)
    return np.asarray(force * (1.0 + travel) - base_stress(programme, law, scales, travel))


@dataclass(frozen=True, eq=False)
class View:
    """One record by its means over blocks of samples."""

    time: FloatArray
    thin: Programme
    starts: FloatArray

    def at_samples(self, at_nodes: FloatArray) -> FloatArray:
        """Columns of values at the nodes, between them."""
        return np.stack([np.interp(self.time, self.thin.time, column) for column in at_nodes.T], axis=1)

    def means(self, at_samples: FloatArray) -> FloatArray:
        """Block means of one or more columns of samples."""
        counts = np.diff([*self.starts, len(self.time)])
        return np.asarray((np.add.reduceat(at_samples, self.starts, axis=0).T / counts).T)


class Sight:
    """The space in which causes are seen.

    Parameters
    ----------
    programmes : sequence of Programme
        Of the identified records, at their samples.
    law : Law
    scales : Scales
    instruments : Instruments
    scatter : tuple of float, or None
        Relative standard deviations of E, tau, G and the section.
    """

    def __init__(
        self,
        programmes: Sequence[Programme],
        law: Law,
        scales: Scales,
        instruments: Instruments,
        scatter: tuple[float, float, float, float] | None,
    ) -> None:
        self.law, self.scales, self.scatter = law, scales, scatter
        self.views = [view_of(each) for each in programmes]
        self.responses = [
            _response(each, view, law, scales) for each, view in zip(programmes, self.views, strict=True)
        ]  # of the law less the recorded stress to the read true strain; block means by samples [MPa]
        blocks = [
            _noise(each, view, response, instruments)
            for each, view, response in zip(programmes, self.views, self.responses, strict=True)
        ]
        covariance = block_diag(*blocks)
        tangents = [view.means(view.at_samples(self.tangents(view))) for view in self.views]
        ends = np.cumsum([0, *(len(block) for block in blocks)])
        self.rows = [slice(int(a), int(b)) for a, b in pairwise(ends)]
        if scatter is not None:
            for rows, each in zip(self.rows, tangents, strict=True):
                own = each * np.array(scatter)
                covariance[rows, rows] += own @ own.T
        self._root = np.linalg.cholesky(covariance)
        self._taken, _ = np.linalg.qr(self.white(np.concatenate([each[:, :3] for each in tangents])))

    def white(self, columns: FloatArray) -> FloatArray:
        """Block means of all records, one below the other, in units of their noise."""
        return np.asarray(solve_triangular(self._root, columns, lower=True))

    def tangents(self, view: View) -> FloatArray:
        """By ln E, ln tau, ln G and ln of the section, at the nodes of a record."""
        law, step = self.law, 1e-3

        def stress(changed: Law) -> FloatArray:
            return base_stress(view.thin, changed, self.scales, view.thin.travel)

        base = stress(law)
        columns = [
            (stress(replace(law, modulus=law.modulus * (1 + step))) - base) / step,
            (stress(replace(law, time=law.time * (1 + step))) - base) / step,
            (stress(replace(law, hardening=law.hardening * (1 + step))) - base) / step,
            base,
        ]
        return np.stack(columns, axis=1)

    def seen(self, by_record: Sequence[FloatArray]) -> FloatArray:
        """Block means of all records (zero where an array is empty), whitened and without the base law's tangents."""
        whole = np.zeros(self.rows[-1].stop)
        for rows, estimate in zip(self.rows, by_record, strict=True):
            if len(estimate):
                whole[rows] = estimate
        white = self.white(whole)
        return np.asarray(white - self._taken @ (self._taken.T @ white))

    def signal(self, acting: Sequence[Acting], record: int) -> FloatArray:
        """Block means of what causes add to one record [MPa]."""
        view = self.views[record]
        at_nodes = residual(view.thin, self.law, self.scales, acting)
        return view.means(np.interp(view.time, view.thin.time, at_nodes))

    def sampling(self, programmes: Sequence[Programme], cut: Sequence[Programme]) -> float:
        """sqrt(lambda) of what is lost between samples, and before the first of a record that is cut."""
        left = []
        for whole, kept, view in zip(programmes, cut, self.views, strict=True):
            fine = refined(whole)
            true = base_stress(fine, self.law, self.scales, fine.travel)
            there = np.interp(kept.time + whole.time[-1] - kept.time[-1], fine.time, true)
            found = base_stress(kept, self.law, self.scales, kept.travel)
            counts = np.diff([*view.starts, len(view.time)])
            left.append(np.add.reduceat(there - found, view.starts) / counts)
        return float(np.linalg.norm(self.seen(left)))


def refined(programme: Programme) -> Programme:
    """Twice the nodes, the travel straight between samples in time as the crosshead moves."""
    time = np.sort(np.concatenate([programme.time, 0.5 * (programme.time[1:] + programme.time[:-1])]))
    return replace(programme, time=time, travel=np.interp(time, programme.time, programme.travel))


def view_of(programme: Programme) -> View:
    """The record of a programme, its samples in some hundred blocks."""
    thin = programme.thinned(_NODES)
    starts = np.searchsorted(programme.time, thin.time[:-1] if len(thin.time) > 2 else thin.time)
    return View(programme.time, thin, np.unique(starts))


def _noise(programme: Programme, view: View, response: FloatArray, instruments: Instruments) -> FloatArray:
    """Covariance of the block means of one record [MPa^2]."""
    starts = view.starts
    counts = np.diff([*starts, len(programme.time)]).astype(float)
    section = 1.0 + programme.travel
    white = np.add.reduceat((instruments.force_white * section) ** 2, starts) / counts**2
    centre = np.add.reduceat(programme.time, starts) / counts
    opened = np.add.reduceat(section, starts) / counts
    slow = slow_covariance(centre, instruments) * np.outer(opened, opened)
    carried = response * (instruments.strain_white / section)
    return np.asarray(np.diag(white) + slow + carried @ carried.T)


def _response(programme: Programme, view: View, law: Law, scales: Scales) -> FloatArray:
    """Of the law less the recorded stress to the read true strain; block means by samples [MPa]."""
    starts, samples = view.starts, len(programme.time)
    counts = np.diff([*starts, samples]).astype(float)
    strain = np.log1p(programme.travel)
    speed = BenchTest(programme, law, scales).speed
    reduced = np.concatenate([[0.0], np.cumsum(np.diff(programme.time) / law.times(speed))])
    operator = SQUARE_ROOT.operator(reduced)
    relaxed = law.hardening * (2.0 * np.exp(2.0 * strain) + np.exp(-strain))
    stress = law.hardening * haward_thackray(strain) + operator @ (
        law.modulus * np.diff(strain) - law.hardening * np.diff(haward_thackray(strain))
    )
    averaged = np.add.reduceat(operator, starts, axis=0) / counts[:, None]
    edge = np.zeros((len(starts), 1))
    response = np.diff(np.concatenate([edge, averaged, edge], axis=1), axis=1) * -(law.modulus - relaxed)
    owner = np.repeat(np.arange(len(starts)), counts.astype(int))
    response[owner, np.arange(samples)] += (relaxed - stress) / counts[owner]
    return np.asarray(response)
