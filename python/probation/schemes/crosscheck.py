"""Every scheme on one record: error, order, time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.answers import PARAMETER_KEYS
from probation.errors import InputError
from probation.law.schemes import BE2
from probation.progress import shows_progress
from probation.schemes.candidates import CANDIDATES, SchemeCandidate, Solve, solve
from probation.schemes.cases import Case, record_case, twin_case
from probation.schemes.result import CrossCheck, RecordCheck, SchemeCheck
from probation.schemes.steps import StepStudy, study_steps

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation.law.modal import Law
    from probation.records.record import Record

__all__ = ["CrossCheck", "RecordCheck", "SchemeCheck", "StepStudy", "crosscheck"]


@shows_progress
def crosscheck(
    records: Sequence[Record] | None = None,
    law: Law | None = None,
    *,
    progress: Callable[[int, int, str], None] | None = None,
) -> CrossCheck:
    """Run every scheme: be2 from both starts, sa2, sa3, exact, cvode, and eq. (7) on a ramp.

    Parameters
    ----------
    records : sequence of Record, optional
        If left out, the embedded synthetic data of experiments 1 and 3, each with the law it was made with.
    law : Law, optional
        To be given with `records`.
    progress : callable, optional
        Called with ``(done, total, what)``.

    Returns
    -------
    CrossCheck
        For a record, errors are against the exact scheme on the samples as they stand; for the smooth synthetic record
        of experiment 3, against the exact scheme on a much finer grid.

    Raises
    ------
    InputError
        If only one of `records` and `law` is given.
    """
    if (records is None) != (law is None):
        raise InputError("records and law: found one without the other, expected both or neither")
    if records is None or law is None:
        cases = [twin_case(1), twin_case(3)]
        used = "that of each embedded synthetic record"
    else:
        cases = [record_case(record, law, with_steps=at == 0) for at, record in enumerate(records)]
        parameters = zip(law.parameter_names, law.parameters, strict=True)
        used = ", ".join(f"{PARAMETER_KEYS[name]} {value:.6g}" for name, value in parameters)
        used += "" if law.companion is None else f", companion relation {law.companion.form}"
    checks = []
    for at, case in enumerate(cases):

        def advance(what: str, at: int = at) -> None:
            if progress is not None:
                progress(at, len(cases), what)

        checks.append(_check(case, advance))
    return CrossCheck(tuple(checks), used)


def _check(case: Case, advance: Callable[[str], None]) -> RecordCheck:
    steps = None if case.smooth is None else study_steps(case.law, case.smooth, case.smooth_name, advance)
    schemes = []
    for candidate in CANDIDATES:
        advance(f"{case.name} by {candidate.name}")
        done = solve(candidate, case.law, case.path)
        if done is not None:
            schemes.append(_scheme_check(case, candidate, done, steps))
    return RecordCheck(case.name, len(case.reference), case.reference_name, tuple(schemes), steps, case.data_sha256)


def _scheme_check(case: Case, candidate: SchemeCandidate, done: Solve, steps: StepStudy | None) -> SchemeCheck:
    error = np.full(1, np.nan) if done.true_stress is None else done.true_stress - case.reference
    return SchemeCheck(
        name=candidate.name,
        scheme=None if candidate.scheme is None else candidate.scheme.name,
        start=candidate.scheme.start if isinstance(candidate.scheme, BE2) else None,
        largest_error_MPa=float(np.abs(error).max()),
        rms_error_MPa=float(np.sqrt(np.mean(error**2))),
        order=np.nan if steps is None else steps.order.get(candidate.name, np.nan),
        time_us=done.time_us,
        statistics=done.statistics,
        failure=done.failure,
    )
