"""Real files read as they are, from the folder of measured records beside the repository."""

import csv
import gzip
import math
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from probation.errors import InputError
from probation.records.profiles import PROFILES
from probation.records.reading import read_record, read_records

DATA = Path(__file__).parents[3] / "shared" / "data"
TENSION = DATA / "etfe" / "OUTRaw_MD_CSR_01_T40.csv"
RELAXATION = DATA / "etfe" / "OUTRaw_MD_Rel_9MPa_T20.csv"
TEMPERATURE = DATA / "etfe" / "OUTTemp_MD_CSR_01_T40.csv"
VHB = DATA / "vhb4910"
SILICONES = DATA / "silicones"

measured = pytest.mark.skipif(not DATA.is_dir(), reason="the measured records are not beside the repository")


@measured
@pytest.mark.parametrize(
    ("path", "profile", "samples"),
    [
        ("etfe/OUTRaw_MD_CSR_01_T40.csv", "etfe", [1001, 1000, 957]),
        ("etfe/OUTRaw_MD_Rel_9MPa_T20.csv", "etfe_relaxation", [1176, 1075, 1070]),
        ("vhb4910/0d01_3d0.csv", "vhb", [20007]),
        ("vhb4910/0d03_2d0_1.csv", "vhb", [3340]),
        ("vhb4910/0d03_2d0_2.csv", "vhb", [3340]),
        ("vhb4910/0d03_3d0.csv", "vhb", [6675]),
        ("vhb4910/0d05_2d5_1.csv", "vhb", [3012]),
        ("vhb4910/0d05_3d0.csv", "vhb", [4006]),
        ("vhb4910/relaxation_3d0.csv.gz", "vhb", [36164]),
        ("silicones/Dragon Skin 30.csv", "silicone", [311]),
        ("silicones/RTV615.csv", "silicone", [84]),
    ],
)
def test_every_measured_file_is_recognised_and_read_whole(path, profile, samples):
    """Counts are the file's rows of numbers: `wc -l` less headings, metadata and padding."""
    records = read_records(DATA / path)
    assert [len(record) for record in records] == samples
    assert {record.profile for record in records} == {profile}


@measured
def test_etfe_specimens_stand_side_by_side():
    """The second specimen's block begins at column 16; SOI strain and stress are its 8th and 10th."""
    with TENSION.open(encoding="utf-8") as stream:
        cells = list(csv.reader(stream))[500]
    record = read_record(TENSION, specimen_index=2)
    assert record.time[500] == float(cells[15])
    assert record.true_strain[500] == float(cells[15 + 7])
    assert record.true_stress[500] == float(cells[15 + 9])
    assert record.transverse_strain is not None
    assert record.transverse_strain[500] == float(cells[15 + 13])


@measured
def test_etfe_padding_is_cut_where_each_specimen_ends():
    """Specimens end at 600.02, 599.4166 and 573.615 s; rows of NaN follow."""
    assert [record.time[-1] for record in read_records(TENSION)] == [600.02, 599.4166, 573.615]


@measured
def test_etfe_rates_differentiated_by_the_authors_are_not_taken_as_measured_unless_asked():
    assert read_record(TENSION, specimen_index=1).strain_rate is None
    asked = read_record(TENSION, specimen_index=1, columns={"strain_rate": "true strain rate SOI"})
    assert asked.strain_rate is not None
    gradient = np.gradient(asked.true_strain, asked.time)
    assert np.median(np.abs(asked.strain_rate - gradient)) < 1e-5


@measured
def test_etfe_averaged_strain_can_be_asked_for():
    """The largest averaged true strain of specimen 1 is 0.6256, in the section of interest 0.6704."""
    columns = {"true_strain": "true strain AVG", "true_stress": "true stress AVG"}
    averaged = read_record(TENSION, specimen_index=1, columns=columns)
    assert averaged.true_strain.max() == pytest.approx(0.6256, abs=1e-4)
    assert read_record(TENSION, specimen_index=1).true_strain.max() == pytest.approx(0.6704, abs=1e-4)


@measured
def test_several_specimens_without_a_choice_are_refused_with_their_number():
    with pytest.raises(InputError, match=r"found 3 specimens side by side.*specimen_index = 1 … 3"):
        read_record(TENSION)


