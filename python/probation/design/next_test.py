"""The test to do next: of those a laboratory can do, the one that best discriminates the remaining explanations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.design.planned_tests import Laboratory, planned_tests
from probation.design.predicted import RivalExplanation, RivalPrediction, Weighing, outcome, predictions
from probation.errors import InputError
from probation.inference.unsolvable import UNSOLVABLE
from probation.parallel import in_parallel
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation._arrays import FloatArray
    from probation.design.planned_tests import ProposedTest
    from probation.inference.model import CampaignModel
    from probation.noise.model import NoiseModel


@dataclass(frozen=True, eq=False)
class RankedTest:
    """A planned test and what to expect of it.

    Attributes
    ----------
    probability_after : float
        Of a right answer.
    probability_in_rough_hands : float
        The same at three times the noise: room for what no noise model knows, such as other specimens.
    information : float
        Expected gain on which explanation it is [bit].
    what : str
        One sentence.
    separates : list of list of str
        As in `Recommendation`.
    """

    test: ProposedTest
    probability_after: float
    probability_in_rough_hands: float
    information: float
    what: str
    separates: list[list[str]]

    @property
    def worth(self) -> float:
        """Probability of a right answer, the mean of both, less what the effort costs."""
        both = 0.5 * (self.probability_after + self.probability_in_rough_hands)
        return both - DESIGN.help_per_half_hour * self.test.effort / 1800.0

    def to_dict(self) -> dict[str, object]:
        """For JSON."""
        return {
            **self.test.to_dict(),
            "effort_s": self.test.effort,
            "probability_after": self.probability_after,
            "probability_in_rough_hands": self.probability_in_rough_hands,
            "information_bit": self.information,
        }


@dataclass(frozen=True, eq=False)
class Recommendation:
    """What to do next.

    Attributes
    ----------
    what : str
        One sentence.
    separates : list of list of str
        Effects of the explanations that it discriminates from another one; if it does so of none surely, of the two
        that it discriminates best.
    probability_before, probability_after : float
        Of the most probable explanation being the right one, given that one of them is.
    ranking : tuple of RankedTest
        All tests, the one of most worth first.
    """

    what: str
    separates: list[list[str]]
    probability_before: float
    probability_after: float
    test: ProposedTest
    ranking: tuple[RankedTest, ...]

    def to_dict(self) -> dict[str, object]:
        """For JSON."""
        return {
            "what": self.what,
            "separates": self.separates,
            "probability_before": self.probability_before,
            "probability_after": self.probability_after,
            "test": self.test.to_dict(),
            "ranking": [explanation.to_dict() for explanation in self.ranking],
        }


def next_test(
    model: CampaignModel,
    explanations: Sequence[tuple[CampaignModel, FloatArray, float, tuple[str, ...]]],
    *,
    noises: Sequence[NoiseModel],
    weighing: Weighing | None = None,
    threads: int = 1,
    seed: int = 0,
    progress: Callable[[float], None] | None = None,
) -> Recommendation | None:
    """The realisable test after which the right explanation is most probably the most probable one, for its effort.

    Every test of `PLANNERS` is predicted by every explanation, with what the records there are leave open of its
    parameters: a rival may refit all of them, base and effects, to old and new records together (linearised). The noise
    is that of the records there are. A fault of single records comes back in half of the cases.

    Parameters
    ----------
    model : CampaignModel
        The law without causes, on the records there are.
    explanations : sequence of (CampaignModel, ndarray, float, tuple of str)
        Those still in the answer set: the model with its causes on the same records, parameters at their optimum,
        probability, names of the effects. Explanations with the same effects count as one answer: give every form that
        describes the records, or a test may be chosen that discriminates a form from the rest rather than the effect.
    noises : sequence of NoiseModel
        One per record.
    weighing : Weighing, optional
        How far evidence counts; all of it, if left out.
    threads : int
        Tests are worked out in parallel.
    progress : callable, optional
        Called with the fraction done, 0 to 1.

    Returns
    -------
    Recommendation or None
        None where there are fewer than two answers.

    Raises
    ------
    InputError
        For another number of noises than records, probabilities that are not positive, or records without strain.
    """
    if len(noises) != len(model.views):
        raise InputError(f"noises: found {len(noises)}, expected one for each of {len(model.views)} records")
    answers = list(dict.fromkeys(tuple(sorted(effects)) for _, _, _, effects in explanations))
    if len(answers) < 2:
        return None
    prior = np.array([probability for _, _, probability, _ in explanations])
    if not (np.isfinite(prior).all() and np.all(prior > 0.0)):
        raise InputError(f"explanations: found the probabilities {prior.tolist()}, expected positive numbers")
    prior = prior / prior.sum()
    group = [answers.index(tuple(sorted(effects))) for _, _, _, effects in explanations]
    known = [RivalExplanation.of(*explanation, noises) for explanation in explanations]
    base = known[int(np.argmax(prior))].parameters[: model.base_count]

    titles = {
        cause.effect.name: cause.effect.title
        for explanation_model, *_ in explanations
        for cause in explanation_model.causes
    }
    names = [" with ".join(titles.get(name, name) for name in effects) or "no effect" for effects in answers]
    before = max(float(prior[[g == answer for g in group]].sum()) for answer in range(len(answers)))

    def work(test: ProposedTest) -> RankedTest | None:
        try:
            ways = predictions(test, model, base, known, noises)
        except UNSOLVABLE:
            return None
        return judged(
            test, ways, prior, group, [list(answer) for answer in answers], names, before, seed=seed, weighing=weighing
        )

    tests = planned_tests(Laboratory.of(model, base))
    worked = [judged_test for judged_test in in_parallel(work, tests, threads, progress) if judged_test is not None]
    if not worked:
        return None
    worked.sort(key=lambda judged_test: -judged_test.worth)
    chosen = worked[0]
    return Recommendation(chosen.what, chosen.separates, before, chosen.probability_after, chosen.test, tuple(worked))


def judged(
    test: ProposedTest,
    ways: Sequence[RivalPrediction],
    prior: FloatArray,
    group: Sequence[int],
    answers: Sequence[list[str]],
    names: Sequence[str],
    before: float,
    *,
    seed: int,
    weighing: Weighing | None = None,
) -> RankedTest:
    """What to expect of a test.

    Parameters
    ----------
    ways : sequence of RivalPrediction
        How it may come out.
    prior, group
        As in `outcome`.
    answers, names : sequence
        What each group stands for, as it leaves the program and for people.
    before : float
        Probability of a right answer without the test.
    weighing : Weighing, optional
        As in `outcome`.
    """
    expected, rough = (
        outcome(each, prior, group, draws=DESIGN.draws, seed=seed, weighing=weighing)
        for each in (ways, [way.through(DESIGN.rough_noise) for way in ways])
    )
    separated, surely = _separated(expected.pairwise)
    return RankedTest(
        test=test,
        probability_after=expected.probability,
        probability_in_rough_hands=rough.probability,
        information=expected.information,
        what=_sentence(test.what, expected.probability, [names[at] for at in separated], surely, before),
        separates=[answers[at] for at in separated],
    )


def helps(after: float, before: float) -> bool:
    """Whether a test makes the right answer so much more probable that it is worth doing."""
    return after >= before + DESIGN.least_help


def _separated(pairwise: FloatArray) -> tuple[list[int], bool]:
    """Explanations that are surely discriminated, and True; or else the two discriminated best, and False."""
    both = np.minimum(pairwise, pairwise.T)
    np.fill_diagonal(both, -1.0)
    surely = np.flatnonzero((both >= DESIGN.separated).any(axis=1)).tolist()
    best = sorted(int(at) for at in np.unravel_index(int(np.argmax(both)), both.shape))
    return (surely, True) if surely else (best, False)


def _sentence(what: str, after: float, names: Sequence[str], surely: bool, before: float) -> str:
    named = f"{', '.join(names[:-1])} and {names[-1]}"
    if not helps(after, before):
        best = f"{what[0].lower()}{what[1:]}"
        return f"None of the tests considered helps to discriminate between {named}; the best of them: {best}."
    does = f"it discriminates between {named}" if surely else f"it helps most between {named}"
    return f"{what}: {does}; the answer is then right with {_percent(after)}, now with {_percent(before)}."


def _percent(probability: float) -> str:
    """Never 100 % of what is only probable."""
    return "more than 99 %" if probability > 0.99 else f"{100.0 * probability:.0f} %"
