"""The library is built from the bottom up: a room imports only from rooms below it, and results know no report."""

import ast
import re
import subprocess
import sys
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from probation.report.renderers import RENDERERS, renderer

SOURCES = Path(__file__).parents[2] / "python"

ORDER = re.findall(
    r"\w+",
    """
    _core errors normal settings
    _interrupt _text _arrays _short_repr _complaint limits _files wording answers provenance origin processors
    parallel pool progress results law records histories published smoothing noise detection effects inference
    identify design calibration certificate diagnosis comparison
    schemes simulation batch bulk exporting field
    report
    fe demo commands cli __main__
    """,
)
"""The rooms of `probation`, bottom first."""

STUDIES = ["paper", "blind", "specimen", "coverage", "smoothing", "commands"]
"""The rooms of `probation_studies`, which stands on the library, bottom first."""

PLACE = {f"probation.{room}": place for place, room in enumerate(ORDER)} | {
    f"probation_studies.{room}": len(ORDER) + place for place, room in enumerate(STUDIES)
}


def room_of(module):
    """`probation.report` of `probation.report.table`."""
    return ".".join(module.split(".")[:2])


def imports(path):
    """Modules that a file imports anywhere in it, those for type checking included."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: a relative import"
            inside = node.module in ("probation", "probation_studies")  # the names are rooms
            names = [f"{node.module}.{alias.name}" for alias in node.names] if inside else [node.module]
            yield from ((name, node.lineno) for name in names)


@cache
def crossings():
    """(importing room, imported room, where) of every import from another room."""
    return list(_crossings())


def _crossings():
    for path in sorted(SOURCES.glob("probation*/**/*.py")):
        parts = path.relative_to(SOURCES).with_suffix("").parts
        own = room_of(".".join(parts))
        if own.endswith(".__init__"):  # the public names, which may stand anywhere
            continue
        for name, line in imports(path):
            if name.split(".")[0] in ("probation", "probation_studies") and room_of(name) != own:
                yield own, room_of(name), f"{path.relative_to(SOURCES)}:{line} imports {name}"


def needs_of_files():
    """Which files every file imports, by their module names."""
    paths = {
        ".".join(each.relative_to(SOURCES).with_suffix("").parts): each for each in SOURCES.glob("probation*/**/*.py")
    }
    modules = {name.removesuffix(".__init__"): path for name, path in paths.items()}
    for module, path in modules.items():
        tree = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        needed = {
            full if (full := f"{node.module}.{alias.name}") in modules else node.module
            for node in tree
            if isinstance(node, ast.ImportFrom)
            for alias in node.names
        }
        yield module, needed & modules.keys()


def test_no_two_files_need_each_other():
    """Types included: what two files share stands in a third."""
    try:
        tuple(TopologicalSorter(dict(needs_of_files())).static_order())
    except CycleError as circle:
        pytest.fail(f"files that need each other: {' <- '.join(circle.args[1])}")


def test_a_room_imports_only_from_rooms_below_it():
    """So that there is no circle between rooms."""
    wrong = [
        where
        for own, other, where in crossings()
        if other != "probation" and not PLACE.get(other, len(PLACE)) < PLACE.get(own, -1)
    ]
    assert not wrong, "\n".join(["an import of the same height or back up, or a room without a place:", *wrong])


def test_no_room_below_the_reports_imports_one():
    below = {f"probation.{room}" for room in ORDER[: ORDER.index("report")]}
    assert not [where for own, other, where in crossings() if own in below and other == "probation.report"]


def test_the_library_imports_none_of_its_studies():
    assert not [
        where
        for own, other, where in crossings()
        if own.startswith("probation.") and other.startswith("probation_studies")
    ]


def test_only_the_studies_import_the_public_names():
    """Inside the library a name comes from the room where it stands."""
    assert not [where for own, other, where in crossings() if other == "probation" and own.startswith("probation.")]


def is_one_line(result):
    return result.__repr__.__qualname__.startswith("InOneLine.")


@pytest.mark.parametrize("name", RENDERERS)
def test_a_result_offers_what_the_table_of_renderers_has_and_nothing_else(name):
    module, _, kind = f"probation.{name}".rpartition(".")
    if module.startswith("probation.field"):
        pytest.importorskip("xarray")
    result = getattr(__import__(module, fromlist=[kind]), kind)
    offered = {what for what in ("summary", "plot", "report") if hasattr(result, what)}
    assert offered == set(RENDERERS[name]) - {"verdict", "card", "line", "corner"}
    assert set(RENDERERS[name]) & {"card", "line"} <= {
        "card" * hasattr(result, "_repr_html_"),
        "line" * is_one_line(result),
    }
    assert all(callable(renderer(result, what)) for what in RENDERERS[name])


def test_every_result_stands_in_the_table_of_renderers():
    bases = {"Displayed", "InOneLine", "Summarised", "Plotted", "Reported", "Result"}
    found = set()
    for path in (SOURCES / "probation").glob("**/*.py"):
        module = ".".join(path.relative_to(SOURCES / "probation").with_suffix("").parts)
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef) and bases & {getattr(base, "id", "") for base in node.bases}:
                found.add(f"{module}.{node.name}")
    assert {each for each in found if not each.startswith("results.rendering.")} == set(RENDERERS)


def test_a_fit_loads_no_report_and_its_summary_no_matplotlib():
    program = """
import sys
import numpy as np
import probation
time = np.linspace(0.0, 100.0, 60)
law = probation.Law(unrelaxed_modulus=3000.0, tau_max=5.0, hardening_modulus=2.0)
record = probation.Record("ramp", time, 0.005 * time, probation.ramp_stress(law, 0.005, time))
found = probation.fit(probation.Campaign("one", (record,)), "be2")
found.to_json()
print(*(name for name in sys.modules if name.startswith("probation.report")), end="|")
found.summary()
print("probation.report.fit_summary" in sys.modules, "matplotlib" in sys.modules)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "|True False\n"


def test_a_fit_of_ramps_loads_neither_optimisers_nor_splines():
    """They take a tenth of a second, a tenth of the command."""
    program = """
import sys
import numpy as np
import probation
law, records = probation.Law(unrelaxed_modulus=3000.0, tau_max=5.0, hardening_modulus=2.0), []
for name, rate in (("slow", 1e-3), ("fast", 1e-2)):
    time = np.linspace(0.0, 0.5 / rate, 120)
    noise = 0.05 * np.random.default_rng(1).standard_normal(120)
    records.append(probation.Record(name, time, rate * time, probation.ramp_stress(law, rate, time) + noise))
found = probation.fit(probation.Campaign("two", tuple(records)), gap=True)
found.summary()
print(found.gap.in_fitted, *(name for name in ("scipy.optimize", "scipy.interpolate") if name in sys.modules))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
