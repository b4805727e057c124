"""What is one line of the result?"""

from collections.abc import Callable
from dataclasses import dataclass, field

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Row:
    """One method on one problem. `ratios` holds "times as long as ..." under the names of the others."""

    section: str
    case: str
    method: str
    label: str
    median: float  # [s] of processor time, as `best`
    best: float
    spread: float  # quartile distance / median
    error: float | None = None  # largest, [MPa]
    ratios: dict[str, float] = field(default_factory=dict)
    note: str = ""


@dataclass
class Findings:
    """Everything a run found: rows, and plain lines about what was skipped and why."""

    rows: list[Row] = field(default_factory=list)
    skipped: list[str] = field(default_factory=list)
    identified: dict[str, list[float]] = field(default_factory=dict)
    instructions: dict[str, float] = field(default_factory=dict)  # per mode and step

    def find(self, section: str, method: str, case: str | None = None) -> Row | None:
        for row in self.rows:
            if row.section == section and row.method == method and case in (None, row.case):
                return row
        return None

    def ratio(self, section: str, slow: str, fast: str, case: str | None = None) -> float | None:
        """How many times as long `slow` takes as `fast`; None if either was not run."""
        row = self.find(section, slow, case)
        return row.ratios.get(fast) if row else None
