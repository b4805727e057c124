"""What says how a file is read: the same options in every command, the same keywords in Python."""

import argparse
import json

import numpy as np
import openpyxl
import pytest

from probation import Campaign, InputError, preview
from probation.cli import build_parser, main
from probation.records.options import ReadingKeys
from probation.records.reading import read_record

READERS = ("preview", "excitation", "fit", "companion", "certify", "diagnose", "plan", "simulate", "export")
OPTIONS = {"--profile", "--column", "--unit", "--specimen", "--specimen-index", "--sheet", "--test-rate"}

TIME = np.linspace(0.0, 60.0, 61)


@pytest.fixture
def odd_file(tmp_path):
    """A file that says nothing of what its columns are."""
    path = tmp_path / "odd.csv"
    rows = [f"{t:g},{0.01 * t:g},{0.02 * (1 - np.exp(-t / 10)) + 1e-4 * t:g}" for t in TIME]
    path.write_text("\n".join(["a,b,c", *rows]) + "\n")
    return path


HOW = ["--column", "time=a", "--column", "displacement=2", "--column", "force=c", "--unit", "force=kN"]
SPECIMEN = ["--specimen", "width_mm=4", "--specimen", "thickness_mm=1", "--specimen", "gauge_length_mm=20"]


def _commands():
    parser = build_parser()
    (subparsers,) = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    return {
        name: {text for action in own._actions for text in action.option_strings}
        for name, own in subparsers.choices.items()
    }


def test_every_command_that_reads_a_file_takes_the_options_of_preview():
    options = _commands()
    assert {name: OPTIONS - options[name] for name in READERS} == {name: set() for name in READERS}


def test_the_options_say_what_the_keywords_of_python_say():
    keys = {name.strip("-").replace("-", "_") for name in OPTIONS}
    assert {key.removesuffix("s") for key in ReadingKeys.__annotations__} >= keys


def test_fit_reads_a_file_as_preview_shows_it(odd_file, tmp_path, capsys):
    assert main(["preview", str(odd_file), *HOW, *SPECIMEN]) == 0
    assert "kN        → force" in capsys.readouterr().out
    answer = tmp_path / "fit.json"
    assert main(["fit", str(odd_file), *HOW, *SPECIMEN, "--json", str(answer)]) == 0
    assert json.loads(answer.read_text())["schema"] == "probation.fit/1"


def test_campaigns_from_files_take_the_keywords_of_preview(odd_file):
    how = {
        "columns": {"time": "a", "displacement": 2, "force": "c"},
        "units": {"force": "kN"},
        "specimen": {"width_mm": 4, "thickness_mm": 1.0, "gauge_length_mm": 20},
    }
    (record,) = Campaign.from_files([odd_file], **how).records
    (shown,) = preview(odd_file, **how).records
    assert np.array_equal(record.true_stress, shown.true_stress)
    force = 1000 * (0.02 * (1 - np.exp(-6.0)) + 0.006)
    assert record.true_stress[-1] == pytest.approx(force / 4 * 1.03, rel=1e-4)


def test_the_options_are_for_data_files_and_not_for_a_campaign(tmp_path, capsys):
    (tmp_path / "campaign.toml").write_text("")
    assert main(["fit", str(tmp_path), "--unit", "force=kN"]) == 2
    assert "found --unit with the campaign" in capsys.readouterr().err


def test_simulate_takes_any_strain_of_a_record(odd_file, capsys):
    law = ["--set", "unrelaxed_modulus_MPa=3220", "--set", "tau_max_s=5", "--set", "hardening_modulus_MPa=2"]
    how = ["--column", "time=1", "--column", "engineering_strain=2", "--unit", "engineering_strain=%"]
    assert main(["simulate", str(odd_file), *law, *how, "-o", "-"]) == 0
    last = capsys.readouterr().out.splitlines()[-1].split(",")
    assert float(last[1]) == pytest.approx(np.log1p(0.006))


@pytest.mark.parametrize(
    ("given", "area"),
    [
        ({"area_mm2": 3.0}, 3.0),
        ({"width_mm": 2.0, "thickness_mm": 1.5}, 3.0),
        ({"diameter_mm": 2.0}, np.pi),
    ],
)
def test_the_section_is_an_area_a_rectangle_or_a_circle(odd_file, given, area):
    columns = {"time": 1, "engineering_strain": 2, "force": 3}
    record = read_record(odd_file, columns=columns, units={"engineering_strain": "%"}, specimen=given)
    force = 0.02 * (1 - np.exp(-6.0)) + 0.006
    assert record.true_stress[-1] == pytest.approx(force / area * 1.006, rel=1e-4)


