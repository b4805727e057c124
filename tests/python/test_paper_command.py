"""``probation paper`` as users rely on it."""

import json

import pytest

from probation.cli import main
from probation_studies.paper.exhibits import EXHIBITS


def test_the_page_goes_where_the_help_says_and_the_verdict_comes_first(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["paper", "--only", "figure-s1"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("Of 2 numbers of the paper 2 are reproduced.")
    assert "wrote report probation-paper.html" in err
    page = (tmp_path / "probation-paper.html").read_text(encoding="utf-8")
    assert "Figure S1" in page
    assert "seed 0" in page


def test_figures_and_json_are_written_where_they_are_asked_for(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    asked = ["--only", "figure-4a", "--only", "figure-s1", "--out", "figures", "--json", "paper.json", "--seed", "3"]
    assert main(["paper", *asked, "--report", "page.html"]) == 0
    assert {path.name for path in (tmp_path / "figures").iterdir()} == {"figure-4a.png", "figure-s1.png", "paper.json"}
    answer = json.loads((tmp_path / "paper.json").read_text(encoding="utf-8"))
    assert list(answer["exhibits"]) == ["figure-4a", "figure-s1"]
    assert answer["seed"] == 3
    assert not (tmp_path / "probation-paper.html").exists()


def test_the_names_are_listed(capsys):
    assert main(["paper", "--list"]) == 0
    assert capsys.readouterr().out.split() == [entry.name for entry in EXHIBITS]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--only", "tabel-3"], "--only: found 'tabel-3'; did you mean 'table-3'?"),
        (["--draws", "0"], "found '0', expected a whole number from 1"),
        (["--seed", "-1"], "found '-1', expected a whole number from 0"),
        (["--out", "taken"], "taken: found a file, expected a folder or a new name"),
    ],
)
def test_bad_arguments_are_answered_in_one_line(arguments, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").write_text("", encoding="utf-8")
    assert main(["paper", *arguments]) == 2
    error = capsys.readouterr().err
    assert said in error.splitlines()[-1]
    assert len(error.splitlines()) == 1


def test_a_plot_of_what_has_no_figure_costs_the_page_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["paper", "--only", "slips", "--plot", "slips.png"]) == 2
    assert capsys.readouterr().err.splitlines() == [
        "wrote report probation-paper.html",
        "probation: plot: found no figure in slips, expected an exhibit with one",
    ]
    assert (tmp_path / "probation-paper.html").is_file()
