"""
Into finite elements
====================

*You have an identified law and want it in a finite-element code, with an error that you know.*

There are two ways. A **format** that a code has already (Prony series, flow curves by rate)
takes part of the law, at a cost that is stated. A **user material** takes all of it: the C++
point of this package behind the interface of Abaqus, CalculiX, MGIS or plain C.
"""

# %%
# The law
# -------
#
# Usually it comes from a fit: ``probation fit hdpe-2020/ --json fit.json``, then ``probation
# export fit.json …``; in Python ``fit.law`` is the identified law. Here we write it down.

import matplotlib.pyplot as plt
import numpy as np

import probation

law = probation.Law(
    unrelaxed_modulus=3220.0,
    alpha=1.0,
    hardening_modulus=1.8,
    companion=probation.Weissenberg(0.00464, 0.0367),
)

# %%
# Fewer modes
# -----------
#
# The law has 50 modes, and each is a state variable at every integration point (six in three
# dimensions). Nine modes keep the stress within a thousandth.

modes, errors = [3, 4, 5, 6, 7, 9, 11], []
for count in modes:
    errors.append(probation.reduce_spectrum(modes=count).error)

figure, axes = plt.subplots(figsize=(6.4, 2.8), layout="constrained")
axes.semilogy(modes, errors, "o-")
axes.set(
    xlabel="modes kept", ylabel="relative error of the stress", title="What fewer modes cost"
)
print(f"{modes[-2]} modes: at most {errors[-2]:.1e} of the flow stress, on any history")
# > 9 modes: at most 5.5e-04 of the flow stress, on any history

# %%
# A file for a user material
# --------------------------
#
# In a terminal: ``probation export fit.json --format abaqus-umat --modes 9 -o hdpe.inp``. The
# file is read back from its own text and solved again; the error against the identified law is
# in its header. In Python ``card.text`` is the whole file, to be written where you want it.

card = probation.export(law, "abaqus-umat", name="hdpe", modes=9)
print(card.text[:2600])
# > ** probation 0.1.0: Abaqus *USER MATERIAL for the UMAT: the whole law
# > **   jump of the rate and an unloading, at 5e-05, 0.00071, 0.01 1/s: 0.0043
# > *USER MATERIAL, CONSTANTS=29, UNSYMM

# %%
# A file for a code without user materials
# ----------------------------------------
#
# A Prony series is linear viscoelasticity: it has one relaxation spectrum, at one strain rate,
# and no hardening. The header says what is lost. Do not use a Prony series away from the
# rate that it was made for: ten times slower, the stress is wrong by up to 82 %; ten times
# faster, by up to 370 %.

prony = probation.export(law, "abaqus-prony", name="hdpe", rate=0.005)
print(prony.summary())
# > Abaqus *VISCOELASTIC, TIME=PRONY: the linear part at one rate.
# > left out, on a ramp to strain 1.5 at 0.005 1/s, against the whole law: 27 MPa
# > at most (40 % of the largest stress)
# > left out, on a ramp to strain 1.5 at 0.0005 1/s, against the whole law: 50 MPa
# > at most (82 % of the largest stress)
# > left out, on a ramp to strain 1.5 at 0.05 1/s, against the whole law: 2.7e+02
# > MPa at most (370 % of the largest stress)

# %%
# Compare before you trust
# ------------------------
#
# The stress of one element under the history that matters to you, by the exported modes and by
# the full law:

