"""One table or figure of the paper made again: what the paper says, what we find, number beside number."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from probation.report.table import Table
from probation.wording import plus_minus

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

Verdict = Literal["reproduced", "recovered", "differs"]
Relation = Literal["=", "≤"]

TOLERANCE = 0.02
"""How near counts as reproduced: 2 %, the error that the paper gives its own parameters (section 5.3)."""


@dataclass(frozen=True)
class Settings:
    """What every exhibit is made with.

    Attributes
    ----------
    seed : int
        Of the synthetic noise and of every draw.
    draws : int
        How many draws of noise, or of a bias, make a distribution.
    """

    seed: int = 0
    draws: int = 100


@dataclass(frozen=True)
class Comparison:
    """A number of the paper beside ours; make it with `compare`.

    Attributes
    ----------
    quantity : str
    unit : str
    paper, ours : float
    relation : {"=", "≤"}
        What the paper says: that number, or at most that.
    spread : float or None
        Standard error, or scatter over draws, of ours.
    verdict : {"reproduced", "recovered", "differs"}
        "recovered": the synthetic record was made with this number: finding it again shows that the method works, not
        that the paper is right.
    because : str
        Why it differs; empty where it does not, or where nobody knows.
    """

    quantity: str
    unit: str
    paper: float
    ours: float
    relation: Relation
    spread: float | None
    verdict: Verdict
    because: str

    @property
    def difference(self) -> float:
        """Ours over the paper's, less one [-]."""
        return self.ours / self.paper - 1.0

    def to_json(self) -> dict[str, object]:
        """As it leaves the program."""
        return {
            "quantity": self.quantity,
            "unit": self.unit,
            "paper": self.paper,
            "relation": self.relation,
            "ours": self.ours,
            "spread": self.spread,
            "difference_percent": 100.0 * self.difference,
            "verdict": self.verdict,
            "because": self.because,
        }


def compare(
    quantity: str,
    paper: float,
    ours: float,
    *,
    unit: str = "",
    spread: float | None = None,
    relation: Relation = "=",
    tolerance: float = TOLERANCE,
    put_in: bool = False,
    because: str = "",
) -> Comparison:
    """Set a number of the paper beside ours.

    Parameters
    ----------
    quantity : str
    paper, ours : float
    unit : str
    spread : float, optional
        Standard error or scatter of ours.
    relation : {"=", "≤"}
    tolerance : float [-]
        Relative.
    put_in : bool
        Whether the synthetic record was made with that number.
    because : str
        Why it differs, if it does.
    """
    near = ours <= paper * (1.0 + tolerance) if relation == "≤" else abs(ours - paper) <= tolerance * abs(paper)
    verdict: Verdict = "differs" if not near else "recovered" if put_in else "reproduced"
    kept = because if verdict == "differs" else ""
    return Comparison(quantity, unit, paper, float(ours), relation, spread, verdict, kept)


@dataclass(frozen=True, eq=False)
class Drawing:
    """A figure of an exhibit.

    Attributes
    ----------
    stem : str
        Of its file, unique among all exhibits.
    figure : Figure
    caption : str
        Unique among all exhibits.
    """

    stem: str
    figure: Figure
    caption: str


@dataclass(frozen=True, eq=False)
class Exhibit:
    """A table or figure of the paper made again.

    Attributes
    ----------
    title : str
        "Table 3: …".
    says : str
        What the paper shows there.
    explanation : str
        One paragraph: what we find, and why it is so.
    comparisons : tuple of Comparison
    parts : tuple of Table, Drawing or str
        Shown in this order, after the comparisons.
    answer : mapping
        Further numbers for JSON.
    """

    title: str
    says: str
    explanation: str
    comparisons: tuple[Comparison, ...] = ()
    parts: tuple[Table | Drawing | str, ...] = ()
    answer: Mapping[str, object] = field(default_factory=dict)

    @property
    def drawings(self) -> tuple[Drawing, ...]:
        """The figures among the parts."""
        return tuple(part for part in self.parts if isinstance(part, Drawing))

    def count(self, verdict: Verdict) -> int:
        """How many comparisons have that verdict."""
        return sum(comparison.verdict == verdict for comparison in self.comparisons)

    def comparison_table(self) -> Table:
        """The paper's numbers beside ours."""
        rows = tuple(
            (
                comparison.quantity,
                comparison.verdict,
                ("≤ " if comparison.relation == "≤" else "") + number(comparison.paper),
                number(comparison.ours)
                if comparison.spread is None
                else plus_minus(comparison.ours, comparison.spread),
                comparison.unit or "–",
                "within"
                if comparison.relation == "≤" and comparison.difference <= 0.0
                else f"{100.0 * comparison.difference + 0.0:+.1f} %".replace("-0.0", "+0.0"),
            )
            for comparison in self.comparisons
        )
        return Table(("number", "verdict", "paper", "ours", "unit", "difference"), rows, left=2)

    def reasons(self) -> tuple[str, ...]:
        """Why numbers differ, one sentence per reason with the numbers that it explains."""
        explained: dict[str, list[str]] = {}
        for comparison in self.comparisons:
            if comparison.verdict == "differs":
                explained.setdefault(comparison.because, []).append(comparison.quantity)
        return tuple(
            f"{'; '.join(quantities)} {'differs' if len(quantities) == 1 else 'differ'}"
            + (f": because {because}." if because else ", and we do not know why.")
            for because, quantities in explained.items()
        )

    def to_json(self) -> dict[str, object]:
        """As it leaves the program."""
        return {
            "title": self.title,
            "says": self.says,
            "explanation": self.explanation,
            "comparisons": [comparison.to_json() for comparison in self.comparisons],
            **self.answer,
        }


def number(value: float) -> str:
    """A number for a table: four digits, no exponent below a million."""
    if value != 0.0 and not 1e-3 <= abs(value) < 1e6:
        return f"{value:.3g}"
    return f"{float(f'{value:.4g}'):g}" if abs(value) < 1e4 else f"{value:.0f}"
