"""Figures S3 to S8: the supplementary procedure, (A-1) and sines through strain and rate, checked by integration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.published.experiments import SAMPLES, necking_history
from probation.report.figures import styled_figure, thinned
from probation.report.style import colour
from probation.smoothing.necking import fit_necking
from probation_studies.paper.exhibit import Drawing, Exhibit, Settings, compare

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.smoothing.necking import NeckingFit, TwoSteps

LEFT = 0.001
"""What the paper's two steps leave of the strain, in order of magnitude (text above Figure S5)."""

NOISE = 5e-4
"""Of the strain record [-]: two steps leave it, and it is at most three times that: of the paper's order."""

WAVES = ((2.5, 0.006), (4.0, 0.003))
"""What the record has beyond (A-1): waves per test and amplitudes [-]."""


@dataclass(frozen=True, eq=False)
class Necking:
    """A record like that of Figures S3 to S8, its truth known: time [s], strain [-], rate [1/s], all (n_times,)."""

    time: FloatArray
    measured: FloatArray
    true_strain: FloatArray
    rate: FloatArray


def exhibit(settings: Settings) -> Exhibit:
    """Both steps on a record of experiment 2 that is not quite (A-1)."""
    record = necking_record(settings.seed)
    found = fit_necking(record.time, record.measured)
    left = float(np.sqrt(np.mean(found.strain.final_residual**2)))
    first = float(np.sqrt(np.mean(found.strain.first_residual**2)))
    inner = slice(len(record.time) // 50, -(len(record.time) // 50))
    own = _rate_error(
        found.strain.history.strain_rate(record.time) + found.strain.sines.derivative(record.time), record
    )
    as_printed = _rate_error(found.rate.final, record)
    drift = float(np.abs(found.integrated - record.true_strain)[inner].max())
    counts = (len(found.strain.sines.frequencies), len(found.rate.sines.frequencies))
    return Exhibit(
        title="Figures S3 to S8: fitting the command",
        says="(A-1) is fitted to the strain, a few sines to what it leaves, the same to the differentiated strain; the "
        "residuals are of the order of 0.001, and the integrated rate gives the strain back.",
        explanation="The record is experiment 2 of the synthetic data with what (A-1) does not have, two slow waves "
        f"({', '.join(f'{size:g}' for _, size in WAVES)}), and noise of {NOISE:g}. (A-1) alone leaves {first:.2g} "
        f"(rms), (A-1) and {counts[0]} sines {left:.2g}, the noise; the number of sines is the criterion's, not ours. "
        f"The rate fitted on its own as in the paper ({found.differentiator}, then (A-1) and {counts[1]} sines) errs "
        f"by {100 * as_printed:.2g} % (95th percentile), the derivative of the fitted strain by {100 * own:.2g} %. "
        f"Integrated, the fitted rate is {drift:.2g} from the true strain at most. `probation excitation` compares "
        "this with smoothers that need no formula.",
        comparisons=(
            compare(
                "largest residual of the strain, order of magnitude", LEFT, _largest(found), tolerance=1.0, put_in=True
            ),
        ),
        parts=_drawings(found),
        answer={
            "first_rms": first,
            "final_rms": left,
            "sines": {"strain": counts[0], "rate": counts[1]},
            "rate_error_p95": {"as_printed": as_printed, "derivative_of_strain": own},
            "largest_drift": drift,
        },
    )


def necking_record(seed: int) -> Necking:
    """Experiment 2 with slow waves beyond (A-1) and noise."""
    history = necking_history(2)
    time = np.linspace(0.0, history.duration, SAMPLES)
    part = time / history.duration
    strain, rate = history.true_strain(time), history.strain_rate(time)
    for waves, size in WAVES:
        turn = 2.0 * np.pi * waves
        strain = strain + size * (1.0 - np.cos(turn * part)) / 2.0
        rate = rate + size * turn * np.sin(turn * part) / (2.0 * history.duration)
    noise = NOISE * np.random.default_rng([seed, 33]).standard_normal(SAMPLES)
    return Necking(time, strain + noise, strain, rate)


def _largest(found: NeckingFit) -> float:
    return float(np.abs(found.strain.final_residual).max())


def _rate_error(rate: FloatArray, record: Necking) -> float:
    return float(np.quantile(np.abs(rate / record.rate - 1.0), 0.95))


def _drawings(found: NeckingFit) -> tuple[Drawing, ...]:
    strain, rate, time = found.strain, found.rate, found.strain.time
    sines = strain.sines(time)
    return (
        Drawing("figure-s3", _figure_s3(strain), "Figure S3: strain over time with (A-1), and what it leaves."),
        Drawing(
            "figure-s4",
            _over_time(time, strain.first_residual, sines, "residual of step 1 [–]", ("residual", "sines")),
            "Figure S4: the residuals of the first step and the sines through them.",
        ),
        Drawing(
            "figure-s5",
            _over_time(time, strain.final_residual, None, "residual of step 2 [–]", ("residual", "")),
            "Figure S5: what is left after the second step.",
        ),
        Drawing(
            "figure-s6",
            _over_time(time, strain.measured, strain.final, "true strain [–]", ("measured", "(A-1) and sines")),
            "Figure S6: the final fit of the strain.",
        ),
        Drawing(
            "figure-s7",
            _over_time(
                time, rate.measured, rate.final, "true strain rate [1/s]", ("differences", "final fit"), rate.first
            ),
            "Figure S7: the differentiated strain, and its fit after one and two steps.",
        ),
        Drawing(
            "figure-s8",
            _over_time(
                time, strain.measured, found.integrated, "true strain [–]", ("measured", "integral of the fitted rate")
            ),
            "Figure S8: the fitted rate, integrated, gives the strain back.",
        ),
    )


def _figure_s3(strain: TwoSteps) -> Figure:
    with styled_figure(7.2, 4.2) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2.2, 1.0])
        above.plot(
            *thinned(strain.time, strain.measured, 300), ".", ms=4, mew=0, color=colour("data"), label="measured"
        )
        above.plot(*thinned(strain.time, strain.first, 300), color=colour("model"), label="(A-1)")
        below.plot(*thinned(strain.time, strain.first_residual, 900), color=colour("data"), lw=0.6)
        below.axhline(0.0, color=colour("muted"), lw=0.8)
        above.set_ylabel("true strain [–]")
        below.set(xlabel="time [s]", ylabel="residual [–]")
        above.legend(loc="upper left")
    return figure


def _over_time(
    time: FloatArray,
    measured: FloatArray,
    fitted: FloatArray | None,
    label: str,
    names: tuple[str, str],
    first: FloatArray | None = None,
) -> Figure:
    with styled_figure(7.2, 2.7) as figure:
        axes = figure.subplots()
        axes.plot(*thinned(time, measured, 900), color=colour("data"), lw=0.6, label=names[0])
        if first is not None:
            axes.plot(*thinned(time, first, 300), "--", color=colour("second"), label="after step 1")
        if fitted is not None:
            axes.plot(*thinned(time, fitted, 300), color=colour("model"), label=names[1])
            axes.legend()
        axes.set(xlabel="time [s]", ylabel=label)
    return figure
