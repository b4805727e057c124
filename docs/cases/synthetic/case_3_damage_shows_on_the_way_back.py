"""
Damage shows on the way back
============================

**Measured:** pull, wait, and let go a little, at two rates.

**The law missed:** the large strains of the loading, and the slope of the unloading.

**It was:** damage. Voids take part of the section that carries load, and it stays lost when the
strain is taken back. A law that is softer when loaded would be as soft on the way back; a
section that is lost is lost.
"""

import numpy as np

import probation
from probation.report.diagnosis_figures import probability_figure
from probation.report.residual_map import residual_map

relation = {"slope": 0.00464, "intercept": 0.0367}
law = probation.Law(
    unrelaxed_modulus=3220.0,
    alpha=1.0,
    hardening_modulus=1.8,
    companion=probation.Weissenberg(**relation),
)
noise = np.random.default_rng(4)
time, strain, stress, record = [], [], [], []
for name, rate in (("slow", 1e-3), ("fast", 1e-2)):
    test = probation.named_history(
        "load-unload",
        rate=rate,
        strain=1.0,
        dwell=60.0,
        unload_rate=rate,
        unload_to=0.9,
        samples=501,
    )
    farthest = np.maximum.accumulate(test.true_strain)
    lost = probation.Modification(load_bearing_area=np.exp(0.2 * np.expm1(-farthest / 0.6)))
    history = probation.StrainHistory(test.time, test.true_strain, jumps="auto")
    true_stress = law.stress(history, scheme="sa3", modification=lost)
    time.append(test.time)
    strain.append(test.true_strain)
    stress.append(true_stress + noise.normal(0.0, 0.04, len(test.time)))
    record += [name] * len(test.time)
campaign = probation.Campaign.from_arrays(
    np.concatenate(time),
    true_strain=np.concatenate(strain),
    true_stress=np.concatenate(stress),
    record=record,
    control="strain-rate",
    law=probation.LawSettings(companion=probation.CompanionSettings("weissenberg", relation)),
    name="voids",
    specimens=probation.Specimens("none"),  # virtual specimens are alike
)
diagnosis = probation.diagnose(
    campaign,
    effects=[
        "damage",
        "finite_extensibility",
        "structural_softening",
        "rate_dependent_hardening",
        "force_gain",
    ],
)
print(diagnosis.headline)

# %%
# sphinx_gallery_thumbnail_number = 1
diagnosis.plot()

# %%
residual_map(diagnosis)

# %%
probability_figure(diagnosis)

# %%
# Structural softening stays in the set: it, too, lasts, and so little unloading hardly tells
# them apart. Put in: 0.2 of the section (as a logarithm), over a strain of 0.6. Found:

for parameter in diagnosis.best.parameters:
    se = "not determined" if parameter.se is None else f"± {parameter.se:.3f}"
    print(parameter.name, f"{parameter.value:.3f}", se)
