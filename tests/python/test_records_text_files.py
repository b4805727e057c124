"""Delimited text: separators, decimal marks, encodings and headings as laboratories write them."""

import gzip
import time
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from probation import Campaign, Record
from probation.errors import InputError
from probation.records.grid import sniff_separator
from probation.records.header import split_unit
from probation.records.reading import read_record
from probation.records.strain_history import read_strain_history

HEADINGS = ("time_s", "true_strain", "true_stress_MPa")
# Twelve samples of whatever; read back exactly because float(repr(x)) == x.
SAMPLES = [(0.5 * i, 0.0125 * i, 10.0 * i / (1 + i)) for i in range(12)]


def table(separator=",", decimal=".", *, headings=HEADINGS, samples=SAMPLES, above=(), quote="", end="\n"):
    lines = list(above)
    if headings:
        lines.append(separator.join(headings))
    for sample in samples:
        cells = (repr(float(value)).replace(".", decimal) for value in sample)
        lines.append(separator.join(f"{quote}{cell}{quote}" for cell in cells))
    return end.join(lines) + end


@pytest.fixture
def read(tmp_path):
    def write_and_read(content, name="record.csv", **options):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_record(path, **options)

    return write_and_read


def assert_reads_as_samples(record, samples=SAMPLES):
    expected = np.array(samples)
    np.testing.assert_array_equal(record.time, expected[:, 0])
    np.testing.assert_allclose(record.true_strain, expected[:, 1], rtol=3e-16)
    np.testing.assert_array_equal(record.true_stress, expected[:, 2])


def test_the_default_form_is_read_digit_by_digit(read):
    record = read(table())
    assert_reads_as_samples(record)
    assert record.profile == "csv"
    assert record.id == "record"
    assert record.warnings == ()
    assert record.strain_rate is None


@pytest.mark.parametrize(
    ("separator", "decimal", "quote"),
    [(",", ".", ""), (";", ".", ""), (";", ",", ""), ("\t", ".", ""), ("\t", ",", ""), (",", ",", '"')],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "gbk", "latin-1"])
def test_separator_decimal_mark_and_encoding_do_not_change_the_numbers(read, separator, decimal, quote, encoding):
    text = table(separator, decimal, quote=quote)
    assert_reads_as_samples(read(text.encode(encoding)))


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_ends_of_every_system_are_read(read, end):
    assert_reads_as_samples(read(table(end=end)))


@settings(deadline=None, max_examples=60)
def within(largest):
    """Numbers that a test can measure: none so small that it is refused."""
    return st.floats(-largest, largest).filter(lambda value: value == 0.0 or abs(value) > 1e-25)


@given(
    values=st.lists(st.tuples(within(4.0), within(1e9)), min_size=10, max_size=30),
    separator=st.sampled_from([";", "\t"]),
    decimal=st.sampled_from([".", ","]),
)
def test_any_numbers_survive_any_separator(tmp_path_factory, values, separator, decimal):
    samples = [(float(at), *sample) for at, sample in enumerate(values)]
    path = tmp_path_factory.mktemp("any") / "record.csv"
    path.write_text(table(separator, decimal, samples=samples + samples[-1:]), encoding="utf-8")
    record = read_record(path)
    assert_reads_as_samples(record, samples)


def test_a_gzipped_file_is_read(read):
    assert_reads_as_samples(read(gzip.compress(table().encode()), name="record.csv.gz"))


def test_german_headings_in_latin_1_are_found_by_name(read):
    headings = ("Zeit (s)", "Dehnung wahr", "Spannung (N/mm²)", "Temperaturänderung (°C)")
    samples = [(*sample, 1.0) for sample in SAMPLES]
    record = read(
        table(";", ",", headings=headings, samples=samples).encode("latin-1"),
        columns={"time": "Zeit", "true_strain": "Dehnung wahr", "true_stress": "Spannung (N/mm²)"},
    )
    assert_reads_as_samples(record)


def test_chinese_headings_in_gbk_are_found_by_name(read):
    record = read(
        table(headings=("时间(s)", "真应变", "真应力(MPa)")).encode("gbk"),
        columns={"time": "时间", "true_strain": "真应变", "true_stress": "真应力"},
    )
    assert_reads_as_samples(record)


