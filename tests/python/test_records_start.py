"""A record that starts loaded is questioned, and the ramp that was cut off can be put before it."""

import numpy as np
import pytest

import probation
from probation.errors import InputError
from probation.records.campaign import Campaign
from probation.records.preview import preview
from probation.records.reading import read_record
from probation.records.record import Record
from probation.records.saving import csv_text
from probation.records.start import as_started, with_loading

MODULUS, RATE = 2800.0, 0.005
LAW = probation.Law(unrelaxed_modulus=MODULUS, tau_max=5.2, hardening_modulus=2.5)


def ramp(cut=0, *, control="strain-rate", strain_noise=0.0, strain_offset=0.0, stress_offset=0.0):
    """1001 samples over 100 s at 0.005 1/s with 0.04 MPa of noise, without the first `cut`."""
    random = np.random.default_rng(1)
    time = np.linspace(0.0, 100.0, 1001)
    strain = RATE * time if control == "strain-rate" else np.log1p(RATE * time)
    stress = LAW.stress(time, strain, "exact") + random.normal(0.0, 0.04, 1001) + stress_offset
    strain = strain + random.normal(0.0, strain_noise, 1001) + strain_offset
    return Record("a", time[cut:] - time[cut], strain[cut:], stress[cut:], control=control)


@pytest.fixture
def campaign(tmp_path):
    """A campaign of one whole record and a cut one with these lines of its own."""

    def load(lines="", record=None):
        (tmp_path / "whole.csv").write_text(csv_text(ramp()), encoding="utf-8")
        (tmp_path / "cut.csv").write_text(csv_text(record or ramp(10)), encoding="utf-8")
        (tmp_path / "campaign.toml").write_text(
            f'[[record]]\nid = "whole"\nfile = "whole.csv"\n[[record]]\nid = "cut"\nfile = "cut.csv"\n{lines}\n',
            encoding="utf-8",
        )
        return Campaign.load(tmp_path)

    return load


def test_a_record_that_starts_at_its_beginning_is_not_questioned(campaign):
    assert campaign(record=ramp()).warnings == ()


def test_a_record_cut_at_its_start_is_questioned_with_its_remedies(campaign):
    """After 1 s at 0.005 1/s: a strain of 0.005, 1 % of the largest, but 8.4 MPa of some 35."""
    (warning,) = campaign().warnings
    assert warning.startswith("cut: the record starts at true strain 0.005 and 8.41 MPa")
    assert "cut at its start, or a prestress acts" in warning
    assert 'start = "loaded"' in warning
    assert "probation diagnose weighs a prestress" in warning


def test_a_held_out_record_and_a_preview_are_questioned_too(campaign, tmp_path):
    assert len(campaign('role = "held-out"').warnings) == 1
    assert "warning: the record starts at true strain 0.005" in preview(tmp_path / "cut.csv").summary()


def test_a_prestress_at_zero_strain_is_questioned_but_not_to_be_loaded(campaign):
    (warning,) = campaign(record=ramp(stress_offset=8.0)).warnings
    assert "prestress" in warning
    assert "loaded" not in warning


def test_a_start_within_the_noise_is_not_questioned(campaign):
    """A first force of 0.1 MPa, two and a half deviations of the noise, 0.3 % of the largest stress."""
    assert campaign(record=ramp(stress_offset=0.1)).warnings == ()


def test_the_fit_of_a_cut_record_is_wrong_and_warned_of_and_right_when_it_starts_loaded(campaign):
    """By chance one standard error is 1.6 MPa; the restored ramp may shift E_u by as much again."""
    cut = Campaign(name="cut", records=(campaign().record("cut"),))
    wrong = probation.fit(cut)
    assert wrong.parameters["unrelaxed_modulus"].value > 1.2 * MODULUS
    assert any("cut at its start" in warning for warning in wrong.warnings)
    loaded = campaign('start = "loaded"').record("cut")
    found = probation.fit(Campaign(name="loaded", records=(loaded,)))
    assert found.parameters["unrelaxed_modulus"].value == pytest.approx(MODULUS, abs=5.0)
    assert not any("cut at its start" in warning for warning in found.warnings)
    assert any("is put before the first sample" in warning for warning in found.warnings)


def test_a_loaded_start_adds_the_unloaded_specimen_as_far_back_as_the_rate_needs():
    """0.005 at 0.005 1/s takes 1 s."""
    record = with_loading(ramp(10))
    assert len(record) == 992
    assert record.time[:2] == pytest.approx([-1.0, 0.0])
    assert (record.true_strain[0], record.true_stress[0]) == (0.0, 0.0)
    assert record.true_strain[1] == pytest.approx(0.005)


def test_a_driven_displacement_is_followed_back_in_engineering_strain():
    """10 s at 0.005 1/s of engineering strain; a line in true strain would reach back 5 % further."""
    assert with_loading(ramp(100, control="displacement-rate")).time[0] == pytest.approx(-10.0)


def test_noise_of_the_strain_hardly_moves_the_restored_start():
    """2 s at 0.005 1/s; 60 samples of 1e-4 noise leave 2.6e-5 at the first, 0.005 s."""
    assert with_loading(ramp(20, strain_noise=1e-4)).time[0] == pytest.approx(-2.0, abs=0.02)


