"""The virtual specimen: a bar of the law, recorded at its centre, certified and diagnosed."""

import json

import numpy as np
import pytest

import probation
from probation.fe import MaterialPoint
from probation.fe.bar import Bar
from probation.fe.neck import neck
from probation_studies.specimen import Loading, Recording, constant_rate_point, make_specimen, pull
from probation_studies.specimen.__main__ import main
from probation_studies.specimen.experiments import bridgman_factor

pytest.importorskip("felupe")

RELATION = probation.Weissenberg(0.00464, 0.0367)
LAW = probation.Law(unrelaxed_modulus=3220.0, hardening_modulus=1.8, companion=RELATION)
COARSE = {"elements": (8, 1), "radius": 4.0, "largest_step": 0.01, "largest_centre_step": 0.03}


def test_a_bar_without_imperfection_answers_as_the_law_in_one_dimension():
    """Before a neck forms at its held end; at K = 1e8 MPa the elastic volume change is too small to show.

    The strain of the surface is then that of the section, too.
    """
    point = MaterialPoint.from_law(LAW, 1e8)
    bar = Bar(imperfection=0.0, elements=(24, 1), half_length=20.0, largest_step=0.005, centre_strain=0.04)
    section, surface = (pull("bar", point, bar, Loading(grip_speed=0.04), strain) for strain in ("section", "surface"))
    np.testing.assert_allclose(section.true_stress, section.uniaxial_stress, atol=1e-4)
    np.testing.assert_allclose(surface.true_strain, section.true_strain, atol=1e-6)
    np.testing.assert_allclose(section.triaxiality, 1.0 / 3.0, atol=1e-6)


def test_in_a_neck_the_section_carries_more_than_the_law_in_one_dimension_about_as_bridgman_says():
    point = MaterialPoint.from_law(LAW, 64400.0)
    necked = pull("bar", point, Bar(**COARSE, centre_strain=1.2), Loading(grip_speed=0.08))
    relative = necked.gap[-1] / necked.uniaxial_stress[-1]
    assert relative == pytest.approx(necked.bridgman[-1] - 1.0, rel=0.4)
    assert 0.03 < relative < 0.08
    assert necked.triaxiality[-1] > 0.4
    assert 0.0 < necked.volume_change[-1] < 1e-3
    assert np.abs(necked.corrected().gap).max() < 0.5 * np.abs(necked.gap).max()


def test_bridgmans_factor_of_a_neck_as_sharp_as_its_radius():
    """a/R = 1: 3 ln 1.5; a straight outline: 1."""
    np.testing.assert_allclose(bridgman_factor(np.array([1.0, 0.0])), [3.0 * np.log(1.5), 1.0], rtol=1e-6)


def test_a_video_extensometer_keeps_the_strain_rate_of_a_necking_centre():
    necking = neck(MaterialPoint.from_law(LAW, 64400.0), Bar(**COARSE, centre_strain=1.0), centre_rate=0.005)
    np.testing.assert_allclose(necking.centre_strain[10:], 0.005 * necking.time[10:], atol=0.01)
    moving = np.gradient(necking.nominal_strain, necking.time)
    assert moving[-1] < 0.5 * moving[10]


def test_a_point_at_constant_rate_is_the_closed_form_of_a_ramp():
    """Eq. (7), to the error of the increments."""
    point = MaterialPoint.from_law(LAW, 1e4)
    made = constant_rate_point("experiment-1", point, 0.005, 1.8, 0.005)
    tau_max = float(RELATION.relaxation_time([0.005])[0])
    ramp = probation.Law(unrelaxed_modulus=3220.0, tau_max=tau_max, hardening_modulus=1.8)
    expected = probation.ramp_stress(ramp, 0.005, made.time)
    np.testing.assert_allclose(made.true_stress, expected, atol=0.02)


def test_a_recording_adds_the_noise_that_it_says_and_repeats_itself():
    made = constant_rate_point("experiment-1", MaterialPoint.from_law(LAW, 1e4), 0.005, 1.8)
    clean, noisy, again, other = (
        Recording(samples=2001, stress_noise=noise, strain_noise=1e-2 * noise, seed=seed).record(made)
        for noise, seed in ((0.0, 0), (0.05, 0), (0.05, 0), (0.05, 1))
    )
    assert (noisy.true_stress - clean.true_stress).std() == pytest.approx(0.05, rel=0.1)
    assert (noisy.true_strain - clean.true_strain).std() == pytest.approx(5e-4, rel=0.1)
    np.testing.assert_array_equal(noisy.true_stress, again.true_stress)
    assert np.abs(noisy.true_stress - other.true_stress).max() > 0.01


def test_the_control_has_the_strains_of_the_bar_and_the_stress_of_one_dimension():
    bar = Bar(**{**COARSE, "centre_strain": 0.1})
    specimen = make_specimen(LAW, MaterialPoint.from_law(LAW, 64400.0), bar, first="bar")
    exact = Recording(stress_noise=0.0, strain_noise=0.0)
    neck_campaign, control = specimen.campaign(exact), specimen.uniaxial_campaign(exact)
    for record, other, made in zip(neck_campaign.records, control.records, specimen.experiments, strict=True):
        np.testing.assert_array_equal(record.true_strain, other.true_strain)
        np.testing.assert_allclose(other.true_stress[-1], made.uniaxial_stress[-1], rtol=1e-12)
    assert [record.control for record in control.records] == ["strain-rate"] + 2 * ["displacement-rate"]
    assert control.law.companion.parameters == {"slope": 0.00464, "intercept": 0.0367}


def test_the_command_leaves_campaigns_and_reports_the_triaxiality_gap(tmp_path, capsys):
    """To a small strain, where a coarse bar takes seconds and there is hardly a neck."""
    coarse = ["--elements", "4", "1", "--largest-step", "0.03", "--largest-centre-step", "0.1", "--samples", "60"]
    options = [*coarse, "--centre-strain", "0.3", "--noise", "0.5", "--no-control"]
    assert main(["--out", str(tmp_path), *options, "--plot", str(tmp_path / "s.png")]) == 0
    printed = capsys.readouterr().out
    assert "triaxiality" in printed
    assert "The law is" in printed
    assert "volume_change" in printed
    campaign = probation.Campaign.load(tmp_path / "neck")
    assert [record.control for record in campaign.records] == ["strain-rate"] + 2 * ["displacement-rate"]
    answer = json.loads((tmp_path / "specimen.json").read_text())
    assert answer["schema"] == "probation.specimen/1"
    assert answer["known"]["experiment-3"]["largest_triaxiality"] >= 1.0 / 3.0
    assert set(answer["neck"]) == {"certificate", "diagnosis"}
    assert answer["control"] is None
    assert (tmp_path / "s.png").stat().st_size > 5000


@pytest.mark.parametrize(
    ("options", "named"),
    [(["--noise", "-1"], "stress_noise"), (["--radius", "0"], "radius"), (["--samples", "3"], "samples")],
)
def test_what_cannot_be_is_named_in_one_line(tmp_path, capsys, options, named):
    assert main(["--out", str(tmp_path), *options]) == 2
    assert named in capsys.readouterr().err
