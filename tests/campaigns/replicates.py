"""Campaigns of specimens that differ, by the engine's own law."""

import numpy as np

from probation import Campaign, Law, Record, Specimens, Weissenberg
from probation.law.settings import CompanionSettings, LawSettings

LAW = Law(
    unrelaxed_modulus=3000.0, alpha=1.0, hardening_modulus=2.5, companion=Weissenberg(slope=0.0041, intercept=0.0444)
)
SETTINGS = LawSettings(companion=CompanionSettings("weissenberg", {"slope": 0.0041, "intercept": 0.0444}))
RATES = (2e-3, 5e-4, 8e-3)
NOISE = 0.04
SCATTER = {
    "unrelaxed_modulus_MPa": 0.02,
    "alpha": 0.03,
    "hardening_modulus_MPa": 0.03,
    "area": 0.01,
    "strain_offset": 1e-3,
}


def replicates(seed, count=3, rates=RATES, samples=300, scatter=SCATTER, specimens="estimate"):
    """`count` specimens at each rate; each differs in the law's parameters, its section and the start of its strain."""
    rng = np.random.default_rng(seed)
    records = []
    for rate in rates:
        for copy in range(count):
            away = {name: size * rng.standard_normal() for name, size in scatter.items()}
            strain = np.linspace(0.0, 1.0, samples)
            time = strain / rate
            own = LAW.with_parameters(LAW.parameters * (1.0 + np.array(list(away.values())[:3])))
            # Strained from a strain of its own on: before it the specimen is slack, or was strained already.
            seen = strain - away["strain_offset"] * (np.arange(samples) > 0)
            stress = (1.0 + away["area"]) * own.stress(time, np.maximum(seen, 0.0), scheme="sa3")
            stress += NOISE * rng.standard_normal(samples)
            records.append(Record(f"{rate:g}-{copy + 1}", time, strain, stress, control="strain-rate"))
    return Campaign("replicates", tuple(records), SETTINGS, Specimens(specimens))
