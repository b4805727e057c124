"""The base law on measured polymers: it runs, and says how good it is; docs/measured-records.md holds the figures."""

from pathlib import Path

import numpy as np
import pytest

from probation import Campaign, fit

DATA = Path(__file__).parents[2].parent / "shared" / "data"
pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason="the measured records are not beside the checkout")


def test_etfe_is_described_to_a_few_per_cent_and_the_bias_told():
    """Three specimens to 42 MPa; the law without companion relation leaves a wave of a few per cent of that."""
    answer = fit(
        Campaign.from_files([DATA / "etfe" / "OUTRaw_MD_CSR_01_T40.csv"], control="displacement-rate"),
        method="variable-projection",
    )
    assert len(answer.records) == 3
    assert answer.noise_MPa < 0.01
    assert 0.01 < answer.rms_MPa / 42.0 < 0.08
    assert "times the noise" in answer.verdict
    assert all("spline" in record.excitation.differentiator for record in answer.records.values())


def test_the_specimens_of_etfe_agree_on_the_hardening():
    """Same film, same test: G of each within 10 % of the others', beyond their bias-aware standard errors or not."""
    whole = Campaign.from_files([DATA / "etfe" / "OUTRaw_MD_CSR_01_T40.csv"], control="displacement-rate")
    moduli = [
        fit(Campaign(record.id, (record,)), method="variable-projection").law.hardening_modulus
        for record in whole.records
    ]
    assert np.ptp(moduli) < 0.1 * np.mean(moduli)


def test_vhb_at_three_rates_finds_the_turn_of_every_record():
    files = [DATA / "vhb4910" / f"{name}.csv" for name in ("0d03_2d0_1", "0d03_3d0", "0d05_3d0")]
    answer = fit(Campaign.from_files(files, control="displacement-rate"), method="variable-projection")
    for record in answer.records.values():
        assert len(record.excitation.jumps) == 1
        top = record.time[np.argmax(record.true_strain)]
        assert abs(record.time[record.excitation.jumps[0]] - top) < 0.2
    assert answer.parameters["hardening_modulus"].status == "identifiable"
    assert answer.rms_MPa < 0.02