@pytest.mark.parametrize("given", [{"width_mm": 2.0}, {"area_mm2": 3.0, "diameter_mm": 2.0}])
def test_a_section_that_is_half_given_or_given_twice_is_refused(odd_file, given):
    with pytest.raises(InputError, match=r"specimen: found .* expected area_mm2, or width_mm and thickness_mm"):
        read_record(odd_file, specimen=given)


@pytest.fixture
def percentages(tmp_path):
    def save(heading, *, first=0.0, style="0.0%"):
        book = openpyxl.Workbook()
        book.active.append(["Time [s]", heading, "True stress [MPa]"])
        for row, step in enumerate(range(20), start=2):
            book.active.append([step, first + 0.05 * step / 19, step / 2])
            book.active.cell(row, 2).number_format = style
        book.active["B2"].number_format = "General"  # a zero that nobody formatted
        book.save(tmp_path / "percent.xlsx")
        return tmp_path / "percent.xlsx"

    return save


@pytest.mark.parametrize("heading", ["True strain [%]", "True strain", "True strain [mm/mm]"])
def test_a_cell_shown_as_5_percent_is_5_percent_under_every_heading(percentages, heading):
    record = read_record(percentages(heading))
    assert record.true_strain[-1] == pytest.approx(0.05, rel=1e-12)


def test_preview_shows_a_percentage_as_the_sheet_does(percentages):
    shown = preview(percentages("True strain"))
    assert shown.columns[1] == ("True strain", "%", "true_strain")
    assert float(shown.first_rows[-1][1]) == pytest.approx(5.0 * 4 / 19)


def test_a_unit_given_for_percentages_is_that_of_what_is_shown(percentages):
    record = read_record(percentages("True strain"), units={"true_strain": "%"})
    assert record.true_strain[-1] == pytest.approx(0.05, rel=1e-12)


def test_a_percent_sign_that_is_text_changes_nothing(percentages):
    record = read_record(percentages("True strain [%]", style='0.00" %"'))
    assert record.true_strain[-1] == pytest.approx(0.0005, rel=1e-12)


@pytest.fixture
def untimed(tmp_path):
    """Engineering strain in percent and stress, up and down again, standing still for one row."""
    path = tmp_path / "curve.csv"
    strain = [*range(21), 20, *range(19, 9, -1)]
    path.write_text("Engineering strain (%),Engineering stress (MPa)\n" + "".join(f"{e},{e}\n" for e in strain))
    return path


def test_a_curve_without_time_takes_a_stated_strain_rate(untimed):
    record = read_record(untimed, test_rate="1 %/s")
    assert record.time == pytest.approx(np.arange(31.0))
    assert record.true_strain[[20, 30]] == pytest.approx(np.log1p([0.2, 0.1]))
    assert "time: it is made of the strain, taken to go at 1 %/s" in record.warnings[0]
    assert "left out 1 rows" in record.warnings[1]


def test_a_curve_without_time_takes_a_stated_crosshead_speed(untimed):
    record = read_record(untimed, test_rate="30 mm/min", specimen={"gauge_length_mm": 50.0})
    assert record.time == pytest.approx(np.arange(31.0))


@pytest.mark.parametrize("rate", ["fast", "0.001", "-1 1/s", "0 1/s", "1 kg", "1..2 1/s", "nan 1/s"])
def test_a_rate_that_is_none_is_refused(untimed, rate):
    with pytest.raises(InputError, match=r"test_rate: found .*, expected a positive number with a unit"):
        read_record(untimed, test_rate=rate)


def test_a_file_without_time_says_what_to_do(untimed):
    with pytest.raises(InputError, match=r'say test_rate = "0.001 1/s"'):
        read_record(untimed)


def test_a_file_with_time_takes_no_rate(percentages):
    with pytest.raises(InputError, match=r"found the time column 'Time \[s\]' together with test_rate"):
        read_record(percentages("True strain"), test_rate="1 1/s")


def test_an_empty_cell_of_a_curve_without_time_is_named_by_its_row(untimed):
    untimed.write_text(untimed.read_text().replace("\n7,7\n", "\n,7\n", 1))
    with pytest.raises(InputError, match=r"row 9, column 'Engineering strain .*found an empty cell"):
        read_record(untimed, test_rate="1 %/s")
