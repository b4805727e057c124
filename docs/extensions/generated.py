"""The reference, made of the program itself: public names, commands, effects, export formats.

Pages go to docs/built, which git ignores. A page that did not change is not written again, so that a second build is
short.
"""

import argparse
import inspect
import re
import shutil
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np

import probation
from probation.cli import build_parser
from probation.effects.cause import Cause
from probation.effects.effect import Effect, EffectParameter, Form
from probation.effects.record_view import views_of
from probation.effects.registry import effects
from probation.exporting.formats import FORMATS
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.published.experiments import GRIP_LAWS, twin_campaign
from probation.report.diagnosis_words import parameter_words
from probation.report.style import COLOURS, MATPLOTLIB

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sphinx.application import Sphinx

_SEEN = 1e-3  # MPa: less is not drawn as a change

GROUPS = {
    "Files and records": ("Campaign", "Record", "Specimens", "Noise", "preview", "read_history"),
    "The law": ("Law", "Spectrum", "haward_thackray_strain", "ramp_stress", "creep", "reduce_spectrum", "Reduction"),
    "Strain histories": ("StrainHistory", "ImposedHistory", "named_history", "excite", "Excitation"),
    "Schemes": ("BE2", "SA2", "SA3", "Exact", "CVODE", "crosscheck", "CrossCheck"),
    "Companion relations": ("Weissenberg", "Exponential", "PowerLaw", "Table", "RateFunction", "calibrate_companion",
                            "Calibration", "CalibratedCompanion", "RateTable"),
    "Identify": ("fit", "Fit", "identify_many", "BulkIdentification"),
    "Put on probation": ("certify", "Certificate"),
    "Diagnose": ("diagnose", "Diagnosis", "compare", "Comparison", "Reference", "CallableLaw"),
    "Plan tests": ("plan", "Plan"),
    "What an effect changes in the law": (
        "Modification", "SelfHeating", "StressActivation", "PowerActivation", "RateShift", "InitialStress",
        "OtherSpectrum", "Direction",
    ),
    "Simulate and export": ("simulate", "Simulation", "export", "Export"),
    "Errors": ("InputError", "ConvergenceError"),
}  # fmt: skip
"""Public names by theme; one that is missing here is shown under "Further names"."""

COMMAND_ORDER = ("init", "demo", "preview", "fit", "companion", "certify", "diagnose", "plan")


def setup(app: "Sphinx") -> dict[str, bool]:
    """Write the pages, before Sphinx looks for sources."""
    app.connect("config-inited", lambda app, config: _write_all(app))
    app.connect("autodoc-process-docstring", _marks)
    app.connect("autodoc-process-docstring", _whole_sentence, priority=900)  # after napoleon
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _write_all(app: "Sphinx") -> None:
    built = Path(app.srcdir) / "built"
    (built / "figures").mkdir(parents=True, exist_ok=True)
    shutil.rmtree(built / "api", ignore_errors=True)  # pages of names that are no more
    _keep(built / "api", api_page())
    _keep(built / "command-help", commands_page())
    _keep(built / "effects", effects_page())
    _keep(built / "export-formats", formats_page())
    for effect in effects():
        path = built / "figures" / f"{effect.name}.svg"
        if not path.exists() or path.stat().st_mtime < Path(inspect.getsourcefile(probation.diagnose)).stat().st_mtime:
            draw_effect(effect, path)


