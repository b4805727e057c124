"""
Nothing is missing
==================

**Measured:** two ramps and a grip-driven test of a material that obeys the law.

**The law missed:** nothing.

**It was:** noise. An honest diagnosis must say so, and must say how large an effect could still
hide.
"""

import numpy as np

import probation
from probation.report.residual_map import residual_map

relation = {"slope": 0.00464, "intercept": 0.0367}
law = probation.Law(
    unrelaxed_modulus=3220.0,
    alpha=1.0,
    hardening_modulus=1.8,
    companion=probation.Weissenberg(**relation),
)
tests = {
    "ramp-slow": probation.named_history("ramp", rate=1e-3, strain=1.2, samples=401),
    "ramp-fast": probation.named_history("ramp", rate=1e-2, strain=1.2, samples=401),
    "grips": probation.named_history("necking", grip_speed=0.04, samples=401),
}
noise = np.random.default_rng(5)
stress = {
    name: law.stress(
        probation.StrainHistory(test.time, test.true_strain, strain_rate=test.strain_rate),
        scheme="sa3",
    )
    for name, test in tests.items()
}
campaign = probation.Campaign.from_arrays(
    np.concatenate([test.time for test in tests.values()]),
    true_strain=np.concatenate([test.true_strain for test in tests.values()]),
    true_stress=np.concatenate(
        [values + noise.normal(0.0, 0.04, len(values)) for values in stress.values()]
    ),
    record=[name for name, test in tests.items() for _ in test.time],
    control={
        "ramp-slow": "strain-rate",
        "ramp-fast": "strain-rate",
        "grips": "displacement-rate",
    },
    law=probation.LawSettings(companion=probation.CompanionSettings("weissenberg", relation)),
    name="sound",
    specimens=probation.Specimens("none"),  # virtual specimens are alike
)
diagnosis = probation.diagnose(campaign)
print(diagnosis.verdict)
print(diagnosis.headline)

# %%
# Pale strips: nowhere is the distance of the model from the record more than noise.

# sphinx_gallery_thumbnail_number = 1
residual_map(diagnosis)

# %%
# "No effect is needed" keeps most of the probability. What remains goes to effects that these
# tests could not see if they were there and small: that is what the last lines of the summary
# are for.

for explanation in diagnosis.explanations[:4]:
    named = " + ".join(explanation.effects) or "no effect is needed"
    print(f"{explanation.probability:6.1%}  {named}")
