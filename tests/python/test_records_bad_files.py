"""Every way a file can be wrong is refused in one line that names the place and the remedy."""

import gzip
import re

import pytest

from probation.errors import InputError
from probation.records.reading import read_record

HEADINGS = "time_s,true_strain,true_stress_MPa"
ROWS = [f"{0.5 * at},{0.01 * at:.2f},{1.5 * at}" for at in range(12)]


def good(**changed):
    """A good file, with rows replaced by their number as an editor shows it: ``row6="…"``."""
    lines = [HEADINGS, *ROWS]
    for name, text in changed.items():
        lines[int(name.removeprefix("row")) - 1] = text
    return "\n".join(lines) + "\n"


@pytest.fixture
def refusal(tmp_path):
    """The complaint about a file of this content."""

    def read(content, name="exp.csv", **options):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        with pytest.raises(InputError) as caught:
            read_record(path, **options)
        message = str(caught.value)
        assert message.startswith(str(path))
        assert "\n" not in message
        return message.removeprefix(str(path))

    return read


def test_a_missing_column_is_named_with_what_there_is(refusal):
    content = "\n".join(",".join(line.split(",")[:2]) for line in good().splitlines())
    message = refusal(content)
    assert message.startswith(", row 1: found no stress column among 'time_s' and 'true_strain'")
    assert "expected 'true_stress', 'engineering_stress' or 'force'" in message


def test_a_misnamed_column_is_matched_with_the_nearest(refusal):
    message = refusal(good(row1="time_s,true_strian,true_stress_MPa"))
    assert "row 1: found no strain column" in message
    assert "did you mean 'true_strain' where it says 'true_strian'?" in message


def test_a_column_named_by_the_user_that_does_not_exist_gets_the_nearest(refusal):
    message = refusal(good(), columns={"true_strain": "true_strian"})
    assert "found no column 'true_strian'" in message
    assert "did you mean 'true_strain'?" in message


def test_a_file_without_headings_asks_for_them_or_for_positions(refusal):
    assert "row 1: found 3 columns without headings" in refusal("\n".join(ROWS))


def test_a_heading_that_stands_twice_must_be_chosen_by_position(refusal):
    content = "\n".join(f"{line},{line.split(',')[0]}" for line in good().splitlines())
    assert "column 'time_s': found a second column for time" in refusal(content)
    assert "2 columns headed 'time_s' (positions 1 and 4)" in refusal(content, columns={"time": "time_s"})


def test_a_position_outside_the_table_is_refused(refusal):
    assert "found column position 7, expected a position from 1 to 3" in refusal(good(), columns={"time": 7})


@pytest.mark.parametrize(
    ("cell", "remedy"),
    [
        ("abc", "correct or remove the cell"),
        ("1_0", "correct or remove the cell"),
        ("12 MPa", "put the unit into the heading instead"),
        ('"1,23,4.5"', "remove thousands separators"),
        ('"0,5"', "use one decimal mark throughout"),
    ],
)
def test_a_cell_that_is_no_number_is_named_by_row_and_column(refusal, cell, remedy):
    message = refusal(good(row6=f"2.0,{cell},3"))
    shown = cell.strip('"')
    assert f", row 6, column 'true_strain': found '{shown}', expected a number; " in message
    assert remedy in message


def test_a_bad_cell_in_the_very_first_data_row_is_not_taken_for_a_heading(refusal):
    assert ", row 2, column 'true_strain': found 'abc'" in refusal(good(row2="0,abc,0"))


def test_rows_are_counted_as_an_editor_does_with_metadata_and_blank_lines(refusal):
    content = "Sample: A\n\nDate,2020\n" + good(row3="0.5,x,1") + "\n"
    assert ", row 6, column 'true_strain': found 'x'" in refusal(content)


@pytest.mark.parametrize("cell", ["NaN", "nan", "inf", "-inf", "1e400"])
def test_a_number_that_is_not_finite_is_named_by_row_and_column(refusal, cell):
    message = refusal(good(row6=f"2.0,0.04,{cell}"))
    assert f", row 6, column 'true_stress_MPa': found '{cell}', expected a finite number" in message


def test_an_empty_cell_is_named_by_row_and_column(refusal):
    assert ", row 6, column 'true_strain': found an empty cell" in refusal(good(row6="2.0,,3"))
    assert ", row 6, column 'true_stress_MPa': found an empty cell" in refusal(good(row6="2.0,0.04"))


def test_a_last_row_with_time_but_no_stress_is_not_padding(refusal):
    assert ", row 13, column 'true_stress_MPa': found an empty cell" in refusal(good(row13="6,0.12,"))


def test_a_row_wider_than_the_headings_hints_at_decimal_commas(refusal):
    message = refusal(good(row6="2,0,0,04,3,0"))
    assert ", row 6: found 6 cells, expected 3" in message
    assert "decimal commas need another separator" in message


@pytest.mark.parametrize("content", ["", "\n \n", "\ufeff", "\ufeff\n"])
def test_an_empty_file_is_said_to_be_empty(refusal, content):
    assert "found an empty file" in refusal(content)


def test_headings_without_rows_are_refused(refusal):
    assert "found no row of numbers" in refusal(HEADINGS + "\n")


def test_headings_above_nothing_but_padding_are_refused(refusal):
    assert "found no numbers" in refusal(HEADINGS + "\n" + "NaN,NaN,NaN\n" * 12)


