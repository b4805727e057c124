"""A bar in a notebook or a terminal: from two seconds on, one for the outermost call, gone at the end."""

import io
import sys
import time
import types

import numpy as np
import pytest

import probation
from campaigns.few_records import few_records
from lab_files import FILES
from probation import progress
from probation.commands.progress import shown
from probation.diagnosis.isolability import campaign_isolability
from probation.progress import NotebookBar, Part, TerminalBar, clock, said, shows_progress
from probation.published.experiments import twin_campaign


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
    assert "fit: smoothed slow, " in notebook[0]
    assert any('value="100"' in html for html in notebook)
    assert notebook[-1] == ""


def test_a_call_within_another_shows_none_of_its_own(notebook):
    campaign = few_records(names=("slow", "middle"), held_out=("middle",))
    probation.certify(campaign, "sa2")
    assert {html.split("</progress> ")[1].split(":")[0].split(",")[0] for html in notebook if html} == {"certify"}
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


def a_terminal(monkeypatch):
    """A terminal for standard error; every bar is shown at once."""
    stream = io.StringIO()
    stream.isatty = lambda: True
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.setattr(TerminalBar.__init__, "__defaults__", (0.0,))
    monkeypatch.setattr("probation.commands.progress.SHOWN_AFTER", 0.0)
    return stream


def asked(progress):
    """What lasts, and says so."""
    progress(Part(0.4, "on it"))
    time.sleep(0.3)


def test_a_call_from_a_plain_terminal_shows_a_bar(monkeypatch):
    terminal = a_terminal(monkeypatch)

    @shows_progress
    def some_work(*, progress=None):
        asked(progress)

    some_work()
    assert "some work: on it" in terminal.getvalue()
    assert "left" in terminal.getvalue()


def test_a_call_that_asks_shows_no_bar_over_its_question(monkeypatch, tmp_path):
    terminal = a_terminal(monkeypatch)
    FILES["essai.csv"][0](tmp_path / "a.csv")
    asked_of = []

    def answer(question):
        asked_of.append(question.key)
        time.sleep(0.3)
        return question.default

    probation.init_campaign([tmp_path / "a.csv"], tmp_path / "out", ask=answer)
    assert asked_of
    assert terminal.getvalue() == ""


def test_a_call_within_a_command_leaves_the_bar_to_it(monkeypatch):
    terminal = a_terminal(monkeypatch)

    @shows_progress
    def some_work(*, progress=None):
        assert progress is None

    with shown("the command") as advance:
        some_work()
        asked(lambda part: advance(4, 10, part.doing))
    assert "the command: on it" in terminal.getvalue()


def test_a_process_that_works_for_another_shows_none(monkeypatch):
    a_terminal(monkeypatch)
    assert progress.on_terminal()
    monkeypatch.setattr("multiprocessing.parent_process", object)
    assert not progress.on_terminal()


def test_what_is_left_follows_from_what_was_needed():
    assert said(0.4, 31.0) == "40 %, 0:31 so far, about 0:46 left"
    assert said(0.0, 5.0) == "0 %, 0:05 so far"
    assert clock(3725.0) == "62:05"


@pytest.mark.parametrize("question", ["fit", "certify", "diagnose", "compare", "plan", "isolability"])
def test_every_question_says_what_is_being_done(question):
    told = []
    campaign = few_records(names=("slow", "middle"))
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
    effects = ["force_offset", "damage"]
    ask = {
        "fit": lambda: probation.fit(campaign, "sa2", gap=False, progress=told.append),
        "certify": lambda: probation.certify(campaign, "sa2", progress=told.append),
        "diagnose": lambda: probation.diagnose(campaign, "sa2", effects=effects, progress=told.append),
        "compare": lambda: probation.compare(campaign, campaign, "sa2", effects=["force_drift"], progress=told.append),
        "plan": lambda: probation.plan(
            law,
            {"ramp": probation.named_history("ramp", rate=0.005, strain=1.0, samples=60)},
            noise=0.5,
            effects=effects,
            progress=told.append,
        ),
        "isolability": lambda: campaign_isolability(campaign, "sa2", effects=effects, progress=told.append),
    }
    ask[question]()
    assert told == sorted(told)
    assert all(part.doing for part in told if part < 0.9)


def test_a_diagnosis_moves_from_its_start_to_its_end():
    """Every refit and every effect that is compared moves it; it was still for two thirds of the time."""
    told = []
    campaign = few_records(names=("slow", "middle"))
    probation.diagnose(campaign, "sa2", effects=["force_offset", "damage", "force_drift"], progress=told.append)
    steps = np.diff([float(part) for part in told])
    assert steps.min() >= 0.0
    assert steps.max() <= 0.55  # no gap: causes are not searched
    assert len({float(part) for part in told if part.doing == "what these tests can discriminate"}) > 5


def test_a_search_moves_at_every_refit_and_never_back():
    told = []
    campaign = twin_campaign((1, 2))
    effects = ["force_offset", "damage", "rate_dependent_relaxation"]
    probation.diagnose(campaign, "sa2", effects=effects, design=False, progress=told.append)
    parts = [float(part) for part in told if part.doing == "trying causes"]
    assert parts == sorted(parts)
    assert len(set(parts)) > 5


def test_a_file_that_is_read_is_named(tmp_path):
    told = []
    names = ("Specimen_RawData_1.csv", "essai.csv")
    for name in names:
        FILES[name][0](tmp_path / name)
    files = [tmp_path / name for name in names]
    probation.init_campaign(files, tmp_path / "made", progress=lambda *said: told.append(said))
    assert told == [
        (0, 2, "reading Specimen_RawData_1.csv"),
        (1, 2, "reading essai.csv"),
        (2, 2, "drawing the records"),
    ]
