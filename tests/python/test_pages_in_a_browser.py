"""Every page that the program writes, light and dark, on a desk, a telephone and paper: nothing cut, nothing faint."""

import re
from functools import cache

import pytest

from browser import browser, layouts
from campaigns.few_records import few_records
from campaigns.typical_results import NAMES, result
from lab_files import bluehill, zwick
from probation import init_campaign
from probation.cli import main
from probation.demo import demonstrate
from probation.field import identify_field, open_maps
from probation.field.example.make import make_example
from probation.smoothing.answer import describe_excitation

DESK, TELEPHONE = 1280, 390
PAPER = 718
"""Pixels of A4 between its margins."""

RESULTS = list(NAMES)
OTHERS = ["files of a laboratory", "strain histories", "score of a sealed split", "maps of a field"]
OTHERS += ["demonstration", "diagnosis of the demonstration", "the paper made again"]


def written(name, folder):
    path = folder / "page.html"
    if name == "files of a laboratory":
        bluehill(folder / "a specimen with a long name, batch 2020-B.csv")
        zwick(folder / "zwick.csv")
        init_campaign(sorted(folder.glob("*.csv")), folder / "made").report(path)
    elif name == "strain histories":
        describe_excitation(few_records(names=("slow", "unloading")).records).report(path)
    elif name == "score of a sealed split":
        split = str(folder / "split")
        assert main(["blind", "make", "--seed", "1", "--count", "2", "--out", split, "--processes", "1"]) == 0
        solver = "probation_studies.blind.example:no_gap"
        assert main(["blind", "solve", split, "--solver", solver, "--processes", "1"]) == 0
        assert main(["blind", "score", split, "--report", str(path)]) == 0
    elif name == "maps of a field":
        field, truth = make_example(folder, size=8, times=60, processes=1)
        identify_field(field, folder / "maps.zarr", processes=1, threads=1)
        open_maps(folder / "maps.zarr").compared_with(truth).report(path)
    elif name == "demonstration":
        demonstration().report(path)
    elif name == "diagnosis of the demonstration":  # by all effects of the catalogue
        step = next(outcome for _, outcome in demonstration().outcomes if outcome.pages)
        step.pages["diagnosis"].report(path)
    elif name == "the paper made again":
        assert main(["paper", "--draws", "2", "--report", str(path)]) == 0
    else:
        result(name).report(path)
    return path.read_text(encoding="utf-8")


@cache
def demonstration():
    return demonstrate()


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    return {name: written(name, tmp_path_factory.mktemp("page")) for name in (*RESULTS, *OTHERS)}


@pytest.fixture(scope="module")
def layout(pages, tmp_path_factory):
    if browser() is None:
        pytest.skip("no browser here: chromium was looked for")
    return layouts(pages, (DESK, TELEPHONE), tmp_path_factory.mktemp("browser"))


@pytest.fixture(scope="module")
def dark(pages, tmp_path_factory):
    if browser() is None:
        pytest.skip("no browser here: chromium was looked for")
    return layouts(pages, (DESK, TELEPHONE), tmp_path_factory.mktemp("dark"), dark=True)


@pytest.fixture(scope="module")
def on_paper(pages, tmp_path_factory):
    """The rules for print, on a screen."""
    if browser() is None:
        pytest.skip("no browser here: chromium was looked for")
    printed = {name: page.replace("@media print", "@media all") for name, page in pages.items()}
    return layouts(printed, (PAPER,), tmp_path_factory.mktemp("paper"))


@pytest.mark.parametrize("width", [DESK, TELEPHONE, PAPER])
@pytest.mark.parametrize("name", [*RESULTS, *OTHERS])
def test_nothing_on_a_page_is_cut_or_sticks_out(name, width, layout, on_paper):
    found = (on_paper if width == PAPER else layout)[name, width]
    assert found.outside == []
    assert found.scroll_width <= width
    assert found.cut == []
    assert found.empty == []
    assert found.clipped == []
    assert found.overlapping == []


