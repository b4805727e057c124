"""The diagnosis on measured polymers: it runs, and is honest; docs/measured-diagnoses.md holds the figures."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from bench import measured_cases

from campaigns import measured
from probation import Campaign, Reference, Specimens, compare, diagnose
from probation.diagnosis import attribution, trust
from probation.settings.calibrated import CALIBRATED
from probation_studies.blind.inject import Injection

DATA = Path(__file__).parents[2].parent / "shared" / "data"
pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason="the measured records are not beside the checkout")

RATE = "rate_dependent_relaxation"
HARDENING = "rate_dependent_hardening"


def thinned(record, every, samples=None, role="identify"):
    return replace(record.only(slice(0, samples, every)), role=role)


def test_of_known_effects_rate_dependent_relaxation_comes_first_in_etfe_and_none_is_certain():
    """One temperature, one speed: the true rate changes twofold along the test, and the law without relation minds.

    One speed cannot say which effect it is: an unknown stays open, and so does a saturation of the force.
    """
    whole = Campaign.from_files([DATA / "etfe" / "OUTRaw_MD_CSR_01_T40.csv"], control="displacement-rate")
    found = diagnose(whole, design=False)
    assert found.gap.rejected
    assert found.verdict == "unexplained"
    assert RATE in found.best.effects
    chances = {each.name: each.probability for each in found.effects if each.name != "unknown"}
    assert max(chances, key=chances.get) == RATE
    assert chances[RATE] > 0.5
    assert found.shrink.identify.after_MPa < 0.2 * found.shrink.identify.before_MPa
    assert found.best.probability < 0.9
    assert "rate-dependent relaxation" in found.headline
    assert sum(each.probability for each in found.explanations) == pytest.approx(1.0)


def test_neither_rate_effect_alone_describes_vhb_down_to_its_noise():
    """Loading only, two rates fitted, the middle one predicted; the law is hundreds of times the noise away."""
    files = [DATA / "vhb4910" / f"{name}.csv" for name in ("0d01_3d0", "0d03_3d0", "0d05_3d0")]
    whole = Campaign.from_files(files, control="displacement-rate")
    records = []
    for each in whole.records:
        role = "held-out" if each.id == "0d03_3d0" else "identify"
        records.append(thinned(each, 40, int(np.argmax(each.true_strain)) + 1, role))
    found = diagnose(
        replace(whole, records=tuple(records), specimens=Specimens("none")), effects=[RATE, HARDENING], design=False
    )
    assert found.verdict == "unexplained"
    assert set(found.best.effects) <= {RATE, HARDENING, "unknown"}
    assert found.shrink.identify.before_MPa > 20 * found.noise_MPa
    assert found.shrink.identify.after_MPa < found.shrink.identify.before_MPa
    assert found.shrink.held_out is not None


def two_rates_of_vhb(effects):
    files = [DATA / "vhb4910" / f"{name}.csv" for name in ("0d01_3d0", "0d05_3d0")]
    whole = Campaign.from_files(files, control="displacement-rate")
    records = tuple(thinned(each, 10, int(np.argmax(each.true_strain)) + 1) for each in whole.records)
    return diagnose(replace(whole, records=records, specimens=Specimens("none")), effects=effects, design=False)


def test_what_leaves_nine_times_the_noise_may_be_part_of_a_gap_and_does_not_explain_it():
    """Only hardening and flow to explain two rates: their forms' errors hide what is left."""
    found = two_rates_of_vhb((HARDENING, "stress_activated_flow"))
    assert found.verdict == "unexplained"
    assert found.shrink.identify.after_MPa > 4.0 * found.noise_MPa
    assert found.shrink.effects == (HARDENING,)
    assert "rate-dependent hardening may be part of it" in found.headline
    assert "more than noise is left" in found.headline


def test_hardening_and_a_published_spectrum_describe_two_rates_of_vhb_nearly_down_to_the_noise(monkeypatch):
    """1.6 times the noise are left of 53; the power of tau alone leaves five times it.

    With as good odds for two effects as for one. With those of laboratories either leads, by the last digits of a sum.
    """
    monkeypatch.setattr(trust, "CALIBRATED", replace(CALIBRATED, odds_of_two=1.0))
    found = two_rates_of_vhb((HARDENING, "spectrum_shape"))
    assert found.best.effects == (HARDENING, "spectrum_shape")
    assert found.shrink.identify.closure > 0.999
    assert found.shrink.identify.after_MPa < 2.0 * found.noise_MPa


def test_effects_that_leave_many_times_less_together_are_all_named(monkeypatch):
    """As the noise weighs it a slow process closes 99 % alone; in MPa it leaves 17 times what damage and it leave.

    Also where it is not certain that both act.
    """
    monkeypatch.setattr(attribution, "_probability_within", lambda effects, weighed: 0.5)
    files = [DATA / "vhb4910" / f"{name}.csv" for name in ("0d03_3d0", "0d05_3d0")]
    whole = Campaign.from_files(files, control="displacement-rate")
    records = tuple(thinned(each, 10, int(np.argmax(each.true_strain)) + 1) for each in whole.records)
    found = diagnose(replace(whole, records=records), effects=("slow_process", "damage"), design=False)
    assert found.best.effects == ("damage", "slow_process")
    assert {each.name for each in found.effects if each.named} == {"damage", "slow_process"}
    assert f"to {found.shrink.identify.after_MPa:.3g} MPa" in found.headline
    assert found.shrink.identify.after_MPa < 0.1 * found.shrink.identify.before_MPa


def test_the_back_stress_of_a_steel_is_named_with_a_size_that_no_polymer_has():
    """S355, strain cycles; Voce's law has none."""
    law = measured_cases.isotropic_metal(measured_cases.MODULUS_OF_STEEL)
    found = diagnose(measured_cases.cycles_of_steel(), law=law, design=False)
    assert found.effects[0].name == "back_stress"
    assert found.best.effects == ("back_stress",)
    assert found.best.parameters[0].value > 100.0
    assert found.shrink.identify.closure > 0.85


def test_a_gain_put_into_vhb_is_named_without_a_slack_that_closes_next_to_nothing():
    """A slack of 0.0004 in all records gains evidence, and adds less than a hundredth of the gap."""
    before = measured.measured("vhb")
    name = before.records[0].id
    after = measured.injected(before, Injection(name, "force_gain", -0.4, 1))
    found = compare(after, Reference.of(before), threads=1)
    assert found.headline.startswith(f"Since vhb: force gain in {name} (probability > 99 %): gain_error = -0.4 (95 %: ")
    assert "strain offset" not in found.headline
    assert found.best.parameters[0].value == pytest.approx(-0.4, abs=0.01)