def test_every_column_of_a_record_gets_its_sample():
    whole = ramp(10)
    rates, temperatures = np.full(len(whole), RATE), np.full(len(whole), 23.0)
    record = Record(
        "a",
        whole.time,
        whole.true_strain,
        whole.true_stress,
        strain_rate=rates,
        transverse_strain=-0.5 * whole.true_strain,
        temperature=temperatures,
    )
    first = {name: values[0] for name, values in with_loading(record).samples.items()}
    assert first == pytest.approx(
        {"time": -1.0, "true_strain": 0.0, "true_stress": 0.0, "strain_rate": RATE}
        | {"transverse_strain": 0.0, "temperature": 23.0}
    )


@pytest.mark.parametrize(
    "record",
    [
        ramp(),
        ramp(stress_offset=8.0),
        ramp(strain_noise=1e-4),
        Record("a", np.arange(20.0), np.full(20, 0.3), 30.0 * np.exp(-np.arange(20.0))),
        Record("a", np.arange(20.0), np.linspace(0.3, 0.1, 20), np.linspace(30.0, 5.0, 20)),
    ],
    ids=["whole", "prestressed", "noisy", "held", "unloading"],
)
def test_a_start_that_no_ramp_leads_to_is_refused(record):
    with pytest.raises(InputError, match=r"record 'a', start = \"loaded\": found a first true strain of .* no ramp"):
        with_loading(record)


def test_an_unknown_start_is_refused(campaign, tmp_path):
    with pytest.raises(InputError, match=r"found start = 'laoded'.*did you mean 'loaded'"):
        campaign('start = "laoded"')
    with pytest.raises(InputError, match="start: found 'laoded'; did you mean 'loaded'"):
        read_record(tmp_path / "cut.csv", start="laoded")


def triggered(late, *, strain_noise=0.0, prestress=0.0, held=0.0):
    """A ramp at 0.005 1/s, sampled every 0.1 s, whose record begins so long after the first load."""
    random = np.random.default_rng(2)
    fine = np.linspace(0.0, 40.0 + late, 4001)
    time = np.arange(0.0, 40.0, 0.1)
    stress = np.interp(time + late, fine, LAW.stress(fine, RATE * fine + held, "sa3")) + prestress
    strain = RATE * (time + late) + held + random.normal(0.0, strain_noise, len(time))
    return Record("a", time, strain, stress + random.normal(0.0, 0.04, len(time)), control="strain-rate")


@pytest.mark.parametrize(("late", "strain_noise", "error"), [(0.07, 0.0, 1e-6), (0.07, 2e-5, 0.01), (0.15, 2e-5, 0.01)])
def test_what_a_trigger_lost_is_restored_unasked(late, strain_noise, error):
    """0.07 s at 0.005 1/s: a strain of 3.5e-4 and 1 MPa, 25 times the noise, which no relaxed start explains.

    A trigger that waits until the force is beyond its noise loses more than the interval after that.
    """
    record = as_started(triggered(late, strain_noise=strain_noise))
    assert record.time[0] == pytest.approx(-late, abs=error)
    assert (record.true_strain[0], record.true_stress[0]) == (0.0, 0.0)
    assert any("is put before the first sample" in warning for warning in record.warnings)


def test_what_a_trigger_lost_is_restored_where_the_stress_bends_between_the_first_samples():
    """Two seconds apart, two fifths of the longest time: a line through the first stresses comes from too far back."""
    fine, time = np.linspace(0.0, 62.0, 6201), np.arange(0.0, 60.0, 2.0)
    stress = np.interp(time + 1.5, fine, LAW.stress(fine, RATE * fine, "sa3"))
    stress += np.random.default_rng(2).normal(0.0, 0.04, len(time))
    started = as_started(Record("a", time, RATE * (time + 1.5), stress, control="strain-rate"))
    assert started.time[0] == pytest.approx(-1.5, abs=1e-6)


@pytest.mark.parametrize(
    "record",
    [
        triggered(0.0),
        triggered(0.0, prestress=1.0),
        triggered(0.0, prestress=0.3, strain_noise=5e-4),
        triggered(0.0, held=0.1),
        triggered(0.25),
        triggered(0.07, strain_noise=5e-4),
    ],
    ids=["at zero", "prestressed", "force off", "held at a strain", "more than two missing", "strain unclear"],
)
def test_other_starts_stay_as_they_are(record):
    assert as_started(record).time[0] == 0.0


def test_a_strain_whose_first_steps_are_hidden_restores_nothing():
    """The extensometer's step of 0.003 is reached after the fourth sample: the strain stands still at zero before."""
    record = triggered(0.07)
    strain = np.floor(record.true_strain / 0.003) * 0.003
    assert np.all(strain[:4] == 0.0)
    assert as_started(Record("a", record.time, strain, record.true_stress)).time[0] == 0.0


def test_a_start_that_is_said_to_be_relaxed_stays_so():
    assert as_started(triggered(0.07), "relaxed").time[0] == 0.0
