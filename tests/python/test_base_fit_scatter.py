"""The law's parameters once specimens may differ."""

import numpy as np
import pytest
from bench import waiting

import probation
import probation.inference.base_fit as base_fit_module
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.law.settings import CompanionSettings, LawSettings

TRUTH = np.array([1700.0, 25.0, 0.9])


def replicates(seed):
    """Three specimens at each of two rates, to a strain of 0.25, where a few per cent of E_u outweigh the network."""
    random = np.random.default_rng(seed)
    records = []
    for rate in (5e-4, 5e-3):
        time = np.linspace(0.0, 0.25 / rate, 240)
        for specimen in "abc":
            values = TRUTH * (1.0 + np.array([0.04, 0.04, 0.03]) * random.standard_normal(3))
            law = probation.Law(unrelaxed_modulus=values[0], tau_max=values[1], hardening_modulus=values[2])
            stress = law.stress(time, rate * time, "sa2") * (1.0 + 0.01 * random.standard_normal())
            stress += 0.015 * random.standard_normal(len(time))
            name = f"{rate:g}-{specimen}"
            records.append(probation.Record(id=name, time=time, true_strain=rate * time, true_stress=stress))
    return probation.Campaign(name="replicates", records=tuple(records))


@pytest.mark.parametrize("seed", range(3))
def test_specimens_that_differ_do_not_keep_a_soft_network_wrong(seed):
    """As if specimens were alike, G takes up the scatter of E_u and is far off; with the scatter it comes back."""
    campaign = replicates(seed)
    base = base_fit(campaign, plain_fit(campaign, "sa3", None))
    assert base.scatter.source == "replicates"
    assert base.parameters[2] == pytest.approx(TRUTH[2], rel=0.15)


def test_specimens_that_hold_the_gap_are_given_up_after_the_first_turn_of_noise_and_parameters(monkeypatch):
    """Two effects of twice their usual size: what is left of six records is no scatter of what is tested. E_u would
    be 4600 to 5000 MPa, by machine, in place of 3093; the parameters are those of specimens that are alike."""
    found = []

    def counted(model, parameters, residuals, noises):
        found.append([])
        for turn in turns(model, parameters, residuals, noises):
            found[-1].append(turn[0].parameters)
            yield turn

    turns = base_fit_module._turns
    monkeypatch.setattr(base_fit_module, "_turns", counted)
    campaign = waiting.campaign(*waiting.DIAGNOSED["strong gap"])
    base = base_fit(campaign, plain_fit(campaign, "sa3", None))
    alike, scattered = found
    assert base.scatter.any
    assert len(scattered) == 1 < len(alike)
    assert scattered[0][0] > 1.3 * alike[-1][0]
    np.testing.assert_array_equal(base.parameters, alike[-1])


def bulging():
    """Three rates and a neck whose section grows by 8 % per strain beyond 0.2, which no specimen explains."""
    random = np.random.default_rng(0)
    relation = {"slope": 0.00464, "intercept": 0.0367}
    companion = probation.Weissenberg(**relation)
    law = probation.Law(unrelaxed_modulus=3100.0, alpha=1.05, hardening_modulus=1.9, companion=companion)
    records = []
    for name, rate in (("slow", 1e-3), ("middle", 5e-3), ("fast", 1e-2), ("neck", 0.0)):
        time = np.linspace(0.0, 1.3 / rate if rate else 225.0, 500)
        strain = rate * time if rate else 1.78 / (1.0 + np.exp(-(time - 100.0) / 14.0))
        strain -= strain[0]
        stress = law.stress(time, strain, "sa2") * np.exp(0.08 * np.maximum(strain - 0.2, 0.0))
        stress += 0.04 * random.standard_normal(len(time))
        records.append(probation.Record(id=name, time=time, true_strain=strain, true_stress=stress))
    settings = LawSettings(companion=CompanionSettings("weissenberg", relation))
    return probation.Campaign(name="bulging", records=tuple(records), law=settings)


def test_specimens_that_explain_a_part_of_a_gap_do_not_lead_the_law_astray():
    """The law by itself misses these records by 0.2 MPa. With alpha at 0.77 it would miss them by 3.3: what is then
    left beside deviations of many standard deviations is less, as the noise weighs it, though not noise."""
    campaign = bulging()
    plain = plain_fit(campaign, "sa3", None)
    base = base_fit(campaign, plain)
    assert base.scatter.any
    assert base.parameters[1] == pytest.approx(plain.law.parameters[1], rel=0.02)
    assert base.misfit[0] == pytest.approx(0.2, rel=0.2)
