"""One of every kind of result that says something to people, computed in a second or put together by hand."""

from dataclasses import replace
from functools import cache

import numpy as np

import probation
from campaigns import made_up_diagnosis as made_up
from campaigns.few_records import LAW, NOISE, few_records
from probation import Campaign, Record
from probation.diagnosis.isolability import campaign_isolability
from probation.histories import named_history
from probation.published.experiments import twin_campaign
from probation.smoothing.answer import describe_excitation
from probation_studies.coverage.study import CASES, study
from probation_studies.paper.relations import RATE_TABLE
from probation_studies.smoothing.comparison import compare as compare_methods
from probation_studies.smoothing.known_histories import KNOWN_HISTORIES


def ramps():
    """Three rates, at which tau_max is 20 s, 10 s and 4 s."""
    records = []
    for rate, tau_max in ((1e-3, 20.0), (2e-3, 10.0), (5e-3, 4.0)):
        time = np.linspace(0.0, 1.0 / rate, 120)
        stress = replace(LAW, tau_max=tau_max).stress(time, rate * time, scheme="exact")
        noisy = stress + NOISE * np.random.default_rng(3).standard_normal(len(time))
        records.append(Record(f"ramp-{rate:g}", time, rate * time, noisy, control="strain-rate"))
    return Campaign("ramps", tuple(records))


def necking():
    """A specimen that necks, strain noise 1e-3."""
    known = KNOWN_HISTORIES["necking"][1](np.random.default_rng(1))
    strain = known.true_strain[::3] + 1e-3 * np.random.default_rng(2).normal(size=501)
    return Record("grips", known.time[::3], strain, np.zeros(501), control="displacement-rate")


@cache
def result(name):
    makers = {
        "fit": lambda: probation.fit(few_records()),
        "fit with profiles": lambda: probation.fit(few_records(), intervals="profile"),
        "fit with a companion relation": lambda: probation.fit(replace(twin_campaign((1,)), name="\u202etwins\x1b")),
        "certificate": lambda: probation.certify(twin_campaign((1,), held_out=(2,)), "sa2"),
        "diagnosis": lambda: probation.diagnose(few_records(), effects=["force_offset", "damage"], threads=1),
        "made-up diagnosis": made_up.self_heating,
        "diagnosis without a gap": made_up.no_gap,
        "diagnosis with everything": made_up.with_everything,
        "calibration on a table": lambda: probation.calibrate_companion(RATE_TABLE),
        "calibration on ramps": lambda: probation.calibrate_companion(ramps()),
        "calibration through the law": lambda: probation.calibrate_companion(ramps(), route="direct", form="power"),
        "comparison": lambda: probation.compare(few_records(), few_records(seed=2), effects=["force_offset"]),
        "isolability": lambda: campaign_isolability(few_records(), effects=["force_offset", "damage"], threads=1),
        "plan": lambda: probation.plan(LAW, {"ramp": named_history("ramp")}, noise=0.04, effects=["damage"]),
        "export of the whole law": lambda: probation.export(LAW, "abaqus-umat"),
        "export of a linear part with fewer modes": lambda: probation.export(LAW, "ansys-prony", accuracy=1e-2),
        "export of flow curves": lambda: probation.export(LAW, "abaqus-plastic", rates=(1e-3, 1e-2)),
        "excitation": lambda: describe_excitation([*few_records().records, necking()], source="three tests"),
        "excitation by the two steps of the paper": lambda: describe_excitation([necking()], "necking"),
        "coverage": lambda: study(2, cases=CASES[:1], methods=("plain", "auto")),
        "comparison of methods": lambda: compare_methods(["jump"], [2e-5, 1e-3], ["raw", "spline"], draws=1),
        "cross-check": lambda: probation.crosscheck([few_records().records[0]], LAW),
    }
    return makers[name]()


NAMES = (
    "fit",
    "fit with profiles",
    "fit with a companion relation",
    "certificate",
    "diagnosis",
    "made-up diagnosis",
    "diagnosis without a gap",
    "diagnosis with everything",
    "calibration on a table",
    "calibration on ramps",
    "calibration through the law",
    "comparison",
    "isolability",
    "plan",
    "cross-check",
)

FURTHER = (
    "excitation",
    "excitation by the two steps of the paper",
    "export of the whole law",
    "export of a linear part with fewer modes",
    "export of flow curves",
    "coverage",
    "comparison of methods",
)
"""Those that have no page, or whose pages are tested with others of their kind."""
