"""The industrial laboratory: its own integration of the law, plausible campaigns, causes that do what they say."""

import json

import numpy as np
import pytest

import probation
from probation.effects.registry import effects
from probation_studies.blind.laboratories import industry
from probation_studies.blind.laboratories.industry.bench import BenchTest, Law, Programme, Scales, base_stress
from probation_studies.blind.laboratories.industry.causes import CATALOGUE, CAUSES, effect
from probation_studies.blind.laboratories.industry.instruments import Instruments
from probation_studies.blind.laboratories.industry.known_causes import Errors, RecordAsTested, left_when_told
from probation_studies.blind.laboratories.industry.oracle import beats
from probation_studies.blind.laboratories.industry.sight import Acting, Sight, residual, view_of

CORNERS, TRAVEL = [0.0, 100.0, 150.0, 250.0, 320.0, 420.0], [0.0, 0.2, 0.2, 0.4, 0.36, 0.8]
TIME = np.unique(np.concatenate([np.linspace(0.0, 420.0, 200), CORNERS]))
PROGRAMME = Programme(TIME, np.interp(TIME, CORNERS, TRAVEL), (0.0, 100.0, 150.0, 250.0, 320.0), 2)
LAW, SCALES = Law(2000.0, 5.0, 2.0), Scales(float(np.log(1.8)), 14.7, 8.2, 2e-3, 420.0)


@pytest.mark.parametrize("companion", [None, (0.004, 0.04)])
def test_its_integral_of_the_law_agrees_with_the_library(companion):
    """Within 1e-4 of the largest stress, holds and unloading included (a companion has no rate in a hold)."""
    time = TIME if companion is None else np.linspace(0.0, 420.0, 300)
    travel = np.interp(time, CORNERS, TRAVEL) if companion is None else np.interp(time, [0, 200, 420], [0, 0.1, 0.8])
    found = base_stress(
        Programme(time, travel, (0.0,), 0),
        Law(2000.0, 5.0 if companion is None else 1.1, 2.0, companion),
        SCALES,
        travel,
    )
    given = {"tau_max": 5.0} if companion is None else {"alpha": 1.1, "companion": probation.Weissenberg(*companion)}
    law = probation.Law(unrelaxed_modulus=2000.0, hardening_modulus=2.0, **given)
    expected = law.stress(time, np.log1p(travel), scheme="exact")
    assert np.abs(found - expected).max() < 1e-4 * expected.max()


@pytest.mark.parametrize("name", CAUSES)
def test_every_form_vanishes_with_its_amplitude_and_is_finite_at_its_largest(name):
    assert len(CAUSES[name].forms) >= 2
    for form in CAUSES[name].forms:
        shape = {key: float(np.sqrt(low * high)) for key, (low, high) in form.shape.items()}
        size = [
            np.abs(residual(PROGRAMME, LAW, SCALES, [Acting(name, form, part * form.largest, shape)])).max()
            for part in (1e-4, 1e-2, 1.0)
        ]
        assert np.all(np.isfinite(size)), form.name
        assert size[0] < 0.05 * size[2], form.name
        assert 0.03 < size[2] < 120.0, form.name  # MPa, of 15


def test_a_hold_relaxes_further_after_what_flows_faster():
    """Ree & Eyring: stress shortens the relaxation, so that the stress of the ramp is lower."""
    slow, fast = BenchTest(PROGRAMME, LAW, SCALES), BenchTest(PROGRAMME, LAW, SCALES)
    form = CAUSES["activated_flow"].forms[0]
    form.act(fast, 2.0, {"second": 0.3, "volumes": 2.0})
    assert fast.run()[1].max() < 0.95 * slow.run()[1].max()


@pytest.mark.parametrize("stratum", industry.STRATA)
def test_a_campaign_of_each_stratum_reads_and_is_plausible(stratum, tmp_path):
    made = industry.make(11, 4, "develop", stratum)
    truth = json.loads(made.truth.to_json())
    campaign = probation.Campaign.load(made.write(tmp_path / "campaign"))
    assert len(campaign.records) == len(truth["records"])
    assert {name: each["samples"] for name, each in truth["records"].items()} == {
        each.id: len(each.time) for each in campaign.records
    }
    for record in campaign.records:
        assert np.all(np.diff(record.time) > 0.0)
        assert 0.3 < np.max(record.true_stress) < 600.0
    assert truth["stratum"] == stratum
    assert len(truth["causes"]) == {"single": 1, "pair": 2, "outside": 1}.get(stratum, 0)
    assert truth["explanation"] == sorted(each["effect"] for each in truth["causes"])
    assert (truth["detectability"] > 1.5) == bool(truth["causes"])
    assert 0.0 <= truth["oracle"]["right"] <= 1.0
    assert truth["sampling_detectability"] < 1.5
    text = (tmp_path / "campaign" / "campaign.toml").read_text()
    assert ('scatter = "none"' in text) == (not truth["noise"]["replicates"])
    assert not any(each["kind"] in text for each in truth["causes"])  # nothing of the truth


