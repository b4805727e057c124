"""A result as one self-contained HTML page: verdict, sections, tables, figures, provenance."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup

from probation._files import write_whole
from probation._text import printable_lines
from probation.provenance import Provenance, provenance
from probation.report.figures import figure_to_svg
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


@dataclass(frozen=True)
class Gallery:
    """Pictures side by side, as many as there is room for."""

    pictures: tuple[Picture, ...]


@dataclass(frozen=True)
class Section:
    """A part of a page.

    Attributes
    ----------
    title : str
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
    title : str
    verdict : str
        One sentence, read first.
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
        """The page: no script, nothing fetched, light and dark by the reader's own setting."""
        return _template().render(page=self, light=css_variables(dark=False), dark=css_variables(dark=True))

    def write(self, path: str | PathLike[str]) -> None:
        """Write the page, whole or not at all.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        write_whole(path, self.html())


def picture(figure: Figure, caption: str) -> Picture:
    """Put a figure into a page; the caption, unique within the page, also tells what it shows."""
    return Picture(figure_to_svg(figure, caption), caption, figure.get_figwidth())


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
    return environment.get_template("page.html.j2")
