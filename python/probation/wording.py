"""Numbers and lists as one reads them, with the digits that mean something."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence


def percentage(part: float, sign: str = "") -> str:
    """A part in percent to two significant digits, without the unit and without exponent: "0.086", "13", "130".

    Parameters
    ----------
    part : float
    sign : {"", "+"}
        "+" shows the sign of positive ones, too.
    """
    text = f"{100.0 * part:{sign}.2g}"
    return f"{float(text):{sign}.0f}" if "e+" in text else text


def plus_minus(value: float, se: float) -> str:
    """Both to two significant digits of the error: "1.8500 ± 0.0012".

    Parameters
    ----------
    value : float
    se : float
        Its standard error; where it is zero or not finite the value stands alone.

    Returns
    -------
    str
    """
    if not np.isfinite(se) or se <= 0.0:
        return f"{value:.5g}"
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


def listed(names: Sequence[str], last: str = "or") -> str:
    """Such as "a, b or c"."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} {last} {names[-1]}" if names else ""
