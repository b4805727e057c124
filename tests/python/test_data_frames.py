"""Records and results as data frames of pandas, and datasets of xarray."""

from functools import cache

import numpy as np
import pytest

import probation
from campaigns import made_up_diagnosis as made_up
from campaigns.few_records import LAW, few_records
from probation import Campaign, Fit, InputError
from probation.histories import named_history


@cache
def fit():
    return probation.fit(few_records(names=("slow", "middle")), hold={"tau_max_s": 5.2})


def test_a_campaign_goes_to_a_data_frame_and_back():
    campaign = few_records()
    frame = campaign.to_dataframe()
    assert list(frame.columns) == ["record", "time_s", "true_strain", "true_stress_MPa"]
    again = Campaign.from_dataframe(frame, record="record", noise=campaign.records[0].noise)
    for old, new in zip(campaign.records, again.records, strict=True):
        assert new.id == old.id
        assert new.samples_sha256 == old.samples_sha256


def test_a_record_has_axes_and_optional_columns():
    time = np.linspace(0.0, 10.0, 12)
    record = probation.Record("r", time, 0.01 * time, time, temperature=20.0 + time)
    assert list(record.to_dataframe().columns) == ["time_s", "true_strain", "true_stress_MPa", "temperature_C"]
    assert record.to_xarray()["temperature_C"].sel(time_s=10.0) == 30.0


def test_the_curves_of_a_fit_are_a_row_a_sample():
    frame = fit().to_dataframe()
    assert len(frame) == 300
    of_slow = frame[frame["record"] == "slow"]
    assert np.sqrt(np.mean(of_slow["residual_MPa"] ** 2)) == pytest.approx(fit().records["slow"].rms_MPa)
    with pytest.raises(InputError, match="found no curves"):
        Fit.from_json(fit().to_json()).to_dataframe()


def test_the_parameters_of_a_fit_are_a_row_each():
    frame = fit().to_dataframe("parameters").set_index("parameter")
    assert frame.loc["tau_max_s", "status"] == "held"
    assert frame.loc["hardening_modulus_MPa", "se"] == fit().parameters["hardening_modulus"].se
    with pytest.raises(InputError, match="what is 'errors'; expected one of curves, parameters"):
        fit().to_dataframe("errors")


def test_causes_and_regions_of_a_diagnosis_are_a_row_each():
    found = made_up.self_heating()
    causes = found.to_dataframe()
    assert causes["probability"].sum() == pytest.approx(1.0)
    assert list(causes[causes["in_answer_set"]]["effects"]) == [" + ".join(each) for each in found.answer_set]
    assert list(found.to_dataframe("where")["share"]) == [each.share for each in found.located]
    curves = found.to_dataframe("curves")
    assert set(curves["record"]) == set(found.curves)


def test_where_there_is_no_gap_the_regions_have_columns_all_the_same():
    frame = made_up.no_gap().to_dataframe("where")
    assert len(frame) == 0
    assert "p_value" in frame.columns


def test_a_simulation_has_the_columns_of_its_file():
    found = probation.simulate(LAW, named_history("ramp"))
    assert ",".join(found.to_dataframe().columns) == found.to_csv().splitlines()[0]


def test_a_fit_has_the_axes_sample_and_parameter():
    curves = fit().to_xarray()
    assert curves["residual_MPa"].dims == ("sample",)
    of_slow = curves.where(curves["record"] == "slow", drop=True)
    slow = fit().records["slow"]
    np.testing.assert_array_equal(of_slow["time_s"], slow.time)
    np.testing.assert_array_equal(of_slow["model_stress_MPa"], slow.model_stress)
    along_tau = of_slow["sensitivity_MPa"].sel(parameter="tau_max_s")
    np.testing.assert_array_equal(along_tau, slow.sensitivity[:, 1])
    with pytest.raises(InputError, match="found no curves"):
        Fit.from_json(fit().to_json()).to_xarray()


@pytest.mark.parametrize("found", [made_up.self_heating, made_up.no_gap])
def test_the_curves_of_a_diagnosis_are_a_sample_each(found):
    curves, frame = found().to_xarray(), found().to_dataframe("curves")
    for name in ("record", "time_s", "base_stress_MPa", "explained_stress_MPa"):
        np.testing.assert_array_equal(curves[name], frame[name])


def test_a_simulation_is_over_time():
    found = probation.simulate(LAW, named_history("ramp"))
    np.testing.assert_array_equal(found.to_xarray()["true_stress_MPa"].sel(time_s=found.time), found.true_stress)
