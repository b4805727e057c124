"""Campaigns: read from a folder, made in memory, saved, and refused in one line when they are wrong."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from probation.errors import InputError
from probation.law.settings import CompanionSettings, LawSettings
from probation.records.campaign import Campaign
from probation.records.record import Noise, Record

CSV = "time_s,true_strain,true_stress_MPa\n" + "".join(f"{at},{0.1 * at},{at}\n" for at in range(12))
ENTRY = '[[record]]\nid = "a"\nfile = "a.csv"\ncontrol = "strain-rate"\nrole = "identify"\n'
SECOND = '[[record]]\nid = "b"\nfile = "b.csv"\ncontrol = "hold"\nrole = "held-out"\n'
WEISSENBERG = '[law.companion]\nform = "weissenberg"\nslope = 0.00464\nintercept = 0.0367\n'


@pytest.fixture
def folder(tmp_path):
    for name in ("a.csv", "b.csv"):
        (tmp_path / name).write_text(CSV, encoding="utf-8")
    return tmp_path


@pytest.fixture
def load(folder):
    def write_and_load(text):
        (folder / "campaign.toml").write_text(text, encoding="utf-8")
        return Campaign.load(folder)

    return write_and_load


@pytest.fixture
def refusal(load, folder):
    """The complaint about a campaign of this text."""

    def write_and_refuse(text):
        with pytest.raises(InputError) as caught:
            load(text)
        message = str(caught.value)
        assert "\n" not in message
        return message.replace(f"{folder}/", "")

    return write_and_refuse


def record(record_id="a", role="identify", n=10):
    time = np.linspace(0.0, 1.0, n)
    return Record(record_id, time, 0.1 * time, 30.0 * time, role=role)


def test_a_campaign_is_read_as_it_is_written(load, folder):
    text = 'name = "hdpe"\n[law]\nmodes = 40\ndecades = 5\n' + WEISSENBERG
    noise = "noise = { stress_MPa = 0.04, strain = 2e-5 }\n"
    campaign = load(text + "[law.fixed]\nunrelaxed_modulus_MPa = 3220\n" + ENTRY + noise + SECOND)
    assert campaign.name == "hdpe"
    assert campaign.path == folder / "campaign.toml"
    assert campaign.law == LawSettings(
        modes=40,
        decades=5.0,
        companion=CompanionSettings("weissenberg", {"slope": 0.00464, "intercept": 0.0367}),
        fixed={"unrelaxed_modulus_MPa": 3220.0},
    )
    assert [r.id for r in campaign.identify] == ["a"]
    assert [r.id for r in campaign.held_out] == ["b"]
    assert campaign.record("a").noise == Noise(stress_MPa=0.04, strain=2e-5)
    assert campaign.record("b").control == "hold"
    assert campaign.record("b").file == folder / "b.csv"


def test_what_a_campaign_leaves_out_has_defaults(load, folder):
    campaign = load('[[record]]\nid = "a"\nfile = "a.csv"\n')
    assert campaign.name == folder.name
    assert campaign.law == LawSettings(modes=50, decades=6.0, companion=None, fixed={})
    assert (campaign.records[0].control, campaign.records[0].role) == ("other", "identify")
    assert campaign.records[0].noise == Noise(None, None)


def test_the_folder_and_its_file_load_the_same(load, folder):
    campaign = load(ENTRY)
    assert Campaign.load(folder / "campaign.toml").data_hash == campaign.data_hash
    assert Campaign.load(str(folder)).data_hash == campaign.data_hash


def test_the_data_hash_changes_with_the_campaign_and_with_its_data(load, folder):
    before = load(ENTRY).data_hash
    assert load(ENTRY + "# a remark\n").data_hash != before
    (folder / "a.csv").write_text(CSV.replace("11,1.1", "11,1.2"), encoding="utf-8")
    assert load(ENTRY).data_hash != before


@pytest.mark.parametrize(
    ("form", "values", "parameters"),
    [
        ("weissenberg", "slope = 1\nintercept = 2", {"slope": 1.0, "intercept": 2.0}),
        ("exponential", "coefficient = 27.24\nexponent = -2.1", {"coefficient": 27.24, "exponent": -2.1}),
        ("power", "coefficient = 0.1\nexponent = -0.9", {"coefficient": 0.1, "exponent": -0.9}),
        (
            "table",
            "rates = [1e-4, 1e-3]\ntau_max_s = [9, 2]",
            {"rates": (1e-4, 1e-3), "tau_max_s": (9.0, 2.0)},
        ),
    ],
)
def test_every_form_of_companion_is_read(load, form, values, parameters):
    campaign = load(f'[law.companion]\nform = "{form}"\n{values}\n{ENTRY}')
    assert campaign.law.companion == CompanionSettings(form, parameters)


def test_records_may_name_columns_units_and_specimen(load, folder):
    """Doubling 50 mm at 24 N over 8 mm²: ε = ln 2, σ = 3·2 = 6 MPa."""
    lines = ["Time (s);Ext (mm);Load (N)"] + [f"{at};{5 * at};0,024" for at in range(11)]
    (folder / "raw.csv").write_text("\n".join(lines), encoding="utf-8")
    campaign = load(
        '[[record]]\nid = "raw"\nfile = "raw.csv"\n'
        'columns = { time = "Time (s)", displacement = "Ext (mm)", force = "Load (N)" }\n'
        'units = { force = "kN" }\n'
        "specimen = { area_mm2 = 8, gauge_length_mm = 50 }\n"
    )
    assert campaign.records[0].true_strain[-1] == pytest.approx(np.log(2.0))
    assert campaign.records[0].true_stress[-1] == pytest.approx(6.0)
    assert any(warning.startswith("raw: ") for warning in campaign.warnings)


def test_a_specimen_is_chosen_by_its_number_and_given_temperatures(load, folder):
    """Two specimens of 15 columns; the log's 20, 21, … °C at 0, 1, … s is interpolated to 20.5 at 0.5 s."""
    rows = [["0"] * 30 for _ in range(12)]
    for at, row in enumerate(rows):
        row[0], row[7], row[9] = str(at), str(0.01 * at), str(at)
        row[15], row[22], row[24] = str(0.5 * at), str(0.02 * at), str(at)
    (folder / "pair.csv").write_text("\n".join(",".join(row) for row in rows), encoding="utf-8")
    log = "t,TMean01,TMean02\n" + "".join(f"{at},90,{20 + at}\n" for at in range(12))
    (folder / "log.csv").write_text(log, encoding="utf-8")
    entry = '[[record]]\nid = "two"\nfile = "pair.csv"\nspecimen_index = 2\n'
    chosen = load(entry + 'temperature_file = "log.csv"\n').records[0]
    assert chosen.true_strain[-1] == pytest.approx(0.22)
    assert chosen.temperature is not None
    assert chosen.temperature[:3] == pytest.approx([20.0, 20.5, 21.0])


