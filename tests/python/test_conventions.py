"""The public interface against docs/conventions.md, and every document that is cited against the tree."""

import inspect
import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import probation
from probation import batch, bulk
from probation.field.identify import identify_field
from probation.identify import base
from probation.identify.fit import plain_fit
from probation.identify.search import search_range
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.inference.problem import Problem

ROOT = Path(__file__).parents[2]
PACKAGES = (ROOT / "python" / "probation",)

FUNCTIONS = {
    name: given
    for name, given in [
        *((name, getattr(probation, name)) for name in probation.__all__),
        *((f"Law.{name}", given) for name, given in vars(probation.Law).items() if not name.startswith("_")),
        *(
            (f"batch.{name}", given)
            for name, given in vars(batch).items()
            if given.__doc__ and not name.startswith("_")
        ),
        ("identify_field", identify_field),
    ]
    if inspect.isfunction(given)
}
DEFAULT_SCHEMES = {
    "sa3": {"diagnose", "compare", "calibrate_companion", "identify_many"},
    "be2": {"fit", "certify", "simulate", "identify_field", "Law.stress", "Law.sensitivity", "batch.stresses"},
}


def _arguments():
    return [
        (name, argument)
        for name, function in FUNCTIONS.items()
        for argument in inspect.signature(function).parameters.values()
    ]


def test_parameters_are_held_by_hold_and_nothing_else():
    assert {argument.name for _, argument in _arguments()}.isdisjoint({"held", "fix", "fixed"})


@pytest.mark.parametrize("left_out", ["hold", "bounds", "effects", "threads", "progress"])
def test_what_may_be_left_out_is_none_by_default(left_out):
    found = {name: argument.default for name, argument in _arguments() if argument.name == left_out}
    assert found
    assert set(found.values()) == {None}, found


@pytest.mark.parametrize(
    "argument",
    ["hold", "bounds", "excitation", "jumps", "effects", "tolerance", "gap", "seed", "modification"],
)
def test_the_conventions_name_every_public_function_that_takes_an_argument(argument):
    """`batch` stands for its functions; classes, which the table names too, are no functions."""
    page = (ROOT / "docs/conventions.md").read_text(encoding="utf-8")
    (where,) = re.findall(rf"^\| `{argument}` \|.*\| (.*?) \|$", page, re.MULTILINE)
    named = {name for name in re.findall(r"`([\w.]+)`", where) if name == "batch" or name in FUNCTIONS}
    taking = {name for name, function in FUNCTIONS.items() if argument in inspect.signature(function).parameters}
    assert named == {"batch" if name.startswith("batch.") else name for name in taking}


@pytest.mark.parametrize("argument", ["threads", "progress", "seed"])
def test_how_a_function_works_is_told_by_keyword(argument):
    kinds = {name: given.kind for name, given in _arguments() if given.name == argument}
    assert kinds
    assert set(kinds.values()) == {inspect.Parameter.KEYWORD_ONLY}, kinds


def test_the_default_scheme_is_the_one_that_the_conventions_name():
    found = {name: argument.default for name, argument in _arguments() if argument.name == "scheme"}
    for scheme, names in DEFAULT_SCHEMES.items():
        assert {name: found[name] for name in names} == dict.fromkeys(names, scheme)


def _campaign():
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    rng, records = np.random.default_rng(2), []
    for name, rate in (("slow", 1e-3), ("fast", 1e-2)):
        time = np.linspace(0.0, 0.5 / rate, 41)
        stress = law.stress(time, rate * time, "sa3") + 0.05 * rng.standard_normal(41)
        records.append(probation.Record(name, time, rate * time, stress, control="strain-rate"))
    return probation.Campaign("two ramps", tuple(records))


IDENTIFYING = {
    "fit": probation.fit,
    "certify": probation.certify,
    "diagnose": partial(probation.diagnose, effects=["force_offset"], design=False),
    "calibrate_companion": probation.calibrate_companion,
    "compare": lambda campaign, scheme: probation.compare(campaign, campaign, scheme, effects=["force_offset"]),
}


@pytest.mark.parametrize("name", IDENTIFYING)
def test_a_scheme_is_a_name_or_an_object_that_holds_its_options(name):
    """The paper's first step of be2 gives another answer than the default, and the object says the same as its name."""
    answers = [
        IDENTIFYING[name](_campaign(), scheme)
        for scheme in ("be2", probation.BE2(), probation.BE2(start="backward_euler"))
    ]
    by_name, by_object, other_start = (re.sub(r'"created[^,]*,', "", answer.to_json()) for answer in answers)
    assert by_name == by_object != other_start
    with pytest.raises(probation.InputError, match="scheme is 'exact'"):
        IDENTIFYING[name](_campaign(), "exact")


def test_substeps_of_a_scheme_are_those_of_the_function():
    assert probation.fit(_campaign(), probation.SA2(substeps=3)).to_json() == (
        probation.fit(_campaign(), "sa2", substeps=3).to_json()
    )
    assert probation.certify(_campaign(), probation.SA2(substeps=3)).base.substeps == 3
    with pytest.raises(probation.InputError, match="expected one number of steps"):
        probation.fit(_campaign(), probation.SA2(substeps=3), substeps=2)
    with pytest.raises(probation.InputError, match="one step from sample to sample"):
        probation.compare(_campaign(), _campaign(), probation.SA3(substeps=3))


