"""What the diagnosis says of measured polymers: the figures of docs/measured-diagnoses.md.

.venv/bin/python -m bench.measured_diagnoses [etfe | vhb-loading | vhb ...]

A line for each case, as it is done; the records come from ../shared/data. Some minutes of one core.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from probation import Campaign, diagnose

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
TWO = ["rate_dependent_relaxation", "rate_dependent_hardening"]
EVERY = 10
LEADING = 0.05


def etfe():
    """Three specimens, one speed: all of them, and each predicted by the others."""
    whole = Campaign.from_files([DATA / "etfe" / "OUTRaw_MD_CSR_01_T40.csv"], control="displacement-rate")
    for held_out in (None, *(record.id for record in whole.records)):
        records = [replace(each, role="held-out" if each.id == held_out else "identify") for each in whole.records]
        yield f"ETFE, held out: {held_out}", replace(whole, records=tuple(records)), None


def vhb(loading):
    """Three rates, every tenth sample, up to the largest strain or all."""
    files = [DATA / "vhb4910" / f"0d0{rate}_3d0.csv" for rate in (1, 3, 5)]
    whole = Campaign.from_files(files, control="displacement-rate")
    if not loading:
        yield "VHB, as it is", whole, None
    for effects in (TWO, None):
        for held_out in (None, *(record.id for record in whole.records)):
            records = tuple(_thinned(each, each.id == held_out, loading) for each in whole.records)
            part, many = "loading" if loading else "all", "two" if effects else "all"
            yield f"VHB {part}, {many} effects, held out: {held_out}", replace(whole, records=records), effects


CASES = {"etfe": etfe, "vhb-loading": lambda: vhb(True), "vhb": lambda: vhb(False)}


def _thinned(record, held_out, loading):
    part = slice(0, int(np.argmax(record.true_strain)) + 1 if loading else None, EVERY)
    return replace(record.only(part), role="held-out" if held_out else "identify")


def told(found):
    """Lines of an answer: the verdict, the explanations that count, how far the gap shrinks."""
    shrink = found.shrink
    yield f"  {found.verdict}; answer set of {len(found.answer_set)}: {found.headline}"
    for each in found.explanations:
        if each.probability < LEADING:
            break
        sizes = ", ".join(_size(parameter) for parameter in each.parameters)
        yield f"  {each.probability:6.1%} {' + '.join(each.effects) or 'none'} [{', '.join(each.records)}] {sizes}"
        if each.checks and each.checks.notes:
            yield f"         {'; '.join(each.checks.notes)}"
    for name, closure in (("fitted", shrink.identify), ("held out", shrink.held_out)):
        if closure:
            yield f"  {name}: {_closed(closure)}"


def _closed(closure):
    part = "no gap to close" if closure.closure is None else f"{closure.closure:.0%} closed"
    ends = "" if closure.interval is None else " ({:.0%} to {:.0%})".format(*closure.interval)
    return f"{closure.before_MPa:.3g} -> {closure.after_MPa:.3g} MPa, noise {closure.noise_MPa:.2g}, {part}{ends}"


def _size(parameter):
    error = "not determined" if parameter.se is None else f"± {parameter.se:.2g}"
    bound = f", at its {parameter.bound} bound" if parameter.bound else ""
    return f"{parameter.name} {parameter.value:.3g} {error}{bound} {parameter.unit}".strip()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", choices=[*CASES, []], default=[])
    chosen = parser.parse_args().cases or CASES
    if not DATA.is_dir():
        parser.error(f"found no {DATA}: the measured records belong beside the checkout")
    for name in chosen:
        for label, campaign, effects in CASES[name]():
            print(label, flush=True)
            for line in told(diagnose(campaign, effects=effects, design=False)):
                print(line, flush=True)


if __name__ == "__main__":
    main()
