"""Figure 1: strain rate over strain."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.certificate.hardening import regress_hardening
from probation.law.companion import WEISSENBERG_AS_PRINTED
from probation.published.numbers import PEAK_RATE, PREDICTION_ERROR, RATE_RATIO, STRAIN_RATE
from probation.report.plots import strain_rates
from probation.report.table import Table
from probation_studies.paper.direct_prediction import direct_prediction
from probation_studies.paper.exhibit import Drawing, Exhibit, Settings, compare
from probation_studies.paper.grip_tests import GRIPS, PUBLISHED, end_rate_ratio, identify, twin

if TYPE_CHECKING:
    from probation.published.experiments import NeckingSet


SETS: tuple[NeckingSet, ...] = ("P1", "P2", "P3")


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
        explanation="The curves of the paper were not published as numbers. The synthetic data follow (A-1), the form "
        "that the paper itself fits to its strain, with parameters that give the printed peak rate, the factor and "
        "the final strain of 1.8. Many do; of the three sets below P2 is used throughout, for it gives the slopes of "
        "Figure S1. Nothing else hangs on the choice: α and G with (12) and the errors of Figure 4a are the same with "
        "all three.",
        comparisons=(
            compare("rate of experiment 1", STRAIN_RATE, twins[0].strain_rate.mean(), unit="1/s", put_in=True),
            compare("peak rate of experiment 3", PEAK_RATE, twins[2].strain_rate.max(), unit="1/s", put_in=True),
            compare(
                "largest/smallest rate, experiment 3",
                RATE_RATIO[1],
                ratios[3],
                relation="≤",
                tolerance=0.05,
                put_in=True,
            ),
        ),
        parts=(
            Drawing("figure-1", figure, "Figure 1, synthetic data: strain rate over true strain, in closed form."),
            _sets(settings.seed),
        ),
        answer={"rate_ratio": {f"experiment-{number}": ratio for number, ratio in ratios.items()}},
    )


def _sets(seed: int) -> Table:
    """What the sets of (A-1) return, and what the paper has."""
    rows = []
    for number in GRIPS:
        printed = PUBLISHED[number]
        third = printed.identifications[3]
        paper = (third.time.value, third.hardening_modulus.value, printed.regressed_hardening)
        rows.append((f"experiment {number}", "paper", *(f"{each:g}" for each in paper), f"≤ {PREDICTION_ERROR:g}"))
        for name in SETS:
            test = twin(number, seed, name)
            law = identify(test, 3).law
            slope = regress_hardening(test.true_strain, test.true_stress).hardening_modulus
            largest = direct_prediction(number, WEISSENBERG_AS_PRINTED, seed, name).largest
            found = (law.alpha or 0.0, law.hardening_modulus, slope)
            rows.append((f"experiment {number}", name, *(f"{each:.3f}" for each in found), f"{largest:.1f}"))
    headings = ("", "set", "α with (12)", "G with (12) [MPa]", "regressed G [MPa]", "error of Figure 4a [MPa]")
    return Table(headings, tuple(rows), "What the sets of (A-1) return that was not put in", left=2)
