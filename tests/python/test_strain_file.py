"""Strain from a second file on a clock of its own: the shift is found, shown, and stated with an uncertainty."""

import re
from pathlib import Path

import numpy as np
import pytest

from lab_files import STRAIN, STRESS, TIME
from probation import Campaign, InputError, Law, init_campaign
from probation.cli import main
from probation.records.clock import estimate_shift
from probation.records.reading import read_record
from probation.report.initial_page import clocks_figure

DATA = Path(__file__).parents[2].parent / "shared" / "data" / "zr-ti-nb"
needs_data = pytest.mark.skipif(not DATA.exists(), reason="the measured records are not here")

CLOCK = np.arange(-5.0, 20.0, 0.1)
FORCE = 40.0 * np.interp(CLOCK, TIME, STRESS)
CROSSHEAD = 50.0 * np.interp(CLOCK, TIME, STRAIN) + 0.001 * FORCE
"""Of a machine that gives way: half of its travel is its own at first."""
FILM = np.arange(-4.0, 19.0, 0.25)


def _filmed(noise=1e-4, seed=0):
    return np.interp(FILM, TIME, STRAIN) + noise * np.random.default_rng(seed).standard_normal(len(FILM))


@pytest.mark.parametrize("noise", [1e-4, 1e-3])
@pytest.mark.parametrize("with_displacement", [True, False], ids=["rates", "onset"])
def test_the_shift_is_found_as_well_as_it_says(noise, with_displacement):
    """At most 3 of 20 lie beyond two standard errors (98 % of sets), none beyond 0.2 s, with four frames a second."""
    errors, errors_in_se = [], []
    for seed in range(20):
        true = np.random.default_rng(seed).uniform(-5.0, 5.0)
        displacement = CROSSHEAD if with_displacement else None
        found = estimate_shift(CLOCK, FORCE, displacement, FILM - true, _filmed(noise, seed))
        errors.append(found.value - true)
        errors_in_se.append(errors[-1] / found.se)
    assert np.abs(errors).max() < 0.2
    assert (np.abs(errors_in_se) > 2.0).sum() <= 3


@pytest.mark.parametrize("rate", [1e-3, 1e-2])
@pytest.mark.parametrize("rests", [(0.0, 0.0), (0.0, 3.0), (3.0, 0.0)], ids=["neither", "film", "force"])
def test_a_ramp_that_only_one_file_shows_the_start_of_tells_its_shift(rate, rests):
    """A file may begin with the motion: the law of a polymer, a frame with a compliance, 0.0003 of strain noise."""
    law = Law(unrelaxed_modulus=3220.0, tau_max=5.0, hardening_modulus=2.0)
    time = np.linspace(0.0, 0.5 / rate, 2001)
    strain = np.expm1(rate * time)
    force = 40.0 * law.stress(time, rate * time, scheme="sa3") / (1.0 + strain)
    displacement = 50.0 * strain + 2e-4 * force
    for seed, true in enumerate((-5.0, 0.4, 3.3)):
        random = np.random.default_rng(seed)
        clock = np.arange(-rests[0], time[-1], time[-1] / 800)
        frames = np.arange(-rests[1], 0.9 * time[-1], 0.25)
        found = estimate_shift(
            clock,
            np.interp(clock, time, force) + random.normal(0.0, 1.6, len(clock)),
            np.interp(clock, time, displacement),
            frames - true,
            np.interp(frames, time, strain) + random.normal(0.0, 3e-4, len(frames)),
        )
        assert abs(found.value - true) < 4.0 * found.se < 2.0


