"""
The machine gives way
=====================

**Measured:** ramps at three rates. In the second the video was lost, and the strain was taken
from the crosshead.

**The law missed:** the start of that one record: it looks softer than the others.

**It was:** the compliance of the machine. Grips and load cell give way under the force, and the
crosshead counts that as strain of the specimen.
"""

import numpy as np

import probation
from probation.report.diagnosis_figures import probability_figure, record_figure

relation = {"slope": 0.00464, "intercept": 0.0367}
law = probation.Law(
    unrelaxed_modulus=3220.0,
    alpha=1.0,
    hardening_modulus=1.8,
    companion=probation.Weissenberg(**relation),
)
rates = {"slow": 5e-4, "medium": 2e-3, "fast": 8e-3}
given_way = 2e-4  # engineering strain for each MPa of engineering stress
noise = np.random.default_rng(3)
time, strain, stress, record = [], [], [], []
for name, rate in rates.items():
    test = probation.named_history("ramp", rate=rate, strain=1.0, samples=401)
    true_stress = law.stress(test.time, test.true_strain, scheme="sa3")
    recorded = test.true_strain
    if name == "medium":
        force = true_stress * np.exp(-test.true_strain)  # over the initial section
        recorded = np.log(np.exp(test.true_strain) + given_way * force)
        true_stress = force * np.exp(recorded)  # as the laboratory computes it
    time.append(test.time)
    strain.append(recorded)
    stress.append(true_stress + noise.normal(0.0, 0.04, len(test.time)))
    record += [name] * len(test.time)
campaign = probation.Campaign.from_arrays(
    np.concatenate(time),
    true_strain=np.concatenate(strain),
    true_stress=np.concatenate(stress),
    record=record,
    control="strain-rate",
    law=probation.LawSettings(companion=probation.CompanionSettings("weissenberg", relation)),
    name="crosshead",
    specimens=probation.Specimens("none"),  # virtual specimens are alike
)
diagnosis = probation.diagnose(
    campaign,
    effects=[
        "machine_compliance",
        "strain_offset",
        "force_offset",
        "force_gain",
        "damage",
        "grip_slip",
    ],
)
print(diagnosis.headline)

# %%
# The fit bends the law to please all three records, so all of them look wrong. The record in
# which the fault sits is found nevertheless, because no single set of parameters does it.

# sphinx_gallery_thumbnail_number = 1
record_figure(diagnosis, "medium")

# %%
probability_figure(diagnosis)

# %%
# The answer names effect and record, and the size comes back:

print(diagnosis.best.effects, "in", ", ".join(diagnosis.best.records))
for parameter in diagnosis.best.parameters:
    print(parameter.name, f"{parameter.value:.2e} ± {parameter.se:.1e} {parameter.unit}")
print(f"put in: {given_way:.2e}")
