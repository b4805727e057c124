"""The preview says what a file would be read as, first of all."""

from pathlib import Path

import numpy as np
import pytest

from probation.errors import InputError
from probation.records.noise import noise_level
from probation.records.preview import preview
from probation.records.text_plot import text_plot

DATA = Path(__file__).parents[3] / "shared" / "data"
measured = pytest.mark.skipif(not DATA.is_dir(), reason="the measured records are not beside the repository")


@pytest.fixture
def shown(tmp_path):
    lines = ["Zeit (ms);True strain;True stress (kPa);Note"]
    lines += [f"{100 * at};0,{at:02d};{10 * at},5;x" for at in range(12)]
    path = tmp_path / "zug.csv"
    path.write_bytes("\n".join(lines).encode("latin-1"))
    return preview(path, columns={"time": "Zeit"})


def verdict(seen):
    """The first paragraph of the summary, in one line."""
    return " ".join(seen.summary().split("\n\n")[0].split())


def test_the_verdict_comes_first(shown):
    assert verdict(shown).endswith("zug.csv: reads as csv (delimited text with headings), 1 record")


def test_the_layout_is_told(shown):
    summary = " ".join(shown.summary().split())
    assert "encoding utf-8, separator semicolon, decimal comma, headings in row 1, 12 rows" in summary
    assert "12 samples over 1.1 s, every 0.1 s" in summary
    assert shown.columns == (
        ("Zeit (ms)", "ms", "time"),
        ("True strain", None, "true_strain"),
        ("True stress (kPa)", "kPa", "true_stress"),
        ("Note", None, None),
    )
    assert "0 to 0.11" in summary
    assert "0.0005 to 0.1105 MPa" in summary


def test_the_first_rows_are_shown_as_they_stand(shown):
    assert "  100  0,01  10,5" in shown.summary().splitlines()


def test_warnings_are_shown(tmp_path):
    path = tmp_path / "percent.csv"
    lines = ["time_s,true_strain,true_stress_MPa"] + [f"{at},{0.3 * at},{at}" for at in range(12)]
    path.write_text("\n".join(lines), encoding="utf-8")
    assert "1 record, 1 warning" in verdict(preview(path))
    assert "warning: strain in percent?" in preview(path).summary()


def test_units_that_are_assumed_are_told(tmp_path):
    path = tmp_path / "bare.csv"
    lines = ["Time,true_strain,kPa"] + [f"{at},{0.01 * at},{at}" for at in range(12)]
    path.write_text("\n".join(lines), encoding="utf-8")
    shown = preview(path, columns={"true_stress": "kPa"})
    assert "warning: no unit is stated for column 'Time' of bare.csv: s assumed" in shown.summary()
    assert ("kPa", "kPa", "true_stress") in shown.columns


def test_uneven_sampling_is_told(tmp_path):
    path = tmp_path / "uneven.csv"
    lines = ["time_s,true_strain,true_stress_MPa"] + [f"{at**2},{0.1 * at},{at}" for at in range(12)]
    path.write_text("\n".join(lines), encoding="utf-8")
    assert "unevenly, every 1 to 21 s (median 11 s)" in preview(path).summary()


def test_a_bad_file_is_refused_as_reading_would(tmp_path):
    path = tmp_path / "bad.csv"
    path.write_text("time_s,true_strain,true_stress_MPa\n0,x,0\n1,2,3\n", encoding="utf-8")
    with pytest.raises(InputError, match="row 2, column 'true_strain': found 'x'"):
        preview(path)


def test_the_plot_has_labelled_axes_with_units(shown):
    labels = {label for axes in shown.plot().axes for label in (axes.get_xlabel(), axes.get_ylabel())}
    assert {"true strain [–]", "true stress [MPa]", "time [s]"} <= labels


@measured
def test_temperatures_are_shown_not_refused():
    seen = preview(DATA / "etfe" / "OUTTemp_MD_CSR_01_T40.csv")
    assert seen.records == ()
    assert verdict(seen).endswith("temperatures over time, no stress-strain record")


@measured
def test_three_specimens_are_three_records_unless_one_is_chosen():
    path = DATA / "etfe" / "OUTRaw_MD_CSR_01_T40.csv"
    assert "3 records, one per specimen" in verdict(preview(path))
    assert [record.id for record in preview(path, specimen_index=2).records] == ["OUTRaw_MD_CSR_01_T40-2"]


@measured
def test_metadata_is_shown():
    assert "  Type of test: Pull-to-failure" in preview(DATA / "silicones" / "RTV615.csv").summary()


@measured
def test_scatter_of_etfe_is_of_the_size_that_was_stated():
    """Stated with the data: about 0.002 MPa (engineering stress) and 8e-5 strain."""
    record = preview(DATA / "etfe" / "OUTRaw_MD_CSR_01_T40.csv", specimen_index=1).records[0]
    assert 0.001 < noise_level(record.time, record.true_stress) < 0.006
    assert 2e-5 < noise_level(record.time, record.true_strain) < 1.6e-4


def test_scatter_finds_the_noise_under_a_steep_curve_at_uneven_times():
    """White noise of 0.04 on a curve from 0 to 40; 4000 samples tell it to a few percent."""
    random = np.random.default_rng(5)
    time = np.sort(random.uniform(0.0, 400.0, 4000))
    time += np.linspace(0.0, 1e-6, 4000)
    clean = 40.0 * (1.0 - np.exp(-time / 60.0))
    assert noise_level(time, clean + random.normal(0.0, 0.04, 4000)) == pytest.approx(0.04, rel=0.06)


def test_a_straight_line_is_drawn_from_corner_to_corner():
    """Two by two characters are four by eight dots: up the diagonal, two dots high for each dot wide."""
    line = np.linspace(0.0, 1.0, 50)
    top, bottom = text_plot(line, line, "x [s]", "y [m]", width=2, height=2).splitlines()[1:3]
    assert top.startswith("1 ┤")
    assert bottom.startswith("0 ┤")
    assert (top[-2], bottom[-1]) == ("⠀", "⠀")
    assert "⠀" not in (top[-1], bottom[-2])


def test_a_constant_is_a_level_line_labelled_once():
    """Four characters are sixteen dots high; the middle, 7.5, rounds to the ninth row, top of the third."""
    lines = text_plot(np.arange(10.0), np.ones(10), "x", "y", width=5, height=4).splitlines()
    assert lines[3] == "1 ┤" + 5 * "⠉"
    assert sum(line.startswith("1") for line in lines) == 1
