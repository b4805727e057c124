"""``probation blind``: the sealed benchmark."""

from __future__ import annotations

import argparse
from typing import cast

from probation.commands.cluster import add_cluster, cluster
from probation.commands.delivery import add_delivery, deliver, output_folder, outputs_with_report, said, tell, warn
from probation.commands.progress import shown
from probation.commands.streams import say
from probation.errors import InputError
from probation_studies.blind.laboratory_named import LABORATORIES, OWN

NAME = "blind"

_DESCRIPTION = """\
The sealed benchmark: campaigns of a virtual laboratory whose cause is withheld, answers to them, and scores.

  probation blind make --seed 7 --count 100 --out split/      campaigns, and a seal of every truth
  probation blind make --laboratory NAME …                    another laboratory's
  probation blind solve split/                                answers, each with the version that gave it
  probation blind score split/ --report score.html             opens the truths, checks the seals, scores

An interrupted run goes on where it stopped. The truths are in split/truths unless --truths says otherwise: keep them
from whoever answers. Answers given after the truths were first opened are refused. The test split is scored once per
release: at least 600 campaigns with at least 250 nulls, of a seed that was not used before.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="the sealed benchmark: make, solve, score", description=_DESCRIPTION)
    steps = parser.add_subparsers(title="steps", metavar="STEP", dest="step")
    make = steps.add_parser("make", help="campaigns of a virtual laboratory, their truths sealed")
    make.add_argument("--seed", type=int, required=True, help="another seed gives other campaigns")
    make.add_argument("--count", type=int, help="campaigns (100), their strata drawn")
    make.add_argument(
        "--strata", metavar="NAME=COUNT,…", type=_strata, help="instead of --count: campaigns of each stratum"
    )
    make.add_argument(
        "--laboratory", metavar="NAME", default=OWN, help=f"which one makes them: {', '.join(LABORATORIES)} ({OWN})"
    )
    make.add_argument(
        "--split", choices=("develop", "calibrate", "test"), default="develop", help="what it may be used for (develop)"
    )
    make.add_argument("--out", metavar="DIR", type=output_folder, required=True, help="folder for campaigns and seals")
    make.add_argument("--truths", metavar="DIR", type=output_folder, help="folder for the truths (truths/ in --out)")
    solve = steps.add_parser("solve", help="answer every campaign")
    solve.add_argument("folder", metavar="DIR", help="as make left it")
    solve.add_argument(
        "--solver",
        metavar="NAME",
        help="diagnose (default), no-gap, a baseline, or MODULE:FUNCTION from a campaign's folder to an answer",
    )
    solve.add_argument(
        "--baselines",
        action="store_true",
        help="answer by nearest-signature, bic-argmin and score-screen, too, into DIR/baselines",
    )
    solve.add_argument("--answers", metavar="DIR", type=output_folder, help="folder for the answers (answers/ in DIR)")
    solve.add_argument("--again", action="store_true", help="answer anew what has an answer")
    for step in (make, solve):
        add_cluster(step)
    score = steps.add_parser("score", help="open the truths and score the answers")
    score.add_argument("folder", metavar="DIR", help="as solve left it")
    score.add_argument("--truths", metavar="DIR", help="folder of the truths (truths/ in DIR)")
    score.add_argument("--answers", metavar="DIR", help="folder of the answers (answers/ in DIR)")
    score.add_argument(
        "--beside", metavar="NAME=DIR", action="append", default=[], help="other answers to score beside; repeatable"
    )
    score.add_argument(
        "--after-opening", action="store_true", help="score answers given after the opening, too; not of a test split"
    )
    score.add_argument(
        "--require", metavar="FILE.json", help="exit with status 1 where a figure is beyond its threshold there"
    )
    add_delivery(score)
    return parser


def _strata(text: str) -> dict[str, int]:
    """Of "none=300,single=60", the mapping."""
    found: dict[str, int] = {}
    for entry in text.split(","):
        name, _, count = entry.partition("=")
        if not count.isdigit() or name in found:
            raise argparse.ArgumentTypeError(f"found {text!r}, expected such as none=300,single=60")
        found[name] = int(count)
    return found


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    if options.step is None:
        raise InputError("blind: found no step, expected make, solve or score; see probation blind --help")
    return {"make": _make, "solve": _solve, "score": _score}[options.step](options)


def _make(options: argparse.Namespace) -> int:
    from probation_studies.blind.make import make_split  # noqa: PLC0415 - see the package
    from probation_studies.blind.release import LEAST_CAMPAIGNS, LEAST_NULLS  # noqa: PLC0415

    count = 100 if options.count is None and options.strata is None else options.count
    whole = sum(options.strata.values()) if count is None else count
    if options.split == "test" and whole < LEAST_CAMPAIGNS:
        warn(f"--count: found {whole}; a release takes {LEAST_CAMPAIGNS} or more, {LEAST_NULLS} nulls among them")
    with shown(f"making {options.split}") as advance, cluster(options.scheduler) as executor:
        layout = make_split(
            options.out,
            seed=options.seed,
            count=count,
            strata=options.strata,
            split=options.split,
            laboratory=options.laboratory,
            truths=options.truths,
            processes=options.processes,
            executor=executor,
            progress=advance,
        )
    said("campaigns", layout.campaigns)
    said("seals", layout.folder / "seals.json")
    said("truths", layout.truths)
    return 0


def _solve(options: argparse.Namespace) -> int:
    from probation_studies.blind.solve import solve_split  # noqa: PLC0415
    from probation_studies.blind.solvers import BASELINES, solver_named  # noqa: PLC0415

    named = [options.solver] if options.solver in BASELINES and options.answers is None else []
    solver = None if named else solver_named(options.solver or "diagnose")
    with shown("solving") as advance, cluster(options.scheduler) as executor:
        solved = solve_split(
            options.folder,
            solver,
            answers=options.answers,
            baselines=list(BASELINES) if options.baselines else named,
            processes=options.processes,
            executor=executor,
            progress=advance,
            again=options.again,
        )
    for name, failure in solved.failed.items():
        warn(f"{name}: {failure}")
    tell(f"{solved.now} answered now, {solved.before} before, {len(solved.failed)} failed\n")
    return 0


def _score(options: argparse.Namespace) -> int:
    from probation_studies.blind.release import SEEDS_FILE, spend_seed  # noqa: PLC0415
    from probation_studies.blind.score import score_split  # noqa: PLC0415
    from probation_studies.blind.thresholds import failures, read_thresholds  # noqa: PLC0415

    thresholds = read_thresholds(options.require) if options.require else ()

    beside: dict[str, str] = {}
    for entry in options.beside:
        name, equals, folder = entry.partition("=")
        if not equals or not name or not folder:
            raise InputError(f"--beside: found {entry!r}, expected NAME=DIR")
        beside[name] = folder
    with shown("scoring") as advance:
        score = score_split(
            options.folder,
            truths=options.truths,
            answers=options.answers,
            beside=beside,
            after_opening=options.after_opening,
            progress=advance,
        )
    if score.split == "test":
        for seed in cast("list[int]", score.content["seeds"]):
            if spend_seed(seed, cast("int", score.content["campaigns"])):
                said(f"seed {seed}, which is spent: commit", SEEDS_FILE)
    deliver(score.summary(), outputs_with_report(score, options))
    fallen_short = failures(score.content, thresholds)
    for failure in fallen_short:
        say(f"failed: {failure}")
    return 1 if fallen_short else 0
