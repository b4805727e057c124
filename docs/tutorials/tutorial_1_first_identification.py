"""
First identification
====================

*You have a file of a testing machine and want the parameters of the law, with standard errors.*

The law has three parameters: the unrelaxed modulus E_u, the longest relaxation time τ_max and
the hardening modulus G (:doc:`/law`). You will read a file, look at what was understood,
identify the law, and learn to read the answer. A terminal will do for most of it: the commands
stand beside.
"""

# %%
# A file as a laboratory has it
# -----------------------------
#
# So that the tutorial needs no data, we write the file ourselves: time, elongation of the gauge
# length and force of a tension test at a constant rate of the true strain, with the noise of a
# load cell. It is a made-up record whose truth we know: E_u 3220 MPa, τ_max 5 s, G 2.0 MPa.
# With a file of your own, keep the imports and the lines of ``folder``, set
# ``file = Path("yours.csv")`` and leave the rest of this block out; area and gauge length are
# those of your specimen.

import shlex
import shutil
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

folder = Path("tutorial-1")  # in the present folder; made anew each time
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir()
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

# ``--control`` says how the test was driven: here at a constant true strain rate. A machine
# whose crosshead moves at constant speed is ``displacement-rate``. Plots and warnings use it;
# the strain itself always comes from the file.

terminal(
    f"probation init {file} -o {folder}/hdpe --yes --control strain-rate "
    "--specimen area_mm2=40 --specimen gauge_length_mm=50"
)
print((folder / "hdpe" / "campaign.toml").read_text())

# %%
# One warning comes with every record of force and displacement: *true stress made from force by
# constant volume*. The section is taken to shrink as the specimen grows longer, everywhere
# alike. A specimen that necks does not obey: it may neck from the largest force on, here at a
# strain of 0.08. This made-up one does not. Of a real one the strain must then come from the
# neck itself, by an extensometer or a camera, or the record must end there (:doc:`/lab-files`).
# And where the crosshead alone tells the elongation, the frame's own is in it, and E_u comes
# out too small.

# %%
# Identify
# --------
#
# In a terminal: ``probation fit tutorial-1/hdpe --report fit.html``. In Python:

campaign = probation.Campaign.load(folder / "hdpe")
fit = probation.fit(campaign)
print(fit.summary())
# > hdpe: All parameters are identifiable; the law describes the records to within their noise.
# > E_u [MPa]  3219.4 ± 3.1 (0.095 %)
# > τ_max [s]  5.0008 ± 0.0049 (0.097 %)

# %%
# How to read it, from the top:
#
# - **The first sentence** says whether the law describes the record: what is left (the fit
#   residual) is compared with the noise, which is estimated from the record itself.
# - **The parameters** have standard errors, and a status. *Identifiable* means that the record
#   determines the parameter; *weakly identifiable* that its error is large; *not identifiable*
#   that it could be nearly anything.
# - **be2, 9 steps** is how the law was solved: an implicit scheme of second order, with so many
#   steps from sample to sample that its error stays below the noise. **start exponential**:
#   its first step is an exponential one (:doc:`/schemes`).
# - The **condition number of the scaled Jacobian** says how far the parameters can replace each
#   other: 1 where they cannot at all; some tens are usual; thousands say that two do nearly the
#   same.
# - **E_u·τ_max** is known better than either factor: at a given rate the flow stress at small
#   strain is in proportion to it. Quote it beside them.
# - **They are of the specimens that were tested**: the errors hold for this specimen. How far
#   another one differs, one specimen cannot tell; put several into one campaign.
#
# Each true value lies within two standard errors, as it should in 95 of 100 such tests:

for name, true in (("unrelaxed_modulus", 3220.0), ("tau_max", 5.0), ("hardening_modulus", 2.0)):
    found = fit.parameters[name]
    off = (found.value - true) / found.se
    print(f"{name:18} {found.value:9.4f} ± {found.se:.4f}   off by {off:+.1f} se")
# > unrelaxed_modulus  3219.3755 ± 3.0695   off by -0.2 se
# > tau_max               5.0008 ± 0.0049   off by +0.2 se
# > hardening_modulus     1.9997 ± 0.0003   off by -1.1 se


# %%
# Look at what is left
# --------------------
#
# A good fit leaves noise and nothing else. A wave in the lower picture means that the law
# misses something, and then standard errors say less than they seem to. In a notebook the
# figure shows itself. In a script write ``fit.plot().savefig("fit.png")``, or
# ``fit.plot().show()`` for a window.

fit.plot()

# %%
# What if the law is wrong?
# -------------------------
#
# Take another test, in which the rate jumps tenfold, on a material whose relaxation time
# changes with the strain rate. The fit still returns three numbers. The first sentence and the
# residual say that they are not to be trusted.

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
for name, found in misfit.parameters.items():
    error = "at its bound" if found.se is None else f"± {found.se:.2g}"
    print(f"{name:18} {found.value:9.4g} {error:12} {found.status}")
# > the law leaves a bias of 16.1 MPa (36 % of the largest stress), 383 times the noise.
# > unrelaxed_modulus      91.77 ± 2.9e+02    not_identifiable
# > tau_max             1.75e+05 at its bound not_identifiable
# > hardening_modulus          0 at its bound not_identifiable


# %%
figure, axes = plt.subplots(figsize=(6.4, 3.0), layout="constrained")
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
