"""A result as one self-contained HTML page: verdict, sections, tables, figures, provenance."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup

from probation._files import write_whole
from probation._text import printable_lines
from probation.provenance import Provenance, provenance
from probation.report.figures import figure_to_svg, narrow
from probation.report.style import css_variables
from probation.report.table import Table

if TYPE_CHECKING:
    from os import PathLike

    from jinja2 import Template
    from matplotlib.figure import Figure

Mood = Literal["good", "bad", "neutral"]


@dataclass(frozen=True)
class Picture:
    """A figure with its caption; make it with `picture`."""

    svg: str
    caption: str
    width: float = 7.2
    """Inches it was drawn in; text is shown in one size whatever the width."""
    narrow: str = ""
    """The same for a telephone; empty where the one above serves."""


@dataclass(frozen=True)
class Gallery:
    """Pictures side by side, as many as there is room for."""

    pictures: tuple[Picture, ...]


@dataclass(frozen=True)
class Section:
    """A part of a page.

    Attributes
    ----------
    parts : tuple of str, Table, Picture or Gallery
        A text is one paragraph.
    """

    title: str
    parts: tuple[str | Table | Picture | Gallery, ...]


@dataclass(frozen=True)
class Page:
    """A page.

    Attributes
    ----------
    verdict : str
        Read first: its first 25 words at most, up to the end of a clause; the rest stands below.
    mood : {"good", "bad", "neutral"}
        How the verdict is coloured.
    sections : tuple of Section
    lead : str
        A paragraph under the verdict.
    provenance : Provenance
        Goes to the footer.
    """

    title: str
    verdict: str
    sections: tuple[Section, ...]
    mood: Mood = "neutral"
    lead: str = ""
    provenance: Provenance = field(default_factory=provenance)

    def html(self) -> str:
        """The page: nothing fetched, light and dark by the reader's own setting; a script shows values of plots."""
        verdict, rest = _headed(" ".join(self.verdict.split()))
        return _template().render(
            page=self,
            verdict=verdict,
            rest=rest,
            folded=_FOLDED,
            unfolded=_UNFOLDED,
            long=_LONG,
            light=css_variables(dark=False),
            dark=css_variables(dark=True),
        )

    def write(self, path: str | PathLike[str]) -> None:
        """Write the page, whole or not at all.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        write_whole(path, self.html())


def picture(figure: Figure, caption: str) -> Picture:
    """Put a figure into a page; the caption, unique within the page, also tells what it shows.

    The figure is made narrow for the second drawing: it is of no other use afterwards.
    """
    wide, width = figure_to_svg(figure, caption), figure.get_figwidth()
    other = narrow(figure)
    return Picture(wide, caption, width, "" if other is None else figure_to_svg(other, f"{caption} (narrow)"))


_FOLDED = 12
"""Rows of a table beyond which it is folded ..."""

_UNFOLDED = 8
"""... to so many."""

_LONG = 28
"""Letters of a cell beyond which it is broken into lines."""

_WORDS = 20
"""Letters that a telephone keeps for a column of words at least, the first excepted."""

_TELEPHONE = 42
"""Letters side by side on a telephone; each column costs two more."""


def _headed(verdict: str, most: int = 25, fewest: int = 6) -> tuple[str, str]:
    """A verdict as one sentence of at most so many words, and the rest of what it says.

    A longer one is parted at the first sentence's end, else where the first clause of at least `fewest` words ends,
    outside of parentheses. If none ends early enough, it ends at a comma, else where the words are too many, and the
    whole of it follows.
    """
    words = verdict.split()
    ends = [
        match.end()
        for match in re.finditer(r"[.;:,](?= )", verdict)
        if verdict[: match.end()].count("(") == verdict[: match.end()].count(")")
        and len(verdict[: match.end()].split()) <= most
    ]
    stops = [end for end in ends if verdict[end - 1] == "."]
    if not stops and len(words) <= most:
        return verdict, ""
    enough = [end for end in ends if len(verdict[:end].split()) >= fewest]
    clauses = stops or [end for end in enough if verdict[end - 1] != ","]
    if not clauses:
        return f"{verdict[: enough[-1] - 1]}." if enough else f"{' '.join(words[: most - 1])} …", verdict
    rest = verdict[clauses[0] :].strip()
    begins = re.match(r"[a-z]+ ", rest)
    return f"{verdict[: clauses[0] - 1]}.", rest[0].upper() + rest[1:] if begins else rest


def _stacks(table: Table) -> bool:
    """Whether a telephone is too narrow for the columns of a table side by side."""
    columns = zip(table.headings, *table.rows, strict=True)
    letters = [
        max(
            max((len(word) for word in heading.split()), default=0),
            *(min(len(cell), _LONG) for cell in cells),
            _WORDS if 0 < at < table.left else 0,
        )
        for at, (heading, *cells) in enumerate(columns)
    ]
    return len(letters) > 1 and sum(letters) + 2 * len(letters) > _TELEPHONE


def _escaped(value: object) -> object:
    """What a page shows, printable; markup made here stays."""
    return printable_lines(value) if type(value) is str else value


@cache
def _template() -> Template:
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=select_autoescape(("html", "j2")),
        undefined=StrictUndefined,
        finalize=_escaped,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["kind"] = lambda part: type(part).__name__
    environment.filters["trusted"] = Markup
    environment.filters["stacks"] = _stacks
    return environment.get_template("page.html.j2")