history = probation.named_history("necking", grip_speed=0.08, samples=401)
reduced = probation.Law(
    unrelaxed_modulus=3220.0,
    alpha=1.0,
    hardening_modulus=1.8,
    companion=probation.Weissenberg(0.00464, 0.0367),
    spectrum=probation.reduce_spectrum(modes=9).spectrum,
)
driven = probation.StrainHistory(
    history.time, history.true_strain, strain_rate=history.strain_rate
)
full = law.stress(driven, scheme="sa3")
short = reduced.stress(driven, scheme="sa3")
figure, (top, bottom) = plt.subplots(
    2, 1, figsize=(6.4, 4.2), sharex=True, height_ratios=(2, 1), layout="constrained"
)
top.plot(history.true_strain, full, label="50 modes")
top.plot(history.true_strain, short, "--", label="9 modes")
top.set_ylabel("true stress [MPa]")
top.legend()
bottom.plot(history.true_strain, short - full)
bottom.set(xlabel="true strain [–]", ylabel="difference [MPa]")
print(f"largest difference: {np.abs(short - full).max():.3f} MPa")
# > largest difference: 0.002 MPa

# %%
# The material point in three dimensions
# --------------------------------------
#
# The point works at finite strain. Here it is driven in isochoric tension, one increment after
# another, and compared with the law in one dimension. The same C++ is what Abaqus or CalculiX
# call. It takes one step of second order for an increment, as the scheme ``sa2`` of the library
# does (``sa3`` is of third order: :doc:`/schemes`). A polymer hardly changes its volume: a bulk
# modulus of 100 times the shear modulus, E_u/3, keeps that change below a hundredth of the
# elastic strain. A difference of some 10⁻³ MPa is below what a load cell tells.

from probation.fe.point import MaterialPoint

point = MaterialPoint.from_law(law, bulk_modulus=100 * 3220.0 / 3)  # MPa
state, axial = None, [0.0]
for strain, dt in zip(history.true_strain[1:], np.diff(history.time), strict=True):
    stretch = np.exp(strain)
    gradient = np.diag([stretch, stretch**-0.5, stretch**-0.5])
    piola, _, state = point.first_piola(gradient[np.newaxis], dt, state, with_tangent=False)
    cauchy = piola[0] @ gradient.T
    axial.append(cauchy[0, 0] - cauchy[1, 1])

increments = law.stress(history.time, history.true_strain, scheme="sa2")
print(f"three dimensions less one: {np.abs(np.array(axial) - increments).max():.1e} MPa")
# > three dimensions less one: 2.8e-03 MPa

# %%
# A bar that necks
# ----------------
#
# With felupe (``pip install 'probation[fe]'``) the point drives a whole bar: a round specimen,
# a section 2 % smaller in its middle, grips at constant speed. The mesh is coarse, so that this
# page is built in seconds. ``centre_strain`` is the true strain in the middle at which it ends.
# The force has a maximum; there the neck begins. It then grows along the bar, while the ends
# hardly deform any more.

from probation.fe.bar import Bar
from probation.fe.neck import neck

bar = Bar(elements=(12, 1), centre_strain=1.2, largest_step=0.02)
necking = neck(point, bar)
figure, (left, right) = plt.subplots(1, 2, figsize=(8.0, 3.0), layout="constrained")
left.plot(necking.nominal_strain, necking.nominal_stress)
left.set(
    xlabel="nominal strain [–]", ylabel="nominal stress [MPa]", title="What the machine sees"
)
right.plot(*necking.outline, color="C0")
right.plot(necking.outline[0], -necking.outline[1], color="C0")
right.set(
    xlabel="along the bar [mm]", ylabel="radius [mm]", title="The bar at the end (half of it)"
)
right.set_aspect("equal")
top_of_force = np.argmax(necking.nominal_stress)
print(f"the neck begins at a nominal strain of {necking.nominal_strain[top_of_force]:.3f},")
print(f"under {necking.nominal_stress[top_of_force]:.1f} MPa")
# > the neck begins at a nominal strain of 0.067,
# > under 25.5 MPa

# %%
# Next
# ----
#
# - Constants, state, tangents, increments, Abaqus, CalculiX and MGIS: :doc:`/finite-elements`.
# - What each format errs by: :doc:`/export`.
# - Check your own constants in the compiled routines: ``probation_point_check``, a program that
#   comes with the C++ build (:doc:`/finite-elements`), not with ``pip install``.