@pytest.fixture
def files(tmp_path):
    """A force file, and a film whose clock is 7.5 s ahead."""
    rows = zip(CLOCK + 5.0, CROSSHEAD, FORCE, strict=True)
    force = tmp_path / "force.csv"
    force.write_text("Time (s),Stroke (mm),Force (N)\n" + "".join(f"{t:.3f},{u:.6f},{f:.6f}\n" for t, u, f in rows))
    film = tmp_path / "video.csv"
    text = "".join(f"{t + 12.5:.3f},{100 * e:.6f}\n" for t, e in zip(FILM, _filmed(), strict=True))
    film.write_text("Zeit (s),Engineering strain (%)\n" + text)
    return force, film


def _error(record):
    """Largest departure from the true stress over the true strain, but for the kink at the start [MPa]."""
    expected = np.interp(np.expm1(record.true_strain), STRAIN, STRESS) * np.exp(record.true_strain)
    return np.abs(record.true_stress - expected)[record.true_strain > 0.005].max()


def test_the_strain_of_a_film_is_joined_to_the_force(files):
    force, film = files
    record = read_record(force, strain_from={"file": film.name}, specimen={"area_mm2": 40.0})
    assert _error(record) < 1.0
    (note,) = [warning for warning in record.warnings if "video.csv" in warning]
    shift, se = map(float, re.search(r"set back by (\S+) ± (\S+) s \(one standard error", note).groups())
    assert abs(shift - 7.5) < 4 * se < 0.4
    assert "samples of the force without strain are left out" in note
    assert 0.9 < record.time[0] < 1.3


@pytest.mark.parametrize("with_displacement", [True, False], ids=["rates", "onset"])
def test_the_misfit_over_the_shift_is_kept_and_drawn(files, with_displacement):
    force, film = files
    if not with_displacement:
        force.write_text("\n".join(",".join(row.split(",")[::2]) for row in force.read_text().split("\n")))
    record = read_record(force, strain_from={"file": film.name}, specimen={"area_mm2": 40.0})
    clock = record.clock
    assert (np.diff(clock.tried) > 0.0).all()
    assert clock.tried[np.argmin(clock.misfit)] == pytest.approx(clock.value, abs=2 * clock.se)
    assert 0.0 <= clock.misfit.min() < 0.1 < clock.misfit.max() <= 1.0 + 1e-9
    misfit, start = clocks_figure(record).axes
    assert misfit.get_xlabel() == "shift of the strain file [s]"
    assert start.get_xlabel() == "time [s]"


def test_a_stated_shift_is_taken(files):
    force, film = files
    how = {"specimen": {"area_mm2": 40.0}}
    record = read_record(force, strain_from={"file": film.name, "shift_s": -7.5}, **how)
    assert _error(record) < 0.5
    assert "set back by 7.5 s, as stated" in " ".join(record.warnings)
    assert len(clocks_figure(record).axes) == 1  # nothing was tried
    late = read_record(force, strain_from={"file": film.name, "shift_s": -6.5}, **how)
    assert _error(late) > 2.0


def test_a_force_file_without_displacement_is_joined_by_the_onset(files):
    force, film = files
    force.write_text(re.sub(r"^([^,\n]*),[^,\n]*,", r"\1,", force.read_text(), flags=re.MULTILINE))
    record = read_record(force, strain_from={"file": film.name}, specimen={"area_mm2": 40.0})
    assert _error(record) < 2.0
    assert "by onset of force and of strain" in " ".join(record.warnings)


def test_the_command_line_joins_too(files, capsys):
    force, film = files
    said = ["--specimen", "area_mm2=40", "--strain-file", str(film), "--strain-column", "engineering_strain=2"]
    assert main(["preview", str(force), *said]) == 0
    assert "the strain is that of video.csv, its clock set back by 7." in capsys.readouterr().out
    assert main(["preview", str(force), "--strain-shift", "3"]) == 2
    assert "found --strain-shift without --strain-file" in capsys.readouterr().err


