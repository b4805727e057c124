"""Sharp causes are sought where something sharp is left: lines, steps, periods of the strain."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.detection.lines_and_steps import find_lines, find_steps
from probation.detection.strain_periodic import find_strain_periodic
from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.inference.candidate import Candidate
    from probation.noise.whitening import Whitened


def credible(candidates: Sequence[Candidate], left: Whitened) -> list[Candidate]:
    """Without sharp causes where nothing sharp is left; a soft step shows by what no smooth cause does.

    Parameters
    ----------
    candidates : sequence of Candidate
    left : Whitened
        What the model that they are added to leaves.
    """
    kinds = {candidate.cause.form.sharp for candidate in candidates}
    found = find_lines(left) if "line" in kinds else ()
    lines = {line.record for line in found if line.p_value < SEARCH.line_or_step_level}
    steps = {step.record: step.p_value for step in find_steps(left)} if "step" in kinds else {}
    periodic = _periodic_in_strain(left) if "strain_period" in kinds else set()
    everywhere = {record.name for record in left.records}
    smooth_ones = [candidate for candidate in candidates if candidate.cause.form.sharp is None]
    best_smooth = max(smooth_ones, key=lambda candidate: candidate.gain, default=None)
    smooth = 0.0 if best_smooth is None else best_smooth.gain

    def is_credible(candidate: Candidate) -> bool:
        sharp = candidate.cause.form.sharp
        places = everywhere if candidate.cause.records is None else {*candidate.cause.records}
        if sharp is None or (
            sharp == "step" and candidate.gain > max(SEARCH.soft_step_ratio * smooth, SEARCH.strong_gap)
        ):
            return True
        if sharp == "step" and best_smooth is not None and candidate.cause.effect is best_smooth.cause.effect:
            return True  # a slip that creeps may be one that takes some samples
        if sharp == "line":
            return bool(places & lines)
        if sharp == "strain_period":
            return bool(places & periodic)
        soft = candidate.gain > smooth + SEARCH.soft_step_lead
        level = SEARCH.soft_step_level if soft else SEARCH.line_or_step_level
        return min((steps.get(name, 1.0) for name in places), default=1.0) < level

    return [candidate for candidate in candidates if is_credible(candidate)]


def _periodic_in_strain(left: Whitened) -> set[str]:
    """Records in which something is periodic in the strain: all of them, where it shows in all together."""
    seen = {wave.record for wave in find_strain_periodic(left) if wave.p_value < SEARCH.line_or_step_level}
    return {record.name for record in left.records if None in seen or record.name in seen}
