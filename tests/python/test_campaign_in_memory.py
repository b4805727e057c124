"""Campaigns of arrays and data frames: the conversions and the refusals of files."""

import numpy as np
import pandas as pd
import pytest

from probation import Campaign, InputError, Noise
from probation.law.settings import LawSettings

TIME = np.linspace(0.0, 100.0, 21)
STRETCH = 1.0 + 0.01 * TIME
ENGINEERING_STRESS = 20.0 * (1.0 - np.exp(-TIME / 10.0))
TRUE_STRAIN = np.log(STRETCH)
TRUE_STRESS = ENGINEERING_STRESS * STRETCH


def frame(**other):
    columns = {"time_s": TIME, "Extension [mm]": 50.0 * (STRETCH - 1.0), "Load [kN]": 0.01 * ENGINEERING_STRESS}
    return pd.DataFrame(columns | other)


@pytest.mark.parametrize(
    "arrays",
    [
        {"true_strain": TRUE_STRAIN, "true_stress": TRUE_STRESS},
        {"engineering_strain": STRETCH - 1.0, "engineering_stress": ENGINEERING_STRESS},
        {
            "engineering_strain": 100.0 * (STRETCH - 1.0),
            "engineering_stress": 1e3 * ENGINEERING_STRESS,
            "units": {"engineering_strain": "%", "engineering_stress": "kPa"},
        },
        {
            "displacement": 50.0 * (STRETCH - 1.0),
            "force": 0.01 * ENGINEERING_STRESS,
            "units": {"force": "kN"},
            "specimen": {"gauge_length_mm": 50.0, "width_mm": 5.0, "thickness_mm": 2.0},
        },
        {"stretch": list(STRETCH), "true_stress": TRUE_STRESS.astype(np.float32)},
    ],
)
def test_every_measure_becomes_true_strain_and_true_stress(arrays):
    (record,) = Campaign.from_arrays(TIME, **arrays).records
    assert record.time == pytest.approx(TIME)
    assert record.true_strain == pytest.approx(TRUE_STRAIN, abs=1e-12)
    assert record.true_stress == pytest.approx(TRUE_STRESS, rel=1e-6)
    assert not any("no unit is stated" in warning or "the file says" in warning for warning in record.warnings)


def test_arrays_hold_several_records_one_after_the_other():
    twice = {"true_strain": np.tile(TRUE_STRAIN, 2), "true_stress": np.concatenate([TRUE_STRESS, 2.0 * TRUE_STRESS])}
    campaign = Campaign.from_arrays(
        np.tile(TIME, 2),
        **twice,
        record=["slow"] * 21 + ["fast"] * 21,
        role={"fast": "held-out"},
        control="strain-rate",
        noise=Noise(stress_MPa=0.05),
        specimen_id={"slow": "A3"},
        name="two",
        law=LawSettings(modes=30),
    )
    assert [(each.id, each.role, each.control, each.specimen_id) for each in campaign.records] == [
        ("slow", "identify", "strain-rate", "A3"),
        ("fast", "held-out", "strain-rate", None),
    ]
    assert campaign.record("fast").true_stress == pytest.approx(2.0 * TRUE_STRESS)
    assert campaign.record("fast").noise.stress_MPa == 0.05
    assert (campaign.name, campaign.law.modes) == ("two", 30)


def test_a_data_frame_is_read_by_its_headings():
    (record,) = Campaign.from_dataframe(frame(), specimen={"gauge_length_mm": 50.0, "area_mm2": 10.0}).records
    assert record.true_strain == pytest.approx(TRUE_STRAIN, abs=1e-12)
    assert record.true_stress == pytest.approx(TRUE_STRESS)
    assert record.id == "data frame"


@pytest.mark.parametrize("made", [dict, lambda table: table.to_records(index=False), pd.DataFrame.convert_dtypes])
def test_anything_with_columns_will_do(made):
    table = pd.DataFrame({"time_s": TIME, "true_strain": TRUE_STRAIN, "true_stress_MPa": TRUE_STRESS})
    (record,) = Campaign.from_dataframe(made(table)).records
    assert record.true_stress == pytest.approx(TRUE_STRESS)


def test_a_column_says_which_record_a_row_belongs_to_and_others_may_hold_text():
    both = pd.concat([frame(test=1.0, operator="Ann"), frame(test=2.0, operator="Bob")])
    sizes = {"1": {"gauge_length_mm": 50.0, "area_mm2": 10.0}, "2": {"gauge_length_mm": 50.0, "area_mm2": 5.0}}
    campaign = Campaign.from_dataframe(both, record="test", specimen=sizes)
    assert [each.id for each in campaign.records] == ["1", "2"]
    assert campaign.record("2").true_stress == pytest.approx(2.0 * TRUE_STRESS)


