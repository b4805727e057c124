"""Draws the pictures of the README and of the site's first page: `make pictures`.

They are the only image files that the repository holds, because the README is read where nothing can be built. A test
draws them again and compares.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from probation import Diagnosis, Fit, diagnose, fit
from probation.demo import diagnosis_campaign
from probation.published.experiments import twin_campaign
from probation.report.diagnosis_figures import probability_figure, record_figure
from probation.report.figures import house_style, new_figure, save_figure, thinned
from probation.report.residual_map import residual_map
from probation.report.style import colour

FOLDER = Path(__file__).parent / "pictures"


def overview(identified: Fit, found: Diagnosis) -> Figure:
    """Identify on one test, predict another, name what is missing."""
    with house_style():
        figure = new_figure(9.6, 3.0)
        left, middle, right = figure.subplots(1, 3, width_ratios=(1, 1, 0.9))
        record = next(iter(identified.records.values()))
        left.plot(*thinned(record.true_strain, record.true_stress, 60), ".", ms=5, color=colour("data"))
        left.plot(*thinned(record.true_strain, record.model_stress, 200), color=colour("model"))
        left.set(title="1  Identify on one test", xlabel="true strain [–]", ylabel="true stress [MPa]")
        held = next(each for each in found.curves.values() if each.role == "held-out")
        middle.plot(*thinned(held.true_strain, held.data, 60), ".", ms=5, color=colour("data"), label="measured")
        middle.plot(
            *thinned(held.true_strain, held.base, 200), "--", color=colour("second"), label="predicted by the law"
        )
        middle.plot(
            *thinned(held.true_strain, held.explained, 200), color=colour("model"), label="with what was missing"
        )
        middle.set(title="2  Predict another", xlabel="true strain [–]", ylim=(0.0, 1.5 * np.max(held.base)))
        middle.legend(loc="upper right", fontsize=8)
        best = found.best.probability
        rows = ((" + ".join(found.best.titles), best, "model"), ("all other explanations", 1.0 - best, "data"))
        for at, (name, probability, shade) in enumerate(rows):
            right.barh(at, 100 * probability, height=0.3, color=colour(shade))
            right.text(0.0, at - 0.2, f"{name}, {100 * probability:.0f} %", va="bottom", fontsize=8)
        right.set(title="3  Name what is missing", xlabel="probability [%]", xlim=(0, 100), ylim=(1.6, -0.8))
        right.set_yticks([])
        right.grid(visible=False)
    return figure


def draw(folder: Path = FOLDER) -> None:
    """Write every picture into the folder."""
    folder.mkdir(exist_ok=True)
    found = diagnose(diagnosis_campaign())
    pictures = {
        "overview": overview(fit(twin_campaign((1,))), found),
        "curves": record_figure(found, "experiment-2"),
        "where": residual_map(found),
        "which": probability_figure(found),
    }
    for name, figure in pictures.items():
        save_figure(figure, folder / f"{name}.svg")


if __name__ == "__main__":
    draw(*(Path(given) for given in sys.argv[1:]))