def test_init_copies_the_film_and_the_campaign_joins_it(files, tmp_path):
    force, film = files
    how = {"specimen": {"area_mm2": 40.0}, "strain_from": {"file": str(film)}}
    made = init_campaign([force], tmp_path / "made", **how)
    page = (tmp_path / "made" / "records.html").read_text(encoding="utf-8")
    assert page.count("two standard errors shaded, and the beginning of the test on one clock") >= 1
    force.unlink()
    film.unlink()
    (record,) = Campaign.load((tmp_path / "made").rename(tmp_path / "moved")).records
    assert np.array_equal(record.true_strain, made.campaign.records[0].true_strain)
    assert _error(record) < 1.0
    text = (tmp_path / "moved" / "campaign.toml").read_text()
    assert 'strain_from = { file = "video.csv" }' in text


def test_films_that_do_not_show_the_start_need_a_shift(files):
    """Both run at constant rates from their first sample to their last."""
    force, film = files
    steady = np.arange(0.0, 20.0, 0.1)
    text = "".join(f"{t:.2f},{t:.4f},{t:.4f}\n" for t in steady)
    force.write_text("Time (s),Stroke (mm),Force (N)\n" + text)
    film.write_text("Time (s),True strain\n" + "".join(f"{t:.2f},{0.01 * t:.6f}\n" for t in steady[50:150]))
    with pytest.raises(InputError, match=r"tells the shift of video\.csv.*--strain-shift"):
        read_record(force, strain_from={"file": film.name}, specimen={"area_mm2": 40.0})


@pytest.mark.parametrize(
    ("given", "complaint"),
    [
        ({"file": "video.csv", "shift": 1.0}, "found the unknown key 'shift'; did you mean 'shift_s'"),
        ({"shift_s": 1.0}, "found no file"),
        ({"file": "video.csv", "shift_s": "1"}, "found shift_s = '1', expected a number of seconds"),
        ({"file": "video.csv", "shift_s": 500.0}, "found 0 samples within the time of video.csv"),
        ({"file": "nowhere.csv"}, "nowhere.csv"),
    ],
)
def test_what_is_wrong_with_a_film_is_said(files, given, complaint):
    with pytest.raises(InputError, match=re.escape(complaint)):
        read_record(files[0], strain_from=given, specimen={"area_mm2": 40.0})


@needs_data
def test_the_frame_of_a_measured_film_is_found_on_the_clock_of_its_stage():
    """The film's frame moves with the stage: 48 s, to two standard errors of 2 s at most."""
    film = {
        "file": str(DATA / "video-extensometer.txt"),
        "columns": {"displacement": "Avg. frameDisplacement (mm)"},
        "specimen": {"gauge_length_mm": 5.1},
    }
    record = read_record(DATA / "stage.txt", strain_from=film)
    shift = float(re.search(r"set forward by (\S+) ±", " ".join(record.warnings)).group(1))
    assert shift == pytest.approx(48.0, abs=2.0)


@needs_data
def test_markers_on_a_yielding_metal_do_not_tell_their_clock_and_are_not_guessed():
    film = {
        "file": str(DATA / "video-extensometer.txt"),
        "columns": {"displacement": "blobDisplacement_B13 (mm)"},
        "specimen": {"gauge_length_mm": 1.727},
    }
    with pytest.raises(InputError, match=r"tells the shift of video-extensometer\.txt"):
        read_record(DATA / "stage.txt", strain_from=film)
    record = read_record(DATA / "stage.txt", strain_from={**film, "shift_s": 47.5})
    elastic = (record.true_stress > 100.0) & (record.true_stress < 400.0) & (record.true_strain < 0.02)
    modulus = np.polyfit(record.true_strain[elastic], record.true_stress[elastic], 1)[0]
    assert 20e3 < modulus < 70e3  # a beta alloy; the stage alone says 4e3


@pytest.mark.parametrize("scale", [1e2, 1e3, 1e9], ids=str)
def test_a_film_on_a_clock_of_another_unit_tells_no_shift(scale):
    found = estimate_shift(CLOCK, FORCE, CROSSHEAD, scale * FILM, _filmed())
    assert np.isinf(found.se)
