"""
A law of your own
=================

*Your material has another law, and you have it as a Python function. You want to know whether
it holds on your tests and, if not, what it leaves out.*

``diagnose`` takes any law that gives the stress along a strain history. Its parameters are
identified on your records, a test that was not fitted is predicted, and the catalogue of
effects is searched for what is missing. ``fit``, ``certify`` and ``export`` take the built-in
law alone.
"""

# %%
# The law
# -------
#
# A *standard linear solid*: a spring in parallel with a Maxwell element, the simplest solid
# that relaxes. A law is a function of time [s], true strain, its parameters in an order of
# yours, and a ``modification``. It gives the true stress [MPa], one value for each sample.
#
# The modification is what makes a diagnosis of the material possible: it says what an
# effect changes. Here the law lets the load-bearing area shrink, which is what damage does.
# That takes one line, and the law says so in its ``capabilities``. A law without any is
# diagnosed, too, but only for faults of the rig.

import matplotlib.pyplot as plt
import numpy as np

import probation
from probation.report.diagnosis_figures import probability_figure
from probation.report.residual_map import residual_map


def solid_stress(time, true_strain, parameters, modification):
    """True stress of the solid [MPa]."""
    spring, modulus, relaxation_time = parameters
    element = np.zeros_like(true_strain)
    for i in range(1, len(time)):  # exact where the strain is linear between samples
        step = (time[i] - time[i - 1]) / relaxation_time
        rise = modulus * (true_strain[i] - true_strain[i - 1]) / step
        element[i] = element[i - 1] * np.exp(-step) - rise * np.expm1(-step)
    stress = spring * true_strain + element
    area = modification.load_bearing_area  # None: nothing changes it
    return stress if area is None else area * stress


law = probation.CallableLaw(
    solid_stress,
    names=("spring_MPa", "modulus_MPa", "relaxation_time_s"),
    starts=(50.0, 500.0, 10.0),
    lower=(0.0, 0.0, 0.1),
    upper=(1e4, 1e4, 1e4),
    capabilities=frozenset({"load_bearing_area"}),
)

# %%
# Your records
# ------------
#
# Yours come from files (``probation.Campaign.from_files``, or ``probation init`` in a
# terminal). To know what the answer should be, this page makes its own: the same solid
# pulled at four rates, once as it is, and once with damage that starts with the first
# strain. All have noise of 0.05 MPa. One test is *held out*: it is only predicted.

RATES = {"slowest": 1e-3, "slow": 3e-3, "fast": 1e-2, "fastest": 3e-2}  # [1/s]
TRUTH = (40.0, 800.0, 12.0)


def campaign(name, area_lost):
    """Four tests of one material, whose area shrinks to exp(-area_lost) of its own."""
    random = np.random.default_rng(1)
    time = {test: np.linspace(0.0, 0.5 / rate, 301) for test, rate in RATES.items()}
    strain = {test: rate * time[test] for test, rate in RATES.items()}
    stress = {}
    for test, e in strain.items():
        damage = probation.Modification(
            load_bearing_area=np.exp(area_lost * np.expm1(-e / 0.2))
        )
        exact = solid_stress(time[test], e, TRUTH, damage)
        stress[test] = exact + random.normal(0.0, 0.05, len(e))
    return probation.Campaign.from_arrays(
        np.concatenate(list(time.values())),
        true_strain=np.concatenate(list(strain.values())),
        true_stress=np.concatenate(list(stress.values())),
        record=np.repeat(list(RATES), 301),
        control="strain-rate",
        role={test: "held-out" if test == "slow" else "identify" for test in RATES},
        specimens=probation.Specimens("none"),  # these specimens are alike
        name=name,
    )


sound, damaged = campaign("sound", 0.0), campaign("damaged", 0.3)

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for number, test in enumerate(RATES):
    for tests, line in ((sound, "-"), (damaged, "--")):
        record = next(record for record in tests.records if record.id == test)
        axes.plot(
            record.true_strain,
            record.true_stress,
            line,
            color=f"C{number}",
            label=f"{test}, {tests.name}",
        )

axes.set(xlabel="true strain [–]", ylabel="true stress [MPa]")
axes.legend(ncols=2, fontsize="small")

# %%
# Does the law hold?
# ------------------
#
# Where it does, the answer is short, and the parameters come with their standard errors.
# They are those that made the records.

holds = probation.diagnose(sound, law=law)
print(holds.headline)
for parameter in holds.base:
    print(f"{parameter.name:18} {parameter.value:8.3f} ± {parameter.se:.3f}")
# > No gap: the law describes all 3 records and predicts those held out to within the noise
# > spring_MPa           39.982 ± 0.021
# > modulus_MPa         799.973 ± 0.073

# %%
# What does it leave out?
# -----------------------
#
# The same law on the other material. Each strip is a record, from its start to its end:
# blue where the law is too low, orange where it is too high, pale where only noise is left.
# The thin strips are what remains with the best explanation. A box marks where the law departs,
# with its share of the squared gap.

diagnosis = probation.diagnose(damaged, law=law)
print(diagnosis.headline)
# > Damage may explain the gap: with it the misfit falls from 2.89 to 0.0499 MPa
residual_map(diagnosis)

# %%
# Only effects that the law can follow were compared with the faults of the rig. This law
# follows one field, so most effects of the material were not tried: they count as unknown, and
# the headline says "may". Of a law that follows more, more can be said. A bar is one
# explanation.

probability_figure(diagnosis)

# %%
# The verdict on the explanation is the test that was held out: nothing was fitted to it.

shrink = diagnosis.shrink.held_out
print(f"{shrink.before_MPa:.2f} → {shrink.after_MPa:.3f} MPa, noise {shrink.noise_MPa:.3f} MPa")
# > 2.34 → 0.049 MPa, noise 0.048 MPa

# %%
# Everything else that a diagnosis has is here, too: ``diagnosis.report("mine.html")``
# writes the page, ``diagnosis.to_json()`` the numbers.
#
# What to remember
# ----------------
#
# - A function, names, starts and bounds are enough. A start should be of the right order of
#   magnitude.
# - Each capability opens effects of the material: ``load_bearing_area`` damage and
#   softening, ``unrelaxed_modulus_factor`` a stiffness that changes.
#   ``probation.Modification`` lists them all.
# - Probabilities were calibrated with the built-in law. With another the summary says so:
#   trust held-out records more.
#
# Next
# ----
#
# - An effect of your own: :doc:`/recipes`.
# - What the answer rests on: :doc:`/diagnosis-method`.
