"""Numbers and lists as one reads them, with the digits that mean something."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence


WIDTH = 80
"""Columns of a terminal; a longer line is broken between words, a longer word is not."""


def within_width(text: str, width: int = WIDTH) -> str:
    """A text with its long lines broken; an indented line goes on two letters further in.

    Returns
    -------
    str
        Lines that fit are as they were, so that tables and plots stay.
    """
    return "\n".join(line if len(line) <= width else _broken(line, width) for line in text.split("\n"))


def _broken(line: str, width: int) -> str:
    words = line.lstrip(" ")
    indent = " " * min(len(line) - len(words), width // 2)
    return fill(
        words,
        width,
        initial_indent=indent,
        subsequent_indent=f"{indent}  " if indent else "",
        break_long_words=False,
        break_on_hyphens=False,
    )


def percentage(part: float, sign: str = "") -> str:
    """A part in percent to two significant digits, without the unit and without exponent: "0.086", "13", "130".

    Parameters
    ----------
    sign : {"", "+"}
        "+" shows the sign of positive ones, too.
    """
    text = f"{100.0 * part:{sign}.2g}"
    return f"{float(text):{sign}.0f}" if "e+" in text else text


def times(ratio: float) -> str:
    """How many times, to three significant digits and without exponent: "0.962", "316", "1850"."""
    text = f"{ratio:.3g}"
    return f"{float(text):.0f}" if "e+" in text else text


def plus_minus(value: float, se: float) -> str:
    """Both to two significant digits of the error: "1.8500 ± 0.0012".

    Parameters
    ----------
    se : float
        Its standard error; where it is zero or not finite the value stands alone. Below 1e-9 both are written with
        an exponent.
    """
    if not np.isfinite(se) or se <= 0.0:
        return f"{value:.5g}"
    if se < 1e-9:
        return f"{value:.5g} ± {se:.2g}"
    digits = max(1 - int(np.floor(np.log10(se))), 0)
    if float(f"{se:.{digits}f}") >= 10.0 ** (2 - digits) and digits > 0:  # 0.0996 is 0.10
        digits -= 1
    return f"{value:.{digits}f} ± {se:.{digits}f}"


def percent(part: float) -> str:
    """A probability or a share: "91 %", "< 1 %", "> 99 %"."""
    if part < 0.01:
        return "< 1 %" if part > 0.0 else "0 %"
    if 0.99 < part < 1.0:
        return "> 99 %"
    return f"{100.0 * part:.0f} %"


def signed_percent(part: float) -> str:
    """A share, which is negative where an effect makes the misfit larger: "91 %", "−3 %"."""
    return percent(part) if part > -0.005 else f"−{percent(-part)}"


def chance(probability: float) -> str:
    """A probability that came out: "91 %", "< 1 %"; rounded to 1 it is still no certainty: "> 99 %"."""
    return "> 99 %" if probability > 0.99 else percent(probability)


def change(before: float, after: float, would: Literal["", "would "] = "") -> str:
    """What a misfit does [MPa], to three significant digits: "falls from 1.31 to 0.043 MPa", "would stay at 1.31 MPa".

    Parameters
    ----------
    would : {"", "would "}
    """
    old, new = f"{before:.3g}", f"{after:.3g}"
    s = "" if would else "s"
    if old == new:
        return f"{would}stay{s} at {new} MPa"
    return f"{would}{'fall' if after < before else 'rise'}{s} from {old} to {new} MPa"


def sentence(text: str) -> str:
    """A phrase as a sentence: with a capital, and one full stop.

    >>> sentence("thinned to 3000 samples")
    'Thinned to 3000 samples.'
    """
    text = text.strip()
    return f"{text[:1].upper()}{text[1:].rstrip('.')}." if text else ""


def listed(names: Sequence[str], last: str = "or") -> str:
    """Such as "a, b or c"."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} {last} {names[-1]}" if names else ""