@pytest.mark.parametrize("name", [*RESULTS, *OTHERS])
def test_no_text_is_as_faint_as_what_lies_behind_it(name, layout, dark, on_paper):
    screens = [each[name, width] for each in (layout, dark) for width in (DESK, TELEPHONE)]
    assert [found.faint for found in (*screens, on_paper[name, PAPER])] == [[]] * 5


def test_a_dark_page_is_dark_and_a_faint_text_is_found(tmp_path):
    """Grey on the paper of either theme, and white in a square of the drawing."""
    if browser() is None:
        pytest.skip("no browser here: chromium was looked for")
    page = result("fit").report(tmp_path / "fit.html").read_text(encoding="utf-8")
    added = "<p style='color: #8d8d8d'>grey</p><svg width='9em' height='3em'>"
    added += (
        "<rect width='99%' height='99%' fill='#fff'/><text x='2em' y='2em' style='fill: #eee'>white</text></svg></body>"
    )
    pages = {"fit": page.replace("</body>", added)}
    light, dark = (layouts(pages, (DESK,), tmp_path, dark=each) for each in (False, True))
    assert [text.rpartition(": ")[2] for text in light["fit", DESK].faint] == ["grey", "white"]
    assert [text.rpartition(": ")[2] for text in dark["fit", DESK].faint] == ["white"]


@pytest.mark.parametrize("name", ["fit", "certificate", "diagnosis", "cross-check", "files of a laboratory"])
def test_a_pointer_on_a_curve_shows_its_values_with_their_units(name, layout):
    """A value is a name, a number and, unless it is a pure number, its unit."""
    told = [text for width in (DESK, TELEPHONE) for text in layout[name, width].hovered if text]
    assert told
    for text in told:
        assert re.search(r"[a-z]\S* −?\d", text)
    if name == "fit":
        strain, stress = re.search(r"true strain (\S+)\ntrue stress (\S+) MPa", told[0]).groups()
        record = next(iter(result("fit").records.values()))
        assert 0.0 <= float(strain) <= 1.2
        assert float(stress) <= max(each.true_stress.max() for each in result("fit").records.values())
        assert record.true_stress.min() - 1.0 <= float(stress)


def test_a_pointer_on_a_map_shows_the_value_of_its_pixel(layout):
    told = layout["maps of a field", DESK].hovered
    assert re.fullmatch(r"E_u τ_max \d+ MPa s\nx \S+ mm\ny \S+ mm", told[0])
    assert any(re.match(r"standard error of E_u τ_max \S+ %\n", text) for text in told)


@pytest.mark.parametrize("name", [*RESULTS, *OTHERS])
def test_the_verdict_is_one_sentence_of_at_most_25_words(name, pages):
    verdict = re.search(r'<p class="verdict [a-z]+">(.*?)</p>', pages[name], re.DOTALL)[1]
    assert 0 < len(verdict.split()) <= 25
    assert not re.search(r"[.!?] ", verdict)


def test_a_long_table_is_folded_and_opens_without_a_script(pages):
    """Twenty regions: eight of them shown, the others once the summary is clicked."""
    page = pages["diagnosis with everything"]
    folded = page[page.index("<summary>all 20 rows</summary>") :]
    table = folded[: folded.index("</table>")]
    assert table.count("<tr>") == 1 + 8  # the headings' row, too
    assert table.count('<tr class="more">') == 12
    assert ".fold:not([open]) + table tr.more { display: none; }" in page


def test_what_a_verdict_does_not_hold_follows_it(pages):
    page = pages["certificate"]
    headline = result("certificate").headline
    verdict = re.search(r'<p class="verdict [a-z]+">(.*?)\.</p>', page)[1]
    assert headline.startswith(verdict)
    assert headline[len(verdict) + 1 :].strip() in page
