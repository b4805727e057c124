"""Colours and type of every plot and page, for light and dark."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Colour:
    """One colour by what it stands for.

    Attributes
    ----------
    light, dark : str
        On a white and on a dark page; the light one is also what PNG files get.
    """

    light: str
    dark: str


# Blue, orange, green, violet and red hold apart for colour-blind eyes too (after Okabe and Ito).
COLOURS: dict[str, Colour] = {
    "ink": Colour("#1f2328", "#e6e9ed"),
    "muted": Colour("#6b7480", "#97a1ad"),
    "grid": Colour("#d9dee4", "#343b44"),
    "data": Colour("#8a939e", "#8f9aa7"),
    "model": Colour("#0a64ad", "#58aef0"),
    "second": Colour("#cc5a00", "#f29a4a"),
    "third": Colour("#0b7f5c", "#3ecb9f"),
    "fourth": Colour("#8a4fb0", "#c792ea"),
    "bad": Colour("#b3261e", "#ff8a80"),
    "good": Colour("#1a7f37", "#57d17a"),
}
SERIES = ("model", "second", "third", "fourth", "muted", "bad", "good")
"""Colours of several curves in one plot, in order."""

MATPLOTLIB: dict[str, object] = {
    "axes.axisbelow": True,
    "axes.edgecolor": COLOURS["muted"].light,
    "axes.grid": True,
    "axes.labelcolor": COLOURS["ink"].light,
    "axes.linewidth": 0.8,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "figure.facecolor": "white",
    "figure.constrained_layout.use": True,
    "font.family": ["DejaVu Sans"],
    "font.size": 9,
    "grid.color": COLOURS["grid"].light,
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "legend.labelcolor": COLOURS["ink"].light,
    "lines.linewidth": 1.4,
    "savefig.facecolor": "auto",
    "svg.fonttype": "none",
    "svg.hashsalt": "probation",  # the same picture is the same file
    "text.color": COLOURS["ink"].light,
    "xtick.color": COLOURS["muted"].light,
    "xtick.labelcolor": COLOURS["ink"].light,
    "ytick.color": COLOURS["muted"].light,
    "ytick.labelcolor": COLOURS["ink"].light,
}
"""Settings of matplotlib within `figures.new_figure`."""


def colour(name: str) -> str:
    """The colour by that name, for matplotlib."""
    return COLOURS[name].light


def series_colour(at: int) -> str:
    """The colour of the curve number `at`, counted from 0."""
    return colour(SERIES[at % len(SERIES)])


def css_variables(*, dark: bool) -> str:
    """The colours as declarations of CSS custom properties."""
    return " ".join(f"--{name}: {shade.dark if dark else shade.light};" for name, shade in COLOURS.items())