def _slower(factor):
    return Programme(TIME * factor, PROGRAMME.travel, tuple(corner * factor for corner in PROGRAMME.corners), 2)


def test_what_a_refit_takes_up_is_left_in_no_record_and_a_held_out_specimen_is_not_known():
    """Of the held-out record its specimen's response to its deviations is left."""
    programmes = [PROGRAMME, _slower(2.0), _slower(4.0)]
    sight = Sight(programmes[:2], LAW, SCALES, Instruments(0.02, 0.002, 1e-4, 1e-5, 1e-6), (0.03, 0.03, 0.03, 0.01))
    form = CAUSES["network_locking"].forms[0]
    shape = {key: float(np.sqrt(low * high)) for key, (low, high) in form.shape.items()}
    acting = Acting("network_locking", form, 0.3 * form.largest, shape)
    records, own = [], np.array([0.02, 0.0, 0.0, 0.01])
    for k, programme in enumerate(programmes):
        view = view_of(programme)
        tangents = sight.tangents(view)
        error = tangents[:, :3] @ [0.01, -0.02, 0.03] + 0.2 * residual(view.thin, LAW, SCALES, [acting])
        errors = Errors(view.at_samples(error[:, None])[:, 0], np.zeros(len(programme.time)), own * (k == 2))
        records.append(RecordAsTested(programme, k == 2, (acting,), errors))
    *left, held_out = left_when_told(sight, records)
    assert max(left) < 1e-6
    expected = view_of(programmes[2]).at_samples(sight.tangents(view_of(programmes[2]))) @ own
    assert held_out == pytest.approx(np.sqrt(np.mean(expected**2)), rel=1e-6)


def test_a_truth_says_what_a_told_refit_leaves_of_every_record():
    """Specimens alike: the noise of the force over the true section, little more or less; held out, too."""
    truth = json.loads(industry.make(11, 9, "develop", "single").truth.to_json())
    left = truth["left_when_told_MPa"]
    assert {each["role"] for each in truth["records"].values()} == {"identify", "held-out"}
    assert left.keys() == truth["records"].keys()
    assert [left[name] for name in truth["noise_MPa"]] == pytest.approx(list(truth["noise_MPa"].values()), rel=0.05)


def test_a_campaign_is_the_same_for_the_same_arguments():
    one, other = (industry.make(11, 5, "develop", "none") for _ in range(2))
    assert one.truth.to_json() == other.truth.to_json()
    assert all(np.array_equal(a.stress, b.stress) for a, b in zip(one.records, other.records, strict=True))
    assert industry.make(12, 5, "develop", "none").truth.to_json() != one.truth.to_json()


def test_the_catalogue_has_the_names_that_causes_are_mapped_to():
    names = {each.name for each in effects()}
    assert set(CATALOGUE) <= set(CAUSES)
    assert set(CATALOGUE.values()) <= names
    assert sum(effect(name) == "unknown" for name in CAUSES) >= 3


def test_an_extensometer_on_the_specimen_sees_nothing_of_the_frame():
    for name in ("frame_compliance", "slack", "grip_slip"):
        assert CAUSES[name].forms_seen(clip_on=True) == ()
        assert CAUSES[name].forms_seen(clip_on=False) == CAUSES[name].forms
    assert [form.name for form in CAUSES["machine_vibration"].forms_seen(clip_on=True)] == ["den Hartog 1934"]


@pytest.mark.parametrize(("size", "degrees"), [(2.8, 90.0), (6.4, 30.0), (18.9, 10.0)])
def test_two_causes_are_discriminated_in_95_percent_at_the_published_sizes(size, degrees):
    assert beats(size, float(np.cos(np.radians(degrees)))) == pytest.approx(0.95, abs=0.005)
