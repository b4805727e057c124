"""The compiled material point seen from Python, and where the package keeps what C++ needs."""

import numpy as np
import pytest

import probation
from probation.exporting.constants import MaterialConstants
from probation.fe import CutStep, MaterialPoint, cmake_prefix, include_path, interface_path
from probation.fe.__main__ import main
from probation.fe.where import calculix_library

LAW = probation.Law(
    unrelaxed_modulus=3220.0, alpha=1.1, hardening_modulus=1.8, companion=probation.Weissenberg(0.00464, 0.0367)
)


def stretched(true_strain):
    """F of incompressible tension along 1; shape (points, 3, 3)."""
    strain = np.atleast_1d(true_strain)
    return np.stack([np.diag(np.exp([e, -e / 2, -e / 2])) for e in strain])


def test_one_dimension_is_the_laws_own_sa2_where_every_instant_is_a_jump():
    """Then the engine, too, takes the rate of the increment."""
    rises = np.r_[np.full(30, 0.004), np.full(30, 0.009), np.full(10, -0.002)]
    steps = np.r_[np.full(30, 4.0), np.full(30, 0.7), np.full(10, 1.0)]
    time, strain = np.r_[0.0, np.cumsum(steps)], np.r_[0.0, np.cumsum(rises)]
    expected = LAW.stress(probation.StrainHistory(time, strain, jumps=time[1:-1]), scheme="sa2")
    point = MaterialPoint.from_law(LAW, 2e4)
    state, found = None, [0.0]
    for rise, dt in zip(rises, steps, strict=True):
        stress, _, state = point.uniaxial(rise, dt, state)
        found.append(stress)
    np.testing.assert_allclose(found, expected, atol=1e-11)


def test_three_dimensions_in_incompressible_tension_are_one():
    """sigma_11 - sigma_22 of P F^T, whatever K."""
    point = MaterialPoint.from_law(LAW, 2e4)
    expected, _, _ = point.uniaxial(0.1, 20.0)
    f = stretched(0.1)
    piola, tangent, state = point.first_piola(f, 20.0)
    cauchy = piola[0] @ f[0].T
    assert cauchy[0, 0] - cauchy[1, 1] == pytest.approx(expected, rel=1e-13)
    assert tangent is not None
    assert state.shape == (1, point.state_size) == (1, 310)


def test_many_points_are_each_point_by_itself():
    point = MaterialPoint.from_law(LAW, 2e4)
    f = stretched([0.05, 0.1, 0.2])
    together, _, _ = point.first_piola(f, 5.0, with_tangent=False)
    for k in range(3):
        alone, _, _ = point.first_piola(f[k : k + 1], 5.0)
        np.testing.assert_array_equal(together[k], alone[0])


@pytest.mark.parametrize(
    "law",
    [
        probation.Law(unrelaxed_modulus=2000.0, tau_max=5.2, hardening_modulus=2.5),
        probation.Law(unrelaxed_modulus=2000.0, hardening_modulus=2.5, companion=probation.Exponential(27.24, -2.1)),
        probation.Law(unrelaxed_modulus=2000.0, hardening_modulus=2.5, companion=probation.PowerLaw(0.03, -0.95)),
        probation.Law(
            unrelaxed_modulus=2000.0,
            alpha=0.9,
            hardening_modulus=2.5,
            companion=probation.Table((1e-4, 1e-3, 1e-2), (300.0, 22.0, 2.5)),
            spectrum=probation.Spectrum([1e-3, 1e-2, 0.1, 1.0], [0.1, 0.2, 0.3, 0.35]),
        ),
    ],
)
def test_every_form_of_the_law_reaches_the_point(law):
    """One step from rest, against the engine's SA2."""
    stress, _, _ = MaterialPoint.from_law(law, 2e4).uniaxial(1e-4, 0.03)
    assert stress == pytest.approx(law.stress([0.0, 0.03], [0.0, 1e-4], scheme="sa2")[1], rel=1e-12)


def test_log_spaced_modes_need_eleven_constants_and_others_their_lists():
    assert MaterialConstants.of(LAW, 2e4).values == (3220, 1.8, 2e4, 1, 1.1, 0.00464, 0.0367, 1e-7, 0, 50, 6)
    kernel = probation.Spectrum([0.1, 1.0], [0.4, 0.6])
    law = probation.Law(unrelaxed_modulus=1.0, tau_max=2.0, hardening_modulus=3.0, spectrum=kernel)
    assert MaterialConstants.of(law, 4.0).values == (1, 3, 4, 0, 2, 0, 0, 1e-7, 0, 2, 0, 0.1, 1, 0.4, 0.6)


