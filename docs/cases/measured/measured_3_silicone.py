"""
Silicone RTV 615
================

**Measured:** a silicone rubber pulled to failure at 450 mm/min (Maréchal and others, Soft
Robotics Materials Database).

**The law missed:** 0.45 MPa, in a wave along the whole record.

**It was:** finite chains, for the most part: a rubber locks as its chains reach their length.
And it was the wrong law for the question. One pull at one rate shows no relaxation, so the
modulus ends at its bound, and the fit says so.
"""

from pathlib import Path

import probation
from probation.report.diagnosis_figures import probability_figure


def data() -> Path:
    """The folder of the measured records: beside the checkout, above this script."""
    return next(
        at / "shared/data" for at in Path.cwd().parents if (at / "shared/data").is_dir()
    )


campaign = probation.Campaign.from_files(
    [data() / "silicones/RTV615.csv"], control="displacement-rate"
)
fit = probation.fit(campaign)
print(fit.summary())

# %%
# sphinx_gallery_thumbnail_number = 1
fit.plot()

# %%
# What could be missing? Finite extensibility is the textbook answer for a rubber; the diagnosis
# weighs it against others.

diagnosis = probation.diagnose(
    campaign,
    effects=[
        "finite_extensibility",
        "spectrum_shape",
        "damage",
        "strain_offset",
        "machine_compliance",
    ],
)
print(diagnosis.headline)

# %%
probability_figure(diagnosis)

# %%
# The strain is that of the crosshead: a fault of the rig (compliance, slack) is as plausible as
# one of the law. A strain from the specimen itself would be worth more than any statistics.
