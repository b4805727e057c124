"""What is aimed at, and what was reached."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from collections.abc import Mapping

    Plain = Mapping[str, object]

LEAST = 20
"""Cases below which a split is too small to say."""


@dataclass(frozen=True)
class Aim:
    """One aim.

    Attributes
    ----------
    name : str
    n : int
        Cases that tell.
    value : float or None
        What was reached.
    interval : tuple of float, or None
        Of 95 %.
    low, high : float or None
        What is aimed at.
    percent : bool
        Whether these are parts of a whole.
    by_bound : bool
        Whether the interval's lower end is to reach the aim, not the value itself.
    """

    name: str
    n: int
    value: float | None
    interval: tuple[float, float] | None
    low: float | None = None
    high: float | None = None
    percent: bool = True
    by_bound: bool = False

    @property
    def met(self) -> bool | None:
        """Whether it is reached; None where there are too few to say."""
        tested = self.value if not self.by_bound or self.interval is None else self.interval[0]
        return None if tested is None or self.n < LEAST else self._within(tested)

    @property
    def certain(self) -> bool:
        """Whether the whole interval says so; where there is none, the aim allows for chance itself."""
        if self.met is None or self.interval is None:
            return self.met is not None
        if self.met:
            return self.by_bound or all(self._within(end) for end in self.interval)
        low, high = self.interval
        return (self.low is not None and high < self.low) or (self.high is not None and low > self.high)

    @property
    def verdict(self) -> str:
        """In words."""
        if self.met is None:
            return f"too few ({self.n})"
        return ("yes" if self.met else "no") + ("" if self.certain else ", not certain")

    def plain(self) -> dict[str, object]:
        """As JSON has it."""
        return {
            "aim": self.name,
            "at_least": self.low,
            "at_most": self.high,
            "wanted": self._wanted(),
            "reached": self._reached(),
            "n": self.n,
            "value": self.value,
            "interval95": None if self.interval is None else list(self.interval),
            "met": self.met,
            "certain": self.certain,
            "verdict": self.verdict,
        }

    def _within(self, value: float) -> bool:
        return (self.low is None or value >= self.low) and (self.high is None or value <= self.high)

    def _wanted(self) -> str:
        if self.low is not None and self.high is not None:
            return self._text(self.low, self.high)
        if self.low is not None:
            return f"{'lower bound' if self.by_bound else 'at least'} {self._text(self.low)}"
        return "–" if self.high is None else f"at most {self._text(self.high)}"

    def _reached(self) -> str:
        if self.value is None:
            return "nothing to score"
        return self._text(self.value) + ("" if self.interval is None else f" ({self._text(*self.interval)})")

    def _text(self, *values: float) -> str:
        numbers = "\u00a0to\u00a0".join(f"{100.0 * value:.1f}" if self.percent else f"{value:.3f}" for value in values)
        return numbers.replace("-", "−") + ("\u00a0%" if self.percent else "")


def aims(board: Plain) -> list[dict[str, object]]:
    """Every aim beside what a board of scores says of it."""
    return [each.plain() for each in _aims(board)]


def _aims(board: Plain) -> list[Aim]:
    resolvable, gaps = _part(board, "resolvable"), _part(board, "gaps")
    nulls = _part(_part(board, "by_stratum"), "none")
    detection, where, unknown = (_part(board, name) for name in ("detection", "where", "unknown"))
    held_out = _part(_part(board, "closure"), "held_out")
    over, overlap = _part(held_out, "over_oracle"), {"n": _part(where, "overlap_of_0.6")["n"]}
    return [
        _rate("false alarms on nulls", _part(board, "false_alarms"), high=0.01),
        _rate("gaps found at √λ about 5", _part(detection, "5"), low=0.90),
        _rate("gaps found at √λ about 8", _part(detection, "8"), low=0.99),
        _rate("resolvable causes named", _part(resolvable, "top1"), low=0.95),
        _beside_oracle(resolvable),
        _average("probability on the truth, resolvable", resolvable, "probability_on_truth", 0.85),
        *(
            _rate(
                f"answer set holds the truth, {name}", _part(_part(group, "answer_set"), "coverage"), 0.88, bound=True
            )
            for name, group in (("nulls", nulls), ("gaps", gaps))
        ),
        *(
            _size(f"answer set's size over the oracle's, {name}", each)
            for name, each in (("nulls", nulls), ("gaps", gaps))
        ),
        _calibration(board),
        _rate("unknown found, √λ of 8 or more outside", _part(unknown, "found_clear"), low=0.90),
        _rate("pairs named exactly, resolvable", _part(board, "exact_pairs"), low=0.80),
        _average("overlap in time with localised faults", {**where, **overlap}, "mean_overlap", 0.60),
        _rate("record of a fault named", _part(where, "right_record"), low=0.98),
        _average("held-out closure over the oracle's, median", over, "value", 0.95, interval="interval95"),
        _rate("held-out closure within its 90 % interval", _part(held_out, "interval_holds"), 0.87, 0.93),
    ]


def _rate(name: str, plain: Plain, low: float | None = None, high: float | None = None, *, bound: bool = False) -> Aim:
    n = cast("int", plain["n"])
    ends = _ends(plain["interval95"]) if n else None
    return Aim(name, n, cast("float | None", plain["rate"]), ends, low, high, by_bound=bound)


def _average(name: str, plain: Plain, key: str, low: float, interval: str | None = None) -> Aim:
    """An average that is told beside its n and, as `interval`, its interval: KEY_interval95 if left out."""
    ends = _ends(plain[interval or f"{key}_interval95"])
    return Aim(name, cast("int", plain["n"]), cast("float | None", plain[key]), ends, low=low, percent=False)


def _beside_oracle(group: Plain) -> Aim:
    """How much more often than the oracle expects; the oracle's own expectation is known well beside it."""
    top, expected = _part(group, "top1"), cast("float | None", group["oracle_expected"])
    name, rate = "resolvable named, less the oracle's rate", cast("float | None", top["rate"])
    if rate is None or expected is None:
        return Aim(name, 0, None, None, low=-0.03)
    low, high = cast("list[float]", top["interval95"])
    return Aim(name, cast("int", top["n"]), rate - expected, (low - expected, high - expected), low=-0.03)


def _size(name: str, group: Plain) -> Aim:
    over = _part(_part(group, "answer_set"), "over_oracle")
    ends = _ends(over["interval95"])
    return Aim(name, cast("int", over["n"]), cast("float | None", over["value"]), ends, high=1.5, percent=False)


def _calibration(board: Plain) -> Aim:
    curve = _part(board, "reliability")
    count = sum(cast("int", _part(each, "right")["n"]) for each in cast("list[Plain]", curve["bins"]))
    error, limit = (cast("float | None", curve[each]) for each in ("ece", "ece_limit95"))
    return Aim("expected calibration error", count, error, None, high=limit, percent=False)


def _part(whole: Plain, name: str) -> Plain:
    return cast("Plain", whole[name])


def _ends(plain: object) -> tuple[float, float] | None:
    return None if plain is None else cast("tuple[float, float]", tuple(cast("list[float]", plain)))