@measured
def test_the_misaligned_relaxation_headings_are_overruled_by_position():
    """By heading, 'exxHencky01SOI' is a strain; by content it is the time again, up to 10 853 s.

    By position, columns 7 and 8 are true strain and stress: σ = s(1 + e) of columns 2 and 3, e below 0.008
    and s peaking at the commanded 9 MPa, so σ at 9 · 1.0077 = 9.07 or a little above.
    """
    with RELAXATION.open(encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    assert rows[0][5] == "exxHencky01SOI"
    assert float(rows[-1][5]) == float(rows[-1][0]) == 10853.4938
    record = read_record(RELAXATION, specimen_index=1)
    assert record.true_strain[-1] == float(rows[-1][6])
    assert record.true_stress[-1] == float(rows[-1][7])
    assert 0.007 < record.true_strain.max() < 0.008
    assert 9.07 < record.true_stress.max() < 9.2
    engineering = np.array([[float(cell) for cell in row[1:3]] for row in rows[1:]])
    np.testing.assert_allclose(record.true_stress, engineering[:, 1] * (1 + engineering[:, 0]), atol=1e-7)
    assert any("misaligned" in warning for warning in record.warnings)


@measured
def test_temperatures_alone_are_no_record():
    with pytest.raises(InputError, match="found temperatures over time, expected a stress-strain record"):
        read_records(TEMPERATURE)


@measured
def test_vhb_displacement_and_force_become_true_strain_and_stress():
    """At 1.2738 mm and 0.1251 N (row 22): λ = 1 + 1.2738/80, ε = ln λ, σ = 0.1251/22·λ."""
    record = read_record(VHB / "0d05_3d0.csv")
    stretch = 1.0 + 1.2738 / 80.0
    assert record.time[18] == 0.36
    assert record.true_strain[18] == pytest.approx(math.log(stretch), rel=1e-14)
    assert record.true_stress[18] == pytest.approx(0.1251 / 22.0 * stretch, rel=1e-14)
    assert sum("assumed by the profile" in warning for warning in record.warnings) == 2


@measured
def test_vhb_dimensions_can_be_replaced():
    specimen = {"area_mm2": 44.0, "gauge_length_mm": 80.0}
    halved = read_record(VHB / "0d05_3d0.csv", specimen=specimen)
    np.testing.assert_allclose(halved.true_stress * 2.0, read_record(VHB / "0d05_3d0.csv").true_stress)
    assert not any("assumed" in warning for warning in halved.warnings)


@measured
def test_vhb_relaxation_in_utf_8_reaches_stretch_three():
    """160 mm on 80 mm is stretch 3, true strain ln 3, held to 1808.15 s."""
    record = read_record(VHB / "relaxation_3d0.csv.gz")
    assert record.time[-1] == 1808.15
    assert record.true_strain[-1] == pytest.approx(math.log(3.0), abs=1e-5)


@measured
def test_silicone_metadata_is_skipped_and_the_true_columns_are_read():
    record = read_record(SILICONES / "RTV615.csv")
    assert (record.time[0], record.true_strain[0], record.true_stress[0]) == (
        0.2,
        0.0436333333333333,
        0.0370843865566667,
    )
    assert (record.time[-1], record.true_strain[-1], record.true_stress[-1]) == (8.5, 1.07562, 7.35146262181)


@measured
def test_profiles_give_what_the_general_reader_gives_on_the_same_file():
    general = read_record(
        VHB / "0d05_3d0.csv",
        profile="csv",
        columns={"time": "时间", "displacement": "位移", "force": "力"},
        specimen={"area_mm2": 22.0, "gauge_length_mm": 80.0},
    )
    np.testing.assert_array_equal(general.true_stress, read_record(VHB / "0d05_3d0.csv").true_stress)


def test_profile_names_are_unique():
    assert len({profile.name for profile in PROFILES}) == len(PROFILES)


def test_etfe_columns_are_recognised_on_a_made_up_file(tmp_path):
    """One specimen: time in column 1, SOI true strain 8, SOI true stress 10, padded by a row of NaN."""
    rows = [[0.0] * 15 for _ in range(12)]
    for at, row in enumerate(rows):
        row[0], row[7], row[9] = float(at), 0.01 * at, 2.0 * at
    lines = [",".join(map(repr, row)) for row in rows] + [",".join(["NaN"] * 15)]
    (tmp_path / "made_up.csv").write_text("\n".join(lines), encoding="utf-8")
    record = read_record(tmp_path / "made_up.csv")
    assert (record.profile, len(record)) == ("etfe", 12)
    assert (record.time[-1], record.true_strain[-1], record.true_stress[-1]) == (11.0, 0.11, 22.0)


def test_vhb_is_recognised_in_gbk_and_in_gzipped_utf_8(tmp_path):
    text = "\r\n时间,位移,力\r\n(s),(mm),(N)\r\n" + "".join(f'"{at}","{at}","0.{at}"\r\n' for at in range(12))
    (tmp_path / "a.csv").write_bytes(text.encode("gbk"))
    (tmp_path / "b.csv.gz").write_bytes(gzip.compress(text.strip().encode("utf-8")))
    one, other = read_record(tmp_path / "a.csv"), read_record(tmp_path / "b.csv.gz")
    assert one.profile == other.profile == "vhb"
    assert one.true_strain[-1] == pytest.approx(math.log(1.0 + 11.0 / 80.0))
    np.testing.assert_array_equal(one.true_stress, other.true_stress)


HEADINGS = ["Time (s)", "True strain (%)", "True stress (kPa)"]
ROWS = [[0.1 * at, 1.0 * at, 1500.0 * at] for at in range(12)]


@pytest.fixture
def workbook(tmp_path):
    def write(**sheets):
        book = openpyxl.Workbook()
        book.remove(book.active)
        for name, rows in sheets.items():
            sheet = book.create_sheet(name)
            for row in rows:
                sheet.append(row)
        book.save(tmp_path / "record.xlsx")
        return tmp_path / "record.xlsx"

    return write


@pytest.mark.parametrize("above", [[], [["Operator", "x"], [], ["Width", 3.0]]])
@pytest.mark.parametrize("left", [[], [None]])
def test_a_workbook_is_read_wherever_its_table_stands(workbook, above, left):
    """11 % is 0.11; 16 500 kPa is 16.5 MPa."""
    record = read_record(workbook(Data=above + [left + row for row in [HEADINGS, *ROWS]]))
    assert record.profile == "excel"
    assert record.time == pytest.approx([row[0] for row in ROWS])
    assert record.true_strain[-1] == pytest.approx(0.11)
    assert record.true_stress[-1] == pytest.approx(16.5)


def test_the_first_sheet_with_enough_rows_is_read_and_the_others_are_mentioned(workbook):
    path = workbook(Notes=[["made by x"]], Data=[HEADINGS, *ROWS], Second=[HEADINGS, *ROWS[:11]])
    assert len(read_record(path)) == 12
    assert "Notes, Second" in read_record(path).warnings[0]
    assert len(read_record(path, sheet="Second")) == 11
    with pytest.raises(InputError, match="found no sheet 'Secnd'; did you mean 'Second'"):
        read_record(path, sheet="Secnd")


def test_a_bad_cell_of_a_workbook_is_named_by_its_row(workbook):
    rows = [row.copy() for row in ROWS]
    rows[3][1] = "#DIV/0!"
    with pytest.raises(InputError, match=r"row 5, column 'True strain .*found '#DIV/0!', expected a number"):
        read_record(workbook(Data=[HEADINGS, *rows]))


def test_an_empty_workbook_is_refused(workbook):
    with pytest.raises(InputError, match="found an empty sheet"):
        read_record(workbook(Data=[]))


def test_an_old_or_broken_workbook_is_refused(tmp_path):
    (tmp_path / "old.xls").write_bytes(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + b"\0" * 512)
    with pytest.raises(InputError, match="old Excel file"):
        read_record(tmp_path / "old.xls")
    (tmp_path / "broken.xlsx").write_bytes(b"PK\x03\x04 and then nothing")
    with pytest.raises(InputError, match="found no Excel workbook"):
        read_record(tmp_path / "broken.xlsx")
