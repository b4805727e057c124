"""
Relaxation follows the rate
===========================

**Measured:** a specimen of polyethylene between grips at 0.02 mm/s. It necks, and the strain
rate in the neck rises from 4e-4 to 4e-3 1/s and falls again. A second test at 0.08 mm/s is held
out.

**The law missed:** with a constant relaxation time, the stress by up to 19 MPa.

**It was:** a relaxation time that falls as the rate rises. This is the discovery of the paper
whose law this is; the records are made after its experiments 2 and 3.
"""

import probation
from probation.demo import diagnosis_campaign
from probation.report.diagnosis_figures import probability_figure
from probation.report.residual_map import residual_map

campaign = diagnosis_campaign()
diagnosis = probation.diagnose(campaign)
print(diagnosis.headline)

# %%
# The fitted law bends through the record: too low in the first tenth of the strain, too high
# around 0.8. The record that was held out shows what that bend is worth.

# sphinx_gallery_thumbnail_number = 1
diagnosis.plot()

# %%
residual_map(diagnosis)

# %%
# With the whole catalogue of effects considered, one name is left:

probability_figure(diagnosis)

# %%
# The exponent says how: with 0 the relaxation time is a constant, with 1 the Weissenberg number
# is. Its value here, 0.92, is what eq. (11) of the paper has. The next step is a companion
# relation of one's own: :doc:`/companion`.

for parameter in diagnosis.best.parameters:
    print(parameter.name, f"{parameter.value:.3f} ± {parameter.se:.3f}")
