"""Figure 2: the residual of experiment 1 holds the error of the strain."""

from __future__ import annotations

import numpy as np

from probation.identify.bias import low_frequency
from probation_studies.paper.exhibit import Drawing, Exhibit, Settings, compare
from probation_studies.paper.table_1 import WAVE, WAVE_AT, figure_2

_WHY_PLACE = (
    "identification moves the parameters along the bias that was put in, which lowers it in places and raises it in "
    "others"
)


def exhibit(settings: Settings) -> Exhibit:
    """The synthetic record with vibration, identified on the straight line."""
    found = figure_2(settings.seed)
    left = low_frequency(found.model - found.record.true_stress)
    at = int(np.abs(left).argmax())
    where, largest = float(found.record.true_strain[at]), float(np.abs(left[at]))
    return Exhibit(
        title="Figure 2: what the residual of experiment 1 is made of",
        says="The residual's high frequencies correspond exactly to the noise seen on the strain; its long wave is "
        f"bias, at most about {WAVE:g} MPa at a strain of {WAVE_AT:g}.",
        explanation="The synthetic record vibrates as the specimen of Figure 2 did, and a wavy bias of the printed "
        "size is in its stress. The high-frequency part of the residual is correlated with the strain error (r = "
        f"{found.correlation:+.2f}), and the law makes {100 * found.explained:.0f} % of its variance from that error. "
        "It is the law's answer to a strain that it was not told of, and not noise of the stress: driven by the strain "
        f"as measured, it leaves little of it (r = {found.followed:+.2f}).",
        comparisons=(
            compare("largest bias left", WAVE, largest, unit="MPa", tolerance=0.1, put_in=True, because=_WHY_PLACE),
            compare("its true strain", WAVE_AT, where, tolerance=0.1, put_in=True, because=_WHY_PLACE),
        ),
        parts=(
            Drawing(
                "figure-2",
                found.plot(),
                "Figure 2 from the vibrating synthetic record: stress; on the right axis the residual, four times "
                "magnified, and the strain error, shifted to +40.",
            ),
        ),
        answer={
            "correlation": found.correlation,
            "explained": found.explained,
            "followed": found.followed,
            "largest_bias_MPa": largest,
            "at_true_strain": where,
        },
    )