def _keep(page: Path, text: str) -> None:
    path = page.with_suffix(".md")
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def _marks(app: "Sphinx", what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Single backquotes of the docstrings are code, as in NumPy's own convention for names."""
    lines[:] = [re.sub(r"(?<![`:\w])`([^`<>]+)`(?![`_])", r"``\1``", line) for line in lines]


def _whole_sentence(app: "Sphinx", what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Put together again what napoleon takes for "type: description" in the docstring of a property."""
    if what == "property" and len(lines) > 2 and lines[-1].startswith(":type: ") and lines[0]:
        lines[0] = f"{lines.pop()[len(':type: ') :]}: {lines[0]}"


def api_page() -> str:
    """Every public name, by theme, each with a page of its own."""
    listed = {name for names in GROUPS.values() for name in names}
    rest = tuple(name for name in probation.__all__ if name not in listed | {"__version__", "batch"})
    groups = {**GROUPS, **({"Further names": rest} if rest else {})}
    page = [
        "# Python interface\n",
        "`import probation` offers these names. [Conventions](../conventions.md) holds what is common to all:",
        "units, names of arguments, defaults, errors, results.\n",
    ]
    for title, names in groups.items():
        page += [f"## {title}\n", "```{eval-rst}", ".. autosummary::", "   :toctree: api", "   :nosignatures:", ""]
        page += [f"   probation.{name}" for name in names if name in probation.__all__]
        page += ["```\n"]
    page += ["## Many at once\n", "```{eval-rst}", ".. automodule:: probation.batch", "   :members:", "```\n"]
    return "\n".join(page)


def commands_page() -> str:
    """`--help` of every command, as its parser prints it."""
    parser = build_parser()
    page = [
        "# Help of the commands\n",
        "What `probation COMMAND --help` prints, made from the program when this page was built.\n",
    ]
    page += ["```text", _help(parser), "```\n"]
    subcommands = _subcommands(parser)
    names = [name for name in COMMAND_ORDER if name in subcommands]
    names += [name for name in subcommands if name not in names]
    for name in names:
        page += [f"## probation {name}\n", "```text", _help(subcommands[name]), "```\n"]
        for step, sub in _subcommands(subcommands[name]).items():
            page += [f"### probation {name} {step}\n", "```text", _help(sub), "```\n"]
    return "\n".join(page)


def _help(parser: argparse.ArgumentParser) -> str:
    return re.sub(r"\x1b\[[0-9;]*m", "", parser.format_help()).rstrip()


def _subcommands(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            return dict(action.choices)
    return {}


def effects_page() -> str:
    """The catalogue: what each effect is, its equation as the source has it, parameters, units, bounds, priors."""
    page = [
        "# Effects\n",
        "What `probation diagnose` considers, made from the registry when this page was built. Each figure shows",
        "experiment 2 (grips at 0.02 mm/s) and experiment 3 (0.08 mm/s) of the synthetic data: the law as it is",
        "(thin) and with the effect at the usual size that is written above it (thick), and below the difference.",
        "Where neither would change, the records are a test that is unloaded, or the two at two temperatures.",
        "How an effect is chosen: [how a diagnosis is reached](../diagnosis-method.md). How to add one:",
        "[developing](../developing.md#adding-files).\n",
        "| effect | kind | what happens |", "|---|---|---|",
    ]  # fmt: skip
    page += [
        f"| [{effect.title}](#{effect.name.replace('_', '-')}) | {effect.kind} | {effect.physics.splitlines()[0]} |"
        for effect in effects()
    ]
    for effect in effects():
        first, *rest = effect.physics.splitlines()
        page += [f"\n({effect.name.replace('_', '-')})=", f"## {effect.title[0].upper()}{effect.title[1:]}\n"]
        page += [f"`{effect.name}`, an effect of the {effect.kind}. {first} {' '.join(rest)}\n"]
        page += [f"Shows in: {effect.shows_in}. Source: {effect.source}.\n"]
        for form in effect.forms:
            where = " or ".join({"all": "all records", "one": "one record"}[at] for at in effect.placements(form))
            page += [f"**Form `{form.name}`**, in {where}. {_equation(form)}\n"]
            page += ["| parameter | unit | bounds | prior | why |", "|---|---|---|---|---|"]
            page += [_row(parameter) for parameter in form.parameters]
            page += [""]
        page += [f"![{effect.title} in the synthetic records](figures/{effect.name}.svg)\n"]
    return "\n".join(page)


def _equation(form: Form) -> str:
    """First paragraphs of the functions by which the form enters the law or the record."""
    said = []
    for field in fields(form):
        function = getattr(form, field.name)
        if field.name != "starts" and callable(function) and (text := inspect.getdoc(function)):
            said.append(" ".join(text.split("\n\n")[0].split()).replace("*", r"\*").replace("|", r"\|"))
    return " ".join(text.rstrip(".") + "." for text in dict.fromkeys(said))


def _row(parameter: EffectParameter) -> str:
    if not np.isfinite(parameter.scale):
        prior = "any alike" + (" in its logarithm" if parameter.log else "")
    elif parameter.log:
        prior = f"about {parameter.centre:g}, a factor of {np.exp(parameter.scale):.2g} either way"
    else:
        prior = f"about {parameter.centre:g} ± {parameter.scale:g}"
    bounds = f"{parameter.lower:g} to {parameter.upper:g}"
    return f"| `{parameter.name}` | {parameter.unit or '–'} | {bounds} | {prior} | {parameter.reason} |"


def _drawn_on(law: probation.Law) -> "Iterator[tuple[tuple[str, str], probation.Campaign]]":
    """Pairs of records with their names: the two driven by grips; loaded and unloaded; the two at two temperatures."""
    grips = twin_campaign((2, 3), noise=0.0)
    yield ("0.02 mm/s", "0.08 mm/s"), grips
    records = []
    for rate in (0.0005, 0.005):
        history = probation.named_history("load-unload", rate=rate, strain=0.5, unload_rate=rate, unload_to=0.3)
        stress = np.maximum(law.stress(history, scheme="sa3"), 0.0)  # measured on a strip, which does not push
        records.append(probation.Record(f"{rate:g} 1/s", history.time, history.true_strain, stress))
    yield (records[0].id, records[1].id), replace(grips, records=tuple(records))
    warm = [
        replace(each, temperature=np.full(len(each.time), degrees))
        for each, degrees in zip(grips.records, (23.0, 28.0), strict=True)
    ]
    yield ("0.02 mm/s, 23 °C", "0.08 mm/s, 28 °C"), replace(grips, records=tuple(warm))


def draw_effect(effect: Effect, path: Path) -> None:
    """Two records with and without the effect, at the size that its prior calls usual."""
    form = effect.forms[0]
    law = GRIP_LAWS[3].with_parameters(np.array([3220.0, 1.0, 1.8]))
    for names, campaign in _drawn_on(law):
        labels, views = names, views_of(campaign, scheme="sa3")
        model = CampaignModel(DnlrLaw(law), views)
        without = model.predict(model.start)
        values = form.typical
        if form.starts is not None:  # instants, frequencies: from the records
            starts = form.nonlinear_starts([replace(view, data=without[view.id]) for view in views])
            start = starts[len(starts) // 2]
            values = start if form.threshold else (values[0], *start)
        changed = model.with_causes([Cause(effect, form)])
        stresses = changed.predict(changed.parameters(law.parameters, values))
        if max(float(np.abs(stresses[view.id] - without[view.id]).max()) for view in views) > _SEEN:
            break
    with plt.rc_context(MATPLOTLIB):
        figure, (top, bottom) = plt.subplots(2, 1, figsize=(6.4, 4.2), sharex=True, height_ratios=(2, 1))
        for view, colour, label in zip(views, ("model", "second"), labels, strict=True):
            strain = view.recorded_strain[:: view.stride]
            shade = COLOURS[colour].light
            top.plot(strain, without[view.id], color=shade, lw=0.8, alpha=0.6)
            top.plot(strain, stresses[view.id], color=shade, lw=1.8, label=label)
            bottom.plot(strain, stresses[view.id] - without[view.id], color=shade)
        first = form.parameters[0]
        top.set_title(f"{parameter_words(first)} {values[0]:.3g} {first.unit}".strip())
        top.set_ylabel("true stress [MPa]")
        top.legend()
        bottom.set(xlabel="true strain [–]", ylabel="change [MPa]")
        figure.savefig(path, metadata={"Date": None})
        plt.close(figure)


def formats_page() -> str:
    """What `probation export --format` takes."""
    page = ["# Export formats\n", "What `probation export --format NAME` writes; errors and limits: "]
    page[-1] += "[an identified law in finite-element codes](../export.md).\n"
    page += ["| format | what it is |", "|---|---|"]
    page += [f"| `{name}` | {made.what} |" for name, made in FORMATS.items()]
    return "\n".join([*page, ""])
