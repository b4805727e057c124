"""
Why does my law fail?
=====================

*The fit leaves a wave, or a test is not predicted. You want to know what the law leaves out: a
mechanism of the material, or a fault of the rig?*

``diagnose`` answers four questions in turn. Is there a gap beyond the noise? Where is it? Which
effect explains it, and which others cannot be ruled out? How far does the gap shrink with it,
in records that were held out, too?
"""

# %%
# A campaign with a cause that we know
# ------------------------------------
#
# Four tests of a material that warms: plastic work turns into heat, the specimen relaxes faster
# and hardens less. The law that will be identified knows nothing of heat. Only the slowest test
# stays nearly cool. One test is held out.

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np

import probation
from probation.report.diagnosis_figures import probability_figure
from probation.report.residual_map import residual_map

relation = probation.Weissenberg(0.00464, 0.0367)
law = probation.Law(
    unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=relation
)
warming = probation.Modification(
    feedbacks=(
        probation.SelfHeating(
            heating=0.05, cooling_rate=0.004, softening=0.1, hardening_loss=0.004
        ),  # °C/MPa, 1/s, 1/°C, 1/°C
    )
)
load_cell = 0.3  # MPa, standard deviation of its noise
tests = {
    "ramp-slow": probation.named_history("ramp", rate=5e-4, strain=1.2, samples=401),
    "ramp-fast": probation.named_history("ramp", rate=5e-3, strain=1.2, samples=401),
    "grips-slow": probation.named_history("necking", grip_speed=0.02, samples=401),
    "grips-fast": probation.named_history("necking", grip_speed=0.08, samples=401),
}
folder = Path("tutorial-3/warm")  # in the present folder; made anew each time
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
noise = np.random.default_rng(0)
text = [
    'name = "warm"',
    "[law.companion]",
    'form = "weissenberg"',
    "slope = 0.00464",
    "intercept = 0.0367",
    "[specimens]",
    'scatter = "none"',  # made up, so alike; leave it out for real specimens, which differ
]
for name, test in tests.items():
    history = probation.StrainHistory(test.time, test.true_strain, strain_rate=test.strain_rate)
    stress = law.stress(history, scheme="sa3", modification=warming) + noise.normal(
        0.0, load_cell, len(test.time)
    )
    table = np.column_stack([test.time, test.true_strain, stress])
    np.savetxt(
        folder / f"{name}.csv",
        table,
        delimiter=",",
        header="time_s,true_strain,true_stress_MPa",
        comments="",
    )
    text += ["[[record]]", f'id = "{name}"', f'file = "{name}.csv"']
    text += [f'control = "{"strain-rate" if "ramp" in name else "displacement-rate"}"']
    text += [f'role = "{"held-out" if name == "grips-slow" else "identify"}"']

(folder / "campaign.toml").write_text("\n".join(text) + "\n")
campaign = probation.Campaign.load(folder)

# %%
# Is there a gap?
# ---------------
#
# In a terminal: ``probation diagnose tutorial-3/warm --report diagnosis.html``. The catalogue
# of effects (:doc:`/built/effects`) is searched. Here we compare five, which takes some
# seconds; leave ``effects`` out to compare all of them, which takes several times as long. A
# notebook shows a bar, and so does the command; a script can take ``progress=lambda part:
# print(f"{part:.0%}")``.

considered = [
    "self_heating",
    "stress_activated_flow",
    "rate_dependent_hardening",
    "damage",
    "force_gain",
]
diagnosis = probation.diagnose(campaign, effects=considered)
print(diagnosis.headline)
# > Self-heating explains the gap: with it the misfit falls from 1.2 to 0.3 MPa

# %%
# The headline is the answer in short. The rest says how it was reached, and how far to trust
# it.
#
# Where?
# ------
#
# One strip for each record, from its start to its end. Colour is the distance of the model from
# the record in standard deviations of noise, once each specimen has its own deviations: pale is
# noise, blue means that the model is too low, orange that it is too high. The thin
# strip below each is what remains with the best explanation. Frames mark the places of the gap,
# with the share of the squared gap that lies in each.

residual_map(diagnosis)

