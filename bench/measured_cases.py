"""Measured records whose cause is known: is it named, and how large?

python -m bench.measured_cases [CASE ...] [--json FILE]

A metal stage beside a video, a steel's cycles with a thermometer, gross faults put into measured polymers, and repeats
of a test, in which nothing changed. Records lie beside the checkout (`shared/data`). Prints the table of
docs/measured-cases.md.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from campaigns import measured
from probation import CallableLaw, Campaign, Reference, Specimens, compare, diagnose
from probation.records.reading import read_record
from probation.records.record import Record
from probation_studies.blind.inject import Injection

DATA = measured.DATA
MODULUS_OF_STEEL, MODULUS_OF_TITANIUM = 200e3, 60e3
"""Starts [MPa]."""


@dataclass(frozen=True)
class Row:
    """One case: what is known, what is answered."""

    case: str
    known: str
    answer: str
    size: str
    seconds: float


def isotropic_metal(modulus: float) -> CallableLaw:
    """Voce's plasticity without back stress: |s - X| <= s_y + Q (1 - e^(-b p)), X only if an effect gives one.

    Parameters
    ----------
    modulus : float [MPa]
        Where the search begins.
    """

    def stress(time, strain, parameters, modification):
        young, yield_stress, gain, rate = parameters
        shift = np.broadcast_to(_or(modification.added_relaxed_stress, 0.0), len(strain)).tolist()
        young_now = np.broadcast_to(young * _or(modification.unrelaxed_modulus_factor, 1.0), len(strain))
        moduli, steps = young_now.tolist(), np.diff(strain, prepend=strain[0]).tolist()
        now, hardened, found = 0.0, 0.0, []
        for step, back, e in zip(steps, shift, moduli, strict=True):
            trial = now + e * step - back
            size = abs(trial)
            limit = yield_stress + gain * (1.0 - np.exp(-rate * hardened))
            if size > limit:
                more = 0.0
                for _ in range(4):
                    grown = yield_stress + gain * (1.0 - np.exp(-rate * (hardened + more)))
                    slope = gain * rate * np.exp(-rate * (hardened + more))
                    more += (size - e * more - grown) / (e + slope)
                hardened += more
                trial = np.copysign(size - e * more, trial)
            now = trial + back
            found.append(now)
        return np.array(found) * _or(modification.load_bearing_area, 1.0)

    return CallableLaw(
        stress,
        ("modulus_MPa", "yield_stress_MPa", "saturation_MPa", "rate"),
        (modulus, 0.002 * modulus, 100.0, 10.0),
        (0.05 * modulus, 20.0, -0.0015 * modulus, 0.1),
        (3.0 * modulus, 0.05 * modulus, 0.05 * modulus, 500.0),
        frozenset({"added_relaxed_stress", "unrelaxed_modulus_factor", "load_bearing_area"}),
    )


def _or(values, usual: float) -> np.ndarray:
    return np.asarray(usual if values is None else values)


def stage_beside_video(samples: int = 150) -> Campaign:
    """One specimen of a Ti-Zr-Nb alloy twice: its strain by the stage's travel, and by two markers on a video."""

    def numbers(path: Path, columns: int) -> np.ndarray:
        rows = []
        for line in path.read_text(encoding="latin-1").splitlines():
            try:
                rows.append([float(cell) for cell in line.replace(",", ".").split("\t")[:columns]])
            except ValueError:
                continue
        return np.array([row for row in rows if len(row) == columns])

    gauge, area, between_clocks = 5.1, 2.21 * 0.95, 45.0
    stage = numbers(DATA / "zr-ti-nb/stage.txt", 8)
    video = numbers(DATA / "zr-ti-nb/video-extensometer.txt", 12)
    started, ended = int(np.argmax(stage[:, 4] > 25.0)), int(np.argmax(stage[:, 4] > 0.97 * stage[:, 4].max()))
    kept = np.linspace(started, ended, samples).astype(int)
    time, force = stage[kept, 0], stage[kept, 4]
    travel = (stage[kept, 3] - stage[started, 3]) * 1e-3 / gauge
    seen = np.interp(time, video[:, 0] + between_clocks, video[:, 6] / video[0, 6] - 1.0)
    records = [
        Record(
            id=name,
            time=time - time[0],
            true_strain=np.log1p(strain - strain[0]),
            true_stress=(force - force[0]) / area * (1.0 + strain - strain[0]),
            control="displacement-rate",
            specimen_id="one",
        )
        for name, strain in (("video", seen), ("stage", travel))
    ]
    return Campaign(name="stage beside video", records=tuple(records), specimens=Specimens("none"))


