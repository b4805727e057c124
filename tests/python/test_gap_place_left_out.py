"""A fit that leaves a gap's place out shows the gap where it is, and changes nothing where there is none."""

from dataclasses import replace

import numpy as np

from campaigns import gap_noise
from probation.detection.place_left_out import place_left_out
from probation.detection.where import locate
from probation.noise.whitening import Whitened

COUNT = 400


def fitted(seed, bias):
    """Six records of white noise and a bias in the second, the parameters fitted to all."""
    blank = [np.zeros(COUNT) for _ in range(6)]
    blank[1] = bias
    records = gap_noise.records("white", np.random.default_rng(seed), COUNT, blank)
    tangent = np.vstack([record.tangent for record in records])
    step = np.linalg.lstsq(tangent, np.concatenate([record.residual for record in records]), rcond=None)[0]
    noises = Whitened.of(gap_noise.records("white", np.random.default_rng(seed), COUNT)).noises
    return Whitened.of([replace(each, residual=each.residual - each.tangent @ step) for each in records], noises)


def late(size):
    """Half a sine over the last two fifths of a record: hardening does much the same."""
    values = np.zeros(COUNT)
    values[240:] = size * np.sin(np.pi * np.arange(COUNT - 240) / (COUNT - 240))
    return values


def test_a_gap_that_the_fit_smears_over_all_records_is_shown_where_it_is():
    smeared = fitted(0, late(4.0))
    before = locate(smeared).located
    after = locate(place_left_out(smeared, before)).located
    assert len({each.record for each in before}) > 3
    assert {each.record for each in after} == {"middle"}
    assert abs(after[0].samples.start - 240) < 20
    assert sum(each.share for each in after) > 0.95


def test_what_the_fit_smeared_comes_back_at_its_full_size():
    """The peak of 4 MPa (data above the model: negative), of which the fit to all records hides a part."""
    smeared = fitted(1, late(4.0))
    shown = place_left_out(smeared, locate(smeared).located)
    peak = slice(300, 340)
    sizes = [np.abs(np.mean(each.records[1].residual[peak])) for each in (smeared, shown)]
    wanted = np.mean(late(4.0)[peak])
    assert sizes[0] < 0.97 * wanted
    assert abs(sizes[1] - wanted) < 0.01 * wanted


def test_noise_keeps_its_fit():
    quiet = fitted(2, late(0.0))
    assert place_left_out(quiet, locate(quiet).located) is quiet
