"""The product on the embedded synthetic data of the paper's experiments, without any file.

What is shown is the list `STEPS`; a new part is a function here or elsewhere and one line there.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from probation._files import make_folder, write_whole
from probation.answers import PARAMETER_KEYS, json_answer
from probation.certificate.certify import certify
from probation.diagnosis.diagnose import diagnose
from probation.identify.fit import fit
from probation.law.settings import LawSettings
from probation.provenance import provenance, samples_sha256
from probation.published.experiments import Twin, experiment, twin_campaign
from probation.published.numbers import UNRELAXED_MODULUS
from probation.report.certificate_summary import parameter_table, prediction_table
from probation.report.crosscheck_summary import record_table
from probation.report.diagnosis_tables import MOST, shrink_table, where_table, which_table
from probation.report.figures import save_figure
from probation.report.page import Page, Picture, Section, picture
from probation.report.plots import Curve, sensitivities, strain_rates, stress_strain_with_residuals
from probation.report.table import Table
from probation.schemes.crosscheck import crosscheck
from probation.wording import plus_minus

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from os import PathLike

    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.diagnosis.result import Diagnosis
    from probation.records.campaign import Campaign

SEED = 0
_EXPERIMENTS: tuple[Literal[1, 2, 3], ...] = (1, 2, 3)
_ENOUGH = 3.0  # standard errors


@dataclass(frozen=True)
class DemoOutcome:
    """What one step of the demonstration found.

    Attributes
    ----------
    verdict : str
        One sentence.
    parts : tuple of str, Table or Picture
        For the page; tables also go to the terminal.
    answer : mapping
        For JSON.
    plots : mapping of file stem to Figure
    pages : mapping of file stem to Diagnosis
        Answers that have a page of their own.
    """

    verdict: str
    passed: bool
    parts: tuple[str | Table | Picture, ...]
    answer: Mapping[str, object]
    plots: Mapping[str, Figure]
    pages: Mapping[str, Diagnosis] = field(default_factory=dict)


@dataclass(frozen=True)
class DemoStep:
    """One step: its name in JSON, its title, what it does."""

    name: str
    title: str
    run: Callable[[], DemoOutcome]


def identification() -> DemoOutcome:
    """Identify each synthetic record and compare the parameters with the truth."""
    rows, curves, answers, farthest = [], [], {}, 0.0
    for number in _EXPERIMENTS:
        twin = experiment(number, SEED)
        found = fit(twin_campaign((number,), seed=SEED))
        answers[twin.name] = found.to_dict()["parameters"]
        for name, parameter in found.parameters.items():
            if not parameter.se:  # held
                continue
            truth = getattr(twin.truth, name)
            distance = abs(parameter.value - truth) / parameter.se
            farthest = max(farthest, distance)
            identified = plus_minus(parameter.value, parameter.se)
            status = parameter.status.replace("_", " ")
            rows.append((twin.name, PARAMETER_KEYS[name], f"{truth:g}", identified, f"{distance:.1f}", status))
        record = found.records[twin.name]
        curves.append(Curve(twin.name, twin.true_strain, twin.true_stress, record.model_stress, record.noise_MPa))
    headings = ("record", "parameter", "truth", "identified ± se", "off by [se]", "status")
    plots = {
        "stress-strain": stress_strain_with_residuals(curves),
        "sensitivities": _sensitivities(experiment(1, SEED)),
        "strain-rates": strain_rates(_rates()),
    }
    return DemoOutcome(
        verdict=f"The law is identified: every parameter lies within {farthest:.1f} standard errors of the truth.",
        passed=farthest <= _ENOUGH,
        parts=(
            "Synthetic data of the paper's experiments, made with known parameters and 0.04 MPa of noise, are "
            "identified as a measured record would be. E_u is held at 3220 MPa on experiments 2 and 3, as in the "
            "paper.",
            Table(headings, tuple(rows), "Parameters and the truth", left=2),
            picture(plots["stress-strain"], "True stress over true strain, measured and identified; residuals below"),
            picture(plots["sensitivities"], "Scaled sensitivities of the stress in experiment 1"),
            picture(plots["strain-rates"], "What drives the specimen: strain rate over strain (the paper's Figure 1)"),
        ),
        answer={"parameters": answers, "farthest_standard_errors": farthest},
        plots=plots,
    )


def schemes() -> DemoOutcome:
    """Cross-check the schemes."""
    answer = crosscheck()
    figure = answer.plot()
    caption = "Largest error away from the start, against the step and against the time of one solve"
    return DemoOutcome(
        verdict=answer.verdict,
        passed=not any(check.failure for record in answer.records for check in record.schemes),
        parts=(*(record_table(record) for record in answer.records), picture(figure, caption)),
        answer=json.loads(answer.to_json()),
        plots={"crosscheck": figure},
    )


def probation_test() -> DemoOutcome:
    """Identify on experiment 1 and predict 2 and 3: the paper's own question, on its own numbers."""
    campaign = twin_campaign((1,), held_out=(2, 3), seed=SEED)
    found = certify(replace(campaign, law=replace(campaign.law, fixed={})))
    figure = found.plot()
    return DemoOutcome(
        verdict=f"Probation test: {found.headline[0].lower()}{found.headline[1:]}",
        passed=found.verdict == "intrinsic_except" and not found.parameters["hardening_modulus"].passes,
        parts=(
            "The synthetic data carry the paper's own parameters: α and G differ between the kinds of test, E_u does "
            "not.",
            parameter_table(found),
            prediction_table(found),
            picture(figure, "Measured, predicted with nothing adjusted, and identified alone (Figures 4 to 6)"),
        ),
        answer=json.loads(found.to_json()),
        plots={"probation-test": figure},
    )


