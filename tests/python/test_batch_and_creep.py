"""Batches against single solves; creep against the law itself."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import probation
from probation import Law, Modification, PowerLaw, Weissenberg, batch
from probation.law.creep import creep
from probation.law.history import StrainHistory

TIME = np.linspace(0.0, 100.0, 201)
STRAIN = 0.005 * TIME
LAW = Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
SETS = np.array([[3220.0, 5.2, 2.5], [3000.0, 6.0, 2.0], [3500.0, 4.0, 3.0]])


@pytest.mark.parametrize("threads", [1, 2, None])
def test_a_batch_is_many_single_solves(threads):
    history = StrainHistory(TIME, STRAIN)
    found = batch.stresses(LAW, SETS, history, "sa3", threads=threads)
    assert_allclose(found, [LAW.with_parameters(one).stress(TIME, STRAIN, "sa3") for one in SETS], rtol=1e-14)


def test_a_batch_writes_where_it_is_told():
    out = np.empty((3, 201))
    assert batch.stresses(LAW, SETS, StrainHistory(TIME, STRAIN), out=out) is out


def test_what_an_output_shares_memory_with_is_read_first():
    """Every function with out=: parameters, times, strains that lie in the memory of the answer."""
    history, records = StrainHistory(TIME, STRAIN), [batch.Observed(StrainHistory(TIME, STRAIN), 0.3 * TIME)]
    sets = np.tile(SETS, (7, 1)) * np.linspace(0.9, 1.1, 21)[:, None]

    def inside(out, values, offset=0):
        view = out.reshape(-1)[offset : offset + values.size].reshape(values.shape)
        view[...] = values
        return view

    out = np.empty((21, 201))
    found = batch.stresses(LAW, inside(out, sets), history, threads=1, out=out)
    assert_allclose(found, batch.stresses(LAW, sets, history), rtol=0.0)
    out = np.empty((21, 1, 13))
    batch.many_normal_equations(LAW, inside(out, sets), records, threads=1, out=out)
    assert_allclose(out[..., :9].reshape(21, 1, 3, 3), batch.many_normal_equations(LAW, sets, records)[0], rtol=0.0)
    both = np.empty(63)
    found = batch.sums_of_squares(LAW, inside(both, sets), records, threads=1, out=both[:21].reshape(21, 1))
    assert_allclose(found, batch.sums_of_squares(LAW, sets, records), rtol=0.0)

    strains = STRAIN * np.linspace(0.5, 1.5, 21)[:, None]
    expected = batch.field_stresses(LAW, TIME, strains, sets)
    whole = np.empty(22 * 201)
    shifted = inside(whole, strains, 100)
    found = batch.field_stresses(LAW, TIME, shifted, sets, threads=1, out=whole[: 21 * 201].reshape(21, 201))
    assert_allclose(found, expected, rtol=0.0)
    out = np.empty((21, 201))
    found = batch.field_stresses(LAW, inside(out, TIME), strains, inside(out, sets, 300), threads=1, out=out)
    assert_allclose(found, expected, rtol=0.0)


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3", "exact", "cvode"])
def test_a_stress_may_be_written_over_its_own_times_or_strains(scheme):
    expected = LAW.stress(TIME, STRAIN, scheme)
    for which in (0, 1):
        arrays = [TIME.copy(), STRAIN.copy()]
        assert_allclose(LAW.stress(*arrays, scheme, out=arrays[which]), expected, rtol=0.0)
        memory = np.empty(202)
        memory[1:] = arrays[which] = (TIME, STRAIN)[which]
        arrays = [TIME, STRAIN]
        arrays[which] = memory[1:]
        assert_allclose(LAW.stress(*arrays, scheme, out=memory[:-1]), expected, rtol=0.0)


def test_sums_of_squares_are_those_of_the_stresses():
    history, data = StrainHistory(TIME, STRAIN), 0.3 * TIME
    records = [batch.Observed(history, data), batch.Observed(history, data, Modification(load_bearing_area=0.9))]
    found = batch.sums_of_squares(LAW, SETS, records)
    stress = batch.stresses(LAW, SETS, history)
    assert_allclose(found[:, 0], ((stress - data) ** 2).sum(axis=1), rtol=1e-12)
    assert_allclose(found[:, 1], ((0.9 * stress - data) ** 2).sum(axis=1), rtol=1e-12)


def test_normal_equations_are_those_of_the_sensitivities():
    data = 0.3 * TIME
    matrix, gradient, squares = batch.normal_equations(LAW, batch.Observed(StrainHistory(TIME, STRAIN), data))
    stress, sensitivity = LAW.sensitivity(TIME, STRAIN)
    assert_allclose(matrix, sensitivity.T @ sensitivity, rtol=1e-10)
    assert_allclose(gradient, sensitivity.T @ (stress - data), rtol=1e-9)
    assert squares == pytest.approx(((stress - data) ** 2).sum(), rel=1e-12)


@pytest.mark.parametrize("jumps", ["auto", None])
def test_the_stress_of_a_pixel_is_that_of_its_strain_alone(jumps):
    strains = np.array([STRAIN, np.minimum(STRAIN, 0.3)])
    found = batch.field_stresses(LAW, TIME, strains, SETS[1:], "sa3", jumps=jumps)
    alone = [
        LAW.with_parameters(p).stress(probation.StrainHistory(TIME, e, jumps=jumps), scheme="sa3")
        for p, e in zip(SETS[1:], strains, strict=True)
    ]
    assert_allclose(found, alone, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("law", "jumps", "named"), [(LAW, np.array([1.0]), "jumps"), (LAW, "some", "jumps"), (None, "auto", "law is None")]
)
def test_a_field_refuses_what_is_no_law_and_jumps_of_one_record(law, jumps, named):
    with pytest.raises(probation.InputError, match=named):
        batch.field_stresses(law, TIME, np.array([STRAIN]), jumps=jumps)


def test_a_bad_set_of_parameters_is_named():
    history = StrainHistory(TIME, STRAIN)
    with pytest.raises(probation.InputError, match="tau_max"):
        batch.stresses(LAW, [[3220.0, -1.0, 2.5]], history)
    with pytest.raises(probation.InputError, match=r"\(sets, 3\)"):
        batch.stresses(LAW, [1.0, 2.0, 3.0], history)
    with pytest.raises(probation.InputError, match=r"parameters\[1\]"):
        batch.stresses(LAW, [[1.0, 1.0, 1.0], [1.0, np.nan, 1.0]], history)
    with pytest.raises(probation.InputError, match="true_stress"):
        batch.sums_of_squares(LAW, SETS, [batch.Observed(history, TIME[:-1])])


@pytest.mark.parametrize(
    "law",
    [
        LAW,
        Law(unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=Weissenberg(0.00464, 0.0367)),
        Law(unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=PowerLaw(0.05, -0.9)),
    ],
    ids=["constant", "weissenberg", "power"],
)
def test_the_strain_of_creep_carries_the_stress(law):
    """Loaded in 20 s, then held: bE2 run on the strain gives the stress back."""
    time = np.linspace(0.0, 200.0, 401)
    stress = np.minimum(time, 20.0)
    strain = creep(law, time, stress, jumps=[20.0])
    assert_allclose(law.stress(probation.StrainHistory(time, strain, jumps=[20.0])), stress, atol=1e-7)
    assert np.all(np.diff(strain) > 0.0)


def test_a_load_put_on_at_once_starts_elastic():
    """e(0) = s / E_u."""
    assert creep(LAW, TIME, np.full(201, 10.0))[0] == pytest.approx(10.0 / 3220.0, rel=1e-12)


def test_creep_of_one_mode_without_hardening_is_maxwells():
    """One mode, G = 0: e = (s / E_u) (1 + t / tau)."""
    law = Law(unrelaxed_modulus=1000.0, tau_max=10.0, hardening_modulus=0.0, modes=1)
    assert_allclose(creep(law, TIME, np.full(201, 5.0)), 5e-3 * (1.0 + TIME / 10.0), rtol=1e-9)


def test_a_stress_that_strains_beyond_all_numbers_at_once_is_refused():
    with pytest.raises(
        probation.InputError, match=r"true_stress\[0\] is 1e\+06 MPa; put on at once it strains by 1e\+06"
    ):
        creep(Law(unrelaxed_modulus=1.0, tau_max=1.0, hardening_modulus=1.0), TIME, np.full(201, 1e6))


def test_creep_refuses_what_it_cannot_do():
    with pytest.raises(probation.InputError, match="unrelaxed_modulus"):
        creep(Law(unrelaxed_modulus=0.0, tau_max=1.0, hardening_modulus=1.0), TIME, STRAIN)
    with pytest.raises(probation.InputError, match="feedbacks"):
        creep(LAW, TIME, STRAIN, modification=Modification(feedbacks=(probation.StressActivation(10.0),)))
