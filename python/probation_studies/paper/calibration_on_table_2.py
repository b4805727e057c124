"""Companion relations calibrated on the paper's Table 2, beside its own (11) and (12)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from probation.answers import json_answer
from probation.law.companion import EXPONENTIAL_AS_PRINTED, WEISSENBERG_AS_PRINTED
from probation.published.numbers import EXPONENTIAL_R_SQUARED, FICTITIOUS_ERROR, WEISSENBERG_R_SQUARED
from probation.report.companion_summary import companion_summary
from probation.report.page import Section
from probation.report.table import Table
from probation.results.data import KEY, encoded
from probation.wording import within_width
from probation_studies.paper.relations import RATE_TABLE, paper_relations

if TYPE_CHECKING:
    from os import PathLike

    from matplotlib.figure import Figure

    from probation.calibration.result import Calibration


@dataclass(frozen=True, eq=False)
class CalibrationOnTable2:
    """What `calibrate_companion` found on Table 2, and what that says of the paper's relations."""

    calibration: Calibration

    def summary(self) -> str:
        """The calibration's, and the findings after it."""
        return within_width(companion_summary(self.calibration, paper_relations().sentences()))

    def plot(self) -> Figure:
        """Figure S2: the relations, (11) and (12) as printed, and bars of the paper's "fictitious 10 %"."""
        from probation.report.companion_figure import companion_figure  # noqa: PLC0415 - matplotlib when asked for

        printed = {"(11) as printed": WEISSENBERG_AS_PRINTED, "(12) as printed": EXPONENTIAL_AS_PRINTED}
        return companion_figure(self.calibration, printed, FICTITIOUS_ERROR)

    def report(self, path: str | PathLike[str]) -> Path:
        """Write one self-contained HTML page and return its path."""
        from probation.report.companion_page import companion_page  # noqa: PLC0415 - templates only when asked for

        bars = f"bars of {100 * FICTITIOUS_ERROR:.0f} %, as fictitious as in the paper"
        companion_page(self.calibration, self.plot(), bars=bars, further=(_section(),)).write(Path(path))
        return Path(path)

    def to_json(self) -> str:
        """The calibration's, with the key `paper`; `Calibration.from_json` reads it."""
        content = {**self.calibration.to_dict(), "paper": paper_relations().to_dict(), KEY: encoded(self.calibration)}
        return json_answer(self.calibration.SCHEMA, content)


def _section() -> Section:
    paper = paper_relations()
    names = tuple(paper.percent)
    rows = [
        (f"{rate:.3g}", f"{time:.5g}", *(f"{paper.percent[name][at]:+.1f}" for name in names))
        for at, (rate, time) in enumerate(zip(RATE_TABLE.rates, RATE_TABLE.tau_max, strict=True))
    ]
    slope, intercept = paper.weissenberg.parameters
    coefficient, exponent = paper.exponential.parameters
    errors = paper.weissenberg.covariance
    assert errors is not None
    spread = np.sqrt(np.diag(errors))
    beside = (
        ("(11) slope", f"{WEISSENBERG_AS_PRINTED.slope:g}", f"{slope:.5f} ± {spread[0]:.5f}"),
        ("(11) intercept", f"{WEISSENBERG_AS_PRINTED.intercept:g}", f"{intercept:.4f} ± {spread[1]:.4f}"),
        ("(11) R² in We", f"{WEISSENBERG_R_SQUARED:g}", f"{paper.weissenberg.r_squared:.3f}"),
        ("(12) coefficient [s]", f"{EXPONENTIAL_AS_PRINTED.coefficient:g}", f"{coefficient:.2f}"),
        ("(12) exponent", f"{EXPONENTIAL_AS_PRINTED.exponent:g}".replace("-", "−"), f"{exponent:.3f}"),
        ("(12) R² in τ_max", f"{EXPONENTIAL_R_SQUARED:g}", f"{paper.exponential.r_squared:.5f}"),
    )
    ratios = tuple(
        (
            f"experiment {ratio.experiment}",
            f"{ratio.printed:.3f}",
            f"{ratio.as_printed:.3f}",
            f"{ratio.as_regressed:.3f}",
        )
        for ratio in paper.ratios
    )
    return Section(
        "The paper's own relations",
        (
            Table(("", "as printed", "regressed from Table 2"), beside),
            Table(("rate [1/s]", "τ_max [s]", *(f"{name} [%]" for name in names)), tuple(rows), "Errors on Table 2"),
            Table(
                ("α with (11) over α with (12)", "Tables 3, 4", "synthetic, 0.0367", "synthetic, regressed"),
                ratios,
                "Which intercept were Tables 3 and 4 computed with?",
            ),
            *paper.sentences(),
        ),
    )
