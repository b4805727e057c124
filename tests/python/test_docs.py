"""What the site is made of: the tutorials run here, `make docs` builds all; pictures of the README are up to date."""

import contextlib
import io
import re
import runpy
import sys
from itertools import pairwise
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

import probation
from probation.cli import build_parser
from probation.effects.registry import effects, unregister

DOCS = Path(__file__).parents[2] / "docs"
PICTURES = ("overview", "curves", "where", "which")


@pytest.fixture(autouse=True)
def no_figures_left(tmp_path, monkeypatch):
    """And files in a folder of the test: tutorials write into the present one."""
    monkeypatch.chdir(tmp_path)
    yield
    plt.close("all")


def _run(name):
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed), plt.rc_context({"figure.max_open_warning": 0, "backend": "agg"}):
        names = runpy.run_path(str(DOCS / "tutorials" / name))
    said = " ".join(printed.getvalue().split())
    promised = re.findall(r"^# > (.*)$", (DOCS / "tutorials" / name).read_text(encoding="utf-8"), re.MULTILINE)
    assert promised
    for line in promised:
        assert " ".join(line.split()) in said, f"{name} promises what it does not print: {line}"
    return names, printed.getvalue()


def test_the_first_tutorial_returns_the_truth_that_it_put_in():
    names, printed = _run("tutorial_1_first_identification.py")
    fit = names["fit"]
    for name, true in (("unrelaxed_modulus", 3220.0), ("tau_max", 5.0), ("hardening_modulus", 2.0)):
        assert abs(fit.parameters[name].value - true) < 2.0 * fit.parameters[name].se, name
    assert "the law describes the records to within their noise" in " ".join(printed.split())
    assert "times the noise" in names["misfit"].verdict


def test_the_second_tutorial_certifies_one_law_and_names_what_changes_in_the_other():
    names, _ = _run("tutorial_2_the_probation_test.py")
    assert names["certificate"].verdict == "intrinsic"
    assert names["failing"].verdict == "intrinsic_except"
    assert names["failing"].reason.startswith("G changes")


def test_the_third_tutorial_finds_the_effect_that_it_put_in():
    names, _ = _run("tutorial_3_why_does_my_law_fail.py")
    diagnosis = names["diagnosis"]
    assert diagnosis.best.effects == ("self_heating",)
    assert diagnosis.shrink.held_out.after_MPa < 1.1 * names["load_cell"]
    assert len(names["fewer"].answer_set) > 1


def test_the_fourth_tutorial_exports_the_law_and_pulls_a_bar_that_necks():
    pytest.importorskip("felupe")
    names, _ = _run("tutorial_4_into_finite_elements.py")
    necking = names["necking"]
    assert np.ptp(necking.outline[1]) > 0.2 * necking.outline[1].max()
    assert necking.nominal_stress[-1] < 0.9 * necking.nominal_stress.max()


def test_the_fifth_tutorial_finds_the_damage_that_a_law_of_ones_own_leaves_out():
    names, printed = _run("tutorial_5_a_law_of_your_own.py")
    assert names["holds"].verdict == "no_gap"
    for parameter, true in zip(names["holds"].base, names["TRUTH"], strict=True):
        assert abs(parameter.value - true) < 3.0 * parameter.se, parameter.name
    diagnosis = names["diagnosis"]
    assert diagnosis.best.effects == ("damage",)
    assert abs(diagnosis.best.parameters[0].value - 0.3) < 0.003
    assert diagnosis.shrink.held_out.after_MPa < 0.06
    assert "Damage may explain the gap" in printed


def test_links_of_the_readme_exist_in_the_tree():
    readme = DOCS.parent / "README.md"
    targets = re.findall(r"\]\(([^)#:]+)\)", readme.read_text(encoding="utf-8"))
    assert len(targets) > 20
    assert [target for target in targets if not (readme.parent / target).exists()] == []


def test_no_page_counts_the_catalogue_wrongly():
    for page in [*DOCS.rglob("*.md"), *(DOCS / "tutorials").glob("*.py"), DOCS.parent / "README.md"]:
        for count in re.findall(r"catalogue\s+(?:holds|has)\s+(?:# )?(\d+)", page.read_text(encoding="utf-8")):
            assert int(count) == len(effects()), page


def test_a_python_prompt_takes_the_tutorials_blocks():
    """At a prompt a block ends with an empty line: nothing at the margin follows one without."""
    for page in (DOCS / "tutorials").glob("*.py"):
        lines = page.read_text(encoding="utf-8").splitlines()
        depth = 0
        for before, line in pairwise(lines):
            depth += sum(before.count(c) for c in "([{") - sum(before.count(c) for c in ")]}")
            if depth == 0 and before.startswith("    ") and line[:1].isalpha():
                assert line.startswith(("else", "elif", "except")), f"{page.name}: {line}"


