"""Files as testing machines write them are read as they are: columns, units, the specimen's dimensions."""

from pathlib import Path

import numpy as np
import openpyxl
import pytest

from lab_files import EXTENSION, FILES, FORCE, STRAIN, STRESS, TIME, bluehill, trapezium, zwick_workbook
from probation import Campaign, InputError, preview
from probation.records.reading import read_record, read_records

DATA = Path(__file__).parents[2].parent / "shared" / "data"
needs_data = pytest.mark.skipif(not DATA.exists(), reason="the measured records are not here")

WITHOUT_DIMENSIONS = ("Zugversuch.xlsx", "DAQ- Axial.csv", "specimen.dat", "Temp_LP.xlsx", "Temp_LP.asc", "counts.asc")
HOW = {
    **{name: {"specimen": {"area_mm2": 40.0, "gauge_length_mm": 50.0}} for name in WITHOUT_DIMENSIONS},
    "tension.csv": {"columns": {"engineering_strain": "Strain (%)", "engineering_stress": "Stress (MPa)"}},
}


@pytest.fixture
def lab(tmp_path):
    def write(name):
        FILES[name][0](tmp_path / name)
        return tmp_path / name

    return write


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_read_as_its_machine_wrote_it(lab, name):
    _, profile, count = FILES[name]
    records = read_records(lab(name), **HOW.get(name, {}))
    assert [record.profile for record in records] == [profile] * count
    record = records[0]
    zero = -0.004 if name == "stage.txt" else 0.0
    force = 1.01 if name == "Zugversuch.xlsx" else 1.0
    assert record.time == pytest.approx(TIME, abs=1e-3)
    assert record.true_strain == pytest.approx(np.log1p(STRAIN + zero), abs=2e-6)
    assert record.true_stress == pytest.approx(force * STRESS * (1.0 + STRAIN + zero), abs=2e-4)


@pytest.mark.parametrize("name", [name for name in FILES if name not in HOW])
def test_the_specimen_is_taken_from_the_head_of_the_file(lab, name):
    for record in read_records(lab(name)):
        assert not [warning for warning in record.warnings if "assumed" in warning]


def test_what_is_said_wins_over_the_head_of_the_file(lab):
    path = lab("Specimen_RawData_1.csv")
    stated, said = read_record(path), read_record(path, specimen={"area_mm2": 80.0})
    assert said.true_stress == pytest.approx(stated.true_stress / 2.0)


def test_each_specimen_of_a_file_has_its_own_dimensions(lab):
    first, second = read_records(lab("raw.csv"))
    assert second.true_stress == pytest.approx(first.true_stress / 1.02)


def test_a_specimen_that_broke_earlier_ends_earlier(lab):
    first, second = read_records(lab("raw-side.csv"))
    assert (len(first), len(second)) == (101, 80)


def test_every_sheet_with_the_same_headings_is_a_specimen(lab):
    path = lab("Zugversuch.xlsx")
    how = HOW["Zugversuch.xlsx"]
    records = Campaign.from_files([path], **how).records
    assert [record.id for record in records] == ["Zugversuch-Probe 1", "Zugversuch-Probe 2"]
    assert records[1].true_stress == pytest.approx(records[0].true_stress * 1.02 / 1.01)
    assert len(read_records(path, sheet="Probe 2", **how)) == 1


def test_a_machine_that_is_named_reads_what_it_does_not_recognise(tmp_path):
    path = tmp_path / "bare.csv"
    path.write_text("Time (s),Strain (%),Stress (MPa)\n" + "".join(f"{at},{at},{at}\n" for at in range(12)))
    with pytest.raises(InputError, match="may be true or engineering"):
        read_record(path)
    assert read_record(path, profile="testsuite").true_strain[-1] == pytest.approx(np.log(1.11))


def test_the_best_of_several_columns_is_read(tmp_path):
    """The extensometer before the crosshead, and an extension before a stroke."""
    path = tmp_path / "two.csv"
    rows = "".join(f"{at},{at / 100},{at / 50},{at}\n" for at in range(12))
    path.write_text("Time (s),Extension (mm),Stroke (mm),Force (N)\n" + rows)
    record = read_record(path, specimen={"area_mm2": 1.0, "gauge_length_mm": 1.0})
    assert record.true_strain[-1] == pytest.approx(np.log(1.11))


def test_each_sheet_has_the_section_that_stands_in_the_row_of_its_specimen(lab):
    first, second = read_records(lab("Serie.xlsx"))
    assert second.true_stress == pytest.approx(first.true_stress)


@pytest.mark.parametrize(
    "heading",
    [
        "Tiempo (s);Desplazamiento (mm);Fuerza (N)",
        "Tempo (s);Spostamento (mm);Forza (N)",
        "Timestamp (s);LVDT (mm);Load cell (N)",
        "Test time (s);Standard travel (mm);Standard force (N)",
    ],
)
def test_headings_of_further_languages_and_lone_units_are_known(tmp_path, heading):
    path = tmp_path / "a.csv"
    path.write_text("\n".join([heading, *(f"{at};{at / 100};{at}" for at in range(12))]) + "\n")
    record = read_record(path, specimen={"area_mm2": 2.0, "gauge_length_mm": 1.0})
    assert record.true_strain[-1] == pytest.approx(np.log(1.11))
    assert record.true_stress[-1] == pytest.approx(5.5 * 1.11)


