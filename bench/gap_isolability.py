"""How near is what the isolability matrix predicts to full refits of the rival, and how long does it take?

`python -m bench.gap_isolability`: about a minute. Two ramps, noise 1 MPa; forty pairs below 60 degrees drawn at
random. The effect is there at its usual size, without noise; the rival is fitted with all base and nonlinear parameters
free, from several starts, by scipy. What is left is compared with sqrt(lambda) sin(angle).
"""

from __future__ import annotations

import time

import numpy as np
from scipy.optimize import least_squares
from tests.campaigns.gap_noise import campaign

import probation
from probation.design.isolability import isolability
from probation.design.next_test import next_test
from probation.design.planned_record import white_noise
from probation.effects.cause import cause
from probation.effects.record_view import views_of
from probation.effects.registry import effect, effects
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.records.record import Record

PAIRS = 40
LAW = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)


def model_of(names=None):
    """Records of the made-up campaign of six."""
    records = [
        Record(id=test.name, time=test.time, true_strain=test.strain, true_stress=test.stress)
        for test in campaign()
        if names is None or test.name in names
    ]
    return CampaignModel(DnlrLaw(LAW), views_of(probation.Campaign(name="six", records=tuple(records))))


def nearest(model, truth, rival):
    """Distance [MPa, root of the sum of squares] that the best of all fits of the rival leaves."""
    best = np.inf
    for form in rival.forms:
        if "all" not in rival.placements(form):
            continue
        extended = model.with_causes([cause(rival, form)])
        lower, upper = extended.bounds
        scale = np.append(np.abs(model.start), np.maximum(np.abs(form.typical), 1e-6))
        signs = (1.0,) if 0.0 in (form.amplitude.lower, form.amplitude.upper) else (1.0, -1.0)
        for nonlinear in form.nonlinear_starts(model.views)[:4]:
            for sign in signs:
                values = nonlinear if form.threshold else (0.3 * sign * form.typical[0], *nonlinear)
                start = np.clip(np.append(model.start, values), lower + 1e-12, upper - 1e-12)
                try:
                    found = least_squares(
                        lambda p, m=extended: m.residual(p) - truth,
                        start,
                        jac=lambda p, m=extended: m.jacobian(p),
                        bounds=(lower, upper),
                        x_scale=scale,
                        max_nfev=30,
                    )
                except probation.ConvergenceError:
                    continue
                best = min(best, np.sqrt(2.0 * found.cost))
    return best


def refits():
    """Print pairs with the distance predicted and the one found."""
    model = model_of(("slow", "fast"))
    found = isolability(model, model.start, white_noise(model.views, 1.0), effects())
    known = [
        (row, column)
        for row, each in enumerate(found.effects)
        for column, name in enumerate(found.names)
        if row != column and each.detectability > 5.0 and found.angle[row, column] < 60.0 and name != "grip_slip"
    ]
    np.random.default_rng(0).shuffle(known)
    ratios = []
    print(f"{'there':27}{'rival':27}{'angle':>6}{'predicted':>10}{'refitted':>10}")
    for row, column in known[:PAIRS]:
        each, rival = found.effects[row], effect(found.names[column])
        acting = cause(each.name, each.form, each.records)
        there = model.with_causes([acting])
        amplitude, *nonlinear = each.values.values()
        left = min(
            nearest(model, there.residual(there.parameters(model.start, (sign * amplitude, *nonlinear))), rival)
            for sign in ((1.0,) if each.one_sided else (1.0, -1.0))
        )
        predicted = each.detectability * np.sin(np.radians(found.angle[row, column]))
        ratios.append(left / predicted)
        print(f"{each.name:27}{rival.name:27}{found.angle[row, column]:6.1f}{predicted:10.1f}{left:10.1f}", flush=True)
    inside = np.sum((np.array(ratios) > 0.8) & (np.array(ratios) < 1.25))
    print(f"refitted over predicted: median {np.median(ratios):.2f}, {inside} of {len(ratios)} within 0.8 to 1.25")


def timings():
    """Print the times of an analysis and of a next test on six records of 1000 samples."""
    model = model_of()
    noises = white_noise(model.views, 0.04)
    known, explanations = effects(), []
    for name in ("rate_dependent_relaxation", "self_heating", "damage", "delayed_hardening"):
        extended = model.with_causes([cause(name)])
        parameters = extended.parameters(model.start, extended.causes[0].form.typical)
        explanations.append((extended, parameters, 0.25, (name,)))
    for what, run in (
        (f"isolability, 6 x 1000, {len(known)} effects", lambda: isolability(model, model.start, noises, known)),
        ("next test, 6 x 1000, 4 explanations", lambda: next_test(model, explanations, noises=noises)),
    ):
        walls, processors = [], []
        for _ in range(5):
            wall, processor = time.perf_counter(), time.process_time()
            run()
            walls.append(time.perf_counter() - wall)
            processors.append(time.process_time() - processor)
        print(f"{what}: {min(walls):.2f} s, processor time {min(processors):.2f} s (best of 5, two threads)")


if __name__ == "__main__":
    timings()
    refits()
