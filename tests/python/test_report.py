"""Plots and pages."""

import re
import shutil
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

import probation
from probation.answers import json_answer, plain
from probation.provenance import provenance, running
from probation.report.figures import (
    figure_to_svg,
    house_style,
    narrow,
    new_figure,
    number_logarithmic,
    save_figure,
    thinned,
)
from probation.report.page import Page, Section, picture
from probation.report.plots import Curve, sensitivities, strain_rates, stress_strain_with_residuals
from probation.report.style import COLOURS
from probation.report.table import Table

STRAIN = np.linspace(0.0, 1.0, 500)
CURVE = Curve("ramp <1>", STRAIN, 30 * STRAIN + 0.1 * np.sin(40 * STRAIN), 30 * STRAIN, 0.04)


@pytest.fixture
def figure():
    return stress_strain_with_residuals([CURVE])


@pytest.fixture
def page(figure):
    table = Table(("name", "value [MPa]"), (("E_u", "3224"), ("G & more", "2.5")), "Parameters")
    sections = (Section("Curves", (picture(figure, "Curves <and> residuals"), "A paragraph.", table)),)
    with running("probation fit x"):
        return Page("Fit of <x>", "All is well", sections, "good", "A lead.", provenance("abc123", 7))


class Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.seen = [], []

    def handle_starttag(self, tag, attrs):
        self.seen.append((tag, dict(attrs)))
        if tag not in ("meta", "br", "link", "img"):
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.seen.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_a_page_is_well_formed_and_fetches_nothing(page):
    tags = Tags()
    tags.feed(page.html())
    assert tags.open == []
    names = {tag for tag, _ in tags.seen}
    assert names.isdisjoint({"link", "img", "iframe"})
    assert all("src" not in attributes for tag, attributes in tags.seen if tag == "script")
    links = [value for _, attributes in tags.seen for key, value in attributes.items() if key.endswith("href")]
    assert all(link.startswith("#") for link in links)


def test_a_page_says_the_verdict_first_and_where_it_came_from(page):
    html = page.html()
    assert html.index("All is well") < html.index("A lead.") < html.index("Curves</h2>")
    footer = html[html.index("<footer>") :]
    assert all(part in footer for part in (probation.__version__, "abc123", "seed 7", "probation fit x"))


@pytest.mark.parametrize(
    ("verdict", "first"),
    [
        ("No gap.", "No gap."),
        (f"It holds (1; 2) for all {'tests ' * 9}: {'word ' * 20}", f"It holds (1; 2) for all {'tests ' * 9}".strip()),
        (
            f"Not predicted: it misses jump, by 12 MPa, which is {'far ' * 30}",
            "Not predicted: it misses jump, by 12 MPa.",
        ),
        ("far " * 40, "far " * 24 + "…"),
    ],
    ids=["short", "at a clause", "at a comma", "anywhere"],
)
def test_a_verdict_is_one_sentence_and_nothing_of_it_is_lost(verdict, first):
    html = Page("x", verdict, ()).html()
    shown = re.search(r'<p class="verdict neutral">(.*?)</p>', html)[1]
    assert len(shown.split()) <= 25
    assert shown.rstrip(".").strip() == first.rstrip(".").strip()
    rest = verdict.split(":")[-1].strip()
    assert shown == verdict or rest in html or rest[0].upper() + rest[1:] in html


def test_a_page_escapes_what_it_shows(page):
    html = page.html()
    assert "Fit of &lt;x&gt;" in html
    assert "G &amp; more" in html
    assert "Curves &lt;and&gt; residuals" in html


def test_colours_of_a_figure_follow_the_page(figure):
    svg = figure_to_svg(figure, "curves")
    assert f"var(--model, {COLOURS['model'].light})" in svg
    assert not re.search(r"(?<!, )#[0-9a-f]{6}", svg.replace("#ffffff", ""))


def test_numbers_in_a_figure_keep_their_digits():
    with house_style():
        drawing = new_figure()
        drawing.subplots().set_title("rate 0.00512 1/s")
    assert "rate 0.00512 1/s" in figure_to_svg(drawing, "title")


def test_the_same_figure_gives_the_same_text(figure):
    assert figure_to_svg(figure, "curves") == figure_to_svg(figure, "curves")


@pytest.mark.parametrize("colours", ["light", "dark"])
def test_a_browser_shows_the_page(page, tmp_path, colours):
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if browser is None:
        pytest.skip("no browser here")
    page.write(tmp_path / "page.html")
    scheme = ["--blink-settings=preferredColorScheme=0"] if colours == "dark" else []
    subprocess.run(
        [
            *(browser, "--headless", "--no-sandbox", "--disable-gpu", *scheme, "--window-size=900,1200"),
            f"--user-data-dir={tmp_path / 'profile'}",
            f"--screenshot={tmp_path / 'page.png'}",
            (tmp_path / "page.html").as_uri(),
        ],
        check=True,
        capture_output=True,
        timeout=120,
    )
    shown = np.asarray(Image.open(tmp_path / "page.png").convert("L"))
    background = shown[-20, 20]
    assert background > 240 if colours == "light" else background < 40
    assert len(np.unique(shown)) > 30


def test_a_figure_is_saved_by_its_ending(figure, tmp_path):
    for ending in ("png", "svg", "pdf"):
        save_figure(figure, tmp_path / f"a.{ending}")
    with pytest.raises(probation.InputError, match=r"found the ending '.gif'"):
        save_figure(figure, tmp_path / "a.gif")


