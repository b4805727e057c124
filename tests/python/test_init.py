"""From the files of a laboratory to a campaign that loads and fits, without writing TOML."""

import io
import json
import shutil
import tomllib

import numpy as np
import pytest

from lab_files import FILES, STRAIN, STRESS, TIME, bluehill
from probation import Campaign, InputError, fit, init_campaign
from probation.cli import main
from probation.commands.init import _Asking
from probation.published.experiments import twin_campaign
from probation.records.initial import init_campaign as init_campaign_module
from probation.records.initial.control import guess_control
from probation.records.initial.questions import Question
from probation.records.reading import read_record
from probation.records.said_once import of_all

SPECIMEN = ["--specimen", "area_mm2=40", "--specimen", "gauge_length_mm=50"]


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """The files."""
    folder = tmp_path_factory.mktemp("lab")
    for name, (make, _, _) in FILES.items():
        make(folder / name)
    return folder


@pytest.fixture(scope="module")
def made(lab, tmp_path_factory):
    """A campaign of them."""
    folder = tmp_path_factory.mktemp("made") / "hdpe"
    assert main(["init", *(str(lab / name) for name in FILES), "-o", str(folder), "--yes", *SPECIMEN]) == 0
    return folder


def test_twenty_one_messy_files_become_a_campaign_without_writing_toml(made):
    campaign = Campaign.load(made)
    assert {record.file.name for record in campaign.records} == set(FILES)
    assert len(campaign.records) == sum(count for _, _, count in FILES.values()) == 25
    assert {record.control for record in campaign.records} == {"displacement-rate"}


def test_the_campaign_fits(made):
    campaign = Campaign.load(made)
    some = Campaign("some", campaign.records[:3])
    found = json.loads(fit(some).to_json())["parameters"]
    assert found["unrelaxed_modulus_MPa"]["value"] == pytest.approx(2400.0, rel=0.02)
    assert found["tau_max_s"]["value"] == pytest.approx(6.0, rel=0.02)


def test_a_campaign_survives_being_moved(made, tmp_path):
    moved = shutil.move(shutil.copytree(made, tmp_path / "copy"), tmp_path / "elsewhere")
    assert len(Campaign.load(moved).records) == 25


def test_a_page_shows_every_record(made):
    page = (made / "records.html").read_text()
    assert all(f"{record.id}: stress over strain" in page for record in Campaign.load(made).records)


def test_the_campaign_says_in_comments_how_each_record_is_read(made):
    text = (made / "campaign.toml").read_text()
    assert "# read: by profile bluehill: time 'Time', displacement 'Extension', force 'Load'" in text
    assert "# stated in the file: area_mm2 = 40, gauge_length_mm = 50" in text
    assert "# role: " in text


def test_what_is_said_of_all_files_leaves_what_a_file_states(made):
    entries = tomllib.loads((made / "campaign.toml").read_text())["record"]
    by_id = {entry["id"]: entry for entry in entries}
    assert "specimen" not in by_id["raw-2"]  # its table says 4 mm by 10.2 mm
    assert by_id["specimen"]["specimen"] == {"area_mm2": 40.0, "gauge_length_mm": 50.0}


def test_what_is_said_of_one_file_wins(lab, tmp_path):
    files = [str(lab / "raw.csv"), str(lab / "essai.csv")]
    said = ["--specimen", "essai.csv:area_mm2=80", "--role", "essai.csv:held-out", "--control", "raw.csv:other"]
    assert main(["init", *files, "-o", str(tmp_path / "made"), "--yes", *said]) == 0
    campaign = Campaign.load(tmp_path / "made")
    assert [record.role for record in campaign.records] == ["identify", "identify", "held-out"]
    assert [record.control for record in campaign.records] == ["other", "other", "displacement-rate"]
    assert campaign.record("essai").true_stress == pytest.approx(0.5 * STRESS * (1 + STRAIN), abs=1e-4)


def test_what_is_said_wins_where_there_is_but_one_file(lab, tmp_path):
    said = ["--specimen", "area_mm2=80"]
    assert main(["init", str(lab / "essai.csv"), "-o", str(tmp_path / "made"), "--yes", *said]) == 0
    (record,) = Campaign.load(tmp_path / "made").records
    assert record.true_stress == pytest.approx(0.5 * STRESS * (1 + STRAIN), abs=1e-4)


