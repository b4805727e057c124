"""Opening the truths: seals checked, late answers refused, everything scored beside baselines."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, cast

from probation._files import write_whole
from probation.answers import json_answer
from probation.blind.layout import Layout
from probation.blind.origin import now, origin
from probation.blind.seal import open_truth, read_json
from probation.blind.solve import folder_sha256
from probation.errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation.blind.scores.answer import Answer
    from probation.blind.scores.case import Case

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
        from probation.blind.scores.text import score_text  # noqa: PLC0415

        return score_text(self.content)

    def plot(self) -> Figure:
        """Gaps found and causes named over the detectability."""
        from probation.blind.scores.figures import power_figure  # noqa: PLC0415 - matplotlib is slow to load

        return power_figure(cast("dict[str, dict[str, object]]", self.content["scores"])["answers"])

    def report(self, path: str | Path) -> None:
        """Write one self-contained page."""
        from probation.blind.scores.page import write_score_page  # noqa: PLC0415 - matplotlib is slow to load

        write_score_page(self.content, path)


def score_split(
    folder: str | Path,
    *,
    truths: str | Path | None = None,
    answers: str | Path | None = None,
    beside: Mapping[str, str | Path] | None = None,
    after_opening: bool = False,
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
        Folders of other answers to the same split, by name: further baselines.
    after_opening : bool
        Score later answers, too, and say so; never for the test split.

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
    opened = {name: open_truth(layout.truths / f"{name}.json", seal) for name, seal in seals.items()}
    files, commits = _answer_files(layout, list(seals))
    late = _late(layout, files, after_opening=after_opening)
    found, failed = _answers(layout, list(seals))
    content: dict[str, object] = {
        "split": split,
        "campaigns": len(seals),
        "made": published.get("made"),
        "seeds": sorted({cast("int", truth["seed"]) for truth in opened.values()}),
        "scored": origin(),
        "answered_by": commits,
        "answers_after_opening": len(late),
        "failed": failed,
        "scores": {},
    }
    return Score(split, content | {"scores": _scores(opened, found, beside or {}, layout)})


def _scores(
    truths: dict[str, dict[str, object]], answers: dict[str, Answer], beside: Mapping[str, str | Path], layout: Layout
) -> dict[str, object]:
    from probation.blind.scores.baselines import BASELINES  # noqa: PLC0415 - scipy.stats is slow to load
    from probation.blind.scores.board import board  # noqa: PLC0415
    from probation.blind.scores.case import Case  # noqa: PLC0415

    cases: list[Case] = [Case(name, truth, answers[name]) for name, truth in truths.items()]
    boards: dict[str, object] = {"answers": board(cases)}
    boards |= {name: board(baseline(cases)) for name, baseline in BASELINES.items()}
    for name, folder in beside.items():
        if name in boards:
            raise InputError(f"beside: found the name {name!r}, expected none of {', '.join(boards)}")
        others, _ = _answers(Layout(layout.folder, answer_folder=Path(folder)), list(truths))
        boards[name] = board([Case(case.name, case.truth, others[case.name]) for case in cases])
    return boards


def _answer_files(layout: Layout, names: list[str]) -> tuple[dict[str, str], dict[str, int]]:
    """SHA-256 of every answer, and how many each version and commit gave."""
    digests: dict[str, str] = {}
    commits: Counter[str] = Counter()
    missing = [name for name in names if not (layout.answers / f"{name}.json").is_file()]
    if missing:
        more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        raise InputError(f"{layout.answers}: found no answer to {missing[0]}{more}; run probation blind solve first")
    for name in names:
        path = layout.answers / f"{name}.json"
        answer = read_json(path)
        if answer.get("campaign_sha256") != folder_sha256(layout.campaigns / name):
            raise InputError(f"{path}: found an answer to other data than {layout.campaigns / name} holds")
        by = cast("Mapping[str, str]", answer.get("answered") or {})
        commits[f"{by.get('version', '?')} {by.get('commit', '')}".strip()] += 1
        digests[name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return digests, dict(commits)


def _late(layout: Layout, digests: dict[str, str], *, after_opening: bool) -> list[str]:
    """Answers that were not there when the truths were opened first."""
    record = layout.folder / "opened.json"
    if not record.exists():
        write_whole(record, json.dumps({"at": now(), "answers": {}}, indent=1) + "\n")
    opening = read_json(record)
    known = cast("dict[str, dict[str, str]]", opening["answers"])
    place = str(layout.answers.resolve())
    if not known:
        known[place] = digests
        write_whole(record, json.dumps(opening, indent=1) + "\n")
    there = set().union(*(each.items() for each in known.values()))
    late = [name for name, digest in digests.items() if (name, digest) not in there]
    if late and not after_opening:
        raise InputError(
            f"{layout.answers}: found an answer to {late[0]} that was not there when the truths were opened "
            f"({opening['at']}); such answers are refused"
        )
    return late


def _answers(layout: Layout, names: list[str]) -> tuple[dict[str, Answer], dict[str, str]]:
    """The answers, and what failed; a failure counts as wrong in everything."""
    from probation.blind.scores.answer import NO_ANSWER, read_answer  # noqa: PLC0415

    found: dict[str, Answer] = {}
    failed: dict[str, str] = {}
    for name in names:
        path = layout.answers / f"{name}.json"
        content = read_json(path)
        diagnosis = content.get("diagnosis")
        if isinstance(diagnosis, dict):
            found[name] = read_answer(diagnosis, str(path))
        else:
            found[name] = NO_ANSWER
            failed[name] = str(content.get("error", "no diagnosis"))
    return found, failed
