"""What real exports have beside the table: text below it, blocks, headings twice, a unit that contradicts a name."""

import numpy as np
import pytest

from messy_files import COUNT, EXTENSION, FORCE, FURTHER, MESSY, STRAIN, STRESS, TIME
from probation import Campaign, InputError
from probation.cli import main
from probation.records.reading import read_record, read_records

SPECIMEN = {"area_mm2": 40.0, "gauge_length_mm": 50.0}


@pytest.mark.parametrize("name", [*MESSY, *FURTHER])
def test_a_messy_file_is_read_as_it_is(tmp_path, name):
    make, profile, count = (MESSY | FURTHER)[name]
    make(tmp_path / name)
    how = {} if name == "Serie_12.TRA" else {"specimen": SPECIMEN}
    if name == "essai PEHD.xlsx":
        how = {"columns": {"engineering_strain": "Allongement (%)"}}
    records = read_records(tmp_path / name, **how)
    assert [record.profile for record in records] == [profile] * count
    for record in records:
        end = len(record.time)
        assert end >= 40
        assert record.time == pytest.approx(TIME[:end], abs=1e-5)
        assert record.true_strain == pytest.approx(np.log1p(STRAIN[:end]), abs=1e-6)
        assert record.true_stress == pytest.approx((STRESS * (1.0 + STRAIN))[:end], abs=1e-4)
    assert len(records[0].time) == COUNT


def test_nineteen_other_messy_files_become_a_campaign_without_writing_toml(tmp_path):
    for name, (make, _, _) in (MESSY | FURTHER).items():
        make(tmp_path / name)
    files = [str(tmp_path / name) for name in MESSY | FURTHER]
    options = [part for key, value in SPECIMEN.items() for part in ("--specimen", f"{key}={value}")]
    assert main(["init", *files, "-o", str(tmp_path / "hdpe"), "--yes", *options]) == 0
    assert len(Campaign.load(tmp_path / "hdpe").records) == sum(count for _, _, count in (MESSY | FURTHER).values())


def _table(below, last=""):
    rows = [f"{t:.3f},{u:.4f},{f:.4f}" for t, u, f in zip(TIME, EXTENSION, FORCE, strict=True)]
    return "\n".join(["Time (s),Extension (mm),Load (N)", *rows[:-1], last or rows[-1], *below, ""])


def test_text_below_the_numbers_is_left_out_and_said(tmp_path):
    (tmp_path / "a.csv").write_text(_table(["", "Operator,J. Smith", "Remark,slipped?"]))
    record = read_record(tmp_path / "a.csv", specimen=SPECIMEN)
    assert len(record.time) == COUNT
    assert f"left out 2 rows of text below the numbers: 'Operator' in row {COUNT + 3}" in record.warnings


def test_a_damaged_last_row_is_not_taken_for_text(tmp_path):
    (tmp_path / "a.csv").write_text(_table([], last="5o.0,12.5,1900"))
    with pytest.raises(InputError, match="expected a number"):
        read_record(tmp_path / "a.csv", specimen=SPECIMEN)


def test_text_between_numbers_is_still_refused(tmp_path):
    lines = _table([]).split("\n")
    (tmp_path / "a.csv").write_text("\n".join([*lines[:20], "paused,,", *lines[20:]]))
    with pytest.raises(InputError, match=r"row 21.*'paused', expected a number"):
        read_record(tmp_path / "a.csv", specimen=SPECIMEN)


def test_a_test_in_blocks_is_one_record_and_two_tests_are_two(tmp_path):
    MESSY["specimen.dat"][0](tmp_path / "one.dat")
    (one,) = read_records(tmp_path / "one.dat", specimen=SPECIMEN)
    assert "2 tables joined to 1: the time goes on from one to the next" in one.warnings
    MESSY["b_export.csv"][0](tmp_path / "two.csv")
    assert len(read_records(tmp_path / "two.csv", specimen=SPECIMEN)) == 2


def test_a_heading_that_stands_twice_says_which_is_read(tmp_path):
    MESSY["DAQ- Crosshead, … - (Timed).csv"][0](tmp_path / "a.csv")
    assert any(
        "headed 'Axial Strain': the first, position 4" in one for one in read_record(tmp_path / "a.csv").warnings
    )
    other = read_record(tmp_path / "a.csv", columns={"engineering_strain": 5})
    assert other.true_strain == pytest.approx(np.log1p(STRAIN), abs=1e-6)


def test_a_row_that_names_the_next_specimen_is_no_sample_of_the_one_above(tmp_path):
    FURTHER["Bluehill_PP_all.csv"][0](tmp_path / "a.csv")
    assert [len(record.time) for record in read_records(tmp_path / "a.csv")] == [COUNT, COUNT]


def test_a_force_in_decanewton_is_ten_newton(tmp_path):
    (tmp_path / "a.csv").write_text(_table([]).replace("Load (N)", "Load (daN)"))
    newton = FORCE / 40.0 * (1.0 + STRAIN)
    assert read_record(tmp_path / "a.csv", specimen=SPECIMEN).true_stress == pytest.approx(10.0 * newton, abs=1e-3)


def test_a_heading_is_found_below_facts_with_numbers_though_its_strain_is_vague(tmp_path):
    rows = [f"{f:.4f};{100 * e:.4f}" for f, e in zip(FORCE, STRAIN, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join(["Channels;2;2", "Samples;60;60", "Force (N);Elongation (%)", *rows, ""]))
    how = {"columns": {"engineering_strain": "Elongation (%)"}, "test_rate": "0.005 1/s"}
    record = read_record(tmp_path / "a.csv", specimen={"area_mm2": 40.0}, **how)
    assert record.true_stress == pytest.approx(STRESS * (1.0 + STRAIN), abs=1e-4)