# %%
# The same as curves: every record measured, as the base law has it, and with the best
# explanation. On the right both errors in units of the noise; the grey band is two standard
# deviations, and the shaded parts are the places of the gap. In a script write
# ``diagnosis.plot().savefig("diagnosis.png")``.

diagnosis.plot()

# %%
# Which effect, and what else could it be?
# ----------------------------------------
#
# Every effect is refitted together with the law, because the parameters of the law bend to
# hide part of it. The probability weighs how well the effect explains the records against how
# many ways it has to do so. The starred lines are the *credible set*: these records do not
# distinguish them. The headline's probability is that the effect is *part* of the explanation,
# alone or with another; a bar is one explanation. So the first may be larger than any bar.
# What is left to it are pairs with a second effect too small to show: nothing speaks against
# them, nothing for them, and the set leaves them out.

probability_figure(diagnosis)

# %%
# *An effect outside the catalogue* is always among the candidates: it stands for a smooth
# deviation that no effect of the catalogue produces.
#
# How far does the gap shrink?
# ----------------------------
#
# An explanation that fits is not yet one that predicts. The record that was held out decides.

shrink = diagnosis.shrink
for where, closure in (
    ("fitted records", shrink.identify),
    ("held-out records", shrink.held_out),
):
    shrunk = f"{closure.before_MPa:6.2f} → {closure.after_MPa:.3f} MPa"
    print(f"{where:17} {shrunk}, noise {closure.noise_MPa:.3f} MPa")
# > fitted records      1.20 → 0.300 MPa, noise 0.303 MPa
# > held-out records    2.80 → 0.293 MPa, noise 0.277 MPa

# %%
# The name is sure; the sizes are less so: warming more and softening less look alike, so that
# softening is not determined by itself.

truth = {"heating": 0.05, "cooling_rate": 0.004, "softening": 0.1, "hardening_loss": 0.004}
for parameter, (name, true) in zip(diagnosis.best.parameters, truth.items(), strict=True):
    error = "not determined" if parameter.se is None else f"± {parameter.se:.2g}"
    print(f"{name:15} {parameter.value:.2g} {error}, put in: {true:g}")
# > heating         0.048 ± 0.022, put in: 0.05
# > softening       0.1 not determined, put in: 0.1


# %%
# Everything at once, as the terminal shows it:

print(diagnosis.summary())

# %%
# With fewer tests
# ----------------
#
# Suppose that only the fast ramp had been done. The same cause is in it, and the answer is
# another: several names are starred, and the program says which test would choose between them.

alone = tuple(record for record in campaign.records if record.id == "ramp-fast")
fewer = probation.diagnose(replace(campaign, records=alone), effects=considered)
print(fewer.headline)
print(fewer.next_tests[0].what)
for explanation in fewer.explanations[:3]:
    print(f"{explanation.probability:5.0%}  {' + '.join(explanation.effects)}")

# >   51%  self_heating
# >   28%  damage
# >    6%  unknown

# %%
# What to do with a name
# ----------------------
#
# - **Doubt it, and measure.** Self-heating can be seen by a thermocouple. A temperature column
#   in the files, or a repeat at a tenth of the rate, settles more than any probability.
# - **A fault of the rig**: mend the record or the rig, and test again.
# - **An effect of the material**: ``diagnosis.best`` holds its form and parameters, and the
#   predictions with it are in ``diagnosis.curves``. A fit without it is pulled by the gap: do
#   not quote its parameters.
#
# What to remember
# ----------------
#
# - Read the credible set, not the first line alone. Several names in it are one answer: these
#   tests cannot choose.
# - ``no_gap`` means that the noise hides whatever there is. ``unexplained`` means that the
#   catalogue has no name for it.
# - A warning says where the probabilities were not checked, as with one record alone or a gap
#   of a hundred times the noise. They give an order then rather than odds.
# - Trust held-out records more than probabilities.
# - An effect of the rig (force offset, compliance, a slipping grip) is looked for in the same
#   way as one of the material. :doc:`/built/cases/index` has both kinds.
#
# Next
# ----
#
# - What can these tests distinguish at all? ``probation diagnose tutorial-3/warm
#   --isolability``. What would planned ones? ``probation plan`` (:doc:`/isolability`).
# - How an answer is reached: :doc:`/diagnosis-method`; how often it is right:
#   :doc:`/blind-results`.