def test_headings_are_found_below_metadata(read):
    above = ["Sample: A7", "Width,6.0,mm", "Date,2020-02-01", "", ",,", "Operator;none"]
    assert_reads_as_samples(read(table(above=above)))


def test_units_in_a_row_of_their_own_are_read(read):
    r"""Milliseconds, percent, kPa: 5500 ms is 5.5 s, 13.75 % is 0.1375, 9.1667 kPa is 0.0091667 MPa."""
    headings = ("Time", "True strain", "True stress\n(ms),(%),(kPa)")
    record = read(table(headings=headings))
    assert record.time[-1] == pytest.approx(5.5e-3)
    assert record.true_strain[-1] == pytest.approx(0.1375e-2)
    assert record.true_stress[-1] == pytest.approx(110.0 / 12.0 * 1e-3)


@pytest.mark.parametrize(
    "headings",
    [
        ("Time (ms)", "True Strain [%]", "True Stress (kPa)"),
        ("time_ms", "true_strain_percent", "true_stress_kPa"),
        ("Time / ms", "Hencky strain / %", "Cauchy stress / kPa"),
        ("Time, ms", "True strain in %", "True stress kPa"),
    ],
)
def test_units_in_the_headings_are_read(read, headings):
    record = read(table(separator=";", headings=headings))
    assert record.time[-1] == pytest.approx(5.5e-3)
    assert record.true_strain[-1] == pytest.approx(0.1375e-2)
    assert record.true_stress[-1] == pytest.approx(110.0 / 12.0 * 1e-3)


SPECIMEN = {"area_mm2": 10.0, "gauge_length_mm": 50.0}


def test_a_units_row_may_hold_a_cell_that_is_no_unit(read):
    """2 kN on 10 mm² at 1 mm on 50 mm: 2000/10·1.02 = 204 MPa."""
    rows = "".join(f"{0.1 * at};{0.2 * at};{at};2\n" for at in range(12))
    for names in ("Displacement;Load;Time;Cycle", "Axial Displacement;Axial Load;Time;Axial Count"):
        content = f"Operator;x\n{names}\nmm;kN;Sec;segments\n{rows}"
        label = names.split(";")
        record = read(content, columns={"displacement": label[0], "force": label[1]}, specimen=SPECIMEN)
        assert record.true_stress[10] == pytest.approx(204.0)
        assert not any("no unit" in warning for warning in record.warnings)


def test_a_units_row_is_found_below_a_row_of_comments(read):
    headings = ("Time", "True strain", "True stress\nfirst,channel,A\nms,1,kPa")
    assert read(table(headings=headings)).true_stress[-1] == pytest.approx(110.0 / 12.0 * 1e-3)


def test_a_units_row_that_misspells_the_unit_of_a_column_in_use_is_refused(read):
    headings = ("Time", "True strain", "True stress\ns,-,Megapaskal")
    with pytest.raises(InputError, match=r"column 'True stress': found unknown unit .Megapaskal., expected a stress"):
        read(table(headings=headings))


def test_a_row_of_names_below_metadata_is_not_taken_for_units(read):
    """'t' is the tonne too, and 'strain' a spelling of no unit."""
    above = ["Sample,Operator,Machine", "A7,none,B"]
    content = table(above=above, headings=("t", "strain", "sigma"))
    record = read(content, columns={"true_strain": 2, "true_stress": 3})
    assert_reads_as_samples(record)


def test_a_heading_that_is_a_unit_gives_its_unit_and_its_role(read):
    """2 kN on 10 mm² at 1 mm on 50 mm: 204 MPa; seconds, lengths and forces cannot be anything else."""
    rows = "".join(f"{0.1 * at};{0.2 * at};{at}\n" for at in range(12))
    record = read("mm;[kN];ms\n" + rows, specimen=SPECIMEN)
    assert record.true_stress[10] == pytest.approx(204.0)
    assert record.time[10] == pytest.approx(0.010)
    assert sum("by its unit alone" in warning for warning in record.warnings) == 3
    named = read("mm;kN;s\n" + rows, columns={"displacement": "mm", "force": "kN", "time": "s"}, specimen=SPECIMEN)
    assert named.true_stress[10] == pytest.approx(204.0)
    assert not any("heading" in warning for warning in named.warnings)


