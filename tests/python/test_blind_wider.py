"""The laboratory with errors as large as laboratories have them."""

import numpy as np
import pytest

import probation
from probation_studies.blind.laboratory import wider
from probation_studies.blind.laboratory.causes import AT_TEMPERATURES, KNOWN, OUTSIDE
from probation_studies.blind.laboratory.design import _chamber
from probation_studies.blind.laboratory.histories import ramp
from probation_studies.blind.laboratory.material import BaseLaw
from probation_studies.blind.laboratory.trial import Setting, Trial


def _nulls():
    return [wider.make(5, index, stratum="none") for index in range(6)]


@pytest.fixture(scope="module")
def nulls():
    return _nulls()


def _residuals(sealed):
    """Root mean squares of what the engine's law of the mean specimen leaves of the records."""
    modulus, third, hardening = sealed.truth.base.values()
    companion = None if sealed.companion is None else probation.Weissenberg(*sealed.companion)
    time = {"tau_max": third} if companion is None else {"alpha": third}
    law = probation.Law(unrelaxed_modulus=modulus, hardening_modulus=hardening, companion=companion, **time)
    return {
        record.id: float(
            np.sqrt(np.mean((record.true_stress - law.stress(record.time, record.true_strain, scheme="exact")) ** 2))
        )
        for record in sealed.records
    }


def test_residuals_of_nulls_are_as_large_as_the_covariance_says(nulls):
    """Mean squares over the levels: 1 on the average of 37 records, of which specimens make a few directions each."""
    ratios = [
        (left / sealed.truth.noise_level[name]) ** 2 for sealed in nulls for name, left in _residuals(sealed).items()
    ]
    assert 0.5 < np.mean(ratios) < 1.6
    assert np.quantile(ratios, 0.9) < 4.0


def test_what_a_specimen_has_of_its_own_is_not_counted_as_noise(nulls):
    """The noise that was drawn is what the specimen's own law leaves, not what that of the mean specimen leaves."""
    differing = [sealed for sealed in nulls if sealed.specimens_differ]
    assert differing
    for sealed in differing:
        drawn, left = sealed.truth.noise_drawn, _residuals(sealed)
        assert np.mean(list(drawn.values())) < np.mean(list(left.values()))


def test_campaigns_state_whether_specimens_are_alike(nulls, tmp_path):
    for index, sealed in enumerate(nulls):
        campaign = probation.Campaign.load(sealed.write(tmp_path / str(index)))
        assert campaign.specimens.alike != sealed.specimens_differ


def test_every_strain_is_noisy_from_its_first_sample_on(nulls):
    for sealed in nulls:
        assert 5e-6 < sealed.truth.noise["strain"] < 1e-3
        assert all(record.true_strain[0] != 0.0 for record in sealed.records)


def test_replicates_follow_one_history(nulls):
    """Some campaigns test two or three specimens alike: the same control and, to the controller's error, one strain."""
    alike = 0
    for sealed in nulls:
        first, second = sealed.records[:2]
        if sealed.specimens_differ and first.time[-1] == pytest.approx(second.time[-1], rel=1e-9):
            other = np.interp(first.time, second.time, second.true_strain)
            assert np.sqrt(np.mean((first.true_strain - other) ** 2)) < 0.02
            alike += 1
    assert alike >= 1


TEMPERATURES = "temperature_dependence"
ELSEWHERE = ("temperature_drift", "open_door", "self_heating")
"""What warms or cools a specimen: a thermometer would show it."""


@pytest.fixture(scope="module")
def dependent():
    """Three of seed 6 whose single effect it is."""
    found = [wider.make(6, index, stratum="single") for index in (12, 16, 33)]
    assert all(sealed.truth.explanation == (TEMPERATURES,) for sealed in found)
    return found


def _degrees(sealed):
    return [sealed.truth.records[record.id].get("temperature_C") for record in sealed.records]


def test_records_of_tests_at_several_temperatures_state_them_and_others_none(nulls, tmp_path):
    several = [sealed for sealed in nulls if _degrees(sealed)[0] is not None]
    assert 0 < len(several) < len(nulls)
    for index, sealed in enumerate(nulls):
        campaign = probation.Campaign.load(sealed.write(tmp_path / str(index)))
        for record, degrees in zip(campaign.records, _degrees(sealed), strict=True):
            if degrees is None:
                assert record.temperature is None
            else:
                assert record.temperature == pytest.approx(degrees, abs=1.0)


def test_what_depends_on_the_temperature_acts_in_tests_at_several(dependent):
    """The identified records stand at several, and the stress of all that are off 23 °C is another."""
    for sealed in dependent:
        degrees = dict(zip([record.id for record in sealed.records], _degrees(sealed), strict=True))
        identified = [degrees[record.id] for record in sealed.records if not record.held_out]
        assert len(set(identified)) > 1
        for name, added in sealed.truth.added_stress.items():
            assert (added > 0.0) == (degrees[name] != 23.0), name


def test_tests_of_one_history_may_stand_at_several_temperatures():
    """All records of this design repeat one history: a temperature for each history would be one for all."""
    sealed = wider.make(8, 7)
    assert sealed.records
    random = np.random.default_rng(1)
    assert len(set(_chamber(random, [ramp(1e-3, 0.5)] * 4, [0, 1, 2]))) > 1


def test_the_room_drifts_only_where_no_thermometer_shows_it():
    sealed = wider.make(8, 5, stratum="single")
    assert sealed.truth.explanation == ("temperature_drift",)
    assert _degrees(sealed) == [None] * len(sealed.records)
    for cause in (*KNOWN, *AT_TEMPERATURES, *OUTSIDE):
        shown = {several for several in (True, False) if cause.shows(_setting(temperatures=several))}
        expected = {"temperature_dependence": {True}} | {name: {False} for name in ELSEWHERE}
        assert shown == expected.get(cause.name, {True, False})


def _setting(*, temperatures):
    return Setting(
        duration=100.0,
        end_strain=0.5,
        largest_force=30.0,
        slowest=1e-4,
        fastest=1e-2,
        reference_rate=1e-3,
        sample=0.3,
        longest_time=50.0,
        unloads=True,
        temperatures=temperatures,
    )


@pytest.mark.parametrize("cause", AT_TEMPERATURES, ids=lambda cause: cause.change.__name__)
def test_nothing_depends_on_a_temperature_by_an_amount_of_zero(cause):
    time = np.linspace(0.0, 10.0, 11)
    trial = Trial(BaseLaw(1800.0, 5.0, 1.7), time, 0.01 * time, 0.0, 1e-3, degrees=50.0)
    cause.change(trial, 0.0, cause.draw(np.random.default_rng(1), _setting(temperatures=True)))
    assert np.all(trial.log_factor == 0.0)
    assert np.all(trial.modulus_factor == 1.0)
    assert np.all(trial.network_factor == 1.0)
