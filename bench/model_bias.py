"""Do the errors that a certificate states hold the truth where the form of the law is wrong?

`python -m bench.model_bias`: 778 records of six strain histories (the paper's three, a ramp, a ramp with a hold, one
with an unloading) with noise of 0.04 MPa, on which the law misses a bias: none, a wave of 0.3 to 3 MPa, or an effect of
the catalogue of 0.5 or 2.5 MPa rms. Each is fitted alone. Prints how many of the parameters' 95 % intervals, noise and
model bias together, hold the truth, and the median of their standard errors; a minute.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

import probation
from probation.certificate.bias import model_bias
from probation.certificate.fits import free_parameters
from probation.effects.cause import Cause
from probation.effects.record_view import views_of
from probation.effects.registry import effect
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.law.settings import CompanionSettings, LawSettings
from probation.published.experiments import experiment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from probation._arrays import FloatArray

NOISE, DRAWS = 0.04, 6
LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.5)
MATERIAL = (
    "rate_dependent_hardening", "finite_extensibility", "spectrum_shape", "stress_activated_flow", "self_heating",
    "damage", "structural_softening", "slow_process", "delayed_hardening", "back_stress", "cell_hysteresis",
    "rate_dependent_relaxation",
)  # fmt: skip
RIG = (
    "force_offset", "force_drift", "force_gain", "force_strain_lag", "strain_offset", "machine_compliance",
    "prestress", "grip_slip",
)  # fmt: skip
SIZES = (0.5, 2.5)
"""Rms of an effect's stress [MPa]."""

WIDEST = 0.5
"""A wider relative error counts as this one: such a parameter is not tested."""


def tests() -> Iterator[tuple[str, FloatArray, FloatArray, probation.Law]]:
    """Name, time, strain and the true law."""
    for number in (1, 2, 3):
        twin = experiment(number)
        yield f"experiment-{number}", twin.time, twin.record().true_strain, twin.truth
    time = np.linspace(0.0, 150.0, 301)
    yield "ramp", time, 0.006 * time, LAW
    time = np.linspace(0.0, 300.0, 601)
    yield "hold", time, np.minimum(0.006 * time, 0.9), LAW
    yield "unload", time, np.where(time <= 150.0, 0.006 * time, 0.9 - 0.003 * (time - 150.0)), LAW


def biases(record: probation.Record, law: probation.Law, rng: np.random.Generator) -> Iterator[tuple[str, FloatArray]]:
    """Families of biases [MPa]: what the law misses."""
    clean = record.true_stress
    path = np.append(0.0, np.cumsum(np.abs(np.diff(record.true_strain))))
    path /= path[-1]
    for _ in range(DRAWS):
        yield "nothing", np.zeros_like(clean)
        sines = sum(rng.standard_normal() * np.sin(k * np.pi * path) for k in (1, 2, 3, 4))
        yield "four sines", sines / np.std(sines)
        for rise in (0.0, 0.02, 0.1):
            turns, phases = rng.uniform(0.5, 4.0, 3), rng.uniform(0.0, 2.0 * np.pi, 3)
            wave = np.sin(2.0 * np.pi * path[:, None] * turns + phases).sum(axis=1)
            wave *= -np.expm1(-path / rise) if rise else 1.0
            yield "waves, from the start" if rise == 0.0 else "waves that set in", 1.5 * wave / np.std(wave)
        onset = np.minimum(np.abs(clean) / np.median(np.abs(clean)), 1.0)
        for length in (0.05, 0.2):
            knots = np.linspace(0.0, 1.0, 120)
            covariance = np.exp(-0.5 * ((knots[:, None] - knots) / length) ** 2) + 1e-8 * np.eye(len(knots))
            draw = np.linalg.cholesky(covariance) @ rng.standard_normal(len(knots))
            wave = np.interp(np.linspace(0.0, 1.0, len(clean)), knots, draw) * onset
            yield f"Gaussian process, {length:g} of the record", wave * 10.0 ** rng.uniform(-0.5, 0.5)
    for family, names in (("effects of the material", MATERIAL), ("faults of the rig", RIG)):
        for name in names:
            for change in planted(record, law, name):
                yield family, change


def planted(record: probation.Record, law: probation.Law, name: str) -> Iterator[FloatArray]:
    """What an effect does to the stress, in every form that can be that large."""
    known = effect(name)
    base, views = DnlrLaw(law), views_of(probation.Campaign("one", (record,)), scheme="sa3")
    for form in known.forms:
        if form.needs is not None and not form.needs(views):
            continue
        model = CampaignModel(base, views, [Cause(known, form)])
        for size in SIZES:
            amplitude = form.typical[0] or 0.1
            for _ in range(12):
                amplitude = float(np.clip(amplitude, form.parameters[0].lower, form.parameters[0].upper))
                with np.errstate(all="ignore"):
                    values = model.parameters(base.start, [amplitude, *form.typical[1:]])
                    change = model.predict(values)[record.id] - record.true_stress
                rms = float(np.sqrt(np.mean(change**2)))
                if not np.isfinite(rms) or rms == 0.0:
                    break
                if abs(rms / size - 1.0) < 0.1:
                    yield change
                    break
                amplitude *= float(np.clip(size / rms, 0.1, 10.0))


def judged(record: probation.Record, law: probation.Law) -> tuple[FloatArray, FloatArray]:
    """Deviations from the truth and standard errors of a fit, both over the values, shape (3,)."""
    companion = None
    if law.companion is not None:
        parameters = {"slope": law.companion.slope, "intercept": law.companion.intercept}
        companion = CompanionSettings(law.companion.form, parameters)
    alone = probation.Campaign("one", (record,), LawSettings(companion=companion))
    found = probation.fit(alone, "sa2", method="variable-projection", substeps=1, gap=False)
    own = np.array([found.parameters[name].se or np.inf for name in found.law.parameter_names])
    bias = np.diag(model_bias(found.records[record.id], free_parameters(found)).covariance)
    values = found.law.parameters
    size = np.maximum(np.abs(values), 1e-300)
    return np.abs(values - law.parameters) / size, np.minimum(np.sqrt(own**2 + bias) / size, WIDEST)


def main() -> None:
    """Run."""
    results: dict[str, list[tuple[FloatArray, FloatArray]]] = {}
    for name, time, strain, law in tests():
        rng = np.random.default_rng(len(name))
        clean = law.stress(time, strain, scheme="sa3")
        record = probation.Record(name, time, strain, clean)
        for family, bias in biases(record, law, rng):
            noisy = replace(record, true_stress=clean + bias + NOISE * rng.standard_normal(len(clean)), sha256="")
            results.setdefault(family, []).append(judged(noisy, law))
    print(f"{'what the law misses':34} records  truth held  median standard error of E_u, tau_max or alpha, G")
    for family, cases in results.items():
        off, error = (np.array(side) for side in zip(*cases, strict=True))
        widths = "".join(f"{100.0 * width:8.2f} %" for width in np.median(error, axis=0))
        print(f"{family:34} {len(cases):7} {np.mean(off <= 1.96 * error):11.2f}{widths}")


if __name__ == "__main__":
    main()
