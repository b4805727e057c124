"""What crosses into the engine, in which shape, and what is said when it does not fit."""

import pickle

import numpy as np
import pytest

import probation
from probation import Modification
from probation.law.modified import UNCHANGED
from probation.law.schemes import make_solver

LAW = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5, modes=9)
TIME = np.arange(33) * 0.5
STRAIN = np.round(0.01 * TIME * 2**20) / 2**20  # exact in float32 too
STRESS = LAW.stress(TIME, STRAIN)
HISTORY = probation.StrainHistory(TIME, STRAIN)


@pytest.mark.parametrize(
    "form",
    [
        lambda x: x.astype(np.float32),
        lambda x: x.astype(">f8"),
        lambda x: x.astype(np.longdouble),
        lambda x: x.astype(object),
        list,
        tuple,
        lambda x: np.repeat(x, 2)[::2],
        lambda x: x[::-1].copy()[::-1],
        lambda x: np.asfortranarray(np.stack([x, x]))[0],
        lambda x: np.stack([x, x]).T[:, 0],
        lambda x: np.frombuffer(x.tobytes()),
        np.ma.array,
    ],
    ids=["f4", "big-endian", "long", "object", "list", "tuple", "strided", "reversed", "fortran", "column",
         "read-only", "ma"],
)  # fmt: skip
def test_the_form_of_an_array_does_not_matter(form):
    assert np.array_equal(LAW.stress(form(TIME), form(STRAIN)), STRESS)


def test_integers_and_booleans_are_numbers():
    expected = LAW.stress([0.0, 1.0, 2.0], [0.0, 1.0, 0.0])
    assert np.array_equal(LAW.stress([0, 1, 2], [False, True, False]), expected)
    assert np.array_equal(LAW.stress(np.array([0, 1, 2], np.int8), np.array([0, 1, 0], np.uint16)), expected)


def test_inputs_are_left_as_they_were():
    time, strain = TIME.copy(), STRAIN.copy()
    LAW.stress(time, strain, "sa3")
    LAW.strain_sensitivity(time, strain)
    assert np.array_equal(time, TIME)
    assert np.array_equal(strain, STRAIN)


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3", "exact", "cvode"])
@pytest.mark.parametrize(
    ("time", "strain", "message"),
    [
        (0.0, 0.0, r"time has the shape \(\); expected \(n_times,\)"),
        (np.zeros((2, 2)), np.zeros(4), r"time has the shape \(2, 2\)"),
        ([0.0, 1.0], np.zeros((2, 1)), r"true_strain has the shape \(2, 1\)"),
        ([0.0, 1.0], [0.0, 1.0, 2.0], r"true_strain has 3 samples; expected 2"),
        ([], [], r"time has 0 samples; at least 2"),
        ([0.0], [0.0], r"time has 1 samples; at least 2"),
        ([0.0, 1.0, 1.0], [0.0, 0.1, 0.2], r"time\[2\] is 1; time must increase"),
        ([0.0, 2.0, 1.0], [0.0, 0.1, 0.2], r"time\[2\] is 1; time must increase"),
        ([0.0, np.nan], [0.0, 0.1], r"time\[1\] is nan"),
        ([0.0, np.inf], [0.0, 0.1], r"time\[1\] is inf"),
        ([0.0, 1.0], [np.nan, 0.1], r"true_strain\[0\] is nan"),
        ([0.0, 1.0], [0.0, -np.inf], r"true_strain\[1\] is -inf"),
        ([0.0, 1.0], [0.0, None], r"true_strain\[1\] is nan"),
        ([0.0, 1.0], [0.0, 800.0], r"true_strain\[1\] is 800; .* is it a strain"),
        ([0.0, 1.0], [-800.0, 0.0], r"true_strain\[0\] is -800"),
        ([0.0, 1.0], [[0.0], [1.0, 2.0]], r"true_strain is not an array of numbers"),
        ([0.0, 1.0], ["a", "b"], r"true_strain holds <U1; real numbers"),
        ([0.0, 1.0], ["0", "1"], r"true_strain holds <U1; real numbers"),
        ([0.0, 1.0], [0.0, 1j], r"true_strain holds complex128; real numbers"),
        ([0.0, 10**400], [0.0, 1.0], r"time is not an array of numbers"),
        (np.array(["2020-01-01", "2020-01-02"], "datetime64[s]"), [0.0, 1.0], r"time holds datetime64"),
        ([0.0, 1.0], np.ma.array([0.0, 1.0], mask=[0, 1]), r"true_strain has masked samples"),
        (None, [0.0, 1.0], r"time has the shape \(\)"),
        ({}, [0.0, 1.0], r"time"),
    ],
)
def test_a_bad_history_is_named(scheme, time, strain, message):
    with pytest.raises(probation.InputError, match=message) as raised:
        LAW.stress(time, strain, scheme)
    assert isinstance(raised.value, ValueError)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"jumps": "all"}, r"jumps is 'all'"),
        ({"jumps": 3.0}, r"jumps has the shape \(\)"),
        ({"jumps": [99.0]}, r"jumps holds a time outside the record, 0.0 to 16.0 s"),
        ({"jumps": [np.nan]}, r"jumps\[0\] is nan"),
        ({"strain_rate": np.zeros(3)}, r"strain_rate has 3 samples; expected 33"),
        ({"strain_rate": np.full(33, np.nan)}, r"strain_rate\[0\] is nan"),
        ({"direction": np.ones(33)}, r"direction has 33 entries; expected one per step, 32"),
        ({"direction": np.full(32, np.nan)}, r"direction\[0\] is nan"),
    ],
)
def test_a_history_that_cannot_be_is_refused_when_it_is_made(options, message):
    with pytest.raises(probation.InputError, match=message):
        probation.StrainHistory(TIME, STRAIN, **options)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: LAW.stress(TIME, STRAIN, "rk4"), r"scheme is 'rk4'; expected one of be2, sa2, sa3, exact, cvode"),
        (lambda: LAW.stress(TIME, STRAIN, None), r"scheme is None"),
        (lambda: LAW.stress(TIME), r"true_strain is missing; expected time and true_strain, or a StrainHistory"),
        (lambda: LAW.stress(HISTORY, "sa3"), r"true_strain is 'sa3' together with a StrainHistory"),
        (
            lambda: LAW.strain_sensitivity(HISTORY, scheme=probation.SA3(substeps=2)),
            r"SA3\(substeps=2\); .* substeps=1",
        ),
        (lambda: LAW.sensitivity(HISTORY, scheme=probation.SA3(substeps=2), directions=[]), r"SA3\(substeps=2\)"),
    ],
)
def test_a_call_that_does_not_fit_together_is_named(call, message):
    with pytest.raises(probation.InputError, match=message):
        call()


