"""Figures that a score must reach: a check that fails where the diagnosis has become worse."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from probation.errors import InputError
from probation_studies.blind.seal import read_object

_BOUNDS = ("at_least", "at_most")


@dataclass(frozen=True)
class Threshold:
    """Bounds of one figure of a score.

    Attributes
    ----------
    path : str
        Names from the outside in, with dots between: "scores.answers.false_alarms.rate".
    at_least, at_most : float or None
    """

    path: str
    at_least: float | None
    at_most: float | None

    def failure(self, content: Mapping[str, object]) -> str | None:
        """What is wrong with the figure, in one line; None if nothing is.

        Raises
        ------
        InputError
            If a score has no such figure.
        """
        found: object = content
        for name in self.path.split("."):
            if not isinstance(found, Mapping) or name not in found:
                names = ", ".join(map(str, found)) if isinstance(found, Mapping) else repr(found)
                raise InputError(f"{self.path}: found no {name!r} in the score, expected one of {names}")
            found = found[name]
        wanted = " and ".join(
            f"{name.replace('_', ' ')} {bound:g}"
            for name, bound in zip(_BOUNDS, (self.at_least, self.at_most), strict=True)
            if bound is not None
        )
        if found is None:
            return f"{self.path}: found nothing to score, required {wanted}"
        if isinstance(found, bool) or not isinstance(found, int | float):
            raise InputError(f"{self.path}: found {type(found).__name__} in the score, expected a number")
        low = self.at_least is not None and found < self.at_least
        high = self.at_most is not None and found > self.at_most
        return f"{self.path}: found {found:.4g}, required {wanted}" if low or high else None


def read_thresholds(path: str | Path) -> tuple[Threshold, ...]:
    """Read a file such as ``{"require": {"scores.answers.false_alarms.rate": {"at_most": 0.05}}}``.

    Beside "require" it may hold text that says how the thresholds were chosen.

    Raises
    ------
    InputError
        If it cannot be read, or holds something else.
    """
    require = read_object(Path(path)).get("require")
    if not isinstance(require, dict) or not require:
        raise InputError(f"{path}: found no thresholds, expected an object 'require' with at least one")
    return tuple(_threshold(Path(path), name, bounds) for name, bounds in require.items())


def _threshold(path: Path, name: str, bounds: object) -> Threshold:
    numbers = bounds.items() if isinstance(bounds, dict) else ()
    plain = all(
        each in _BOUNDS and isinstance(number, int | float) and not isinstance(number, bool) for each, number in numbers
    )
    if not numbers or not plain:
        raise InputError(f"{path}: {name}: found {bounds!r}, expected numbers under at_least, at_most or both")
    assert isinstance(bounds, dict)
    return Threshold(name, bounds.get("at_least"), bounds.get("at_most"))


def failures(content: Mapping[str, object], thresholds: tuple[Threshold, ...]) -> list[str]:
    """One line for every figure beyond its threshold; errors as in `Threshold.failure`."""
    return [failure for each in thresholds if (failure := each.failure(content)) is not None]