def test_a_diagnosis_takes_no_fewer_steps_than_its_scheme_says(monkeypatch):
    taken = []
    monkeypatch.setattr(base, "fit_views", lambda _, views, *__: taken.append(min(v.stride for v in views)) or 1 / 0)
    for scheme in (probation.SA3(substeps=4), "sa3"):
        with pytest.raises(ZeroDivisionError):
            probation.diagnose(_campaign(), scheme)
    assert taken[0] >= 4 > taken[1]


def test_a_fit_and_a_diagnosis_search_the_same_relaxation_times():
    campaign = _campaign()
    law = base.base_fit(campaign, plain_fit(campaign)).law
    low, high = law.bounds
    at = law.parameter_names.index("tau_max_s")
    problem = Problem.white(DnlrLaw(law.law), [measured_view(r, probation.excite(r), "sa3") for r in campaign.records])
    assert (low[at], high[at]) == search_range(problem, {})


def test_choices_are_words_with_hyphens():
    assert all(re.fullmatch(r"[a-z0-9-]+", method) for method in bulk.METHODS)


def test_a_parameter_is_held_by_the_same_name_everywhere():
    law = probation.Law(unrelaxed_modulus=1.0, tau_max=1.0, hardening_modulus=1.0)
    with pytest.raises(probation.InputError, match=r"hold: 'tau_max' is not .*tau_max_s"):
        probation.identify_many(law, [0.0, 1.0], [0.0, 1.0], [0.0, 1.0], hold={"tau_max": 1.0})


def _sources():
    for folder in ("python", "cpp", "tests", "bench", "docs"):
        for path in sorted((ROOT / folder).rglob("*")):
            made = ".dist-info" in str(path) or "built" in path.parts
            if path.suffix in {".py", ".pyi", ".md", ".cpp", ".hpp", ".h"} and not made:
                yield path
    yield ROOT / "README.md"


def test_every_document_that_is_cited_is_in_the_tree():
    lost = {
        f"{path.relative_to(ROOT)}: {cited}"
        for path in _sources()
        for cited in re.findall(r"(?<![\w/.*])[\w./-]*\w\.md\b", path.read_text(encoding="utf-8"))
        if not any((folder / cited).exists() for folder in (ROOT, path.parent))
    }
    assert lost == set()


def test_every_section_that_is_cited_is_there():
    pages = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md")}
    cited = [
        (path, page, number)
        for path in _sources()
        for page, numbers in re.findall(
            r"docs/([\w-]+\.md),?\s+sections? ([\d and,]+)", path.read_text(encoding="utf-8")
        )
        for number in re.findall(r"\d+", numbers)
    ]
    assert len(cited) > 15
    for path, page, number in cited:
        assert re.search(rf"^## {number}\. ", pages[page], re.MULTILINE), f"{path} cites section {number} of {page}"


def test_the_glossary_is_in_order_and_names_files_that_are_there():
    text = (ROOT / "docs/glossary.md").read_text(encoding="utf-8")
    for theme in text.split("\n## ")[1:]:
        terms = [line.split("|")[1].strip().lower() for line in theme.split("\n") if line.startswith("| ")][1:]
        assert terms == sorted(terms)
    files = set(re.findall(r"`([\w/]+(?:\.py|\.hpp|/))`", text))
    assert len(files) > 20
    assert [each for each in sorted(files) if not any((root / each).exists() for root in (ROOT, *PACKAGES))] == []


def test_lines_of_the_docs_fit_a_hundred_columns():
    """Tables may be wider."""
    wide = {
        f"{path.relative_to(ROOT)}:{number}"
        for path in [
            *ROOT.glob("*.md"),
            *(ROOT / "docs").glob("*.md"),
            *(ROOT / "python").rglob("*.md"),
            ROOT / "bench/README.md",
        ]
        if path.name != "CHANGELOG.md"
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if len(line) > 100 and not line.lstrip().startswith("|")
    }
    assert wide == set()


def test_the_readme_is_short_and_its_links_lead_somewhere():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) < 150
    links = re.findall(r"\]\(([^)#:]+)", text)
    assert len(links) > 20
    assert [link for link in links if not (ROOT / link).exists()] == []


def test_where_a_formula_stands_is_where_the_page_for_developers_says():
    """Every file of its two tables is there, and every name of a row stands in one of the files of that row."""
    page = (ROOT / "docs/developing.md").read_text(encoding="utf-8")
    tables = page.split("### Where the statistics stands")[1].split("## Adding files")[0]
    rows, lost = [line for line in tables.splitlines() if line.startswith("| ")], []
    for row in rows:
        said = re.findall(r"`([^`]+)`", row)
        paths = [name for name in said if "/" in name or name.endswith((".py", ".hpp", ".cpp", ".md"))]
        roots = (ROOT, *PACKAGES, ROOT / "cpp/include/probation")
        files = {path: next((root / path for root in roots if (root / path).exists()), None) for path in paths}
        lost += [path for path, file in files.items() if file is None]
        text = "".join(
            part.read_text(encoding="utf-8")
            for file in files.values()
            if file is not None
            for part in (sorted(file.glob("*.*")) if file.is_dir() else [file])
            if part.is_file()
        )
        lost += [name for name in said if name not in paths and not re.search(rf"\b{re.escape(name)}\b", text)]
    assert len(rows) > 25
    assert lost == []
