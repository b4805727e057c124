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
# and hardens less. The law that will be identified knows nothing of heat. Slow tests stay cool,
# fast ones do not. One test is held out.

import tempfile
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
            heating=0.3, cooling_rate=0.004, softening=0.1, hardening_loss=0.004
        ),
    )
)
tests = {
    "ramp-slow": probation.named_history("ramp", rate=5e-4, strain=1.2, samples=401),
    "ramp-fast": probation.named_history("ramp", rate=5e-3, strain=1.2, samples=401),
    "grips-slow": probation.named_history("necking", grip_speed=0.02, samples=401),
    "grips-fast": probation.named_history("necking", grip_speed=0.08, samples=401),
}
folder = Path(tempfile.mkdtemp()) / "warm"
folder.mkdir()
noise = np.random.default_rng(0)
text = [
    'name = "warm"',
    "[law.companion]",
    'form = "weissenberg"',
    "slope = 0.00464",
    "intercept = 0.0367",
]
for name, test in tests.items():
    history = probation.StrainHistory(test.time, test.true_strain, strain_rate=test.strain_rate)
    stress = law.stress(history, scheme="sa3", modification=warming) + noise.normal(
        0.0, 0.04, len(test.time)
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
# In a terminal: ``probation diagnose warm/ --report diagnosis.html``. The catalogue holds 22
# effects (:doc:`/built/effects`). Here we compare five, so that this page is built quickly;
# leave ``effects`` out to compare all of them.

considered = [
    "self_heating",
    "stress_activated_flow",
    "rate_dependent_hardening",
    "damage",
    "force_gain",
]
diagnosis = probation.diagnose(campaign, effects=considered)
print(diagnosis.headline)

# %%
# The headline is the answer in short. The rest says how it was reached, and how far to trust
# it.
#
# Where?
# ------
#
# One strip for each record, from its start to its end. Colour is the distance of the model from
# the record in standard deviations of the noise: pale is noise, blue means that the model is
# too low, orange that it is too high. The thin strip below each is what remains with the best
# explanation.

residual_map(diagnosis)

# %%
# The same as curves: every record measured, as the base law has it, and with the best
# explanation. On the right both errors in units of the noise; the grey band is two standard
# deviations.

diagnosis.plot()

# %%
# Which effect, and what else could it be?
# ----------------------------------------
#
# Every effect is refitted together with the law, because the parameters of the law bend to hide
# part of it. The probability weighs how well the effect explains the records against how many
# ways it has to do so. The starred lines are the *95 % credible set*: what these records cannot
# tell apart.

probability_figure(diagnosis)

# %%
# "Unknown" is always among the candidates: it stands for a smooth deviation that no effect of
# the catalogue produces.
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

# %%
# Everything at once, as the terminal shows it:

print(diagnosis.summary())

# %%
# What to remember
# ----------------
#
# - Read the credible set, not the first line alone. Several names in it are one answer: these
#   tests cannot choose.
# - "No gap" means that the noise hides whatever there is. "Unexplained" means that the
#   catalogue has no name for it.
# - Trust held-out records more than probabilities.
# - An effect of the rig (force offset, compliance, a slipping grip) is looked for in the same
#   way as one of the material. :doc:`/built/cases/index` has both kinds.
#
# Next
# ----
#
# - Which test would decide? ``probation diagnose --isolability`` and :doc:`/isolability`.
# - How an answer is reached: :doc:`/diagnosis-method`; how often it is right:
#   :doc:`/blind-results`.
