"""Results come back from the JSON that they wrote."""

import pytest

import probation
from probation import InputError
from probation.histories import history_from
from probation.simulation import Simulation, simulate
from probation_studies.coverage.study import TRUTH, Counted, Coverage
from probation_studies.smoothing.comparison import Comparison, compare

LAW = probation.Law(unrelaxed_modulus=900.0, tau_max=8.0, hardening_modulus=3.0)
RATE_DEPENDENT = probation.Law(
    unrelaxed_modulus=900.0,
    alpha=1.1,
    hardening_modulus=3.0,
    companion=probation.Weissenberg(0.00464, 0.0367, calibrated=(1e-4, 1e-3)),
)


@pytest.mark.parametrize(
    ("history", "law", "scheme"),
    [
        ("ramp", LAW, "be2"),
        ("rate-jump", LAW, "sa3"),
        ("creep", LAW, "be2"),
        ("ramp", RATE_DEPENDENT, "be2"),
    ],
)
def test_a_simulation_comes_back_with_its_curves(history, law, scheme):
    done = simulate(law, history_from(history), scheme)
    again = Simulation.from_json(done.to_json())
    assert again.to_json() == done.to_json()
    assert again.summary() == done.summary()
    assert again.to_csv() == done.to_csv()
    assert again.plot().axes


def test_a_comparison_of_methods_comes_back():
    done = compare(["jump"], [2e-5, 1e-3], ["raw", "spline"], draws=1)
    again = Comparison.from_json(done.to_json())
    assert again.to_json() == done.to_json()
    assert again.summary() == done.summary()
    assert again.results == done.results


@pytest.mark.parametrize("draws", [1, 3, 7, 999, 1000])
def test_a_coverage_study_comes_back_with_whole_hits(draws):
    hits = {name: draws - at for at, name in enumerate(TRUTH) if draws >= at}
    hits = dict.fromkeys(TRUTH, 0) | hits
    done = Coverage((Counted("noise", "auto", draws, hits, dict.fromkeys(TRUTH, 0.01)),), seed=4)
    assert Coverage.from_json(done.to_json()) == done


@pytest.mark.parametrize("result", [Simulation, Comparison, Coverage])
def test_another_text_is_refused_in_one_line(result):
    with pytest.raises(
        InputError, match=r"^the text: found the schema 'probation.fit/1', expected what to_json writes"
    ):
        result.from_json('{"schema": "probation.fit/1"}')
    with pytest.raises(InputError, match=r"^the text: found no JSON"):
        result.from_json("[1, 2")


def test_a_law_that_cannot_be_is_refused():
    text = simulate(LAW, history_from("ramp")).to_json()
    with pytest.raises(InputError, match="law: found no 'unknown_MPa' that is known"):
        Simulation.from_json(text.replace("unrelaxed_modulus_MPa", "unknown_MPa"))