def test_a_campaign_of_arrays_can_be_saved_and_loaded(tmp_path):
    campaign = Campaign.from_arrays(TIME, true_strain=TRUE_STRAIN, true_stress=TRUE_STRESS, record="r1")
    again = Campaign.load(campaign.save(tmp_path / "saved"))
    assert again.record("r1").true_stress == pytest.approx(TRUE_STRESS, abs=0.0)


def broken(values, at, value):
    found = np.array(values, dtype=object)
    found[at] = value
    return found


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"true_strain": None}, "from_arrays: found no strain column among 'time' and 'true_stress', expected"),
        (
            {"true_stress": broken(TRUE_STRESS, 4, np.nan)},
            "from_arrays, row 5, column 'true_stress': found 'nan', expected a finite number",
        ),
        (
            {"true_stress": broken(TRUE_STRESS, 4, "1,5")},
            "from_arrays, row 5, column 'true_stress': found '1,5', expected a number; correct the argument",
        ),
        ({"time": broken(TIME, 7, 0.0)}, "from_arrays, row 8, column 'time': found time going back from 30 to 0"),
        (
            {"true_strain": TRUE_STRAIN[:-1]},
            "from_arrays: found 20 samples of true_strain, expected 21, as many as time",
        ),
        (
            {"true_strain": [TRUE_STRAIN]},
            r"from_arrays, column 'true_strain': found the shape (1, 21), expected (n_times,)",
        ),
        ({"true_stress": 1j * TRUE_STRESS}, "found values of type complex128, expected real numbers"),
        ({"time": TIME.astype("datetime64[s]")}, "subtract the first and divide by a second"),
        ({"true_strain": None, "displacement": TIME}, "found a displacement but no gauge_length_mm"),
        ({"units": {"true_stress": "mm"}}, "column 'true_stress': found unit 'mm', expected a stress unit"),
        ({"units": {"force": "N"}}, "units: found a unit for 'force', expected one of"),
        ({"specimen": {"area": 3.0}}, "specimen: found the unknown key 'area'; did you mean"),
        ({"role": {"x": "held-out"}}, "from_arrays: role: found the record 'x'; use 'record'"),
        ({"start": "warm"}, "from_arrays: start: found 'warm'; use 'auto', 'relaxed' or 'loaded'"),
        ({"noise": 0.04}, "from_arrays: noise: found 0.04, expected a probation.Noise"),
        ({"record": ["a"] * 20 + [None]}, "from_arrays, row 21, column 'record': found no name of a record"),
        ({"record": ["a"] * 20 + ["b"]}, "from_arrays, record 'b', row 21, column"),
        ({"record": ["a"] * 20}, "found 21 samples of time, expected 20, as many as record"),
    ],
)
def test_what_is_wrong_is_named_by_argument_and_row(changed, message):
    arguments = {"time": TIME, "true_strain": TRUE_STRAIN, "true_stress": TRUE_STRESS} | changed
    with pytest.raises(InputError) as raised:
        Campaign.from_arrays(**arguments)
    assert message in str(raised.value)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("table", "options", "message"),
    [
        (frame(), {}, "from_dataframe: found a displacement but no gauge_length_mm, expected specimen ="),
        (frame(), {"record": "test"}, "from_dataframe: found no column 'test' for record, expected one of 'time_s'"),
        (frame(), {"columns": {"force": "Loda"}}, "from_dataframe: found no column 'Loda', expected one of"),
        (frame().rename(columns={"Load [kN]": "Stress"}), {}, "'Stress' may be true or engineering: say which"),
        (frame(Load_N=TIME), {}, "found a second column for force, in addition to 'Load [kN]'"),
        (TIME, {}, "from_dataframe: found a value of type ndarray, expected a data frame"),
        (pd.DataFrame({1: TIME}), {}, "from_dataframe: found the column name 1, expected names that are text"),
        (pd.DataFrame(), {}, "from_dataframe: found no columns, expected one column of each name"),
        (frame().iloc[:0], {"specimen": {"gauge_length_mm": 50.0}}, "from_dataframe: found no rows"),
    ],
)
def test_what_is_wrong_is_named_by_column(table, options, message):
    with pytest.raises(InputError) as raised:
        Campaign.from_dataframe(table, **options)
    assert message in str(raised.value)