def test_a_unit_that_two_columns_have_gives_no_role(read):
    rows = "".join(f"{0.1 * at};{0.2 * at};{at};1\n" for at in range(12))
    with pytest.raises(InputError, match="no strain column among 'mm', 'kN', 's' and 'mm'"):
        read("mm;kN;s;mm\n" + rows, specimen=SPECIMEN)


def test_a_heading_that_ends_in_a_unit_of_its_role_gives_it(read):
    """Nothing but the role says that "Kraft kN" is a force and its last word a unit."""
    rows = "".join(f"{0.1 * at};{0.2 * at};{at}\n" for at in range(12))
    columns = {"displacement": 1, "force": 2, "time": 3}
    record = read("Weg mm;Kraft kN;Zeit_s\n" + rows, columns=columns, specimen=SPECIMEN)
    assert record.true_stress[10] == pytest.approx(204.0)
    assert not any("no unit" in warning for warning in record.warnings)


def test_a_symbol_is_not_taken_for_a_unit_of_something_else(read):
    """'s' heads a stress and 'N' a strain: neither is one of their units."""
    columns = {"time": 1, "true_strain": 2, "true_stress": 3}
    assert_reads_as_samples(read(table(headings=("t", "N", "s")), columns=columns))


def test_a_column_without_a_unit_says_so_in_one_line(read):
    rows = "".join(f"{0.1 * at};{0.2 * at};{at}\n" for at in range(12))
    warnings = read("Displacement;Load;Time (s)\n" + rows, specimen=SPECIMEN).warnings
    told = [warning for warning in warnings if "no unit" in warning]
    assert told == [
        "no unit is stated for columns 'Displacement' and 'Load' of record.csv: mm and N assumed; "
        'if that is wrong, say units = { displacement = "…", force = "…" } (--unit)'
    ]
    stated = read("Displacement;Load;Time (s)\n" + rows, specimen=SPECIMEN, units={"force": "kN", "displacement": "mm"})
    assert not any("no unit" in warning for warning in stated.warnings)
    assert read(table()).warnings == ()


@pytest.mark.parametrize(
    ("label", "name", "unit"),
    [
        ("Stress [N/mm²]", "Stress", "N/mm²"),
        ("Kraft / N", "Kraft", "N"),
        ("strain_rate_per_s", "strain_rate", "1/s"),
        ("Load Cell", "Load Cell", None),
        ("true_strain", "true_strain", None),
        ("https://example.org/data", "https://example.org/data", None),
    ],
)
def test_a_heading_splits_into_name_and_unit(label, name, unit):
    assert split_unit(label) == (name, unit)


def test_what_the_campaign_says_of_a_unit_wins_over_the_file_with_a_warning(read):
    record = read(table(), units={"true_stress": "kPa"})
    assert record.true_stress[-1] == pytest.approx(110.0 / 12.0 * 1e-3)
    assert any("as given" in warning for warning in record.warnings)


def test_columns_may_be_chosen_by_position_where_there_are_no_headings(read):
    content = table(headings=())
    assert_reads_as_samples(read(content, columns={"time": 1, "true_strain": 2, "true_stress": 3}))


def test_optional_columns_are_read_and_converted(read):
    """300 K is 26.85 °C, and 60 1/min is 1 1/s."""
    headings = (*HEADINGS, "Strain rate (1/min)", "Temperature (K)", "transverse_strain")
    record = read(table(headings=headings, samples=[(*sample, 60.0, 300.0, -0.5) for sample in SAMPLES]))
    assert record.strain_rate == pytest.approx(np.full(12, 1.0))
    assert record.temperature == pytest.approx(np.full(12, 26.85))
    assert record.transverse_strain == pytest.approx(np.full(12, -0.5))


def test_an_optional_column_without_any_value_is_left_out_with_a_warning(read):
    content = table(headings=(*HEADINGS, "temperature_C")).replace("\n", ",\n").replace("_C,", "_C")
    record = read(content)
    assert record.temperature is None
    assert any("temperature" in warning for warning in record.warnings)


def test_a_column_of_dates_does_not_spoil_decimal_commas(read):
    lines = table(";", ",").splitlines()
    dated = ["Datum;" + lines[0]] + ["01.02.2020 10:00:00;" + line for line in lines[1:]]
    assert_reads_as_samples(read("\n".join(dated)))


