"""Figure 3: the law without companion relation fails on tests between grips."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.law.spectrum import Spectrum
from probation.published.experiments import necking_history
from probation.published.numbers import CONSTANT_TIME_MODULUS, CONSTANT_TIME_ONSET
from probation.report.figures import styled_figure
from probation.report.plots import Curve, stress_strain_with_residuals
from probation.report.style import colour, series_colour
from probation.report.table import Table
from probation_studies.paper.constant_time import END_OF_JUMP, CostOverTime, cost_over_time, onset
from probation_studies.paper.exhibit import Comparison, Drawing, Exhibit, Settings, compare
from probation_studies.paper.grip_tests import GRIPS, PUBLISHED, identified, twin

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

    from probation_studies.paper.grip_tests import Grip

FLAT_FROM = 20000.0
"""E_u [MPa] from which on the cost is flat."""

_WHY_MODULUS = (
    "E_u is all but unbounded: below τ_max ≈ 1 s only the product E_u·τ_max is determined and the cost is flat, so "
    "that 60 GPa is where the paper's search stopped"
)
_WHY_ONSET = (
    "with τ_max → 0 the onset is E_u·τ_max·Σp_jτ_j/τ_max times the strain rate at the very start of the test, which "
    "the paper does not print; 2 MPa is what a test would give that started more slowly than the synthetic record, at "
    "the rate named below"
)


def exhibit(settings: Settings) -> Exhibit:
    """Constant τ_max on both tests between grips."""
    searched = {number: cost_over_time(number, settings.seed) for number in GRIPS}
    onsets = {number: onset(each.law(each.best), necking_history(number)) for number, each in searched.items()}
    curves = []
    comparisons: list[Comparison] = []
    rows = []
    for number, each in searched.items():
        test = twin(number, settings.seed)
        best, printed = each.best, each.nearest_modulus(CONSTANT_TIME_MODULUS)
        model = each.law(best).stress(test.time, test.true_strain, scheme="exact")
        curves.append(Curve(_name(number), test.true_strain, test.true_stress, model))
        modulus = float(each.unrelaxed_modulus[best])
        comparisons += [
            compare(
                f"E_u without companion, experiment {number}",
                CONSTANT_TIME_MODULUS,
                modulus,
                unit="MPa",
                because=_WHY_MODULUS,
            ),
            compare(
                f"onset without companion, experiment {number}",
                CONSTANT_TIME_ONSET,
                onsets[number],
                unit="MPa",
                because=_WHY_ONSET,
            ),
        ]
        flat = each.nearest_modulus(FLAT_FROM)
        with_companion = identified(number, settings.seed)[2].rms_MPa
        rows.append(
            (
                f"experiment {number}",
                f"{each.rms[best]:.3f} ({modulus / 1000:.0f} GPa)",
                f"{each.rms[printed]:.3f} ({each.unrelaxed_modulus[printed] / 1000:.0f} GPa)",
                f"{each.rms[flat]:.3f} ({each.unrelaxed_modulus[flat] / 1000:.0f} GPa)",
                f"{with_companion:.3f}",
                f"{_start_for(number, each, CONSTANT_TIME_ONSET):.2g} (synthetic record: {_start_rate(number):.2g})",
            )
        )
    low, high = (min(each.rms[each.best] for each in searched.values()), max(onsets.values()))
    headings = ("rms [MPa]", "least", "at the paper's E_u", "at 20 GPa", "with (11) and α", "start for 2 MPa [1/s]")
    return Exhibit(
        title="Figure 3: without the companion relation",
        says="With a constant τ_max the law cannot follow the tests between grips: a sudden jump, a very low yield "
        "stress (around 2 MPa) and an E_u of around 60 GPa.",
        explanation=f"So it is with the synthetic data: the rms is {low:.1f} MPa or more, over a hundred times the "
        "noise, where the companion relation brings it down to the noise. A slow start and a fast middle ask for a "
        "small viscous stress first and a large one later; with a constant τ_max → 0 the viscous stress is "
        "proportional to the strain rate, which is the nearest that the law can come, whatever E_u. The cost is flat "
        f"there, as the second plot shows: every E_u above {FLAT_FROM / 1000:.0f} GPa fits within 0.5 % of the least "
        f"rms. What holds is that E_u exceeds {FLAT_FROM / 1000:.0f} GPa and that the onset, the stress at the end of "
        f"the initial jump ({END_OF_JUMP:g} τ_max after the start), is {high:.1f} MPa at most, against the 30 MPa at "
        "which the tests yield; the 60 GPa do not mean anything.",
        comparisons=tuple(comparisons),
        parts=(
            Drawing(
                "figure-3",
                stress_strain_with_residuals(curves),
                "Figure 3 from the synthetic data: the best fit of the law with a constant τ_max.",
            ),
            Drawing(
                "figure-3-cost",
                _cost_figure(searched),
                "Why 60 GPa means nothing: rms of the best fit at each constant τ_max, and with E_u·τ_max kept. "
                "Points: where E_u is 60 GPa.",
            ),
            Table(
                headings, tuple(rows), "Constant τ_max: rms of the best fit, and the start that an onset of 2 MPa needs"
            ),
        ),
        answer={
            "constant_tau_max": {
                f"experiment-{number}": {
                    "unrelaxed_modulus_MPa": each.unrelaxed_modulus[each.best],
                    "onset_MPa": onsets[number],
                    "rms_MPa": each.rms[each.best],
                    "rms_with_companion_MPa": identified(number, settings.seed)[2].rms_MPa,
                    "tau_max_s": each.tau_max,
                    "profile_rms_MPa": each.rms,
                    "profile_unrelaxed_modulus_MPa": each.unrelaxed_modulus,
                }
                for number, each in searched.items()
            }
        },
    )


def _name(number: Grip) -> str:
    return f"experiment {number}, grips {PUBLISHED[number].grip_speed:g} mm/s"


def _start_rate(number: Grip) -> float:
    return float(necking_history(number).strain_rate([0.0])[0])


def _start_for(number: Grip, searched: CostOverTime, stress: float) -> float:
    """Strain rate at the start that gives such an onset in the limit of fast modes [1/s]."""
    spectrum = Spectrum.log_spaced()
    product = float(searched.unrelaxed_modulus[searched.best] * searched.tau_max[searched.best])
    return stress / (product * float(spectrum.modal_weight @ spectrum.relaxation_ratio))


def _cost_figure(searched: Mapping[Grip, CostOverTime]) -> Figure:
    with styled_figure(7.2, 3.6) as figure:
        axes = figure.subplots()
        for at, (number, each) in enumerate(searched.items()):
            shade = series_colour(at)
            axes.semilogx(each.tau_max, each.rms, color=shade, label=f"experiment {number}, best E_u and G")
            axes.semilogx(
                each.tau_max, each.rms_fixed_product, color=shade, ls="--", lw=1.0, label="E_u·τ_max kept, best G"
            )
            marked = each.nearest_modulus(CONSTANT_TIME_MODULUS)
            axes.plot(each.tau_max[marked], each.rms[marked], "o", ms=6, color=shade, mec=colour("ink"), mew=0.8)
        axes.set(xlabel="τ_max, constant [s]", ylabel="rms of the fit residual [MPa]", ylim=(6.0, 13.0))
        axes.legend(loc="upper left")
    return figure