def test_residuals_are_magnified_as_said(figure):
    above, below = figure.axes
    lengths = [axes.get_window_extent().height / np.ptp(axes.get_ylim()) for axes in (above, below)]
    said = float(re.search(r"magnified (\S+) times", " ".join(text.get_text() for text in below.texts))[1])
    assert said == pytest.approx(lengths[1] / lengths[0], rel=0.06)


def test_every_plot_labels_its_axes_with_units(figure):
    others = [
        sensitivities(STRAIN, np.outer(STRAIN, [1.0, 2.0]), ["E_u", "G"]),
        strain_rates([("ramp", STRAIN, 0.005 + 0 * STRAIN), ("reversed", STRAIN, -0.005 + 0 * STRAIN)]),
    ]
    for drawn in (figure, *others):
        assert "[" in drawn.axes[-1].get_xlabel()
        assert all("[" in axes.get_ylabel() for axes in drawn.axes)


def test_a_constant_rate_is_not_magnified_to_its_round_off():
    axes = strain_rates([("ramp", STRAIN, 0.005 * (1 + 1e-12 * np.sin(99 * STRAIN)))]).axes[0]
    assert axes.get_ylim() == pytest.approx((0.0, 0.00625))


@pytest.mark.parametrize("highest", [0.9, 9.0, 40.0, 4e4])
def test_the_numbers_of_a_logarithmic_axis_do_not_overlap(highest):
    with house_style():
        figure = new_figure(4.0, 3.0)
        axes = figure.subplots()
        axes.loglog([0.2, highest], [1.0, 2.0])
        number_logarithmic(axes.xaxis)
        figure.draw_without_rendering()
        numbers = [label for label in axes.get_xticklabels(which="both") if label.get_text()]
        low, high = axes.get_xlim()
        shown = sorted((label.get_window_extent().extents for label in numbers), key=lambda box: box[0])
    inside = sum(low <= place <= high for place in axes.get_xticks())
    assert inside >= 2 or len(shown) > 2
    assert all(left[2] < right[0] for left, right in pairwise(shown))


def test_a_label_longer_than_its_axis_is_broken_on_a_telephone():
    with house_style():
        figure = new_figure(7.2, 5.0)
        _, below = figure.subplots(2, 1, height_ratios=(2.5, 1.0))
        below.plot([0.0, 1.0], [0.0, 1.0])
        below.set_ylabel("integrated − measured [–]")
        assert narrow(figure)
        figure.draw_without_rendering()
        assert below.yaxis.label.get_window_extent().height <= 1.05 * below.get_window_extent().height
    assert "&quot;label&quot;:&quot;integrated − measured [–]&quot;" in figure_to_svg(figure, "broken")


def test_the_names_of_many_curves_stand_beside_the_curves():
    curve = Curve("a", np.linspace(0.0, 1.0, 50), np.linspace(0.0, 40.0, 50), np.linspace(0.0, 41.0, 50))
    figure = stress_strain_with_residuals([curve] * 4)
    assert [axes.get_legend() for axes in figure.axes] == [None] * 5
    assert len(figure.legends) == 1


@pytest.mark.parametrize("name", ["OUTRaw_MD_CSR_01_T40-{}", "film {0} of the second batch, cut across the roll, " * 3])
def test_long_names_of_curves_do_not_reach_beyond_the_figure(name):
    figure = stress_strain_with_residuals([replace(CURVE, name=name.format(at)) for at in range(3)])
    figure.draw_without_rendering()
    box = figure.legends[0].get_window_extent()
    assert box.x0 >= 0.0
    assert box.x1 <= figure.get_window_extent().width


def test_a_band_of_predictions_much_wider_than_the_residual_is_told_not_drawn():
    wide, near = (stress_strain_with_residuals([replace(CURVE, band95=0 * STRAIN + band)]) for band in (30.0, 0.2))
    notes = [" ".join(text.get_text() for text in figure.axes[1].texts) for figure in (wide, near)]
    assert "95 % prediction: ±30 MPa" in notes[0]
    assert "dashed: 95 % prediction" in notes[1]
    assert wide.axes[1].get_ylim()[1] < 0.5
    assert [sum(line.get_linestyle() == "--" for line in figure.axes[1].lines) for figure in (wide, near)] == [0, 2]


def test_a_long_curve_is_thinned_to_its_outline():
    x = np.arange(100_000.0)
    y = np.zeros_like(x)
    y[54_321] = 1.0
    few_x, few_y = thinned(x, y)
    assert len(few_x) <= 2100
    assert few_y.max() == 1.0
    assert (few_x[0], few_x[-1]) == (x[0], x[-1])


def test_a_table_sets_words_left_and_numbers_right():
    text = Table(("name", "value"), (("a", "1.5"), ("long name", "10")), "Caption").text()
    assert text.splitlines()[0] == "Caption"
    assert text.splitlines()[-1] == "  long name     10"


def test_json_has_no_nan_and_knows_arrays():
    text = json_answer("probation.test/1", {"a": float("nan"), "b": np.arange(3.0), "c": (np.int64(2), np.bool_(True))})
    assert '"a": null' in text
    assert '"b": [ 0.0, 1.0, 2.0 ]' in text
    assert plain({"x": np.float64("inf")}) == {"x": None}
    with pytest.raises(TypeError, match="no form in JSON"):
        plain(object())
