"""A base law put right by what it left unexplained on reference records of the same tests.

The law's own error on a material is no change of the rig. So what it leaves on the reference is taken for known and
carried over to the same point of the specimen's way: at a strain that is seen later, or less of, it comes later, or
less of it. The response to a change of the strain is then the measured one; the law only corrects for a history that
is not quite the reference's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.comparison.strain_path import branches, direction, progress
from probation.inference.wrapped_law import WrappedLaw
from probation.settings.comparison import COMPARISON

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw
    from probation.law.modification import Modification


ROUNDING = 1e-9
"""By which a way may be longer than the reference's."""

TINY = 1e-300


@dataclass(frozen=True, eq=False)
class Branch:
    """What the law leaves on one branch of a reference record.

    Attributes
    ----------
    progress : ndarray, shape (n,)
        See `strain_path.progress`.
    missing : ndarray, shape (n,) [MPa]
        Data minus law; smoothed, but where it is sharp.
    direction : float
        Of straining: +1, -1, or 0 in a dwell.
    frame : ndarray, shape (n, k)
        Orthonormal curves that the smoothing follows: the reference's own noise along them stays in `missing`.
    sharp : ndarray of bool, shape (n,)
        Where the reference has what such curves cannot follow.
    stress : ndarray, shape (n,) [MPa]
        The law's, under the reference's own history.
    """

    progress: FloatArray
    missing: FloatArray
    direction: float
    frame: FloatArray
    sharp: NDArray[np.bool_]
    stress: FloatArray


def reference_branches(view: RecordView, left: FloatArray, sharp: NDArray[np.bool_]) -> tuple[Branch, ...]:
    """The branches of a reference record.

    Parameters
    ----------
    view : RecordView
    left : ndarray, shape (n,) [MPa]
        Data minus law.
    sharp : ndarray of bool, shape (n,)
    """
    all_branches = []
    for part in branches(view):
        frame = followed(view.time[part])
        smooth = frame @ (frame.T @ left[part])
        kept = sharp[part].copy()
        kept[: COMPARISON.branch_ends] = kept[-COMPARISON.branch_ends :] = True
        all_branches.append(
            Branch(
                progress(view, part),
                np.where(kept, left[part], smooth),
                direction(view, part),
                frame,
                sharp[part],
                view.data[part] - left[part],
            )
        )
    return tuple(all_branches)


