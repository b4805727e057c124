"""The paper made again: every exhibit, its numbers beside ours, one page."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from probation._files import make_folder, write_whole
from probation.answers import json_answer
from probation.errors import InputError
from probation.provenance import samples_sha256
from probation.report.figures import save_figure
from probation.report.table import Table
from probation_studies.paper.exhibit import Settings
from probation_studies.paper.exhibits import named_exhibits
from probation_studies.paper.grip_tests import twin

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from os import PathLike

    from matplotlib.figure import Figure

    from probation_studies.paper.exhibit import Comparison, Exhibit, Verdict


@dataclass(frozen=True, eq=False)
class Reproduction:
    """The exhibits that were made again.

    Attributes
    ----------
    exhibits : dict of str to Exhibit
        By name, in the order of the page.
    settings : Settings
    """

    exhibits: dict[str, Exhibit]
    settings: Settings

    @property
    def comparisons(self) -> tuple[Comparison, ...]:
        """Every number of the paper beside ours."""
        return tuple(each for exhibit in self.exhibits.values() for each in exhibit.comparisons)

    def count(self, verdict: Verdict) -> int:
        """How many numbers have that verdict."""
        return sum(comparison.verdict == verdict for comparison in self.comparisons)

    @property
    def unexplained(self) -> tuple[Comparison, ...]:
        """Numbers that differ and nobody knows why."""
        return tuple(
            comparison for comparison in self.comparisons if comparison.verdict == "differs" and not comparison.because
        )

    @property
    def verdict(self) -> str:
        """One sentence."""
        reproduced, recovered, differ = (self.count(each) for each in ("reproduced", "recovered", "differs"))
        if not self.comparisons:
            return "No number of the paper is compared here."
        sentence = f"Of {len(self.comparisons)} numbers of the paper {reproduced} {_are(reproduced)} reproduced"
        if recovered:
            sentence += f" and {recovered}, which the synthetic data were made with, {_are(recovered)} recovered"
        if differ:
            left = len(self.unexplained)
            sentence += f"; {differ} {'differs' if differ == 1 else 'differ'}, "
            sentence += f"{left} of them unexplained" if left else "each explained"
        return sentence + "."

    def overview(self) -> Table:
        """How the numbers of each exhibit came out."""
        rows = tuple(
            (
                exhibit.title,
                name,
                *(str(exhibit.count(verdict) or "–") for verdict in ("reproduced", "recovered", "differs")),
            )
            for name, exhibit in self.exhibits.items()
        )
        return Table(("table or figure", "--only", "reproduced", "put in, recovered", "differ"), rows, left=2)

    def summary(self) -> str:
        """Verdict first, then where, then every number and why it differs."""
        parts = [self.verdict, "", self.overview().text()]
        for exhibit in self.exhibits.values():
            if exhibit.comparisons:
                parts += ["", exhibit.title, exhibit.comparison_table().text()]
                parts += [f"  {reason}" for reason in exhibit.reasons()]
            else:
                parts += ["", exhibit.title]
                for part in exhibit.parts:
                    if isinstance(part, Table):
                        parts.append(part.text())
                    elif isinstance(part, str):
                        parts.append(f"  {part}")
        return "\n".join(parts)

    def plot(self) -> Figure:
        """The first figure.

        Raises
        ------
        InputError
            If these exhibits have none.
        """
        for exhibit in self.exhibits.values():
            for drawing in exhibit.drawings:
                return drawing.figure
        raise InputError(f"plot: found no figure in {', '.join(self.exhibits)}, expected an exhibit with one")

    def to_json(self) -> str:
        """The answer, schema "probation.paper/1"."""
        return json_answer(
            "probation.paper/1",
            {
                "verdict": self.verdict,
                "reproduced": self.count("reproduced"),
                "recovered": self.count("recovered"),
                "differ": self.count("differs"),
                "unexplained": len(self.unexplained),
                "seed": self.settings.seed,
                "draws": self.settings.draws,
                "data_sha256": self.data_sha256,
                "exhibits": {name: exhibit.to_json() for name, exhibit in self.exhibits.items()},
            },
        )

    def report(self, path: str | PathLike[str]) -> Path:
        """Write one self-contained HTML page and return its path."""
        from probation_studies.paper.page import paper_page  # noqa: PLC0415 - templates only when asked for

        page = paper_page(
            self.verdict,
            self.overview(),
            self.exhibits.values(),
            good=not self.unexplained,
            data_sha256=self.data_sha256,
            seed=self.settings.seed,
        )
        page.write(Path(path))
        return Path(path)

    def save_figures(self, folder: str | PathLike[str]) -> tuple[Path, ...]:
        """Save every figure as PNG into `folder`, which is made if need be, and this answer as paper.json."""
        root = make_folder(folder)
        written = []
        for exhibit in self.exhibits.values():
            for drawing in exhibit.drawings:
                written.append(root / f"{drawing.stem}.png")
                save_figure(drawing.figure, written[-1])
        write_whole(root / "paper.json", self.to_json())
        return (*written, root / "paper.json")

    @property
    def data_sha256(self) -> str:
        """Of the three synthetic records."""
        twins = [twin(number, self.settings.seed) for number in (1, 2, 3)]
        return samples_sha256(
            *(samples for each in twins for samples in (each.time, each.true_strain, each.true_stress))
        )


def reproduce(
    only: Sequence[str] = (),
    *,
    seed: int = 0,
    draws: int = 100,
    progress: Callable[[int, int, str], None] | None = None,
) -> Reproduction:
    """Make the paper's tables and figures again from the embedded synthetic data.

    Parameters
    ----------
    only : sequence of str
        Names of `exhibits.EXHIBITS`; all if empty.
    seed : int
        Of the synthetic noise and of every draw.
    draws : int
        How many draws make a distribution.
    progress : callable, optional
        Called with ``(done, total, name)``.

    Returns
    -------
    Reproduction

    Raises
    ------
    InputError
        For an unknown name.
    """
    settings = Settings(seed, draws)
    entries = named_exhibits(only)
    made = {}
    for at, entry in enumerate(entries):
        if progress is not None:
            progress(at, len(entries), entry.name)
        made[entry.name] = entry.make(settings)
    return Reproduction(made, settings)


def _are(count: int) -> str:
    return "is" if count == 1 else "are"