def test_one_temperature_may_stand_for_a_whole_test(load, refusal, folder):
    assert (load(ENTRY + "temperature_C = 40.0\n").records[0].temperature == 40.0).all()
    logged = "time_s,true_strain,true_stress_MPa,temperature_C\n"
    logged += "".join(f"{at},{0.01 * at},{at},20\n" for at in range(12))
    (folder / "logged.csv").write_text(logged, encoding="utf-8")
    message = refusal('[[record]]\nid = "a"\nfile = "logged.csv"\ntemperature_C = 40.0\n')
    assert "found it together with a column of temperatures" in message


def test_a_temperature_log_that_ends_early_is_refused(refusal, folder):
    log = "t,TMean01\n" + "".join(f"{0.1 * at},20\n" for at in range(12))
    (folder / "log.csv").write_text(log, encoding="utf-8")
    message = refusal(ENTRY + 'temperature_file = "log.csv"\n')
    assert "log.csv: found temperatures from 0 to 1.1 s, expected the span of record 'a', 0 to 11 s" in message
    assert "b.csv: found no temperatures" in refusal(ENTRY + 'temperature_file = "b.csv"\n')


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (
            'nmae = "x"\n' + ENTRY,
            "row 1: found the unknown key 'nmae', expected a known one; did you mean 'name'?",
        ),
        ("[law]\nmode = 3\n" + ENTRY, "row 2: found the unknown key 'mode' in [law]"),
        (WEISSENBERG + "slop = 1\n" + ENTRY, "row 5: found the unknown key 'slop' in [law.companion]"),
        ("[law.fixed]\ntau_max = 3\n" + ENTRY, "row 2: found the unknown key 'tau_max' in [law.fixed]"),
        (ENTRY + "contrl = 1\n", "row 6: found the unknown key 'contrl' in [[record]] 1"),
        (ENTRY + "noise = { stress = 1 }\n", "row 6: found the unknown key 'stress' in [[record]] 1, noise"),
        (ENTRY + SECOND + "unit = {}\n", "row 11: found the unknown key 'unit' in [[record]] 2"),
        (
            ENTRY + "[record.specimen]\narea = 1\n",
            "row 7: found the unknown key 'area' in [[record]] 1, specimen",
        ),
        (ENTRY + 'columns = { tim = "t" }\n', "did you mean 'time'?"),
        ("[[records]]\n" + ENTRY, "row 1: found the unknown key 'records'"),
        ('[law]\nmodes = "50"\n' + ENTRY, "row 2: found modes = '50' in [law], expected a whole number"),
        ("[law]\nmodes = 5.5\n" + ENTRY, "row 2: found modes = 5.5 in [law], expected a whole number"),
        ("[law]\ndecades = true\n" + ENTRY, "row 2: found decades = True in [law], expected a number"),
        ("[law]\ndecades = inf\n" + ENTRY, "row 2: found decades = inf in [law], expected a finite number"),
        ("[law]\nmodes = 0\n" + ENTRY, "found modes = 0, expected a whole number from 1 to 10000"),
        ("law = 3\n" + ENTRY, "row 1: found law = 3, expected a table"),
        ("name = 3\n" + ENTRY, "row 1: found name = 3, expected text"),
        ('name = " "\n' + ENTRY, "row 1: found an empty name, expected some text"),
        (ENTRY.replace("[[record]]", "[record]"), "row 1: found a single [record], expected [[record]]"),
        ("record = [1]\n", "found 1 in record, expected [[record]] tables"),
        (ENTRY.replace('"a"', "3", 1), "row 2: found id = 3 in [[record]] 1, expected text"),
        (
            ENTRY + 'noise = { strain = "1" }\n',
            "found strain = '1' in [[record]] 1, noise, expected a number",
        ),
        (ENTRY + "noise = { strain = -1 }\n", "expected a number of at least 0"),
        (ENTRY + "specimen_index = 1.0\n", "row 6: found specimen_index = 1.0"),
        (ENTRY.replace("strain-rate", "strainrate"), "row 4: found control = 'strainrate'"),
        (ENTRY.replace("identify", "held_out"), "did you mean 'held-out'?"),
        (ENTRY + 'profile = "etf"\n', "row 6: found profile = 'etf'"),
        (
            ENTRY.replace("a.csv", "aa.csv"),
            "row 3: found file = 'aa.csv' in [[record]] 1, expected a file that exists",
        ),
        (ENTRY.replace("a.csv", "sub/a.csv"), "sub holds no file"),
        (ENTRY + ENTRY, "row 7: found the id 'a' again in [[record]] 2, expected unique ids"),
        (ENTRY.replace('id = "a"\n', ""), "row 1: found no id in [[record]] 1, expected text"),
        (ENTRY.replace('file = "a.csv"\n', ""), "row 1: found no file in [[record]] 1, expected text"),
        (SECOND, 'found held-out records only, expected at least one record with role = "identify"'),
        ("", "found no records, expected at least one"),
        ('name = "x"\n', "found no records, expected at least one"),
        ('name = "x"\nlaw = = 3\n', "found no valid TOML: Invalid value (at row 2, column 7)"),
        ("[law\n", "found no valid TOML"),
        (WEISSENBERG.replace("weissenberg", "wiesenberg") + ENTRY, "row 2: found form = 'wiesenberg'"),
        (WEISSENBERG.replace("slope = 0.00464\n", "") + ENTRY, "row 1: found no slope in [law.companion]"),
        ('[law.companion]\nform = "power"\ncoefficient = -1\nexponent = 1\n' + ENTRY, "coefficient = -1.0"),
        (
            '[law.companion]\nform = "table"\nrates = [1, "x"]\ntau_max_s = [1, 1]\n' + ENTRY,
            "row 3: found 'x' in rates in [law.companion], expected finite numbers only",
        ),
        (WEISSENBERG + "[law.fixed]\ntau_max_s = 3\n" + ENTRY, "found tau_max_s, expected alpha"),
        ("[law.fixed]\nalpha = 1\n" + ENTRY, "found alpha, expected tau_max_s"),
        ("[law.fixed]\ntau_max_s = 0\n" + ENTRY, "found tau_max_s = 0.0, expected a number that is positive"),
    ],
)
def test_a_wrong_campaign_is_refused_by_its_row(refusal, text, complaint):
    message = refusal(text)
    assert message.startswith("campaign.toml")
    assert complaint in message


