"""``probation demo``, ``fit`` and ``preview``."""

import json
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import pytest

from probation.cli import main
from probation.demo import STEPS
from probation.published.experiments import twin_campaign


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """What the demonstration wrote; beside it what it printed."""
    folder = tmp_path_factory.mktemp("demo") / "out"
    printed = StringIO()
    with redirect_stdout(printed):
        assert main(["demo", "--out", str(folder)]) == 0
    (folder.parent / "printed.txt").write_text(printed.getvalue(), encoding="utf-8")
    return folder


def test_the_demonstration_identifies_every_twin_within_three_standard_errors(folder):
    told = json.loads((folder / "demo.json").read_text(encoding="utf-8"))
    assert told["passed"] is True
    truth = {"unrelaxed_modulus_MPa": 3224.0, "tau_max_s": 5.207, "hardening_modulus_MPa": 2.556}
    for name, value in truth.items():
        found = told["identification"]["parameters"]["experiment-1"][name]
        assert abs(found["value"] - value) < 3 * found["se"]
    assert told["seed"] == 0


def test_the_readme_shows_what_the_demonstration_prints(folder):
    """Each line of its block, up to … where it is cut there, begins a line of the demonstration."""
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    block = readme.split("```text\n")[1].split("```")[0].splitlines()
    printed = (folder.parent / "printed.txt").read_text(encoding="utf-8").splitlines()
    for line in block:
        assert any(each.startswith(line.removesuffix("…").rstrip()) for each in printed), line


def test_the_lines_of_the_readme_print_what_it_shows(folder, tmp_path, monkeypatch, capsys):
    """On what the demonstration wrote; the shown text is folded, and cut at …"""
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    lines = readme.split("```python\n")[1].split("```")[0]
    shown = readme.split("```text\n")[2].split("```")[0]
    assert "probation-demo/" in lines
    monkeypatch.chdir(tmp_path)
    exec(lines.replace("probation-demo", str(folder)), {})
    printed = " ".join(capsys.readouterr().out.split())
    assert shown.count("…") == 1
    assert printed.startswith(" ".join(shown.split("…")[0].split()))
    assert (tmp_path / "diagnosis.html").exists()


def test_the_page_of_the_demonstration_holds_every_step(folder):
    html = (folder / "report.html").read_text(encoding="utf-8")
    assert all(step.title in html for step in STEPS)
    assert html.index("The law is identified") < html.index("All schemes agree")
    assert len(html) < 2_000_000


def test_the_demonstration_finds_the_companion_relation_that_is_taken_away(folder):
    answer = json.loads((folder / "demo.json").read_text(encoding="utf-8"))["diagnosis"]
    assert answer["causes"][0]["effects"] == ["rate_dependent_relaxation"]
    assert answer["causes"][0]["probability"] > 0.8
    assert all(set(names) <= {"rate_dependent_relaxation", "unknown"} for names in answer["answer_set"])
    assert answer["shrink"]["identify"]["before_MPa"] > 6.0
    assert answer["shrink"]["identify"]["after_MPa"] < 0.06
    page = (folder / "diagnosis.html").read_text(encoding="utf-8")
    assert "Rate-dependent relaxation explains the gap" in page
    assert (folder / "plots" / "diagnosis.png").exists()


def test_the_twins_it_wrote_can_be_fitted(folder, capsys):
    assert main(["fit", str(folder / "experiment-2"), "--json", "-"]) == 0
    captured = capsys.readouterr()
    told = json.loads(captured.out)
    assert told["schema"] == "probation.fit/1"
    assert told["parameters"]["alpha"]["value"] == pytest.approx(1.11, abs=0.002)


def test_the_demonstration_can_keep_to_the_terminal(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("probation.demo.STEPS", STEPS[:1])
    assert main(["demo", "--no-files"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("The law is identified: every parameter lies within")
    assert "identified ± se" in out
    assert list(tmp_path.iterdir()) == []


def test_the_demonstration_as_json_alone(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("probation.demo.STEPS", STEPS[:1])
    assert main(["demo", "--no-files", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["schema"] == "probation.demo/1"
    assert main(["demo", "--no-files", "--json", str(tmp_path / "demo.json")]) == 0
    assert (tmp_path / "demo.json").exists()


def test_a_file_in_the_way_of_the_demonstration_is_bad_input(tmp_path, capsys):
    (tmp_path / "taken").write_text("", encoding="utf-8")
    assert main(["demo", "--out", str(tmp_path / "taken")]) == 2
    assert "found a file, expected a folder" in capsys.readouterr().err


def test_fit_holds_parameters_and_writes_what_is_asked_for(tmp_path, capsys):
    twin_campaign((1,)).save(tmp_path / "c")
    page, plot, answer = (tmp_path / name for name in ("fit.html", "fit.png", "fit.json"))
    files = ["--report", str(page), "--plot", str(plot), "--json", str(answer)]
    held = ["--hold", "unrelaxed_modulus_MPa=3220", "--scheme", "sa3"]
    assert main(["fit", str(tmp_path / "c" / "campaign.toml"), *held, *files]) == 0
    assert all(each.exists() for each in (page, plot, answer))
    told = json.loads(answer.read_text(encoding="utf-8"))
    assert told["scheme"] == "sa3"
    assert told["parameters"]["tau_max_s"]["value"] == pytest.approx(5.214, abs=0.01)
    assert "wrote report" in capsys.readouterr().err


def test_preview_shows_how_a_file_would_be_read(tmp_path, capsys):
    twin_campaign((1,)).save(tmp_path)
    plot = tmp_path / "plot.png"
    assert main(["preview", str(tmp_path / "experiment-1.csv"), "--plot", str(plot)]) == 0
    assert "experiment-1" in capsys.readouterr().out
    assert plot.exists()


def test_preview_takes_columns_by_heading_or_position(tmp_path, capsys):
    rows = "".join(f"{at},{0.01 * at},{1.0 + at}\n" for at in range(20))
    path = tmp_path / "odd.csv"
    path.write_text("when,how far,how hard\n" + rows, encoding="utf-8")
    columns = ["--column", "time=when", "--column", "engineering_strain=2", "--column", "engineering_stress=how hard"]
    assert main(["preview", str(path), *columns, "--unit", "engineering_stress=kPa"]) == 0
    assert "kPa" in capsys.readouterr().out