def test_what_the_point_cannot_hold_is_named():
    with pytest.raises(probation.InputError, match=r"bulk_modulus is -1\.0; a positive modulus"):
        MaterialPoint.from_law(LAW, -1.0)
    with pytest.raises(probation.InputError, match=r"rate_filter is -0\.1"):
        MaterialPoint.from_law(LAW, 1.0, rate_filter=-0.1)
    with pytest.raises(probation.InputError, match=r"modes: found 80, expected at most 64"):
        MaterialPoint.from_law(probation.Law(unrelaxed_modulus=1, tau_max=1, hardening_modulus=1, modes=80), 1.0)
    by_function = probation.RateFunction(lambda rate: 0.03 / rate)
    law = probation.Law(unrelaxed_modulus=1, hardening_modulus=1, companion=by_function)
    with pytest.raises(probation.InputError, match=r"companion: found the form .*tabulate it"):
        MaterialPoint.from_law(law, 1.0)
    with pytest.raises(probation.InputError, match=r"constant 10 \(modes\) must be a whole number from 1 to 64"):
        MaterialPoint([3220, 1.8, 2e4, 0, 5.0, 0, 0, 1e-7, 0, 50.5, 6])
    with pytest.raises(probation.InputError, match=r"deformation_gradient has the shape \(3, 3\)"):
        MaterialPoint.from_law(LAW, 1.0).first_piola(np.eye(3), 1.0)
    with pytest.raises(probation.InputError, match=r"state has the shape \(1, 3\); expected \(1, 310\)"):
        MaterialPoint.from_law(LAW, 1.0).first_piola(stretched(0.0), 1.0, np.zeros((1, 3)))


def test_an_increment_that_cannot_be_says_cut_the_step_and_where():
    f = stretched([0.0, 0.1])
    f[1, 0, 0] = -1.0
    with pytest.raises(CutStep) as caught:
        MaterialPoint.from_law(LAW, 2e4).first_piola(f, 1.0)
    assert caught.value.point == 1
    with pytest.raises(CutStep):
        MaterialPoint.from_law(LAW, 2e4).uniaxial(0.1, -1.0)


def test_an_increment_above_the_stress_tolerance_says_cut_the_step():
    watched, unwatched = MaterialPoint.from_law(LAW, 2e4, stress_tolerance=0.1), MaterialPoint.from_law(LAW, 2e4)
    assert MaterialConstants.of(LAW, 2e4, stress_tolerance=0.1).law() == LAW
    for coarse in (lambda: watched.uniaxial(0.05, 10.0), lambda: watched.first_piola(stretched(0.05), 10.0)):
        with pytest.raises(CutStep, match="no update within the stress tolerance at this increment"):
            coarse()
    assert watched.uniaxial(1e-4, 0.02)[:2] == unwatched.uniaxial(1e-4, 0.02)[:2]
    with pytest.raises(probation.InputError, match=r"stress_tolerance is -1\.0"):
        MaterialPoint.from_law(LAW, 2e4, stress_tolerance=-1.0)


def test_decades_that_no_point_resolves_are_refused():
    """At 400 the fastest mode's time was zero, the stress finite and the tangent not a number."""
    with pytest.raises(probation.InputError, match=r"constant 11 \(decades\) must be a positive number of at most 30"):
        MaterialPoint([3220, 1.8, 2e4, 0, 5.0, 0, 0, 1e-7, 0, 50, 400])
    law = probation.Law(unrelaxed_modulus=1, tau_max=1, hardening_modulus=1, decades=40.0)
    with pytest.raises(probation.InputError, match=r"decades: found 40\.0, expected at most 30\.0"):
        MaterialPoint.from_law(law, 1.0)


def test_headers_interfaces_and_package_files_are_where_it_says(capsys):
    assert (include_path() / "probation" / "material" / "point.hpp").is_file()
    assert (include_path() / "probation.h").is_file()
    assert {"abaqus.cpp", "calculix.cpp", "mgis.cpp", "c_abi.cpp"} <= {file.name for file in interface_path().iterdir()}
    assert (cmake_prefix() / "lib" / "cmake" / "probation" / "probationConfig.cmake").is_file()
    assert calculix_library().is_file()
    for option, path in (
        ("--include", include_path()),
        ("--cmake", cmake_prefix()),
        ("--interfaces", interface_path()),
        ("--calculix", calculix_library()),
    ):
        assert main([option]) == 0
        assert capsys.readouterr().out.strip() == str(path)


def test_the_documented_limits_of_the_law_holds_hardly_relax_and_unloading_starts_at_nearly_twice_the_modulus():
    """docs/finite-elements.md: steady flow relaxes at E_u times the rate; turned round, that adds to E_u."""
    law = probation.Law(
        unrelaxed_modulus=2000.0, hardening_modulus=1.5, companion=probation.Weissenberg(0.00464, 0.0367)
    )
    point = MaterialPoint.from_law(law, 2e4)
    state = None
    for _ in range(300):
        loaded, _, state = point.uniaxial(0.001, 1.0, state)
    unloaded, _, _ = point.uniaxial(-1e-4, 0.1, state)
    for _ in range(60):
        held, _, state = point.uniaxial(0.0, 1.0, state)
    assert (round(loaded, 2), round(held, 2)) == (18.95, 18.89)
    assert 3500.0 < (loaded - unloaded) / 1e-4 < 4000.0
