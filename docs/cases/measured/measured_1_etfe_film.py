"""
ETFE film at 40 °C
==================

**Measured:** three strips of a semi-crystalline fluoropolymer film, pulled at one crosshead
speed to a true strain of 0.65 (Comitti and Bosi).

**The law missed:** the same wave in all three, up to 5 MPa: 400 times the noise.

**It was:** not settled, and cannot be by these tests. The strain rate changes along each of
them, but in the same way: whatever changes with the strain looks like an effect of the rate.
Two crosshead speeds would tell.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

import probation
from probation.report.diagnosis_figures import probability_figure
from probation.report.residual_map import residual_map


def data() -> Path:
    """The folder of the measured records: beside the checkout, above this script."""
    return next(
        at / "shared/data" for at in Path.cwd().parents if (at / "shared/data").is_dir()
    )


def thinned(record, every):
    """One of `every` samples."""
    kept = np.arange(0, len(record), every)
    columns = {
        name: getattr(record, name)[kept] for name in ("time", "true_strain", "true_stress")
    }
    return replace(record, **columns, strain_rate=None, transverse_strain=None, sha256="")


whole = probation.Campaign.from_files(
    [data() / "etfe/OUTRaw_MD_CSR_01_T40.csv"], control="displacement-rate"
)
campaign = replace(whole, records=tuple(thinned(record, 2) for record in whole.records))
fit = probation.fit(campaign)
print(fit.verdict)

# %%
# The three specimens agree with each other, and not with the law. What is left is a wave, not
# noise:

# sphinx_gallery_thumbnail_number = 1
fit.plot()

# %%
# Standard errors allow for that wave: E_u is known to about 10 %, not to the 0.1 % that the
# noise alone would give.

for parameter in fit.parameters.values():
    print(f"{parameter.value:10.3f} ± {parameter.se:.3f}  {parameter.status}")

# %%
# What does the diagnosis make of it?

diagnosis = probation.diagnose(campaign)
print(diagnosis.headline)

# %%
residual_map(diagnosis)

# %%
probability_figure(diagnosis)

# %%
# Read this with care. Records of one kind of test ask one kind of question, the law's error is
# taken in part for slow noise, and three specimens are few. :doc:`/measured-diagnoses` says
# what an expert objects.
