"""Opening the truths: seals checked, late answers refused, everything scored beside baselines."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, cast

from probation.answers import json_answer
from probation.errors import InputError
from probation.origin import origin
from probation.pool import Progress
from probation_studies.blind.laboratory_named import OWN
from probation_studies.blind.layout import Layout
from probation_studies.blind.opening import handed_in, record_opening
from probation_studies.blind.release import shortfall
from probation_studies.blind.scores.aims import aims
from probation_studies.blind.seal import open_truth, read_object

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation_studies.blind.scores.answer import Answer
    from probation_studies.blind.scores.case import Case

SCORE_SCHEMA = "probation.blind.score/1"


@dataclass(frozen=True)
class Score:
    """Scores of the answers to a split.

    Attributes
    ----------
    split : str
    content : dict
        Everything, as JSON has it.
    """

    split: str
    content: dict[str, object]

    def to_json(self) -> str:
        """As JSON text."""
        return json_answer(SCORE_SCHEMA, self.content)

    def summary(self) -> str:
        """The main scores as text."""
        from probation_studies.blind.scores.text import score_text  # noqa: PLC0415

        return score_text(self.content)

    def plot(self) -> Figure:
        """Gaps found and causes named over the detectability."""
        from probation_studies.blind.scores.figures import power_figure  # noqa: PLC0415 - matplotlib is slow to load

        return power_figure(cast("dict[str, dict[str, object]]", self.content["scores"])["answers"])

    def report(self, path: str | Path) -> None:
        """Write one self-contained page."""
        from probation_studies.blind.scores.page import write_score_page  # noqa: PLC0415 - matplotlib is slow to load

        write_score_page(self.content, path)


def score_split(
    folder: str | Path,
    *,
    truths: str | Path | None = None,
    answers: str | Path | None = None,
    beside: Mapping[str, str | Path] | None = None,
    after_opening: bool = False,
    progress: Progress | None = None,
) -> Score:
    """Open the truths of a split and score its answers.

    The first call records which answers there are; whatever is answered later has seen the truth, or may have.

    Parameters
    ----------
    folder : path
        As `make_split` left it.
    truths, answers : path, optional
        Where they are, if not in `folder`.
    beside : mapping, optional
        Folders of other answers to the same split, by name: further baselines. Those in baselines/ are found alone.
        All are held to the same checks.
    after_opening : bool
        Score later answers, too, and say so; never for the test split.
    progress : callable, optional
        Called with how many boards of scores are done, how many there are, and what is being done.

    Raises
    ------
    InputError
        If a seal is broken, an answer is missing, was made after the opening or to other data, or is none.
    """
    layout = Layout(Path(folder), *(None if each is None else Path(each) for each in (truths, answers)))
    published, seals = layout.published()
    split = str(published["split"])
    if after_opening and split == "test":
        raise InputError("after_opening: found the test split, expected develop or calibrate; it is scored once")
    places = {name: Layout(layout.folder, answer_folder=Path(each)) for name, each in (beside or {}).items()}
    places |= {name: layout.baseline(name) for name in layout.baselines if name not in places}
    names = list(seals)
    handed = [handed_in(each, names) for each in (layout, *places.values())]
    late = record_opening(layout, handed, after_opening=after_opening)
    advance = progress or (lambda *said: None)
    advance(0, 1, "opening the truths")
    opened = {name: open_truth(layout.truths / f"{name}.json", seal) for name, seal in seals.items()}
    found, failed = _answers(layout, names)
    content: dict[str, object] = {
        "split": split,
        "laboratory": published.get("laboratory", OWN),
        "campaigns": len(seals),
        "made": published.get("made"),
        "seeds": sorted({cast("int", truth["seed"]) for truth in opened.values()}),
        "scored": origin(),
        "answered_by": handed[0].commits,
        "answers_after_opening": late,
        "failed": failed,
    }
    scores = _scores(opened, found, places, advance)
    if split == "test":
        nulls = sum(truth["stratum"] == "none" for truth in opened.values())
        content["too_small"] = shortfall(len(seals), nulls)
    return Score(split, content | {"aims": aims(scores["answers"]), "scores": scores})


def _scores(
    truths: dict[str, dict[str, object]],
    answers: dict[str, Answer],
    places: Mapping[str, Layout],
    advance: Progress,
) -> dict[str, dict[str, object]]:
    from probation_studies.blind.scores.baselines import BASELINES  # noqa: PLC0415 - scipy.stats is slow to load
    from probation_studies.blind.scores.board import board  # noqa: PLC0415
    from probation_studies.blind.scores.case import Case  # noqa: PLC0415

    cases: list[Case] = [Case(name, truth, answers[name]) for name, truth in truths.items()]
    total, boards = 1 + len(BASELINES) + len(places), {}
    advance(0, total, "the answers")
    boards["answers"] = board(cases)
    for name, baseline in BASELINES.items():
        advance(len(boards), total, f"the baseline {name}")
        boards[name] = board(baseline(cases))
    for name, place in places.items():
        advance(len(boards), total, name)
        if name in boards:
            raise InputError(f"beside: found the name {name!r}, expected none of {', '.join(boards)}")
        others, _ = _answers(place, list(truths))
        boards[name] = board([Case(case.name, case.truth, others[case.name]) for case in cases])
    return boards


def _answers(layout: Layout, names: list[str]) -> tuple[dict[str, Answer], dict[str, str]]:
    """The answers, and what failed; a failure counts as wrong in everything."""
    from probation_studies.blind.scores.answer import NO_ANSWER, read_answer  # noqa: PLC0415

    found: dict[str, Answer] = {}
    failed: dict[str, str] = {}
    for name in names:
        path = layout.answers / f"{name}.json"
        content = read_object(path)
        diagnosis = content.get("diagnosis")
        if isinstance(diagnosis, dict):
            found[name] = read_answer(diagnosis, str(path))
        else:
            found[name] = NO_ANSWER
            failed[name] = str(content.get("error", "no diagnosis"))
    return found, failed
