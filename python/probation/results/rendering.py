"""Results are data: what they say to people is made elsewhere, when it is asked for.

A result inherits what it offers: `Summarised`, `Plotted`, `Reported`, or `Result` for all three. Each asks the table
`probation.report.renderers` by the class of the result. That table is imported by name, on first use, so that neither
reading nor computing loads a word, a figure or a page.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from probation.wording import within_width

if TYPE_CHECKING:
    from os import PathLike

    from matplotlib.figure import Figure

RENDERERS = "probation.report.renderers"


def rendered(result: object, what: str, *arguments: object, **options: object) -> Any:
    """What the renderer of a result's class makes of it.

    Parameters
    ----------
    result : object
    what : {"summary", "plot", "report", "verdict", "card", "line"}
    *arguments, **options
        Passed on to the renderer.
    """
    return import_module(RENDERERS).renderer(type(result), what)(result, *arguments, **options)


class Displayed:
    """Something that a notebook shows as a card."""

    def _repr_html_(self) -> str:
        html: str = rendered(self, "card").html()
        return html


class InOneLine(Displayed):
    """... and whose `repr` is one line, whatever it holds."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "__repr__" not in vars(cls):  # in the class itself, so that a dataclass makes none of its own
            cls.__repr__ = InOneLine.__repr__  # type: ignore[method-assign]

    def __repr__(self) -> str:
        line: str = rendered(self, "line")
        return line


class Summarised(InOneLine):
    """A result that has a text for the terminal."""

    def summary(self) -> str:
        """The answer as text for a terminal of 80 columns: the verdict first, then numbers, then details."""
        return within_width(rendered(self, "summary"))


class Plotted:
    """A result that has a figure."""

    def plot(self) -> Figure:
        """The answer as a figure."""
        figure: Figure = rendered(self, "plot")
        return figure


class Reported:
    """A result that has a page."""

    def report(self, path: str | PathLike[str]) -> Path:
        """Write a self-contained HTML page and return its path.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        page = Path(path)
        rendered(self, "report", page)
        return page


class Result(Summarised, Plotted, Reported):
    """A result with a text, a figure and a page."""
