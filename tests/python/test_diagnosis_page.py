"""The page of a diagnosis: what it shows, in which words, and that a browser shows it on a desk and on a phone."""

import re
import shutil
import subprocess
from collections import Counter
from dataclasses import replace
from functools import cache
from html import unescape
from itertools import pairwise

import numpy as np
import pytest
from matplotlib.patches import Rectangle
from PIL import Image

from campaigns import made_up_diagnosis as made_up
from probation.design.isolability_result import EffectIsolability, Isolability
from probation.report.diagnosis_figures import closure_figure, probability_figure, record_figure
from probation.report.diagnosis_page import diagnosis_page
from probation.report.isolability_figure import isolability_figure
from probation.report.residual_map import levels_of, residual_map

JARGON = ("evidence", "posterior", "likelihood", "principal angle", "Laplace", "familywise", "whiten", "isolability")


def could_tell_apart():
    """Four effects: the first two hard to discriminate, the third clear, the last not seen."""
    entries = [("self_heating", 40.0), ("damage", 12.0), ("grip_slip", 90.0), ("force_gain", 0.3)]
    titles = {"self_heating": "self-heating", "grip_slip": "slip in the grips", "force_gain": "gain of the force"}
    chance = np.ones((4, 4))
    chance[0, 1], chance[1, 0], chance[3, 0] = 0.7, 0.9, 0.5
    effects = tuple(
        EffectIsolability(
            name=name,
            title=titles.get(name, name),
            form="first",
            records=None,
            values={"amplitude": 0.1},
            signal=2.0 * size,
            detectability=size,
            seen_from=0.01,
            named_from=None,
            absorbable=0.75 if size > 5.0 else 0.99,
            biases=(),
            rivals={"damage": 0.7} if name == "self_heating" else {},
            one_sided=False,
        )
        for name, size in entries
    )
    return Isolability(("a", "b"), effects, np.eye(4), chance)


@cache
def html(name):
    found = {
        "heating": lambda: replace(made_up.self_heating(), isolability=could_tell_apart()),
        "twelve records": lambda: replace(made_up.self_heating(copies=2), isolability=could_tell_apart()),
        "no gap": lambda: made_up.with_two_records(made_up.no_gap()),
        "unexplained": lambda: made_up.with_two_records(made_up.unexplained()),
    }[name]()
    return diagnosis_page(found).html()


def headings(page):
    return re.findall(r"<h2>(.*?)</h2>", page)


def text_of(page):
    body = page[page.index("<body>") :]
    return " ".join(unescape(re.sub(r"<[^>]*>", " ", body)).split())


def test_the_verdict_comes_first_and_the_rest_in_the_order_of_the_questions():
    page = html("heating")
    assert page.index(made_up.self_heating().headline) < page.index("<h2>")
    assert headings(page) == [
        "In short",
        "Where the simulation departs",
        "Record by record, before and after",
        "Which effect explains it",
        "How far the gap shrinks",
        "The next test",
        "What these tests can discriminate",
        "What was looked for",
        "Details",
    ]
    footer = page[page.index("<footer>") :]
    assert "0" * 64 in footer
    assert "seed 0" in footer


def test_twelve_records_fit_into_two_megabytes_and_fetch_nothing():
    page = html("twelve records")
    assert len(page.encode()) < 2e6
    assert not re.search(r"<(script [^>]*src|link|img|iframe)", page)
    assert all(link.startswith("#") for link in re.findall(r'href="([^"]*)"', page))
    ids = Counter(re.findall(r'\bid="([^"]*)"', page))
    meant = set(re.findall(r'(?:href="|url\()#([^")]*)', page))
    assert {ids[each] for each in meant} == {1}


def test_the_page_does_without_the_words_of_statisticians():
    text = text_of(html("heating"))
    assert [word for word in JARGON if word.lower() in text.lower()] == []


def test_effects_go_by_their_titles_and_not_by_their_names():
    text = text_of(html("heating"))
    assert "self_heating" not in text
    assert "slip in the grips, in ramp-0.003 alone" in text


def test_every_record_has_its_own_picture_with_its_whole_name_and_its_errors():
    page = html("heating")
    for name, each in made_up.self_heating().shrink.records.items():
        assert f"{name}: error {each.before_MPa:.2g} MPa rms before, {each.after_MPa:.2g} after" in page


def test_without_a_gap_there_is_nothing_to_close_and_no_second_curve():
    page = html("no gap")
    assert "there is no gap to close" in text_of(page)
    assert "no effect was added" in text_of(page)
    assert "In no part of any record" in page
    assert "blue)" not in text_of(page)


def test_an_unexplained_gap_is_not_said_to_shrink():
    page = html("unexplained")
    assert "no effect was added" in text_of(page)
    assert "No effect of the catalogue closes the gap; any smooth correction could close" in text_of(page)