def test_nine_points_are_too_few_and_ten_are_enough(refusal, tmp_path):
    message = refusal("\n".join([HEADINGS, *ROWS[:9]]))
    assert "found 9 points, expected at least 10" in message
    (tmp_path / "ten.csv").write_text("\n".join([HEADINGS, *ROWS[:10]]), encoding="utf-8")
    assert len(read_record(tmp_path / "ten.csv")) == 10


def test_time_that_goes_back_is_named_by_its_row(refusal):
    message = refusal(good(row6="1.0,0.04,3"))
    assert ", row 6, column 'time_s': found time going back from 1.5 to 1" in message


def test_time_that_repeats_is_named_by_its_row(refusal):
    assert ", row 6, column 'time_s': found 1.5 again" in refusal(good(row6="1.5,0.04,3"))


def test_a_row_repeated_in_the_middle_is_refused_not_dropped(refusal):
    assert ", row 6, column 'time_s': found 1.5 again" in refusal(good(row6=ROWS[3]))


@pytest.mark.parametrize(
    ("headings", "column", "found"),
    [
        ("time_s,true_strain,true stress (mm)", "true stress (mm)", "unit 'mm', expected a stress unit"),
        ("time (MPa),true_strain,true_stress_MPa", "time (MPa)", "unit 'MPa', expected a time unit"),
        ("time_s,true_strain (N),true_stress_MPa", "true_strain (N)", "unit 'N', expected a strain unit"),
        ("time_s,true_strain,true stress (foo)", "true stress (foo)", "unknown unit 'foo'"),
        ("time_s,true_strain,true stress (mPa)", "true stress (mPa)", "unit 'mPa', millipascal"),
    ],
)
def test_a_unit_that_does_not_fit_is_named_by_its_column(refusal, headings, column, found):
    assert f", row 1, column '{column}': found {found}" in refusal(good(row1=headings))


def test_a_unit_given_by_the_user_must_fit_too(refusal):
    assert "found unit 'mm'" in refusal(good(), units={"true_stress": "mm"})
    assert "found a unit for 'force'" in refusal(good(), units={"force": "N"})


@pytest.mark.parametrize("first", ["Probe é\n", "# µ-Zug\n"])
def test_two_encodings_in_one_file_are_told_by_their_rows(refusal, first):
    message = refusal(first.encode() + good(row6="2.0,0.04,3").encode() + b"# \xe9t\xe9\n")
    assert ", row 15: found byte 0xE9, which is not UTF-8, although row 1 is" in message


def test_chinese_in_gbk_and_in_utf_8_is_refused(refusal):
    content = "时间,位移,力,速度,温度,湿度\n".encode("gbk") * 3 + "# 时间\n".encode() + good().encode()
    assert "which is not UTF-8, although row 4 is" in refusal(content)


def test_bytes_that_no_encoding_holds_are_named_by_their_row(refusal):
    assert ", row 14: found byte 0x81" in refusal(good().encode() + b"# \x81\n")


def test_a_byte_order_mark_binds(refusal):
    assert ", row 14: found byte 0xFF" in refusal(b"\xef\xbb\xbf" + good().encode() + b"# \xff\n")


def test_a_picture_is_no_table(refusal):
    assert "binary file" in refusal(b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR")


def test_prose_is_no_table(refusal):
    assert "found a single column" in refusal("<html>\n<body>nothing here</body>\n</html>\n")


def test_a_quote_that_never_closes_is_named_by_its_row(refusal):
    message = refusal(good(row6='2.0,"0.04,3'))
    assert ", row 6, column 'true_strain'" in message
    assert "close the quote" in message


def test_a_quote_that_swallows_a_whole_book_is_refused(refusal):
    assert "row 6: found text that is no CSV" in refusal(good(row6='2.0,"0.04,3') + "1,2,3\n" * 30_000)


def test_a_damaged_gzip_is_refused(refusal):
    assert "damaged gzip" in refusal(gzip.compress(good().encode())[:-12], name="exp.csv.gz")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=re.escape(f"{tmp_path / 'no.csv'}: found no such file")):
        read_record(tmp_path / "no.csv")


def test_a_folder_is_no_record(tmp_path):
    with pytest.raises(InputError, match="found a folder"):
        read_record(tmp_path)


@pytest.mark.parametrize(
    ("options", "found"),
    [
        ({"columns": {"tme": "time_s"}}, "columns: found the unknown key 'tme'; did you mean 'time'?"),
        ({"units": {"true_stres": "MPa"}}, "units: found the unknown key 'true_stres'; did you mean"),
        ({"specimen": {"area": 3.0}}, "specimen: found the unknown key 'area'; did you mean 'area_mm2'?"),
        ({"specimen": {"area_mm2": 0.0}}, "specimen.area_mm2: found 0.0, expected a positive number"),
        ({"columns": {"time": 0}}, "columns.time: found 0, expected a heading or a position"),
        ({"columns": {"true_strain": "a", "stretch": "b"}}, "found both 'true_strain' and 'stretch'"),
        ({"profile": "etf"}, "found no profile 'etf'; did you mean 'etfe'?"),
        ({"profile": "etfe"}, "found 3 columns, expected a multiple of 15"),
        ({"profile": "excel"}, "found no Excel workbook"),
        ({"sheet": "Data"}, "found sheet = 'Data' for a text file"),
        ({"specimen_index": 2}, "specimen_index: found 2, expected at most 1"),
        ({"specimen_index": 0}, "specimen_index: found 0"),
    ],
)
def test_an_option_that_cannot_be_is_refused(refusal, options, found):
    assert found in refusal(good(), **options)
