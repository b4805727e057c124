"""
First identification
====================

*You have a file of a testing machine and want the parameters of the law, with standard errors.*

You will read a file, look at what was understood, identify the law, and learn to read the
answer. Everything here can be done from a terminal, too; each section names the command.
"""

# %%
# A file as a laboratory has it
# -----------------------------
#
# So that the tutorial needs no data, we write the file ourselves: time, crosshead displacement
# and force of a tension test, with the noise of a load cell. It is a made-up record whose truth
# we know: modulus 3220 MPa, relaxation time 5 s, hardening modulus 2.0 MPa. With a file of your
# own, start at the next section.

import shlex
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import probation
from probation.cli import main

gauge_length, area = 50.0, 40.0  # mm, mm²
truth = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.0, hardening_modulus=2.0)
test = probation.named_history("ramp", rate=0.005, strain=1.5, samples=801)
stress = truth.stress(test.time, test.true_strain, scheme="sa3")
stress += np.random.default_rng(1).normal(0.0, 0.04, stress.shape)

folder = Path(tempfile.mkdtemp())
file = folder / "tension-7.csv"
with file.open("w") as out:
    out.write("Time (s);Extension (mm);Load (N)\n")
    extension = gauge_length * np.expm1(test.true_strain)
    load = area * stress * np.exp(-test.true_strain)
    for row in zip(test.time, extension, load, strict=True):
        out.write("{:.3f};{:.6f};{:.4f}\n".format(*row))
print(file.read_text()[:120])

# %%
# How would this file be read?
# ----------------------------
#
# ``probation preview`` shows it before anything depends on it: the units, the columns, the
# first rows. Headings in several languages, decimal commas and the files of common machines are
# understood. What is unclear is refused in one line that says what to add. A notebook has no
# terminal, so we call the program's own entry point:


def terminal(command):
    """Do what that line would do in a terminal."""
    main(shlex.split(command)[1:])


terminal(f"probation preview {file} --specimen area_mm2=40 --specimen gauge_length_mm=50")

# %%
# Make a campaign
# ---------------
#
# A *campaign* is a folder with the files of all tests and a ``campaign.toml`` that says what no
# file says: here the section and the gauge length. ``probation init`` makes it, and asks for
# what it cannot know; with ``--yes`` it asks nothing. It also writes ``records.html``, with a
# plot of every record: open it.

terminal(
    f"probation init {file} -o {folder}/hdpe --yes --control strain-rate "
    "--specimen area_mm2=40 --specimen gauge_length_mm=50"
)
print((folder / "hdpe" / "campaign.toml").read_text())

# %%
# Identify
# --------
#
# In a terminal: ``probation fit hdpe/ --report fit.html``. In Python:

campaign = probation.Campaign.load(folder / "hdpe")
fit = probation.fit(campaign)
print(fit.summary())

# %%
# How to read it, from the top:
#
# - **The first sentence** says whether the law describes the record: what is left (the fit
#   residual) is compared with the noise, which is estimated from the record itself.
# - **The parameters** have standard errors, and a status. *Identifiable* means that the record
#   determines the parameter; *weakly identifiable* that its error is large; *not identifiable*
#   that it could be nearly anything.
# - **E_u·τ_max** is known better than either factor: the flow stress at small strain is their
#   product. Quote it.
#
# The truth lies within two standard errors, as it should in 95 of 100 such tests:

for name, true in (("unrelaxed_modulus", 3220.0), ("tau_max", 5.0), ("hardening_modulus", 2.0)):
    found = fit.parameters[name]
    off = (found.value - true) / found.se
    print(f"{name:18} {found.value:9.4f} ± {found.se:.4f}   off by {off:+.1f} se")

# %%
# Look at what is left
# --------------------
#
# A good fit leaves noise and nothing else. A wave in the lower picture means that the law
# misses something, and then standard errors say less than they seem to.

fit.plot()

# %%
# What if the law is wrong?
# -------------------------
#
# Take the same test on a material whose relaxation time changes with the strain rate, pulled at
# a varying rate. The fit still returns three numbers. The first sentence and the residual say
# that they are not to be trusted.

rated = probation.Law(
    unrelaxed_modulus=3220.0,
    alpha=1.0,
    hardening_modulus=2.0,
    companion=probation.Weissenberg(0.00464, 0.0367),
)
jump = probation.named_history("rate-jump", rate=0.002, factor=10, strain=0.8)
stress = rated.stress(jump.time, jump.true_strain, scheme="sa3")
stress += np.random.default_rng(2).normal(0.0, 0.04, stress.shape)
wrong = folder / "rate-jump.csv"
np.savetxt(
    wrong,
    np.column_stack([jump.time, jump.true_strain, stress]),
    delimiter=",",
    header="time_s,true_strain,true_stress_MPa",
    comments="",
)
misfit = probation.fit(probation.Campaign.from_files([wrong], control="strain-rate"))
print(misfit.verdict)

# %%
figure, axes = plt.subplots(figsize=(6.4, 3.0))
record = misfit.records["rate-jump"]
axes.plot(jump.true_strain, record.fit_residual)
axes.set(
    xlabel="true strain [–]",
    ylabel="model − measured [MPa]",
    title="Not noise: the law misses something",
)

# %%
# Keep it
# -------
#
# ``fit.report("fit.html")`` writes a page for colleagues, ``fit.to_json()`` the answer for
# programs.

# %%
# Next
# ----
#
# - Several tests driven otherwise: :doc:`tutorial_2_the_probation_test`.
# - The residual is a wave: :doc:`tutorial_3_why_does_my_law_fail`.
# - What the errors hold: :doc:`/uncertainty`.