@pytest.mark.parametrize(
    ("scheme", "options", "message"),
    [
        (probation.BE2, {"start": "euler"}, r"start is 'euler'; expected one of exponential, backward_euler"),
        (probation.SA3, {"substeps": 0}, r"substeps is 0; at least 1"),
        (probation.SA3, {"substeps": 1.5}, r"substeps is 1.5"),
        (probation.CVODE, {"relative_tolerance": 0.0}, r"relative_tolerance is 0.0; a positive number"),
        (probation.CVODE, {"relative_tolerance": np.inf}, r"relative_tolerance is inf"),
        (probation.CVODE, {"absolute_tolerance": -1.0}, r"absolute_tolerance is -1.0"),
        (probation.CVODE, {"relative_tolerance": "tight"}, r"relative_tolerance is 'tight'"),
        (probation.CVODE, {"max_steps": 0}, r"max_steps is 0; at least 1"),
        (probation.CVODE, {"max_steps": 2.5}, r"max_steps is 2.5"),
        (probation.CVODE, {"max_steps": 10**30}, r"max_steps is 1000"),
        (probation.CVODE, {"max_steps": True}, r"max_steps is True"),
    ],
)
def test_a_scheme_that_cannot_be_is_refused_when_it_is_made(scheme, options, message):
    with pytest.raises(probation.InputError, match=message):
        scheme(**options)


@pytest.mark.parametrize("name", ["be2", "sa2", "sa3", "exact", "cvode"])
def test_a_name_is_the_scheme_with_default_options(name):
    scheme = {"be2": probation.BE2, "sa2": probation.SA2, "sa3": probation.SA3, "exact": probation.Exact,
              "cvode": probation.CVODE}[name]()  # fmt: skip
    assert np.array_equal(LAW.stress(TIME, STRAIN, scheme=scheme), LAW.stress(TIME, STRAIN, name))
    assert pickle.loads(pickle.dumps(scheme)) == scheme


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"relaxation_time_factor": 0.0}, r"relaxation_time_factor\[0\] is 0; a positive"),
        ({"relaxation_time_factor": np.r_[np.ones(32), -1.0]}, r"relaxation_time_factor\[32\] is -1"),
        ({"load_bearing_area": 0.0}, r"load_bearing_area\[0\] is 0"),
        ({"unrelaxed_modulus_factor": np.r_[np.ones(32), -0.5]}, r"modulus_factor\[32\] is -0.5; .* not negative"),
        ({"extra_modulus": [2.0, -3.0], "extra_relaxation_time": [1.0, 1.0]}, r"modulus\[1\] is -3; .* not negative"),
        ({"hardening_factor": np.ones(7)}, r"hardening_factor has 7 samples; 1 or 33"),
        ({"unrelaxed_modulus_factor": np.ones((33, 1))}, r"unrelaxed_modulus_factor has the shape \(33, 1\)"),
        ({"added_relaxed_stress": np.nan}, r"added_relaxed_stress\[0\] is nan"),
        ({"initial_modal_stress": [1.0]}, r"initial_modal_stress has 1 entries; the spectrum has 9"),
        ({"initial_modal_stress": np.full(9, np.inf)}, r"initial_modal_stress\[0\] is inf"),
        ({"extra_modulus": [1.0, 2.0], "extra_relaxation_time": [1.0]}, r"2 moduli and 1 relaxation times"),
        ({"extra_modulus": [1.0], "extra_relaxation_time": [0.0]}, r"relaxation_time\[0\] is 0"),
        ({"extra_modulus": [1.0]}, r"1 moduli and 0 relaxation times"),
        ({"feedbacks": (3,)}, r"feedbacks holds 3; a StressActivation"),
    ],
)
@pytest.mark.parametrize("scheme", ["be2", "exact", "cvode"])
def test_a_bad_change_is_named(scheme, change, message):
    with pytest.raises(probation.InputError, match=message):
        LAW.stress(TIME, STRAIN, scheme, modification=Modification(**change))