def test_true_columns_are_preferred_where_engineering_ones_stand_beside_them(read):
    headings = (
        "Engineering Strain",
        "Engineering Stress (MPa)",
        "Time (s)",
        "True Strain",
        "True Stress (MPa)",
    )
    record = read(table(headings=headings, samples=[(9.0, 9.0, *sample) for sample in SAMPLES]))
    assert_reads_as_samples(record)


def test_rows_of_nan_that_pad_the_end_are_cut(read):
    assert_reads_as_samples(read(table() + "NaN,NaN,NaN\n,,\n\n"))


def test_exact_repeats_of_the_last_row_are_dropped_with_a_warning(read):
    last = table().splitlines()[-1]
    record = read(table() + f"{last}\n{last}\n")
    assert_reads_as_samples(record)
    assert record.warnings == ("dropped 2 rows at the end that repeat row 13 exactly",)


def test_true_strain_in_percent_is_refused_with_the_way_to_say_so(read):
    """0.1375 is 13.75 %; the first sample beyond 5 is the sixth, 6.25, in row 7."""
    content = table(samples=[(t, 100.0 * e, s) for t, e, s in SAMPLES])
    with pytest.raises(InputError) as refused:
        read(content)
    assert str(refused.value).endswith(
        "row 7, column 'true_strain': found true strain 6.25 without a unit, "
        'expected at most 5 as true strain, a stretch of 148; if it is in percent, say units = { true_strain = "%" }, '
        'head the column "true_strain (%)", or preview with --unit true_strain=%'
    )
    assert_reads_as_samples(read(content, units={"true_strain": "%"}))


def test_a_stated_unit_does_not_make_an_impossible_strain_possible(read):
    samples = [(t, 100.0 * e, s) for t, e, s in SAMPLES]
    content = table(headings=("time_s", "true_strain (-)", "true_stress_MPa"), samples=samples)
    with pytest.raises(InputError, match=r"row 7, .*found true strain 6\.25 -, expected at most 5 .*; check its unit"):
        read(content)


def test_true_strain_without_unit_above_a_stretch_of_twelve_is_questioned(read):
    """0.1375·20 = 2.75, a stretch of 15.6, or a test to 2.75 %."""
    samples = [(t, 20.0 * e, s) for t, e, s in SAMPLES]
    assert any("strain in percent?" in warning for warning in read(table(samples=samples)).warnings)
    stated = read(table(samples=samples), units={"true_strain": "-"})
    assert not any("percent" in warning for warning in stated.warnings)


@pytest.mark.parametrize(("role", "first"), [("engineering_strain", 0.0), ("stretch", 100.0)])
def test_engineering_strain_and_stretch_beyond_every_elastomer_need_a_unit(read, role, first):
    """30 or 130 in percent is 0.3 as engineering strain: ln 1.3 as true strain. As numbers neither is impossible."""
    samples = [(t, first + 30.0 * at / 11, s) for at, (t, _, s) in enumerate(SAMPLES)]
    content = table(headings=("time_s", role, "true_stress_MPa"), samples=samples)
    with pytest.raises(InputError, match=rf"without a unit, expected at most 2[01] .* units = {{ {role} = \"%\" }}"):
        read(content)
    assert read(content, units={role: "%"}).true_strain[-1] == pytest.approx(np.log(1.3))
    assert read(content, units={role: "-"}).true_strain[-1] == pytest.approx(np.log(samples[-1][1] + (first == 0.0)))


def test_compression_in_percent_without_unit_is_told_how_to_say_so(read):
    samples = [(t, -2.0 * at, -s) for at, (t, _, s) in enumerate(SAMPLES)]
    content = table(headings=("time_s", "engineering_strain", "true_stress_MPa"), samples=samples)
    with pytest.raises(InputError, match=r"a stretch of -1, .*if it is in percent, say units"):
        read(content)