def test_a_bad_record_is_refused_by_its_own_file(refusal, folder):
    (folder / "a.csv").write_text(CSV.replace("5,0.5,5", "5,x,5"), encoding="utf-8")
    assert refusal(ENTRY).startswith("a.csv, row 7, column 'true_strain': found 'x'")


def test_a_missing_folder_and_a_folder_without_campaign_are_distinguished(tmp_path):
    with pytest.raises(InputError, match="found no such file or folder"):
        Campaign.load(tmp_path / "nowhere")
    with pytest.raises(InputError, match=r"found no campaign\.toml, expected a campaign folder"):
        Campaign.load(tmp_path)


@pytest.mark.parametrize(
    ("form", "parameters", "complaint"),
    [
        ("wiesenberg", {}, "did you mean 'weissenberg'"),
        ("power", {"slope": 1.0}, "expected 'coefficient' and 'exponent'"),
        ("power", {"coefficient": 1.0, "exponent": float("nan")}, "expected a finite number"),
        ("table", {"rates": (1.0, 2.0), "tau_max_s": (1.0,)}, "two or more"),
        ("table", {"rates": (1.0, 2.0), "tau_max_s": 3.0}, "two or more"),
        ("table", {"rates": (1.0, 2.0), "tau_max_s": (1.0, 2.0, 3.0)}, "expected as many"),
        ("table", {"rates": (2.0, 1.0), "tau_max_s": (1.0, 2.0)}, "increasing"),
    ],
)
def test_a_companion_made_in_memory_is_checked_too(form, parameters, complaint):
    with pytest.raises(InputError, match=complaint):
        CompanionSettings(form, parameters)