# out=


@pytest.mark.parametrize("scheme", ["be2", "sa3", "exact", "cvode"])
def test_out_is_where_the_stress_goes(scheme):
    out = np.full(33, np.nan)
    assert LAW.stress(TIME, STRAIN, scheme, out=out) is out
    assert np.array_equal(out, LAW.stress(TIME, STRAIN, scheme))


def test_out_may_be_the_strain_itself():
    both = STRAIN.copy()
    LAW.stress(TIME, both, out=both)
    assert np.array_equal(both, STRESS)


def test_out_may_be_a_row_of_a_matrix():
    matrix = np.zeros((3, 33))
    LAW.stress(TIME, STRAIN, out=matrix[1])
    assert np.array_equal(matrix, [np.zeros(33), STRESS, np.zeros(33)])


def read_only():
    out = np.zeros(33)
    out.flags.writeable = False
    return out


@pytest.mark.parametrize(
    "out",
    [np.zeros(32), np.zeros((33, 1)), np.zeros(33, np.float32), np.zeros(33, ">f8"), np.zeros(66)[::2],
     read_only(), [0.0] * 33],
    ids=["length", "shape", "float32", "big-endian", "strided", "read-only", "list"],
)  # fmt: skip
def test_an_out_that_cannot_be_written_is_refused_and_left_alone(out):
    with pytest.raises(
        probation.InputError, match=r"out must be a writeable, contiguous float64 array of shape \(33,\)"
    ):
        LAW.stress(TIME, STRAIN, out=out)
    assert not np.any(out)


def test_no_directions_give_no_columns():
    stress, sensitivity = LAW.sensitivity(TIME, STRAIN, directions=[])
    np.testing.assert_allclose(stress, STRESS, rtol=1e-13, atol=1e-13)
    assert sensitivity.shape == (33, 0)


@pytest.mark.parametrize("scheme", ["exact", "cvode"])
def test_sensitivities_come_from_three_schemes_only(scheme):
    with pytest.raises(probation.InputError, match="be2, sa2 and sa3"):
        LAW.sensitivity(TIME, STRAIN, scheme)
    with pytest.raises(probation.InputError, match="be2, sa2 and sa3"):
        LAW.strain_sensitivity(TIME, STRAIN, scheme)


# Failures of the numerics


def test_a_failure_of_cvode_says_where_and_how_far():
    with pytest.raises(probation.ConvergenceError, match="CV_TOO_MUCH_WORK") as raised:
        LAW.stress(TIME, STRAIN, probation.CVODE(max_steps=1))
    assert isinstance(raised.value, RuntimeError)
    assert not isinstance(raised.value, ValueError)
    assert 0.0 < raised.value.time < TIME[1]
    assert 0.0 <= raised.value.residual_norm < 1.0


def test_an_impossible_tolerance_fails_too():
    with pytest.raises(probation.ConvergenceError, match="CV_TOO_MUCH_ACC") as raised:
        LAW.stress(TIME, STRAIN, probation.CVODE(relative_tolerance=1e-300, absolute_tolerance=1e-300))
    assert 0.0 <= raised.value.time < TIME[1]


def test_a_solver_goes_on_after_a_failure():
    solver = make_solver(probation.StrainHistory(TIME, STRAIN).engine, probation.CVODE(max_steps=1))
    out = np.empty(33)
    for _ in range(2):
        with pytest.raises(probation.ConvergenceError):
            solver.stress(LAW.engine, UNCHANGED, out)


def test_an_error_of_the_law_inside_cvode_is_the_callers():
    """Eq. (11) gives no time below 1.2e-8 1/s; the exception crosses CVODE's C unharmed."""
    companion = probation.Weissenberg(0.00464, 0.0367, rate_floor=1e-9)
    law = probation.Law(unrelaxed_modulus=1.0, hardening_modulus=1.0, companion=companion, modes=3)
    for scheme in ("be2", "exact", "cvode"):
        with pytest.raises(probation.InputError, match="rate_floor"):
            law.stress(TIME, 0.0 * STRAIN, scheme)