def test_two_columns_of_one_unit_tell_no_displacement(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("\n".join(["Time (s);LVDT 1 (mm);LVDT 2 (mm);Force (N)", *(f"{at};1;2;3" for at in range(12))]))
    with pytest.raises(InputError, match="found no strain column"):
        read_record(path)


def test_what_stands_between_the_samples_is_left_out_and_said(lab):
    notes = read_record(lab("strip-13.csv")).warnings
    assert any("left out 1 remark between the numbers: '# light switched on here' in row 57" in note for note in notes)
    assert any("left out 3 rows of text below the numbers: 'Max force'" in note for note in notes)


def test_times_of_day_are_seconds_since_the_first_and_said(lab):
    record = read_record(lab("in-situ.asc"))
    assert record.time[-1] == pytest.approx(20.0)
    assert any("'time' holds times of day" in note for note in record.warnings)


def test_a_bad_time_of_day_is_named_by_its_row(tmp_path):
    path = tmp_path / "clock.csv"
    rows = [f"10:00:{at:02d},{at / 100},{at}" for at in range(12)]
    rows[8] = "10:00:8x,0.08,8"
    path.write_text("\n".join(["time,true strain,true stress (MPa)", *rows]) + "\n")
    with pytest.raises(
        InputError, match=r"row 10, column 'time': found '10:00:8x', expected a time of day as in row 2"
    ):
        read_record(path)


def test_a_bad_last_row_is_no_table_of_results(tmp_path):
    path = tmp_path / "last.csv"
    rows = [f"{at},{at / 100},{at}" for at in range(12)]
    path.write_text("\n".join(["time (s),true strain,true stress (MPa)", *rows, "x,0.12,12"]) + "\n")
    with pytest.raises(InputError, match=r"row 14, column 'time \(s\)': found 'x', expected a number"):
        read_record(path)


def test_preview_shows_the_facts_of_the_head_and_what_it_takes_from_them(lab):
    shown = preview(lab("stage.txt"))
    assert shown.profile == "kammrath-weiss"
    assert shown.metadata["Material"] == "HDPE"
    assert shown.specimen == {"area_mm2": 40.0, "gauge_length_mm": 50.0}
    assert "specimen  area_mm2 = 40, gauge_length_mm = 50, stated in the file" in shown.summary()


@pytest.mark.parametrize("line", ["Dimension : Width,x,mm", "Dimension : Width,-1,mm", "Dimension : Width,1,kg"])
def test_a_dimension_that_is_none_is_left_alone(tmp_path, line):
    path = tmp_path / "a.csv"
    bluehill(path)
    path.write_text(path.read_text().replace("Dimension : Width,10,mm", line))
    with pytest.raises(InputError, match="found a force but no area_mm2"):
        read_record(path)


def test_a_bad_cell_below_the_second_heading_is_named_by_its_row(tmp_path):
    path = tmp_path / "a.csv"
    trapezium(path)
    lines = path.read_text().splitlines()
    lines[-5] = lines[-5].replace(lines[-5].split(",")[1], '"-"')
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match=rf"row {len(lines) - 4}, column 'Force': found '-', expected a number"):
        read_records(path)
    assert FORCE[0] == EXTENSION[0] == 0.0


def test_sheets_that_hold_something_else_are_left_out(tmp_path):
    path = tmp_path / "a.xlsx"
    zwick_workbook(path)
    book = openpyxl.load_workbook(path)
    book["Probe 2"]["B2"] = "Kraft"
    book.save(path)
    assert len(read_records(path, **HOW["Zugversuch.xlsx"])) == 1


@needs_data
def test_a_measured_stage_file_is_read_as_it_is():
    """2.21 mm by 0.95 mm, gauge length 5.1 mm: all in its head; the file's own stress agrees to 0.03 %."""
    record = read_record(DATA / "zr-ti-nb" / "stage.txt")
    assert record.profile == "kammrath-weiss"
    assert (len(record), record.true_strain[0]) == (1960, pytest.approx(np.log1p(-0.5431 / 5.1)))
    assert record.true_stress[0] / np.exp(record.true_strain[0]) == pytest.approx(2.296494, rel=3e-4)


@needs_data
def test_a_measured_catman_workbook_needs_no_more_than_the_specimen():
    specimen = {"diameter_mm": 5.98, "gauge_length_mm": 8.0}
    record = read_record(DATA / "s355" / "Temp_LP9_1_181211.XLSX", specimen=specimen)
    assert record.profile == "catman"
    assert (len(record), record.temperature.max()) == (6573, pytest.approx(30.0, abs=0.01))
    assert record.true_stress.max() == pytest.approx(742.0, abs=0.5)