def test_the_python_of_the_recipes_runs(tmp_path, monkeypatch):
    """All blocks in turn, on the arrays that the first one takes."""
    page = next(DOCS.glob("recipes.*"))
    monkeypatch.chdir(tmp_path)
    test = probation.named_history("ramp", samples=101, strain=0.5)
    law = probation.Law(unrelaxed_modulus=3000.0, tau_max=5.0, hardening_modulus=2.0)
    stress = law.stress(test.time, test.true_strain)
    names = {
        "time": test.time,
        "strain": 100.0 * np.expm1(test.true_strain),
        "force": 22e-3 * stress * np.exp(-test.true_strain),
    }
    try:
        for block in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL):
            exec(block, names)
    finally:
        if any(effect.name == "amplifier" for effect in effects()):
            unregister("amplifier")
    assert names["campaign"].records[0].true_stress[-1] == pytest.approx(stress[-1], rel=1e-6)


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pictures")
    runpy.run_path(str(DOCS / "pictures.py"))["draw"](folder)
    return folder


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_of_the_readme_says_what_the_program_draws_today(drawn, name):
    """Words and numbers in it; lines differ in their last digits from one processor to the next."""
    today, stored = (
        re.findall(r"<text[^>]*>([^<]*)", (folder / f"{name}.svg").read_text(encoding="utf-8"))
        for folder in (drawn, DOCS / "pictures")
    )
    assert len(today) > 5
    assert today == stored, "make pictures draws it anew"


def test_no_image_is_stored_but_those_pictures():
    stored = {
        path.relative_to(DOCS).as_posix()
        for path in DOCS.rglob("*")
        if path.suffix in {".png", ".svg", ".jpg", ".gif", ".pdf"} and "built" not in path.parts
    }
    assert stored == {f"pictures/{name}.svg" for name in PICTURES}


def test_the_generated_reference_holds_every_public_name_command_and_effect(monkeypatch, tmp_path):
    monkeypatch.syspath_prepend(str(DOCS / "extensions"))
    sys.modules.pop("generated", None)
    import generated  # noqa: PLC0415

    names = set(re.findall(r"^   probation\.(\w+)$", generated.api_page(), re.MULTILINE))
    assert names == set(probation.__all__) - {"__version__", "batch"}
    helped = generated.commands_page()
    assert all(f"## probation {name}\n" in helped for name in generated._subcommands(build_parser()))
    page = generated.effects_page()
    for effect in effects():
        assert f"`{effect.name}`" in page
        assert all(f"`{each.name}`" in page for form in effect.forms for each in form.parameters)
    assert "Area e^(-a (1 - e^(-e / e_c)))" in page  # the equation of a form
    generated.draw_effect(effects(["machine_compliance"])[0], tmp_path / "effect.svg")
    assert (tmp_path / "effect.svg").stat().st_size > 10_000


@pytest.fixture(scope="module")
def explained():
    """The module that draws the figures of the explanation."""
    return runpy.run_path(str(DOCS / "extensions" / "explained.py"))


def test_every_figure_of_the_explanation_is_drawn_and_shown(explained):
    shown = {name for page in DOCS.glob("*.md") for name in re.findall(r"explained-(\w+)\.svg", page.read_text())}
    assert shown == set(explained["FIGURES"])


@pytest.mark.parametrize("name", ["law", "clocks", "isolability"])
def test_a_figure_of_the_explanation_has_labelled_axes(explained, name):
    figure = explained["FIGURES"][name]()
    assert all(axes.get_xlabel() and axes.get_ylabel() for axes in figure.axes)


def test_a_table_too_wide_for_a_telephone_bears_its_headings_in_its_cells(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS / "extensions"))
    import stacked  # noqa: PLC0415

    def table(*cells):
        row = "".join(f"<td><p>{cell}</p></td>" for cell in cells)
        head = "".join(f'<th class="head"><p>{name}</p></th>' for name in ("what &amp; why", "how"))
        return f'<table class="table"><thead><tr>{head}</tr></thead><tbody><tr>{row}</tr></tbody></table>'

    assert stacked.stacked(table("a", "b")) == table("a", "b")
    wide = stacked.stacked(table("a <code>long</code> cell of more than twenty letters", "and another as long as that"))
    assert wide.startswith('<table class="stacks table"><thead><tr><th class="head"><p>what')
    assert '<td data-label="what &amp; why"><div><p>a <code>long</code> cell' in wide
    assert '<td data-label="how"></td>' in stacked._labelled("<td><p>a section</p></td><td></td>", ["what", "how"])