@pytest.mark.parametrize(
    ("name", "option"),
    [("specimen.dat", "--specimen gauge_length_mm=…"), ("Zugversuch.xlsx", "--specimen gauge_length_mm=…")],
)
def test_without_a_terminal_one_line_says_which_option_to_give(lab, tmp_path, capsys, monkeypatch, name, option):
    monkeypatch.setattr("sys.stdin", io.StringIO("5\n5\n"))
    assert main(["init", str(lab / name), "-o", str(tmp_path / "made")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"probation: {name}: found no gauge length")
    assert option in line
    assert not (tmp_path / "made").exists()


def test_all_that_is_missing_is_said_at_once(lab, tmp_path, capsys):
    """A displacement and a force without dimensions, a curve without time: three answers, in one line."""
    curve = tmp_path / "curve.csv"
    curve.write_text("Strain (%),Stress (MPa)\n" + "".join(f"{at},{at}\n" for at in range(12)))
    files = [str(lab / "specimen.dat"), str(lab / "Zugversuch.xlsx"), str(curve)]
    assert main(["init", *files, "-o", str(tmp_path / "made"), "--yes"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "specimen.dat and Zugversuch.xlsx: found no gauge length" in line
    assert "specimen.dat and Zugversuch.xlsx: found no section" in line or "specimen.dat: found no section" in line
    assert "curve.csv: found no time column" in line
    for option in ("--specimen gauge_length_mm=…", "--specimen area_mm2=…", "--test-rate"):
        assert line.count(option) == 1


@pytest.mark.parametrize("quantity", ["Strain", "Stress"])
def test_a_record_of_zeros_is_refused(tmp_path, quantity):
    path = tmp_path / "idle.csv"
    rows = [(at, 0.0 if quantity == "Strain" else 0.1 * at, 0.0 if quantity == "Stress" else at) for at in range(12)]
    path.write_text("time_s,true_strain,true_stress_MPa\n" + "".join(f"{t},{e},{s}\n" for t, e, s in rows))
    with pytest.raises(
        InputError, match=rf"idle: found a {quantity.lower()} of zero in all 12 samples, expected a test"
    ):
        init_campaign([path], tmp_path / "made")
    assert not (tmp_path / "made").exists()


def test_an_empty_folder_name_is_refused(lab, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert main(["init", str(lab / "raw.csv"), "-o", "", "--yes"]) == 2
    assert "-o" in (said := capsys.readouterr().err.splitlines()[-1])
    assert "found an empty name, expected a folder" in said
    with pytest.raises(InputError, match="found an empty name"):
        init_campaign([lab / "raw.csv"], "")
    assert list(tmp_path.iterdir()) == []


def test_what_turns_the_order_of_reading_is_escaped_in_campaign_toml(lab, tmp_path):
    """U+202E turns what follows it; U+1F4A9 prints; U+E0001, a tag, has no place in the first plane."""
    name = "raw \u202egnp.\U000e0001\U0001f4a9é.csv"
    shutil.copy(lab / "raw.csv", tmp_path / name)
    init_campaign([tmp_path / name], tmp_path / "made", specimen={"area_mm2": 40.0, "gauge_length_mm": 50.0})
    text = (tmp_path / "made" / "campaign.toml").read_text(encoding="utf-8")
    assert "\u202e" not in text
    assert "\U000e0001" not in text
    assert "\U0001f4a9é" in text
    assert tomllib.loads(text)["record"][0]["file"] == name
    assert len(Campaign.load(tmp_path / "made").records) >= 1


def test_a_curve_without_time_says_that_it_needs_a_rate(tmp_path, capsys):
    path = tmp_path / "curve.csv"
    path.write_text("Strain (%),Stress (MPa)\n" + "".join(f"{at},{at}\n" for at in range(12)))
    assert main(["init", str(path), "-o", str(tmp_path / "a"), "--yes"]) == 2
    assert "--test-rate" in capsys.readouterr().err
    assert main(["init", str(path), "-o", str(tmp_path / "b"), "--yes", "--test-rate", "1 %/s"]) == 0
    assert Campaign.load(tmp_path / "b").records[0].time[-1] == pytest.approx(11.0)


def test_questions_are_asked_with_a_default(lab, tmp_path, monkeypatch, capsys):
    asked = []

    def ask(question):
        asked.append((question.key, question.default))
        return {"gauge_length": "50", "area": "10x4"}.get(question.key, "")

    made = init_campaign([lab / "specimen.dat", lab / "tension.csv"], tmp_path / "made", ask=ask)
    assert asked == [
        ("gauge_length", ""),
        ("area", ""),
        ("role", "identify"),
        ("column:Strain (%)", "engineering"),
        ("column:Stress (MPa)", "engineering"),
        ("role", "identify"),
    ]
    assert {record.control for record in made.campaign.records} == {"displacement-rate"}
    for record in made.campaign.records:
        assert record.true_stress == pytest.approx(STRESS * (1 + STRAIN), abs=1e-3)


def test_how_a_test_was_driven_is_asked_only_where_the_strain_does_not_tell(tmp_path):
    time = np.linspace(0.0, 20.0, 101)
    rows = zip(time, 0.01 * (np.exp(time / 8.0) - 1.0), 2.0 * time, strict=True)
    path = tmp_path / "faster.csv"
    path.write_text("time_s,true_strain,true_stress_MPa\n" + "".join(f"{t},{e},{s}\n" for t, e, s in rows))
    asked = []

    def ask(question):
        asked.append(question.key)
        return "other" if question.key == "control" else ""

    init_campaign([path], tmp_path / "made", ask=ask)
    assert asked == ["control", "role"]


def test_an_answer_is_the_default_of_the_next_file_and_a_bad_one_is_asked_again(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", io.StringIO("40\n\nsideways\nhold\n"))
    ask = _Asking()
    area = Question("a.csv", "area", "section", "--specimen …")
    assert [ask(area), ask(area)] == ["40", "40"]
    assert ask(Question("a", "control", "way", "--control …", "other", ("hold", "other"))) == "hold"
    shown = capsys.readouterr().err
    assert "a.csv: section [40]: " in shown
    assert "a: way (hold, other) [other]: expected hold, other" in shown
    with pytest.raises(InputError, match="found no section, expected --specimen"):
        ask(area)


@pytest.mark.parametrize(("answer", "area"), [("40", 40.0), ("10x4", 40.0), ("10 × 4", 40.0), ("d7,1", 39.59)])
def test_a_section_is_answered_as_an_area_a_rectangle_or_a_diameter(lab, tmp_path, answer, area):
    answers = {"gauge_length": "50", "area": answer}
    made = init_campaign([lab / "specimen.dat"], tmp_path / "made", ask=lambda asked: answers.get(asked.key, ""))
    stress = made.campaign.records[0].true_stress
    assert stress == pytest.approx(STRESS * (1 + STRAIN) * 40.0 / area, rel=1e-3, abs=1e-3)


def test_a_link_names_the_file_where_it_is(lab, tmp_path):
    made = init_campaign([lab / "essai.csv"], tmp_path / "made", link=True)
    assert sorted(path.name for path in (tmp_path / "made").iterdir()) == ["campaign.toml", "records.html"]
    assert made.campaign.records[0].file.resolve() == (lab / "essai.csv").resolve()


def test_files_of_the_same_name_are_both_kept(lab, tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        shutil.copy(lab / "essai.csv", tmp_path / folder)
    made = init_campaign([tmp_path / "a" / "essai.csv", tmp_path / "b" / "essai.csv"], tmp_path / "made")
    assert [record.id for record in made.campaign.records] == ["essai", "essai-2"]
    assert len({record.file for record in made.campaign.records}) == 2


def test_a_campaign_that_is_there_is_left_alone(made, lab, capsys):
    before = (made / "campaign.toml").read_bytes()
    assert main(["init", str(lab / "essai.csv"), "-o", str(made), "--yes"]) == 2
    assert "found a campaign.toml, expected a new folder" in capsys.readouterr().err
    assert (made / "campaign.toml").read_bytes() == before


def test_something_said_of_no_file_is_refused(lab, tmp_path):
    with pytest.raises(InputError, match=r"'esai\.csv', which is not among the files; did you mean 'essai\.csv'"):
        init_campaign([lab / "essai.csv"], tmp_path / "made", by_file={"esai.csv": {"role": "held-out"}})


def test_the_control_is_guessed_of_the_strain():
    twins = {record.id: guess_control(record) for record in twin_campaign().records}
    assert next(iter(twins.values())) == "strain-rate"
    record = twin_campaign().records[0]
    strain = {
        "strain-rate": 0.001 * TIME,
        "displacement-rate": np.log1p(0.05 * TIME),
        "hold": np.minimum(0.1 * TIME, 0.2),
        "cyclic": 0.1 * np.sin(TIME),
        "other": 1e-3 * TIME**2,
    }
    for control, values in strain.items():
        made = type(record)("a", TIME, values, values)
        assert guess_control(made) == control


def test_after_a_disk_that_was_full_the_same_call_can_be_made_again(lab, tmp_path, monkeypatch):
    name = next(iter(FILES))
    whole = init_campaign_module.InitialCampaign.report

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(init_campaign_module.InitialCampaign, "report", full)
    how = {"specimen": {"area_mm2": 40.0, "gauge_length_mm": 50.0}}
    with pytest.raises(OSError, match="space"):
        init_campaign([lab / name], tmp_path / "one", **how)
    monkeypatch.setattr(init_campaign_module.InitialCampaign, "report", whole)
    init_campaign([lab / name], tmp_path / "one", **how)
    assert sorted(each.name for each in (tmp_path / "one").iterdir()) == sorted([name, "campaign.toml", "records.html"])


def test_a_name_that_no_campaign_can_hold_is_refused_before_anything_is_written(lab, tmp_path):
    name = next(iter(FILES))
    odd = tmp_path / "odd\udcff.csv"
    shutil.copy(lab / name, odd)
    with pytest.raises(InputError, match="not UTF-8"):
        init_campaign([odd], tmp_path / "one")
    assert not (tmp_path / "one").exists()


@pytest.mark.parametrize("value", [1e200, 1e-320], ids=str)
def test_a_dimension_beyond_all_specimens_is_refused(lab, value):
    with pytest.raises(InputError, match=r"specimen\.diameter_mm: found .* expected a positive number from"):
        Campaign.from_files([lab / next(iter(FILES))], specimen={"diameter_mm": value})


def test_a_note_of_every_record_is_written_once(tmp_path):
    """Engineering records without a transverse strain: the volume is assumed constant in both."""
    files = [tmp_path / "one.csv", tmp_path / "other.csv"]
    for file in files:
        bluehill(file)
    folder = tmp_path / "made"
    assert main(["init", *map(str, files), "-o", str(folder), "--yes", *SPECIMEN]) == 0
    shared = of_all(Campaign.load(folder).records)
    text = (folder / "campaign.toml").read_text(encoding="utf-8")
    assert shared
    assert [text.count(f"# note, of every record: {warning}\n") for warning in shared] == [1] * len(shared)
    assert not any(f"# note: {warning}" in text for warning in shared)


def test_a_strain_beside_a_displacement_is_asked_for_and_taken(tmp_path):
    rows = (f"{t};{1.1 * e * 50};{f};{100 * e}" for t, e, f in zip(TIME, STRAIN, 40.0 * STRESS, strict=True))
    (tmp_path / "a.csv").write_text("\n".join(["Time (s);Crosshead (mm);Force (N);Strain (%)", *rows]) + "\n")
    arguments = ["init", str(tmp_path / "a.csv"), "-o", str(tmp_path / "made"), "--yes", "--specimen", "area_mm2=40"]
    assert main(arguments) == 0
    (record,) = Campaign.load(tmp_path / "made").records
    assert record.true_strain == pytest.approx(np.log1p(STRAIN))
    plain = read_record(tmp_path / "a.csv", specimen={"area_mm2": 40.0, "gauge_length_mm": 50.0})
    assert any("column 'Strain (%)' is not read" in warning for warning in plain.warnings)