def diagnosis_campaign() -> Campaign:
    """Experiment 2 to be fitted and 3 to be predicted, by a law that knows no companion relation."""
    law = LawSettings(fixed={"unrelaxed_modulus_MPa": UNRELAXED_MODULUS})
    return replace(twin_campaign((2,), held_out=(3,), seed=SEED, name="no-companion-relation"), law=law)


def diagnosis() -> DemoOutcome:
    """Take the companion relation away and ask what is missing: the paper's own discovery."""
    found = diagnose(diagnosis_campaign(), seed=SEED)
    figure = found.plot()
    missing = ("rate_dependent_relaxation",)
    tables = [make(found, MOST)[0] for make in (where_table, which_table, shrink_table)]
    return DemoOutcome(
        verdict=f"Diagnosis without the companion relation: {found.headline[0].lower()}{found.headline[1:]}",
        passed=found.verdict == "explained" and found.best.effects == missing,
        parts=(
            "Experiment 2 is fitted with a constant τ_max and experiment 3 only predicted. The synthetic α and "
            "G differ a little, as in the paper: that is what is left on experiment 3.",
            *tables,
            picture(figure, "Before and after the most probable explanation; where the law departs is marked"),
        ),
        answer=json.loads(found.to_json()),
        plots={"diagnosis": figure},
        pages={"diagnosis": found},
    )


STEPS: tuple[DemoStep, ...] = (
    DemoStep("identification", "Identification", identification),
    DemoStep("probation_test", "Probation test", probation_test),
    DemoStep("diagnosis", "Diagnosis", diagnosis),
    DemoStep("crosscheck", "Cross-check of the schemes", schemes),
)


@dataclass(frozen=True)
class Demo:
    """What the demonstration found.

    Attributes
    ----------
    outcomes : tuple of (DemoStep, DemoOutcome)
    """

    outcomes: tuple[tuple[DemoStep, DemoOutcome], ...]

    @property
    def passed(self) -> bool:
        """Whether every step came out as it should."""
        return all(outcome.passed for _, outcome in self.outcomes)

    @property
    def verdict(self) -> str:
        """One sentence per step."""
        return " ".join(outcome.verdict for _, outcome in self.outcomes)

    def summary(self) -> str:
        """The verdicts, then each step's tables."""
        parts = [outcome.verdict for _, outcome in self.outcomes]
        text = "\n".join(parts)
        for _, outcome in self.outcomes:
            text += "".join(f"\n\n{part.text()}" for part in outcome.parts if isinstance(part, Table))
        return text

    def to_json(self) -> str:
        """The answer, schema "probation.demo/1"."""
        steps = {step.name: {"verdict": found.verdict, **found.answer} for step, found in self.outcomes}
        return json_answer(
            "probation.demo/1",
            {"verdict": self.verdict, "passed": self.passed, "seed": SEED, "data_sha256": _data_sha256(), **steps},
        )

    def report(self, path: str | PathLike[str]) -> None:
        """Write one self-contained HTML page."""
        sections = tuple(Section(step.title, (found.verdict, *found.parts)) for step, found in self.outcomes)
        Page(
            "Demonstration on synthetic data of the paper's experiments",
            self.verdict,
            sections,
            mood="good" if self.passed else "bad",
            provenance=provenance(_data_sha256(), SEED),
        ).write(path)

    def write(self, folder: str | PathLike[str]) -> tuple[str, ...]:
        """Write page, plots, JSON, and the synthetic data as campaigns that ``probation fit`` takes.

        Parameters
        ----------
        folder : path-like
            Made if need be.

        Returns
        -------
        tuple of str
            What was written, for people.
        """
        root = Path(folder)
        make_folder(root / "plots")
        self.report(root / "report.html")
        write_whole(root / "demo.json", self.to_json())
        written = ["report.html"]
        for _, outcome in self.outcomes:
            for stem, figure in outcome.plots.items():
                save_figure(figure, root / "plots" / f"{stem}.png")
            for stem, found in outcome.pages.items():
                found.report(root / f"{stem}.html")
                written.append(f"{stem}.html")
        for number in _EXPERIMENTS:
            twin_campaign((number,), seed=SEED).save(root / f"experiment-{number}")
        return (*written, "demo.json", "plots/", *(f"experiment-{number}/" for number in _EXPERIMENTS))


def demonstrate(progress: Callable[[int, int, str], None] | None = None) -> Demo:
    """Run every step of `STEPS`.

    Parameters
    ----------
    progress : callable, optional
        Called with ``(done, total, what)``.
    """
    outcomes = []
    for at, step in enumerate(STEPS):
        if progress is not None:
            progress(at, len(STEPS), step.title)
        outcomes.append((step, step.run()))
    return Demo(tuple(outcomes))


def _sensitivities(twin: Twin) -> Figure:
    _, sensitivity = twin.truth.sensitivity(twin.time, twin.true_strain)
    names = [PARAMETER_KEYS[name] for name in twin.truth.parameter_names]
    return sensitivities(twin.true_strain, sensitivity * twin.truth.parameters, names)


def _rates() -> list[tuple[str, FloatArray, FloatArray]]:
    twins = [experiment(number, SEED) for number in _EXPERIMENTS]
    return [(twin.name, twin.true_strain, twin.strain_rate) for twin in twins]


def _data_sha256() -> str:
    twins = [experiment(number, SEED) for number in _EXPERIMENTS]
    return samples_sha256(*(samples for twin in twins for samples in (twin.time, twin.true_strain, twin.true_stress)))
