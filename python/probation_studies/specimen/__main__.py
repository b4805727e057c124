"""``python -m probation_studies.specimen``: the virtual specimen on probation."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.exporting.request import BULK_TO_SHEAR
from probation.fe.necking import add_bar_options, bar_of, law_of
from probation.fe.point import MaterialPoint
from probation_studies.specimen.experiments import STRAIN_MEASURES
from probation_studies.specimen.findings import CONTROL, NECK, judge
from probation_studies.specimen.recording import Recording
from probation_studies.specimen.trial import make_specimen

if TYPE_CHECKING:
    from collections.abc import Sequence

_DESCRIPTION = """\
The paper's three experiments, made by the law itself, and put on probation. A round bar is pulled in felupe with the
grips parting at 0.02 and 0.08 mm/s (experiments 2, 3); experiment 1 has a constant true strain rate of 0.005 1/s. What
an experimenter would have at the centre of the neck (time, true strain, force over current section, all with noise)
becomes a campaign in DIR/neck, and the same strains answered in one dimension another in DIR/uniaxial. Both go through
the probation test (experiment 1 identified, 2 and 3 predicted) and the diagnosis (of all three). In a neck stress is
not uniaxial: the report shows the answers beside this known fault.

  python -m probation_studies.specimen --out specimen                   (a minute)
  python -m probation_studies.specimen --out specimen --first bar       (experiment 1 in a bar too, driven by video)
  python -m probation_studies.specimen --out specimen --strain surface  (strain along the bar on its surface)
  python -m probation_studies.specimen --out specimen --bridgman        (stress corrected by the neck's outline)
  python -m probation_studies.specimen --out specimen --imperfection 0.005 --plot specimen.png
  probation certify specimen/neck --held-out experiment-2 --held-out experiment-3 --report certificate.html
  probation diagnose specimen/neck --report diagnosis.html
"""


def parser() -> argparse.ArgumentParser:
    """The options."""
    made = argparse.ArgumentParser(
        prog="python -m probation_studies.specimen",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    made.add_argument("--out", type=Path, required=True, metavar="DIR", help="where to leave campaigns and answer")
    made.add_argument(
        "--first",
        choices=("point", "bar"),
        default="point",
        help="experiment 1: in one dimension, as the video extensometer means it to be, or in the bar (point)",
    )
    made.add_argument(
        "--strain",
        choices=STRAIN_MEASURES,
        default="section",
        help="of the bar: 2 ln(initial / current radius), or along the bar on its surface (section)",
    )
    made.add_argument("--bridgman", action="store_true", help="divide the stress by Bridgman's factor of the outline")
    made.add_argument("--no-control", action="store_true", help="leave out the campaign in one dimension")
    made.add_argument("--plot", type=Path, metavar="FILE", help="strain rates beside Figure 1, and the triaxiality gap")
    group = made.add_argument_group("recording")
    group.add_argument("--samples", type=int, default=601, metavar="N", help="of each record, evenly in time (601)")
    group.add_argument("--noise", type=float, default=0.04, metavar="MPA", help="of the stress (0.04, the paper's)")
    group.add_argument("--strain-noise", type=float, default=5e-5, metavar="X", help="of the strain (5e-5)")
    group.add_argument("--seed", type=int, default=0, metavar="N", help="of the noise (0)")
    add_bar_options(
        made,
        unrelaxed_modulus=3220.0,
        hardening_modulus=1.8,
        bulk_modulus=BULK_TO_SHEAR * 3220.0 / 3.0,
        radius=4.0,
        largest_step=0.005,
        largest_centre_step=0.005,
        nominal_rate=None,
    )
    return made


def main(arguments: Sequence[str] | None = None) -> int:
    """Make the specimen, judge it, and print the report."""
    given = parser().parse_args(arguments)
    try:
        recording = Recording(
            samples=given.samples, stress_noise=given.noise, strain_noise=given.strain_noise, seed=given.seed
        )
        law = law_of(given)
        point = MaterialPoint.from_law(law, given.bulk_modulus, rate_filter=given.rate_filter)
        specimen = make_specimen(law, point, bar_of(given), first=given.first, strain=given.strain)
        if given.bridgman:
            specimen = replace(specimen, experiments=tuple(each.corrected() for each in specimen.experiments))
        found = judge(specimen, recording, control=not given.no_control, folder=given.out)
        (given.out / "specimen.json").write_text(found.to_json(), encoding="utf-8")
        if given.plot:
            from probation_studies.specimen.pictures import draw_specimen  # noqa: PLC0415 -- slow to import

            draw_specimen(specimen, given.plot)
    except InputError as error:
        print(f"specimen: {error}", file=sys.stderr)
        return 2
    print(found.summary())
    folders = (NECK,) if given.no_control else (NECK, CONTROL)
    print(f"\nin {given.out}: specimen.json, {', '.join(f'{each}/' for each in folders)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
