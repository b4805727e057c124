"""Figure 1: strain rate over strain."""

from __future__ import annotations

from probation.paper.exhibit import Drawing, Exhibit, Settings, compare
from probation.paper.grip_tests import end_rate_ratio, twin
from probation.paper.published import PEAK_RATE, RATE_RATIO, STRAIN_RATE
from probation.report.plots import strain_rates


def exhibit(settings: Settings) -> Exhibit:
    """What drives the three specimens."""
    twins = [twin(number, settings.seed) for number in (1, 2, 3)]
    names = ("experiment 1, constant strain rate", "experiment 2, grips 0.02 mm/s", "experiment 3, grips 0.08 mm/s")
    figure = strain_rates([(name, each.true_strain, each.strain_rate) for name, each in zip(names, twins, strict=True)])
    ratios = {number: end_rate_ratio(number, settings.seed) for number in (2, 3)}
    return Exhibit(
        title="Figure 1: strain rate over strain",
        says="Experiment 1 keeps its strain rate; between grips the local rate evolves by a factor of 5 to 10, up to "
        "1.7e-2 1/s in experiment 3.",
        explanation="The curves of the paper were not published as numbers. The twins follow (A-1), the form that the "
        "paper itself fits to its strain, with parameters (set P2) that give the printed peak rate, the factor and the "
        "final strain of 1.8. Of the sets that do so, P2 is the one with which Tables 3 and 4 come out.",
        comparisons=(
            compare("rate of experiment 1", STRAIN_RATE, twins[0].strain_rate.mean(), unit="1/s", put_in=True),
            compare("peak rate of experiment 3", PEAK_RATE, twins[2].strain_rate.max(), unit="1/s", put_in=True),
            compare("largest/smallest rate, experiment 3", RATE_RATIO[1], ratios[3], relation="≤", put_in=True),
        ),
        parts=(Drawing("figure-1", figure, "Figure 1 from the twins: strain rate over true strain, in closed form."),),
        answer={"rate_ratio": {f"experiment-{number}": ratio for number, ratio in ratios.items()}},
    )