def test_law_settings_made_in_memory_are_checked_too():
    with pytest.raises(InputError, match="unknown key 'tau_max'; did you mean 'tau_max_s'"):
        LawSettings(fixed={"tau_max": 1.0})
    with pytest.raises(InputError, match="decades"):
        LawSettings(decades=0.0)


def test_a_campaign_made_in_memory_keeps_the_same_promises():
    with pytest.raises(InputError, match="found no records"):
        Campaign(name="x", records=())
    with pytest.raises(InputError, match="the id 'a' more than once"):
        Campaign(name="x", records=(record(), record()))
    with pytest.raises(InputError, match="only held-out records"):
        Campaign(name="x", records=(record(role="held-out"),))
    with pytest.raises(InputError, match="no record 'aa'; did you mean 'a'"):
        Campaign(name="x", records=(record(),)).record("aa")


@pytest.mark.parametrize(
    ("changes", "complaint"),
    [
        ({"time": np.zeros((2, 5))}, r"time: found shape \(2, 5\), expected \(n,\)"),
        ({"true_strain": np.zeros(9)}, r"true_strain: found shape \(9,\), expected \(10,\)"),
        ({"true_stress": ["x"] * 10}, "true_stress: found no numbers"),
        ({"true_strain": np.full(10, np.nan)}, "true_strain, sample 0: found nan, expected a finite number"),
        ({"time": np.zeros(10)}, "time, sample 1: found 0 again"),
        ({"control": "speed"}, "found control 'speed'"),
        ({"role": "fit"}, "found role 'fit'; use 'identify' or 'held-out'"),
        ({"id": ""}, "found the id ''"),
    ],
)
def test_a_record_made_in_memory_is_checked_too(changes, complaint):
    with pytest.raises(InputError, match=complaint):
        replace(record(), **changes)