def followed(time: FloatArray) -> FloatArray:
    """Orthonormal basis of cubic splines in time, dense at the start; shape (n, k)."""
    from scipy.interpolate import BSpline  # noqa: PLC0415 - slow to load

    count = len(time)
    intervals = max(min(COMPARISON.branch_intervals, count // COMPARISON.samples_per_interval), 1)
    inner = np.arange(1, intervals) / intervals
    if intervals > COMPARISON.graded_intervals:
        finest = COMPARISON.samples_at_start / (count - 1) / (1.0 - COMPARISON.grading)
        graded = (COMPARISON.graded_intervals / intervals) * COMPARISON.grading ** np.arange(1, 40)
        inner = np.concatenate([graded[graded > finest][::-1], inner[COMPARISON.graded_intervals - 1 :]])
    place = (time - time[0]) / (time[-1] - time[0])
    knots = np.concatenate([np.zeros(4), inner, np.ones(4)])
    design = BSpline.design_matrix(place, knots, 3).toarray()
    return np.asarray(np.linalg.qr(design)[0])


class MeasuredLaw(WrappedLaw):
    """`GapLaw`: the base law, all held, plus what it left on the references.

    Parameters
    ----------
    law : GapLaw
        With nothing to identify.
    references : dict of str to sequence of (Branch, ...)
        By record id: the branches of each reference of that record.
    errs : bool
        Whether the law's answer to another history may be wrong.

    Notes
    -----
    Beyond the end of a reference its last value is kept. At the same point of the way histories differ in their rates
    only, and how a material answers to these is what a law may have wrong altogether. If it errs, what it says of that
    difference has a factor 1 - k; k, the same in all records, has a normal prior of standard deviation 1.
    """

    def __init__(
        self, law: GapLaw, references: Mapping[str, Sequence[tuple[Branch, ...]]], *, errs: bool = False
    ) -> None:
        super().__init__(law)
        self.references = dict(references)
        self.errs = errs

    def around(self, law: GapLaw) -> MeasuredLaw:
        """The same around another law."""
        return MeasuredLaw(law, self.references, errs=self.errs)

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """The law's, and the error of its answer to another history."""
        return (*self.law.parameter_names, *(("answer_error",) if self.errs else ()))

    @property
    def start(self) -> FloatArray:
        """The law's, and no error; shape (n_parameters,)."""
        return np.append(self.law.start, np.zeros(int(self.errs)))

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds, each of shape (n_parameters,)."""
        lower, upper = self.law.bounds
        own = np.full(int(self.errs), COMPARISON.farthest_answer)
        return np.append(lower, -own), np.append(upper, own)

    @property
    def scales(self) -> FloatArray:
        """Standard deviations of the parameters' normal priors about 0, shape (n_parameters,)."""
        return np.append(np.full(len(self.law.parameter_names), np.inf), np.ones(int(self.errs)))

    def stress(self, view: RecordView, parameters: FloatArray, modification: Modification | None = None) -> FloatArray:
        """True stress along a record, shape (n,) [MPa]; as in `GapLaw`."""
        inner, errors = np.split(parameters, [len(self.law.parameter_names)])
        stress = self.law.stress(view, inner, modification)
        return np.asarray(stress + self.carried_over(view) - self._answers(view, inner, modification, stress) @ errors)

    def sensitivity(
        self, view: RecordView, parameters: FloatArray, modification: Modification | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """True stress (n,) [MPa] and the derivatives (n, n_parameters); as in `GapLaw`."""
        inner, errors = np.split(parameters, [len(self.law.parameter_names)])
        stress, slopes = self.law.sensitivity(view, inner, modification)
        answers = self._answers(view, inner, modification, stress)
        return stress + self.carried_over(view) - answers @ errors, np.hstack([slopes, -answers])

    def _answers(
        self, view: RecordView, inner: FloatArray, modification: Modification | None, stress: FloatArray
    ) -> FloatArray:
        """The law's answer to what differs from the references' histories, shape (n, 1); (n, 0) if it does not err."""
        if not self.errs:
            return np.zeros((len(view), 0))
        return self._answer(view, stress if modification is None else self.law.stress(view, inner))[:, None]

    def _answer(self, view: RecordView, stress: FloatArray) -> FloatArray:
        """A stress of the law less its stress at the same points of the references; none beyond their ends; (n,)."""
        references = self.references[view.id]
        total = np.zeros(len(view))
        for reference in references:
            for part, branch in _paired(view, reference):
                way = _way(view, part, branch)
                inside = way <= branch.progress[-1] * (1.0 + ROUNDING)
                total[part] += inside * (stress[part] - np.interp(way, branch.progress, branch.stress))
        return total / len(references)

    def carried_over(self, view: RecordView) -> FloatArray:
        """What the law left on the references, at the same points of the way; their mean, shape (n,) [MPa]."""
        references = self.references[view.id]
        total = np.zeros(len(view))
        for reference in references:
            for part, branch in _paired(view, reference):
                total[part] += np.interp(_way(view, part, branch), branch.progress, branch.missing)
        return total / len(references)

    def sharp(self, view: RecordView) -> NDArray[np.bool_]:
        """Instants at which a reference has something sharp; shape (n,)."""
        sharp = np.zeros(len(view), dtype=bool)
        for reference in self.references[view.id]:
            for part, branch in _paired(view, reference):
                sharp[part] |= np.interp(progress(view, part), branch.progress, branch.sharp) > 0.0
        return sharp

    def beyond(self, view: RecordView) -> list[FloatArray]:
        """What the law may leave beyond the end of each reference, whose last value is kept there; each (n, k) [MPa].

        A parabola as large as what it leaves before the end. Not more: under a large fault of the travel these are the
        samples whose strain the specimen did not reach.
        """
        parabolas = []
        for reference in self.references[view.id]:
            columns = np.zeros((len(view), COMPARISON.beyond_reference * len(reference)))
            for index, (part, branch) in enumerate(_paired(view, reference)):
                end = max(float(branch.progress[-1]), TINY)
                far = np.maximum(progress(view, part) / end - 1.0 - ROUNDING, 0.0)[:, None]
                size = float(np.max(np.abs(branch.missing))) / len(self.references[view.id])
                own = slice(COMPARISON.beyond_reference * index, COMPARISON.beyond_reference * (index + 1))
                columns[part, own] = size * (far > 0.0) * far ** np.arange(COMPARISON.beyond_reference)
            parabolas.append(columns[:, columns.any(axis=0)])
        return parabolas

    def frames(self, view: RecordView) -> list[FloatArray]:
        """The curves of every reference, carried over in the same way; each of shape (n, k)."""
        frames = []
        for reference in self.references[view.id]:
            columns = []
            for part, branch in _paired(view, reference):
                own = np.zeros((len(view), branch.frame.shape[1]))
                here = _way(view, part, branch)
                for index, curve in enumerate(branch.frame.T):
                    own[part, index] = np.interp(here, branch.progress, curve)
                columns.append(own)
            frames.append(np.hstack(columns))
        return frames


def _way(view: RecordView, part: slice, branch: Branch) -> FloatArray:
    """How far the specimen has come on a branch; a test begins where its reference began, at rest; shape (n_part,).

    At the first instant the law's stress does not answer to the strain yet. What it leaves does, where it is too stiff,
    and a force that acts back on the strain then need not exist.
    """
    way = progress(view, part)
    if part.start == 0:
        way[0] = branch.progress[0]
    return way


def _paired(view: RecordView, reference: Sequence[Branch]) -> list[tuple[slice, Branch]]:
    """Branches of a record, and those of its reference that they are; a rest at the start need not be in both."""
    own = branches(view)
    resting = direction(view, own[0]) == 0.0
    if resting != (reference[0].direction == 0.0):
        own, reference = (own[1:], reference) if resting else (own, reference[1:])
    return list(zip(own, reference, strict=False))