def test_engineering_strain_without_unit_that_looks_like_percent_is_warned_of(read):
    """6 as engineering strain is only ln 7 = 1.9 as true strain, but 600 % is rarely meant."""
    headings = ("time_s", "engineering_strain", "engineering_stress_MPa")
    samples = [(t, 6.0 * at / 11, s) for at, (t, _, s) in enumerate(SAMPLES)]
    assert any("percent" in warning for warning in read(table(headings=headings, samples=samples)).warnings)
    given_unit = ("time_s", "engineering_strain (-)", "engineering_stress_MPa")
    warnings = read(table(headings=given_unit, samples=samples)).warnings
    assert not any("percent" in warning for warning in warnings)


def test_the_time_of_reading_grows_with_the_rows_not_with_their_square(read):
    """Ten times the rows take about ten times as long; by their square they would take a hundred."""

    def seconds(rows):
        content = table(samples=[(0.1 * at, 1e-5 * at, 0.01 * at) for at in range(rows)])
        taken = []
        for _ in range(3):
            begin = time.process_time()
            assert len(read(content)) == rows
            taken.append(time.process_time() - begin)
        return min(taken)

    assert seconds(20_000) < 25.0 * seconds(2_000)


def test_a_vague_heading_is_not_guessed(read):
    with pytest.raises(InputError, match="'Strain' may be true or engineering"):
        read(table(headings=("Time (s)", "Strain", "Stress (MPa)")))


def test_a_strain_history_needs_no_stress_and_only_two_samples(tmp_path):
    path = tmp_path / "history.csv"
    path.write_text("time_s,true_strain,strain_rate_per_s\n0,0,0.005\n2.5,0.0125,0.005\n", encoding="utf-8")
    history = read_strain_history(path)
    assert (history.time.tolist(), history.true_strain.tolist()) == ([0.0, 2.5], [0.0, 0.0125])
    assert history.strain_rate is not None
    assert history.strain_rate.tolist() == [0.005, 0.005]


@pytest.mark.parametrize(
    ("rows", "complaint"),
    [
        ("0,0\n", "found 1 point, expected at least 2"),
        ("0,0\n1,x\n", "row 3, column 'true_strain': found 'x'"),
        ("0,0\n1,1\n1,2\n", "row 4, column 'time_s': found 1 again"),
    ],
)
def test_a_bad_strain_history_is_refused_like_a_record(tmp_path, rows, complaint):
    path = tmp_path / "history.csv"
    path.write_text("time_s,true_strain\n" + rows, encoding="utf-8")
    with pytest.raises(InputError, match=complaint):
        read_strain_history(path)


@pytest.mark.parametrize(
    "heading", ["# Time (s)  True strain (-)  True stress (MPa)", "time_s true_strain true_stress_MPa"]
)
@pytest.mark.parametrize("form", ["{:10.3f} {:12.5f} {:12.4f}", "{:.3f}\t {:.5f}  {:.4f}"])
@pytest.mark.parametrize("decimal", [".", ","])
def test_columns_that_stand_apart_by_blanks_are_read(read, heading, form, decimal):
    rows = (form.format(0.5 * at, 0.01 * at, 1.5 * at).replace(".", decimal) for at in range(12))
    record = read("\n".join([heading, *rows]) + "\n")
    assert record.time.tolist() == pytest.approx([0.5 * at for at in range(12)])
    assert record.true_stress[10] == pytest.approx(15.0)


def test_a_blank_after_a_comma_or_between_thousands_separates_nothing(read):
    rows = "".join(f"{at}, {at}, {at}\n" for at in range(12))
    assert sniff_separator(rows) == ","
    assert sniff_separator("t;s\n" + "1 234,5;2 345,6\n" * 9) != "blanks"


def test_an_elongation_in_millimetres_is_a_displacement(read):
    rows = "".join(f"{0.1 * at};{at};{0.5 * at}\n" for at in range(12))
    record = read("Time (s);Force (N);Elongation (mm)\n" + rows, specimen=SPECIMEN)
    assert record.true_strain[10] > 0.0


def test_what_all_records_are_warned_of_is_said_once():
    at = np.linspace(0.0, 10.0, 20)
    records = [Record(name, at, 0.01 * at, at, warnings=("by constant volume",)) for name in "ab"]
    other = replace(records[0], id="c", warnings=("by constant volume", "no unit"))
    assert Campaign("x", (*records, other)).warnings == ("all records: by constant volume", "c: no unit")
    assert Campaign("x", (records[0],)).warnings == ("a: by constant volume",)