def cycles_of_steel(samples: int = 300) -> Campaign:
    """Strain-controlled cycles of S355 with a Pt100 on the specimen."""
    file = DATA / "s355" / "Temp_LP9_1_181211.XLSX"
    whole = read_record(file, specimen={"gauge_length_mm": 8.0, "diameter_mm": 5.98})
    taken = np.linspace(0, len(whole) * 3 // 5, samples).astype(int)
    record = Record(
        id="LP9",
        time=whole.time[taken],
        true_strain=whole.true_strain[taken],
        true_stress=whole.true_stress[taken],
        temperature=whole.temperature[taken],
        control="cyclic",
    )
    return Campaign(name="cycles of steel", records=(record,), specimens=Specimens("none"))


def _told(effects, parameters) -> tuple[str, str]:
    sizes = "; ".join(f"{each.name} {each.value:.3g}" for each in parameters)
    return " + ".join(effects) or "nothing", sizes


def diagnosed(case: str, known: str, campaign: Campaign, law: CallableLaw | None) -> Row:
    """A row of `diagnose`: what is named first by its share of the gap."""
    begun = perf_counter()
    found = diagnose(campaign, law=law, design=False)
    shares = ", ".join(
        each.name if each.share is None else f"{each.name} {100 * each.share:.0f} %"
        for each in found.effects
        if each.named
    )
    _, sizes = _told(found.best.effects, found.best.parameters)
    where = "" if len(found.best.records) == len(campaign.records) else f" in {', '.join(found.best.records)}"
    if not shares and found.shrink.effects:
        shares = f"nothing, {' + '.join(found.shrink.effects)} come nearest"
    answer = f"{found.verdict}: {shares or 'nothing'}{where}"
    size = f"{found.shrink.identify.before_MPa:.3g} → {found.shrink.identify.after_MPa:.3g} MPa; {sizes}"
    return Row(case, known, answer, size, perf_counter() - begun)


def compared(case: str, known: str, before: Campaign, after: Campaign) -> Row:
    """A row of `diagnose --against`."""
    begun = perf_counter()
    found = compare(after, Reference.of(before), threads=1)
    effects, sizes = _told(found.best.effects, found.best.parameters)
    where = f" in {', '.join(found.best.records)}" if found.best.effects else ""
    return Row(case, known, f"{effects}{where} ({found.best.probability:.2f})", sizes, perf_counter() - begun)


def gross(material: str, fault: str, size: float) -> Row:
    """A gross fault put into the first record of a measured campaign, against the campaign as it was."""
    before = measured.measured(material)
    name = before.records[0].id
    after = measured.injected(before, Injection(name, fault, size, 1))
    return compared(f"{material}, a gross fault", f"{fault} {size:g} in {name}", before, after)


def gross_in_another(material: str, fault: str, size: float) -> Row:
    """The same in the second specimen of a test, against the first."""
    whole = measured.measured(material)
    first, second = whole.records[:2]
    other = replace(whole, records=(replace(second, id=first.id),))
    after = measured.injected(other, Injection(first.id, fault, size, 1))
    case = f"{material}, a gross fault in another specimen"
    return compared(case, f"{fault} {size:g}", replace(whole, records=(first,)), after)


def repeated(material: str, first: tuple[int, ...], second: tuple[int, ...]) -> Row:
    """Specimens of a measured campaign against others in the same test."""
    whole = measured.measured(material)
    before = replace(whole, records=tuple(whole.records[k] for k in first))
    others = (replace(whole.records[k], id=known.id) for k, known in zip(second, before.records, strict=True))
    case = f"{material}, specimens {_numbers(second)} against {_numbers(first)}"
    return compared(case, "nothing but the specimen", before, replace(whole, records=tuple(others)))


def _numbers(places: tuple[int, ...]) -> str:
    return " and ".join(str(place + 1) for place in places)


def second_run(samples: int = 400) -> Row:
    """VHB 4910 at 0.03 1/s to a stretch of 2, once more."""
    both = []
    for name in ("0d03_2d0_1", "0d03_2d0_2"):
        run = Campaign.from_files([DATA / "vhb4910" / f"{name}.csv"], control="displacement-rate", name=name)
        run = measured.thinned(run, max(len(run.records[0]) // samples, 1))
        both.append(replace(run, records=(replace(run.records[0], id="run", specimen_id=name),)))
    return compared("vhb, second run against the first", "nothing but the specimen, or its rest", *both)


CASES: dict[str, Callable[[], Row]] = {
    "stage": lambda: diagnosed(
        "Ti–Zr–Nb, travel of a stage beside a video",
        "compliance and slack of the stage: 0.5 mm of 5.1 mm at 530 MPa (1.8e-4 1/MPa)",
        stage_beside_video(),
        isotropic_metal(MODULUS_OF_TITANIUM),
    ),
    "steel": lambda: diagnosed(
        "S355, strain cycles, isotropic law",
        "back stress; the thermometer rises by 1 °C only",
        cycles_of_steel(),
        isotropic_metal(MODULUS_OF_STEEL),
    ),
    "etfe-gain": lambda: gross("etfe", "force_gain", 0.4),
    "etfe-slack": lambda: gross("etfe", "slack", 0.1),
    "etfe-compliance": lambda: gross("etfe", "machine_compliance", 2e-3),
    "vhb-gain": lambda: gross("vhb", "force_gain", -0.4),
    "etfe-drift": lambda: gross("etfe", "force_drift", 10.0),
    "vhb-slack": lambda: gross("vhb", "slack", 0.2),
    "vhb-compliance": lambda: gross("vhb", "machine_compliance", 3.0),
    "vhb-offset": lambda: gross("vhb", "force_offset", 0.03),
    "etfe-other-gain": lambda: gross_in_another("etfe", "force_gain", 0.4),
    "etfe-other-offset": lambda: gross_in_another("etfe", "force_offset", 3.0),
    "etfe-other-slack": lambda: gross_in_another("etfe", "slack", 0.1),
    "etfe-other-compliance": lambda: gross_in_another("etfe", "machine_compliance", 2e-3),
    "etfe-repeat": lambda: repeated("etfe", (0, 1), (1, 2)),
    "etfe-1-2": lambda: repeated("etfe", (0,), (1,)),
    "etfe-2-3": lambda: repeated("etfe", (1,), (2,)),
    "etfe-1-3": lambda: repeated("etfe", (0,), (2,)),
    "vhb-repeat": second_run,
}


def table(rows: list[Row]) -> str:
    """As in docs/measured-cases.md."""
    lines = ["| case | known cause and size | answer | misfit, size |", "|---|---|---|---|"]
    return "\n".join([*lines, *(f"| {row.case} | {row.known} | {row.answer} | {row.size} |" for row in rows)])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"some of {', '.join(CASES)} (all)")
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    rows = []
    for name in given.cases or CASES:
        rows.append(CASES[name]())
        print(f"{name}: {rows[-1].seconds:.0f} s: {rows[-1].answer}; {rows[-1].size}", file=sys.stderr, flush=True)
    print(table(rows))
    if given.json:
        given.json.write_text(json.dumps([row.__dict__ for row in rows], indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
