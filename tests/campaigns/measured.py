"""Measured campaigns, and the same with a logged fault of the rig in one record."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from probation import Campaign
from probation_studies.blind.inject import Injection, inject

DATA = Path(__file__).parents[2].parent / "shared" / "data"

FILES = {
    "etfe": (("etfe/OUTRaw_MD_CSR_01_T40.csv",), 2),
    "vhb": (("vhb4910/0d01_3d0.csv", "vhb4910/0d03_2d0_1.csv", "vhb4910/0d05_2d5_1.csv"), 8),
    "rtv615": (("silicones/RTV615.csv",), 1),
    "dragon-skin": (("silicones/Dragon Skin 30.csv",), 1),
}
"""Files of each material, and one of how many samples is kept."""

SIZES = {
    "etfe": {
        "force_offset": (0.25, 0.6, 2.0),
        "force_drift": (0.3, 0.8, 3.0),
        "force_gain": (0.02, 0.04, 0.1),
        "force_strain_lag": (1.2, 3.0, 6.0),
        "slack": (0.002, 0.005, 0.02),
        "machine_compliance": (6e-5, 1.2e-4, 2.5e-4),
    },
    "vhb": {
        "force_offset": (3e-4, 1e-3, 5e-3),
        "force_drift": (3e-4, 1e-3, 5e-3),
        "force_gain": (0.005, 0.02, 0.1),
        "force_strain_lag": (0.16, 0.32, 0.96),
        "slack": (0.002, 0.01, 0.05),
        "machine_compliance": (0.05, 0.1, 0.3),
    },
    "rtv615": {
        "force_offset": (0.01, 0.03, 0.1),
        "force_drift": (0.02, 0.05, 0.2),
        "force_gain": (0.01, 0.03, 0.1),
        "force_strain_lag": (0.03, 0.1, 0.3),
        "slack": (0.005, 0.02, 0.05),
        "machine_compliance": (0.003, 0.01, 0.02),
    },
    "dragon-skin": {
        "force_offset": (0.003, 0.02, 0.1),
        "force_drift": (0.005, 0.02, 0.1),
        "force_gain": (0.005, 0.02, 0.1),
        "force_strain_lag": (0.02, 0.1, 0.3),
        "slack": (0.002, 0.01, 0.05),
        "machine_compliance": (0.001, 0.005, 0.02),
    },
}
"""Small but detectable, medium and plain, by material and fault; units as `probation_studies.blind.inject.UNITS`."""

EFFECT = {"slack": "strain_offset"}
"""The fault's name in the catalogue, where it is another."""


def measured(material, every=None):
    """The campaign of a material, thinned; each record names its specimen, so that another of that name is the same."""
    files, usual = FILES[material]
    whole = Campaign.from_files([DATA / name for name in files], control="displacement-rate", name=material)
    whole = replace(whole, records=tuple(replace(each, specimen_id=each.id) for each in whole.records))
    return thinned(whole, every or usual)


def thinned(campaign, every, first=0):
    """One of `every` samples from the `first` on; the first of all samples stays: there the specimen is relaxed."""

    def taken(record):
        kept = np.union1d([0], np.arange(first, len(record), every))
        return with_samples(record, record.time[kept], record.true_strain[kept], record.true_stress[kept])

    return replace(campaign, records=tuple(taken(record) for record in campaign.records))


def with_samples(record, time, true_strain, true_stress):
    """The record with other samples and nothing beside them."""
    nothing = {"strain_rate": None, "transverse_strain": None, "temperature": None, "sha256": ""}
    return replace(record, time=time, true_strain=true_strain, true_stress=true_stress, **nothing)


def injected(campaign, done):
    """The campaign with one record as the fault would have recorded it."""
    records = [
        with_samples(each, *inject(each.time, each.true_strain, each.true_stress, done))
        if each.id == done.record
        else each
        for each in campaign.records
    ]
    return replace(campaign, name=f"{campaign.name}, later", records=tuple(records))


def drawn(campaign, material, fault, size, rng):
    """An injection of about that size into one of the records, of either sign where the fault has one."""
    record = campaign.records[rng.integers(len(campaign.records))]
    amount = SIZES[material][fault][size] * np.exp(rng.uniform(-0.2, 0.2))
    if fault in ("force_offset", "force_drift", "force_gain"):
        amount *= rng.choice([-1.0, 1.0])
    if fault == "force_strain_lag":  # whole samples keep the noise as it is
        step = float(np.median(np.diff(record.time)))
        amount = max(round(amount / step), 1) * step if amount > 0.5 * step else amount
    return Injection(record.id, fault, float(amount), int(rng.integers(1 << 31)))


def told(found, campaign, done):
    """Whether cause and record were named, whether the answer set holds them, and the size is in its interval."""
    effect = EFFECT.get(done.fault, done.fault)
    truth = ((effect,), (done.record,))
    best = found.best
    named = (best.effects, best.records) == truth
    held = truth in [(each.effects, each.records) for each in found.answer_set]
    mine = next((each for each in found.explanations if (each.effects, each.records) == truth), None)
    covered = value = None
    if mine is not None and mine.parameters:
        size = mine.parameters[0]
        scale = 1.0
        if size.name == "drift_MPa_per_s":
            time = campaign.record(done.record).time
            scale = float(time[-1] - time[0])
        low, high = (scale * end for end in size.interval95)
        covered, value = bool(low <= done.size <= high), scale * size.value
    return {
        "named": named,
        "record": best.records == (done.record,),
        "held": held,
        "covered": covered,
        "value": value,
        "probability": best.probability,
        "answer": "+".join(best.effects) or "nothing",
    }