def test_colours_of_the_map_say_by_how_many_times_the_noise_the_model_errs():
    """Bounds at 1, 3, 10 and 30: 0.5, 2, 5, 20 and 50 times the noise are levels 0 to 4; too low is negative."""
    noise = np.full(600, 0.04)
    for times, level in ((0.5, 0), (2.0, 1), (5.0, 2), (20.0, 3), (50.0, 4)):
        assert set(levels_of(times * noise, noise)) == {level}
        assert set(levels_of(-times * noise, noise)) == {-level}


def test_noise_leaves_the_map_pale():
    """The mean of 10 samples exceeds their deviation with a probability of 0.16 %."""
    levels = levels_of(np.random.default_rng(1).standard_normal(1200), np.ones(1200))
    assert len(levels) == 120
    assert np.count_nonzero(levels) <= 3


def test_a_short_record_has_one_colour_per_sample():
    assert levels_of(np.array([5.0, -5.0, 0.0]), np.ones(3)) == [2, -2, 0]


def test_bars_always_show_none_and_unknown_and_star_what_cannot_be_distinguished():
    axes = probability_figure(made_up.self_heating()).axes[0]
    names = [label.get_text().replace("\n", " ") for label in axes.get_yticklabels()]
    assert "no effect is needed" in names
    assert "an effect outside the catalogue" in names
    texts = [text.get_text() for text in axes.texts]
    starred = {name for name, text in zip(names, texts, strict=True) if "★" in text}
    assert starred == {"self-heating", "structural softening"}


def test_names_of_three_lines_do_not_meet_beside_the_bars():
    """Every bar is an explanation of three effects, two of them with long titles."""
    found = made_up.self_heating()
    titles = ("offset of the force cell", "compliance of the machine", "another shape of the spectrum")
    long = [replace(each, effects=("a", "b", "c"), titles=titles, probability=0.2) for each in found.explanations]
    figure = probability_figure(replace(found, explanations=tuple(long)))
    figure.draw_without_rendering()
    labels = figure.axes[0].get_yticklabels()
    assert sum(label.get_text().count("\n") >= 2 for label in labels) > 2
    boxes = sorted((label.get_window_extent() for label in labels), key=lambda box: -box.y0)
    assert all(below.y1 <= above.y0 for above, below in pairwise(boxes))
    bars = [bar.get_y() + 0.5 * bar.get_height() for bar in figure.axes[0].patches]
    assert bars == pytest.approx(list(figure.axes[0].get_yticks()))


def test_a_strain_that_only_grows_is_the_axis_and_time_otherwise():
    found = made_up.self_heating()
    assert record_figure(found, "ramp-0.003").axes[1].get_xlabel() == "true strain [–]"
    assert record_figure(found, "dwell").axes[1].get_xlabel() == "time [s]"
    assert record_figure(found, made_up.LONG).axes[1].get_xlabel() == "time [s]"


def test_axes_of_measured_quantities_bear_their_units():
    found = made_up.self_heating()
    drawn = [residual_map(found), record_figure(found, "dwell"), closure_figure(found), probability_figure(found)]
    for figure in drawn:
        for axes in figure.axes:
            shared = axes.get_shared_x_axes().get_siblings(axes)
            assert any("[" in each.get_xlabel() for each in shared)
    assert all("[" in axes.get_ylabel() for axes in record_figure(found, "dwell").axes)


def test_the_map_of_rivals_colours_what_is_confused_unless_it_is_not_even_seen():
    """0.7 and 0.9 are below 0.95; the third pair sits in the row of an effect below 5 standard deviations."""
    axes = isolability_figure(could_tell_apart()).axes[0]
    squares = [patch for patch in axes.patches if isinstance(patch, Rectangle) and patch.get_width() == 1.0]
    assert {(round(each.get_x() + 0.5), round(each.get_y() + 0.5)) for each in squares} == {(1, 0), (0, 1)}
    rows = [patch for patch in axes.patches if isinstance(patch, Rectangle) and patch.get_width() == 4.0]
    assert [round(each.get_y() + 0.5) for each in rows] == [3]


@pytest.mark.parametrize(("colours", "width"), [("dark", 1200), ("light", 420)])
def test_a_browser_shows_the_page_and_nothing_sticks_out(colours, width, tmp_path):
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if browser is None:
        pytest.skip("no browser here")
    (tmp_path / "page.html").write_text(html("twelve records"), encoding="utf-8")
    scheme = ["--blink-settings=preferredColorScheme=0"] if colours == "dark" else []
    subprocess.run(
        [
            *(browser, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", *scheme),
            f"--window-size={width},6000",
            f"--user-data-dir={tmp_path / 'profile'}",
            f"--screenshot={tmp_path / 'page.png'}",
            (tmp_path / "page.html").as_uri(),
        ],
        check=True,
        capture_output=True,
        timeout=120,
    )
    shown = np.asarray(Image.open(tmp_path / "page.png").convert("L")).astype(int)
    background = shown[5, 5]
    assert background > 240 if colours == "light" else background < 40
    assert np.ptp(shown[:, -12:]) == 0
    filled = np.ptp(shown, axis=1) > 20
    assert max(len(run) for run in "".join("x" if row else "." for row in filled).split("x")) < 200
    assert len(np.unique(shown)) > 30
