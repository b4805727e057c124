"""A bar in a notebook: from two seconds on, one for the outermost call, gone at the end."""

import sys
import types

import pytest

import probation
from campaigns.few_records import few_records
from probation import progress
from probation.progress import NotebookBar, clock, said, shows_progress


class Handle:
    """What IPython's display gives back."""

    def __init__(self, shown, html):
        self.shown = shown
        shown.append(html)

    def update(self, html):
        self.shown.append(html)


@pytest.fixture
def notebook(monkeypatch):
    """A kernel whose outputs are kept; every bar is shown at once."""
    shown = []
    display = types.ModuleType("IPython.display")
    display.HTML = str
    display.display = lambda html, display_id: Handle(shown, html)
    python = types.ModuleType("IPython")
    python.get_ipython = lambda: types.SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", python)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    monkeypatch.setattr(NotebookBar.__init__, "__defaults__", (0.0,))
    return shown


def test_a_fit_moves_one_bar_and_takes_it_away(notebook):
    probation.fit(few_records(names=("slow",)))
    assert "fit, " in notebook[0]
    assert any('value="100"' in html for html in notebook)
    assert notebook[-1] == ""


def test_a_call_within_another_shows_none_of_its_own(notebook):
    campaign = few_records(names=("slow", "middle"), held_out=("middle",))
    probation.certify(campaign, "sa2")
    assert {html.split("</progress> ")[1].split(",")[0] for html in notebook if html} == {"certify"}
    assert notebook.count("") == 1


def test_a_progress_of_the_callers_own_takes_its_place(notebook):
    told = []
    probation.fit(few_records(names=("slow",)), progress=told.append)
    assert told[-1] == 1.0
    assert notebook == []


def test_an_error_leaves_no_bar_and_the_next_call_has_one(notebook):
    @shows_progress
    def fails(*, progress=None):
        progress(0.5)
        raise ValueError

    for _ in range(2):
        with pytest.raises(ValueError, match=r"^$"):
            fails()
        assert notebook.pop() == ""
        assert notebook.pop()


def test_what_is_done_sooner_shows_nothing(notebook, monkeypatch):
    bar = NotebookBar("quick", after=progress.SHOWN_AFTER)
    bar(0.5)
    bar.close()
    assert notebook == []


def test_text_in_a_bar_is_escaped(notebook):
    NotebookBar("a")(1, 4, "<b>\x1b")
    assert "&lt;b&gt;\\u001b, 25 %" in notebook[0]


def test_outside_a_notebook_nothing_is_shown(capsys):
    probation.fit(few_records(names=("slow",)))
    assert capsys.readouterr() == ("", "")


def test_what_is_left_follows_from_what_was_needed():
    assert said(0.4, 31.0) == "40 %, 0:31 so far, about 0:46 left"
    assert said(0.0, 5.0) == "0 %, 0:05 so far"
    assert clock(3725.0) == "62:05"
