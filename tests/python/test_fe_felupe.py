"""The law in felupe: one element against one dimension, and a turned one."""

import json
import sys

import numpy as np
import pytest

import probation
from probation.fe import MaterialPoint
from probation.fe.bar import Bar
from probation.fe.felupe import felupe_material
from probation.fe.neck import neck
from probation.fe.necking import main

felupe = pytest.importorskip("felupe")

LAW = probation.Law(
    unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=probation.Weissenberg(0.00464, 0.0367)
)
LOADING = [(0.004, 4.0)] * 25 + [(0.006, 0.6)] * 20
"""A ramp, then a rate ten times higher: increments of true strain, and s."""
UNLOADING = [(-0.001, 1.0)] * 20


def cube(point):
    region = felupe.RegionHexahedron(felupe.Cube(n=2))
    field = felupe.FieldContainer([felupe.Field(region, dim=3)])
    return field, felupe.SolidBody(felupe_material(point, 1.0), field)


def with_elastic_volume_change(point, bulk_modulus, rise, dt, stress, state):
    """One increment of the law in one dimension in series with a spring of 9 K, which is uniaxial tension at finite K.

    Lateral Kirchhoff stress vanishes where K ln J is a third of the axial one, s = K ln J + 2 s / 3, and the law sees
    the strain without its volumetric part, ln J / 3 = s / 9 K.
    """
    spring, seen = 9.0 * bulk_modulus, rise
    for _ in range(20):
        found, tangent, _ = point.uniaxial(seen, dt, state)
        excess = seen - rise + (found - stress) / spring
        seen -= excess / (1.0 + tangent / spring)
        if abs(excess) < 1e-15:
            break
    return point.uniaxial(seen, dt, state)


def reactions_of_one_element(bulk_modulus, steps):
    """Kirchhoff stress of a bar of one element, of the law in one dimension, and of that with a spring, each step."""
    point = MaterialPoint.from_law(LAW, bulk_modulus)
    field, solid = cube(point)
    boundaries = felupe.dof.uniaxial(field, clamped=False, return_loadcase=False)
    pulled = field.region.mesh.points[:, 0] == 1.0
    strain, state, stress, elastic, rows = 0.0, None, 0.0, None, []
    for rise, dt in steps:
        strain += rise
        expected, _, state = point.uniaxial(rise, dt, state)
        stress, _, elastic = with_elastic_volume_change(point, bulk_modulus, rise, dt, stress, elastic)
        solid.umat.kwargs["dt"] = dt
        boundaries["move"].update(np.expm1(strain))
        dof0, dof1 = felupe.dof.partition(field, boundaries)
        ext0 = felupe.dof.apply(field, boundaries, dof0)
        felupe.newtonraphson(items=[solid], dof0=dof0, dof1=dof1, ext0=ext0, tol=1e-9, verbose=0)
        force = solid.results.force.toarray().reshape(-1, 3)[pulled, 0].sum()
        rows.append((force * np.exp(strain), expected, stress))
    return np.array(rows).T


def largest_difference_from_one_dimension(bulk_modulus, steps):
    """Of the reaction, over the largest stress."""
    element, expected, _ = reactions_of_one_element(bulk_modulus, steps)
    return np.abs(element - expected).max() / np.abs(expected).max()


def test_the_reaction_of_one_element_is_the_law_in_one_dimension():
    """Within 1e-4 at K = 1e6 MPa; what is left is the volume change, in proportion to 1 / K."""
    nearly, less = (largest_difference_from_one_dimension(bulk_modulus, LOADING) for bulk_modulus in (1e6, 1e5))
    assert nearly < 1e-4
    assert less / nearly == pytest.approx(10.0, rel=0.02)


def test_on_unloading_too_one_element_is_the_law_in_one_dimension_where_the_volume_can_hardly_change():
    """Unloading is steeper than E_u, and the spring of 9 K counts for so much more: 1e-4 needs K = 2e6 MPa."""
    assert largest_difference_from_one_dimension(2e6, [*LOADING, *UNLOADING]) < 1e-4


@pytest.mark.parametrize("bulk_modulus", [3220.0, 1e6])
def test_what_one_element_differs_by_is_the_elastic_volume_change(bulk_modulus):
    """On loading and unloading, and where K is no larger than E_u."""
    element, expected, elastic = reactions_of_one_element(bulk_modulus, [*LOADING, *UNLOADING])
    np.testing.assert_allclose(element, elastic, rtol=0.0, atol=1e-8 * np.abs(expected).max())


def test_an_element_that_is_stretched_and_turned_by_a_right_angle_carries_its_stress_along():
    """The nodal forces of the turned element are those of the unturned one, turned."""
    point = MaterialPoint.from_law(LAW, 2e4)
    turned, straight = cube(point), cube(point)
    for i in range(1, 21):
        strain, angle = 0.01 * min(i, 10), np.pi / 2 * max(i - 10, 0) / 10
        c, s = np.cos(angle), np.sin(angle)
        rotation = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        stretch = np.diag(np.exp([strain, -strain / 2, -strain / 2]))
        forces = []
        for (field, solid), f in ((turned, rotation @ stretch), (straight, stretch)):
            solid.umat.kwargs["dt"] = 2.0
            field[0].values[:] = field.region.mesh.points @ (f - np.eye(3)).T
            forces.append(solid.assemble.vector(field).toarray().reshape(-1, 3))
            solid.results.update_statevars()
        np.testing.assert_allclose(forces[0], forces[1] @ rotation.T, atol=1e-10)
    assert np.abs(forces[1]).max() > 1.0


def test_a_bar_at_constant_grip_speed_has_a_force_maximum_and_a_neck():
    """The rate of the centre rises several times above the nominal one, which it has before the maximum."""
    law = probation.Law(
        unrelaxed_modulus=2000.0, hardening_modulus=1.5, companion=probation.Weissenberg(0.00464, 0.0367)
    )
    bar = Bar(elements=(12, 1), largest_step=0.02, centre_strain=1.2)
    figures = neck(MaterialPoint.from_law(law, 2e4), bar).figures()
    assert 15.0 < figures["largest_nominal_stress_MPa"] < 17.0
    assert figures["lowest_nominal_stress_after_MPa"] < 0.7 * figures["largest_nominal_stress_MPa"]
    assert figures["slowest_centre_rate_per_s"] == pytest.approx(1e-3, rel=0.05)
    assert 4.0 < figures["centre_rate_ratio"] < 13.0


def test_the_necking_command_prints_its_figures_and_draws_them(tmp_path, capsys):
    picture, answer = tmp_path / "neck.png", tmp_path / "neck.json"
    options = ["--elements", "4", "1", "--largest-step", "0.05", "--centre-strain", "0.1"]
    assert main([*options, "--plot", str(picture), "--json", str(answer)]) == 0
    assert "centre_rate_ratio" in capsys.readouterr().out
    assert picture.stat().st_size > 5000
    assert len(json.loads(answer.read_text())["centre_rate"]) > 3


def test_without_felupe_the_necking_command_says_what_to_install(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "felupe", None)
    assert main([]) == 2
    assert "pip install 'probation[fe]'" in capsys.readouterr().err
