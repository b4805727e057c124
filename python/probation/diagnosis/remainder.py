"""What the gap that is left depends on: a free function of one variable, judged on records left out.

docs/diagnosis-method.md, section 12.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from probation.diagnosis.free_function import Dependence, FreeFunctions, TriedTerm, terms_of
from probation.diagnosis.remainder_words import description
from probation.diagnosis.variables import phases_of, variables_of
from probation.inference.unsolvable import UNSOLVABLE
from probation.results.data import LEFT_OUT
from probation.settings.remainder import REMAINDER

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation.diagnosis.closure import Closure
    from probation.diagnosis.free_function import FreeFunction, RemainderCurve
    from probation.inference.base_fit import BaseFit
    from probation.inference.refit import Refit


@dataclass(frozen=True, eq=False)
class Remainder:
    """What the best explanation leaves, described; all of the gap where it has no known effect.

    Attributes
    ----------
    rms_MPa, noise_MPa : float
        Root mean square of what is left on the fitted records, and of the noise.
    depends_on : tuple of Dependence
        The most that explains first; empty where nothing does.
    description : str
        One sentence.
    curve : RemainderCurve or None
    functions : tuple of FreeFunction
        Of the variables of `depends_on`, fitted to all records: what tests could settle.
    what : {"what is left", "the gap"}
        The latter where nothing of it is explained.
    """

    rms_MPa: float  # noqa: N815 - as it leaves the program
    noise_MPa: float  # noqa: N815
    depends_on: tuple[Dependence, ...]
    description: str
    curve: RemainderCurve | None = None
    functions: tuple[FreeFunction, ...] = field(default=(), metadata=LEFT_OUT)
    what: str = "what is left"

    @property
    def mostly_a_function(self) -> bool:
        """Whether a function of one variable closes most of it where it was not fitted."""
        return bool(self.depends_on) and self.depends_on[0].explained > REMAINDER.mostly

    def to_dict(self) -> dict[str, Any]:
        """As in `remainder` of docs/formats.md."""
        return {
            "rms_MPa": self.rms_MPa,
            "noise_MPa": self.noise_MPa,
            "depends_on": [dependence.to_dict() for dependence in self.depends_on],
            "description": self.description,
        }


def is_left(closure: Closure) -> bool:
    """Whether more than noise is left."""
    return closure.after_MPa**2 > (1.0 + REMAINDER.least_remainder) * closure.noise_MPa**2


def remainder_of(
    base: BaseFit, found: Refit, closure: Closure, specimens: Mapping[str, str | None] | None = None
) -> Remainder:
    """Describe what an explanation leaves on the fitted records.

    Parameters
    ----------
    base : BaseFit
    found : Refit
        The explanation's; the base fit's where nothing is explained.
    closure : Closure
        Of the explanation.
    specimens : dict of str to str, optional
        Of which specimen a record is, by its id; each its own if left out.
    """
    views = found.model.views
    known = specimens or {}
    variables = variables_of(views, [known.get(view.id) or view.id for view in views])
    phases = phases_of(views)
    problem = FreeFunctions(base, found, found.parameters, phases, closure.noise_MPa)
    before = problem.before
    for _ in range(REMAINDER.linearisations):
        # The last function has moved the parameters. What the law alone closes from there is not due to a function.
        before = {kind: min(square, problem.before[kind]) for kind, square in before.items()}
        trials = sorted(
            (problem.trial(term, before) for term in terms_of(variables, problem)), key=lambda tried: -tried.rank
        )
        moved = problem.with_function(trials[0].term)
        try:
            linearised_anew = FreeFunctions(base, found, moved, phases, closure.noise_MPa)
        except UNSOLVABLE:
            break
        if not linearised_anew.has_stress:
            break
        problem = linearised_anew
    best: dict[str, TriedTerm] = {}
    for trial in trials:
        best.setdefault(trial.term.variable.name, trial)
    leading = [tried for tried in best.values() if tried.explained > REMAINDER.least_part][: REMAINDER.most_variables]
    depends_on = tuple(
        Dependence(
            variable=trial.term.variable.name,
            title=trial.term.variable.title,
            when=trial.term.when,
            acts=trial.term.acts,
            explained=min(trial.explained, 1.0),
            judged_on=trial.judged_on,
        )
        for trial in leading
    )
    curve = problem.curve(leading[0].term) if leading else None
    most = max((tried.explained for tried in trials), default=0.0)
    what = "what is left" if found.model.causes else "the gap"
    text = description(what, closure.after_MPa, closure.noise_MPa, depends_on, curve, most)
    functions = tuple(
        problem.function(trial.term, dependence, before) for trial, dependence in zip(leading, depends_on, strict=True)
    )
    return Remainder(closure.after_MPa, closure.noise_MPa, depends_on, text, curve, functions, what)
