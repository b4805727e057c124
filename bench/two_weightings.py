"""How far apart are a fit's parameters and those of a diagnosis's base fit, and why?

`python -m bench.two_weightings`: single records, synthetic ones and, where they lie beside the checkout
(`shared/data`), measured ones of ETFE and VHB 4910; ten seconds. Both find parameters and noise in turns. Prints by
how many of the fit's standard errors the base fit's parameters are away, and its standard errors over the fit's; then
the same with the slow drift left out of the base fit's noise.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
import probation
from campaigns.measured import DATA
from probation._arrays import FloatArray
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.refit import Refit, refit
from probation.inference.thinning import thin
from probation.law.settings import CompanionSettings, LawSettings
from probation.published.experiments import experiment
from probation.records.reading import read_record

LAW = probation.Law(unrelaxed_modulus=3224.0, tau_max=5.207, hardening_modulus=2.556)
RATE, SAMPLES, NOISE = 0.005, 400, 0.04


def ramp(correlation: float, strain_noise: float) -> probation.Record:
    """A ramp with AR(1) noise of the stress and white noise of the strain."""
    rng = np.random.default_rng(0)
    time = np.linspace(0.0, 400.0, SAMPLES)
    noise = rng.standard_normal(SAMPLES)
    for index in range(1, SAMPLES):
        noise[index] = correlation * noise[index - 1] + np.sqrt(1.0 - correlation**2) * noise[index]
    strain = RATE * time + strain_noise * rng.standard_normal(SAMPLES)
    stress = probation.ramp_stress(LAW, RATE, time) + NOISE * noise
    return probation.Record("ramp", time, strain, stress, control="strain-rate")


def measured(path: str, specimen: int | None = None) -> probation.Record:
    """A measured record."""
    record = read_record(DATA / path, specimen_index=specimen)
    return record[0] if isinstance(record, (list, tuple)) else record


PRINTED = LawSettings(companion=CompanionSettings("weissenberg", {"slope": 0.00464, "intercept": 0.0367}))
RECORDS: dict[str, tuple[Callable[[], probation.Record], LawSettings]] = {
    "ramp, white noise": (lambda: ramp(0.0, 0.0), LawSettings()),
    "ramp, AR(1) 0.7": (lambda: ramp(0.7, 0.0), LawSettings()),
    "ramp, AR(1) 0.5, strain 5e-4": (lambda: ramp(0.5, 5e-4), LawSettings()),
    "synthetic experiment 2": (lambda: experiment(2).record(), PRINTED),
    "ETFE, specimen 1": (lambda: measured("etfe/OUTRaw_MD_CSR_01_T40.csv", 1), LawSettings()),
    "VHB 4910, 0.03 1/s": (lambda: measured("vhb4910/0d03_3d0.csv"), LawSettings()),
}


def errors_of(found: Refit) -> FloatArray:
    """Standard errors of a base fit's parameters, by its noise alone."""
    covariance = np.linalg.pinv(found.jacobian.T @ found.jacobian)
    return np.asarray(np.sqrt(np.diag(covariance)) * found.coordinates.slopes(found.parameters))


def main() -> None:
    """Run."""
    print(f"{'':30} away, in standard errors of the fit: E_u, tau_max or alpha, G; error over the fit's")
    for name, (make, law) in RECORDS.items():
        try:
            record = make()
        except probation.InputError:
            continue
        alone = probation.Campaign("one", (record,), law, specimens=probation.Specimens("none"))
        fit = probation.fit(alone, "sa3", gap=False)
        few = thin(alone)[0]
        base = base_fit(few, plain_fit(few))
        still = [replace(noise, drift=None, nuisance_drift=None) for noise in base.problem.whitener.noises]
        own = np.array([fit.parameters[each].se or np.nan for each in fit.law.parameter_names])
        for label, found in (
            (name, base.refit),
            ("   without the drift", refit(base.problem.with_noises(still), base.parameters)),
        ):
            away, ratio = (found.parameters - fit.law.parameters) / own, errors_of(found) / own
            print(f"{label:30}", " ".join(f"{value:+6.2f}" for value in away), "; ", end="")
            print(" ".join(f"{value:6.3f}" for value in ratio))


if __name__ == "__main__":
    main()
