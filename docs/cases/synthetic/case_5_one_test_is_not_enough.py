"""
One test is not enough
======================

**Measured:** one fast tension test.

**The law missed:** a tenth of a megapascal, twice the noise, at the end of the record.

**It was:** self-heating. But several effects soften a fast test at large strains, and one
record cannot choose between them. The diagnosis says which they are, and which test would
decide.
"""

import numpy as np

import probation
from probation.report.diagnosis_figures import probability_figure

relation = {"slope": 0.00464, "intercept": 0.0367}
law = probation.Law(
    unrelaxed_modulus=3220.0,
    alpha=1.0,
    hardening_modulus=1.8,
    companion=probation.Weissenberg(**relation),
)
warming = probation.Modification(
    feedbacks=(
        probation.SelfHeating(
            heating=0.03, cooling_rate=0.002, softening=0.1, hardening_loss=0.004
        ),
    )
)
test = probation.named_history("ramp", rate=5e-3, strain=0.8, samples=401)
noise = np.random.default_rng(6)
stress = law.stress(test.time, test.true_strain, scheme="sa3", modification=warming)
campaign = probation.Campaign.from_arrays(
    test.time,
    true_strain=test.true_strain,
    true_stress=stress + noise.normal(0.0, 0.04, len(test.time)),
    record="fast",
    control="strain-rate",
    law=probation.LawSettings(
        companion=probation.CompanionSettings("weissenberg", relation),
        fixed={"unrelaxed_modulus_MPa": 3220.0},
    ),
    name="one-test",
    specimens=probation.Specimens("none"),  # virtual specimens are alike
)
diagnosis = probation.diagnose(
    campaign,
    effects=[
        "self_heating",
        "stress_activated_flow",
        "damage",
        "spectrum_shape",
        "rate_dependent_hardening",
    ],
)
print(diagnosis.headline)

# %%
# sphinx_gallery_thumbnail_number = 1
probability_figure(diagnosis)

# %%
# All starred names are the answer. Choosing the first would be a guess. The next test, ranked
# by what it would tell:

print(diagnosis.next_test.what if diagnosis.next_test else "the best explanation stands alone")

# %%
# :doc:`/isolability` says beforehand, without any record, which effects planned tests can
# separate.
