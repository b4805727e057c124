"""Table 2: longest relaxation time, Weissenberg number and G at five constant strain rates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.identify.fit import fit
from probation.law.modal import Law
from probation.law.ramp import ramp_stress
from probation.law.settings import LawSettings
from probation.published.experiments import SAMPLES, STRESS_NOISE
from probation.published.numbers import TABLE_1, TABLE_2, UNRELAXED_MODULUS, RateRow
from probation.records.campaign import Campaign
from probation.records.record import Noise, Record
from probation_studies.paper.exhibit import Comparison, Exhibit, Settings, compare

if TYPE_CHECKING:
    from probation.identify.result import Fit

END_STRAIN = 1.8


def exhibit(settings: Settings) -> Exhibit:
    """Identify ramps that were made with the table."""
    comparisons: list[Comparison] = []
    answer = {}
    for at, row in enumerate(TABLE_2):
        found = identified_ramp(row, [settings.seed, 20 + at])
        tau, hardening = found.parameters["tau_max"], found.parameters["hardening_modulus"]
        name = f"{row.strain_rate:g} 1/s"
        comparisons += [
            compare(f"τ_max at {name}", row.tau_max, tau.value, unit="s", spread=tau.se, put_in=True),
            compare(f"We at {name}", row.weissenberg, tau.value * row.strain_rate, put_in=True),
            compare(
                f"G at {name}", row.hardening_modulus, hardening.value, unit="MPa", spread=hardening.se, put_in=True
            ),
        ]
        answer[name] = found.to_dict()["parameters"]
    first, same = TABLE_1[2], next(row for row in TABLE_2 if row.strain_rate == 0.005)
    return Exhibit(
        title="Table 2: constant strain rates",
        says="τ_max identified at five strain rates falls from 420 to 3.2 s; We = τ_max·ε̇ grows from 0.021 to 0.032, "
        "and G from 1.53 to 2.46 MPa.",
        explanation="These tests (Blaise et al. 2016) were not published either, and the paper does not print their "
        f"E_u. The ramps here were made with the table's τ_max and G, E_u {UNRELAXED_MODULUS:g} MPa, and "
        f"{STRESS_NOISE:g} MPa of noise, and all three parameters identified: this says that such tests determine the "
        "table's numbers, each alone, and far better than the tests repeat. How well they repeat, the paper itself "
        f"shows: at 0.005 1/s experiment 1 has {first.time.value:g} s and {first.hardening_modulus.value:g} MPa where "
        f"Table 2 has {same.tau_max:g} s and {same.hardening_modulus:g} MPa.",
        comparisons=tuple(comparisons),
        answer={"identifications": answer},
    )


def identified_ramp(row: RateRow, seed: list[int]) -> Fit:
    """E_u, τ_max and G identified on a ramp made with a row of Table 2, by eq. (7)."""
    law = Law(unrelaxed_modulus=UNRELAXED_MODULUS, tau_max=row.tau_max, hardening_modulus=row.hardening_modulus)
    time = np.linspace(0.0, END_STRAIN / row.strain_rate, SAMPLES)
    noise = STRESS_NOISE * np.random.default_rng(seed).standard_normal(SAMPLES)
    record = Record(
        id=f"ramp-{row.strain_rate:g}",
        time=time,
        true_strain=row.strain_rate * time,
        true_stress=ramp_stress(law, row.strain_rate, time) + noise,
        control="strain-rate",
        noise=Noise(stress_MPa=STRESS_NOISE),
    )
    return fit(Campaign(name=record.id, records=(record,), law=LawSettings()), gap=False)