def test_a_record_of_nine_samples_is_refused():
    with pytest.raises(InputError, match="found 9 points, expected at least 10"):
        record(n=9)


def test_a_record_made_in_memory_with_strain_in_percent_is_refused():
    """Its exponential would overflow later, and no message would name the strain."""
    time = np.linspace(0.0, 1.0, 11)
    with pytest.raises(InputError, match=r"record 'a', true_strain, sample 10: found 25, expected at most 5 .* by 100"):
        Record("a", time, 25.0 * time, time)


def test_noise_cannot_be_negative():
    with pytest.raises(InputError, match=r"noise\.strain"):
        Noise(strain=-1.0)


def test_a_record_owns_its_samples():
    time = np.linspace(0.0, 1.0, 10)
    made = Record("a", time, time, time)
    time[0] = 7.0
    assert made.time[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        made.time[0] = 7.0


numbers = st.floats(-300.0, 300.0).filter(lambda value: value == 0.0 or abs(value) > 1e-29)
columns = st.lists(numbers, min_size=10, max_size=10)
optional = st.none() | columns
# Strain within the range where exp() of it is finite.
strains = st.lists(st.floats(-5.0, 5.0), min_size=10, max_size=10)
companions = st.none() | st.builds(
    lambda slope, intercept: CompanionSettings("weissenberg", {"slope": slope, "intercept": intercept}),
    numbers,
    numbers,
)
records = st.builds(
    lambda times, **rest: Record(time=np.cumsum(times), **rest),
    times=st.lists(st.floats(1e-3, 1e3), min_size=10, max_size=10),
    id=st.text(st.characters(codec="utf-8"), min_size=1).filter(str.strip),
    true_strain=strains,
    true_stress=columns,
    strain_rate=optional,
    transverse_strain=optional,
    temperature=optional,
    control=st.sampled_from(["strain-rate", "displacement-rate", "hold", "cyclic", "other"]),
    noise=st.builds(Noise, st.none() | st.floats(1e-12, 1e9), st.none() | st.floats(1e-12, 5.0)),
)


@settings(deadline=None, max_examples=60)
@given(
    saved=st.builds(
        Campaign,
        name=st.text(st.characters(codec="utf-8"), min_size=1).filter(str.strip),
        records=st.lists(records, min_size=1, max_size=3, unique_by=lambda r: r.id),
        law=st.builds(LawSettings, st.integers(1, 99), st.floats(1e-12, 100.0), companions, st.just({})),
    )
)
def test_a_saved_campaign_reads_back_digit_by_digit(tmp_path_factory, saved):
    folder = tmp_path_factory.mktemp("saved") / "deep" / "er"
    path = saved.save(folder)
    loaded = Campaign.load(path)
    assert (loaded.name, loaded.law) == (saved.name, saved.law)
    assert len(loaded.records) == len(saved.records)
    for back, made in zip(loaded.records, saved.records, strict=True):
        assert (back.id, back.control, back.role, back.noise) == (
            made.id,
            made.control,
            made.role,
            made.noise,
        )
        assert back.samples.keys() == made.samples.keys()
        for name, values in made.samples.items():
            np.testing.assert_array_equal(back.samples[name], values)


def test_saving_leaves_no_temporary_files_and_overwrites_whole(tmp_path):
    campaign = Campaign(name="x", records=(record("a/b"), record("a:b", "held-out")))
    for _ in range(2):
        campaign.save(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a_b-2.csv", "a_b.csv", "campaign.toml"]


def test_a_save_that_fails_leaves_the_old_campaign_whole(tmp_path, monkeypatch):
    Campaign(name="old", records=(record(),)).save(tmp_path)

    def full(self, target):
        raise OSError("disk full")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(OSError, match="disk full"):
        Campaign(name="new", records=(record(n=20),)).save(tmp_path)
    monkeypatch.undo()
    assert Campaign.load(tmp_path).name == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.csv", "campaign.toml"]
