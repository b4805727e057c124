"""The law in CalculiX: what decks say, how results are read, and, where a ccx can load the routine, the runs."""

import re

import numpy as np
import pytest

import probation
from probation.errors import InputError
from probation.exporting.constants import MaterialConstants
from probation.fe import MaterialPoint
from probation.fe.calculix import Dumbbell, can_load_routines, find_ccx, neck, necking, read_printed, run
from probation.fe.calculix.__main__ import main
from probation.fe.calculix.deck import elements, material, nodes
from probation.fe.calculix.necking import neck_deck
from probation.fe.calculix.one_dimension import pull_bar
from probation.fe.calculix.printed import Printed

LAW = probation.Law(
    unrelaxed_modulus=2000.0, alpha=1.0, hardening_modulus=1.5, companion=probation.Weissenberg(0.00464, 0.0367)
)
SMALL = Dumbbell(elements=(3, 2, 2, 1), nominal_strain=0.2)


def capable_ccx():
    try:
        return find_ccx()
    except InputError:
        return None


CCX = capable_ccx()
needs_ccx = pytest.mark.skipif(CCX is None, reason="no ccx with external behaviours: make fe")


# --- decks ------------------------------------------------------------------------------------------------------------


def test_no_number_of_a_deck_is_longer_than_calculix_reads():
    """20 characters, and 16 of them in a line."""
    for line in neck_deck(LAW, SMALL, 2e4).splitlines():
        assert line.startswith("*") or all(len(entry) <= 20 for entry in line.split(","))
        assert line.rstrip(",").count(",") < 16


def test_a_brick_of_twenty_nodes_goes_on_after_a_comma():
    text = elements("C3D20R", [range(101, 121)]).splitlines()
    assert text[0] == "*ELEMENT, TYPE=C3D20R, ELSET=BODY"
    assert text[1].endswith(",")
    assert text[2].endswith(",")
    assert [int(each) for each in "".join(text[1:]).split(",")] == [1, *range(101, 121)]


def test_coordinates_keep_thirteen_digits():
    point = np.array([[1.0 / 3.0, -2.0 / 3.0, 1e-9]])
    read = [float(each) for each in nodes(point).splitlines()[1].split(",")[1:]]
    np.testing.assert_allclose(read, point[0], rtol=1e-12)


def test_the_material_of_a_deck_is_the_constants_of_the_law_and_the_state_of_its_modes():
    constants = MaterialConstants.of(LAW, 2e4)
    text = material(constants, 310).splitlines()
    assert text[:2] == ["*MATERIAL, NAME=@PROBATION_DNLR", "*USER MATERIAL, CONSTANTS=11"]
    assert [float(each) for each in ",".join(text[2:4]).split(",")] == pytest.approx(constants.values)
    assert text[4:6] == ["*DEPVAR", "310"]


def test_more_constants_than_calculix_passes_are_named():
    kernel = probation.Spectrum(np.geomspace(1e-3, 1.0, 6), np.full(6, 1 / 6))
    law = probation.Law(unrelaxed_modulus=2000.0, hardening_modulus=1.5, tau_max=5.0, modes=6, spectrum=kernel)
    with pytest.raises(InputError, match=r"found 23, expected at most 21.*PROBATION_CONSTANTS"):
        material(MaterialConstants.of(law, 2e4), 46)


# --- the dumbbell -----------------------------------------------------------------------------------------------------


def test_the_mesh_of_the_dumbbell_fills_it():
    """Volumes of trilinear bricks, all positive; their sum against the integral of the section."""
    dumbbell = Dumbbell(elements=(40, 20, 2, 2))
    corners = dumbbell.points[dumbbell.connectivity[:, :8] - 1]
    edges = np.stack(
        [corners[:, [1, 2, 5, 6]].mean(axis=1), corners[:, [2, 3, 6, 7]].mean(axis=1), corners[:, 4:].mean(axis=1)]
    ) - np.stack(
        [corners[:, [0, 3, 4, 7]].mean(axis=1), corners[:, [0, 1, 4, 5]].mean(axis=1), corners[:, :4].mean(axis=1)]
    )
    volume = np.linalg.det(np.moveaxis(edges, 0, 1))
    assert volume.min() > 0.0
    # The cosines' means: 2/pi over a quarter wave, one half over the shoulder.
    gauge = 15.0 * 2.0 * (1.0 - 0.02 * 2.0 / np.pi)
    assert volume.sum() == pytest.approx(1.5 * (gauge + 8.0 * 3.0), rel=1e-3)


def test_the_nodes_between_corners_lie_between_them():
    dumbbell = Dumbbell(half_head=2.0, imperfection=0.0)
    brick = dumbbell.points[dumbbell.connectivity - 1]
    pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    for between, (one, other) in enumerate(pairs, start=8):
        np.testing.assert_allclose(brick[:, between], 0.5 * (brick[:, one] + brick[:, other]), atol=1e-12)


def test_planes_of_symmetry_are_where_a_coordinate_is_none():
    for axis in range(3):
        on_plane = np.flatnonzero(SMALL.points[:, axis] == 0.0) + 1
        assert SMALL.nodes_on(axis) == tuple(on_plane)
    grip = SMALL.points[np.array(SMALL.nodes_on(0, last=True)) - 1]
    np.testing.assert_allclose(grip[:, 0], 23.0)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"half_width": 0.0}, "half_width is 0.0; a positive number"),
        ({"half_gauge": float("nan")}, "half_gauge is nan"),
        ({"imperfection": 0.7}, "imperfection is 0.7; a fraction"),
        ({"elements": (3, 2, 0, 1)}, "elements is .*at least 1"),
    ],
)
def test_a_dumbbell_that_cannot_be_is_named(wrong, message):
    with pytest.raises(InputError, match=message):
        Dumbbell(**wrong)


# --- results ----------------------------------------------------------------------------------------------------------

DAT = """
 displacements (vx,vy,vz) for set FACE and time  0.1000000E+01

         7  1.000000E-01 -2.000000E-02  0.000000E+00
         9  2.000000E-01 -3.000000E-02  0.000000E+00

 total force (fx,fy,fz) for set GRIP and time  0.1000000E+01

        4.500000E+01  0.000000E+00  1.000000E+00

 displacements (vx,vy,vz) for set FACE and time  0.2500000E+01

         7  3.000000E-01 -2.000000E-02  0.000000E+00
         9  4.000000E-01 -3.000000E-02  0.000000E+00
"""


def test_what_was_printed_is_read_by_quantity_and_set(tmp_path):
    (tmp_path / "job.dat").write_text(DAT)
    printed = read_printed(tmp_path / "job.dat")
    face = printed["displacements", "FACE"]
    assert face.nodes == (7, 9)
    assert face.time.tolist() == [1.0, 2.5]
    assert face.values[:, :, 0].tolist() == [[0.1, 0.2], [0.3, 0.4]]
    force = printed["total force", "GRIP"]
    assert force.nodes == ()
    assert force.values.tolist() == [[[45.0, 0.0, 1.0]]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (DAT.replace("2.000000E-01 -3.000000E-02", "2.000000E-01-3.000000E-102"), "line 5.*expected node, x, y, z"),
        (DAT.replace("         9  4.000000E-01 -3.000000E-02  0.000000E+00\n", ""), "3 rows .* in 2 increments"),
        ("", "nothing was printed"),
    ],
)
def test_a_file_of_results_that_cannot_be_read_is_named(tmp_path, text, message):
    (tmp_path / "job.dat").write_text(text)
    with pytest.raises(InputError, match=message):
        read_printed(tmp_path / "job.dat")


def test_no_file_of_results_is_named(tmp_path):
    with pytest.raises(InputError, match=r"job\.dat: no such file"):
        read_printed(tmp_path / "job.dat")


# --- the program ------------------------------------------------------------------------------------------------------


def program(path, script="", *, capable):
    """A shell script that passes for a ccx."""
    path.write_bytes(b"#!/bin/sh\n" + script.encode() + b"\nexit 201\n" + (b"\0dlopen\0" if capable else b""))
    path.chmod(0o755)
    return path


def test_a_ccx_that_can_load_the_routine_is_told_from_one_that_cannot(tmp_path):
    assert can_load_routines(program(tmp_path / "new", capable=True))
    assert not can_load_routines(program(tmp_path / "stock", capable=False))
    assert not can_load_routines(tmp_path / "none")


def test_the_ccx_is_the_given_one_then_the_variable_then_the_path_then_the_built_one(tmp_path, monkeypatch):
    given, named, built = (tmp_path / each for each in ("given", "named", "build/calculix/ccx"))
    built.parent.mkdir(parents=True)
    (tmp_path / "bin").mkdir()
    for each in (given, named, built, tmp_path / "bin" / "ccx"):
        program(each, capable=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    monkeypatch.setenv("CCX", str(named))
    assert find_ccx(given) == given
    assert find_ccx() == named
    monkeypatch.delenv("CCX")
    assert find_ccx() == tmp_path / "bin" / "ccx"
    program(tmp_path / "bin" / "ccx", capable=False)
    assert find_ccx() == built
    built.unlink()
    with pytest.raises(InputError, match=r"bin/ccx was built without\): make fe"):
        find_ccx()
    with pytest.raises(InputError, match=r"--ccx is .*bin/ccx: a ccx built without external behaviours"):
        find_ccx(tmp_path / "bin" / "ccx")
    monkeypatch.setenv("CCX", str(tmp_path / "nothing"))
    with pytest.raises(InputError, match=r"\$CCX is .*no such program"):
        find_ccx()


def test_a_ccx_that_dies_without_a_word_is_told_what_it_lacks(tmp_path):
    with pytest.raises(InputError, match="without external behaviours; make fe builds one"):
        run(program(tmp_path / "stock", capable=False), "*NODE\n", tmp_path / "run")


def test_a_run_that_stops_early_tells_its_time_and_the_last_error(tmp_path):
    script = """
printf '     1          1     1     3  0.100000E+01  0.100000E+01  0.100000E+01\\n' >job.sta
printf '     1          2     1U    3  0.200000E+01  0.200000E+01  0.100000E+01\\n' >>job.sta
echo ' *ERROR: increment size smaller than minimum'"""
    with pytest.raises(InputError, match=r"stopped at 1 s with the status 201: \*ERROR: increment size smaller"):
        run(program(tmp_path / "ccx", script, capable=True), "*NODE\n", tmp_path / "run")


def test_a_command_without_a_ccx_says_so_and_ends_with_2(tmp_path, capsys):
    assert main(["element", "--ccx", str(tmp_path / "ccx")]) == 2
    assert re.match(r"probation\.fe\.calculix: --ccx is .*no such program", capsys.readouterr().err)


# --- one dimension with a volume change -------------------------------------------------------------------------------


def test_a_jump_of_a_bar_is_elastic_with_young_s_modulus():
    """9 K mu / (3 K + mu), 3 mu = E_u, where nothing relaxes; ln J = (1 - 2 nu) strain."""
    k, mu = 5e3, 2000.0 / 3.0
    young = 9.0 * k * mu / (3.0 * k + mu)
    bar = pull_bar(MaterialPoint.from_law(LAW, k), [(1e-4, 0.0)], k)
    assert bar.kirchhoff_stress[0] == pytest.approx(young * 1e-4, rel=1e-12)
    assert bar.log_volume[0] == pytest.approx(young * 1e-4 / (3.0 * k), rel=1e-12)


# --- the neck ---------------------------------------------------------------------------------------------------------


def uniformly_stretched(dumbbell, strain, time):
    """What ccx would print of a specimen that stretches without a neck, with a force of 6 N times the time."""

    def displacements(numbers):
        places = dumbbell.points[np.array(numbers) - 1]
        stretch = np.exp(np.multiply.outer(strain, [1.0, -0.5, -0.5]))[:, None, :]
        return Printed(time, tuple(numbers), places * (stretch - 1.0))

    section = (int(dumbbell.numbering[0, -1, 0]), int(dumbbell.numbering[0, 0, -1]))
    force = np.zeros((len(time), 1, 3))
    force[:, 0, 0] = 6.0 * time
    return {
        ("displacements", "FACE"): displacements(dumbbell.nodes_on(2, last=True)),
        ("displacements", "SECTION"): displacements(sorted(section)),
        ("total force", "GRIP"): Printed(time, (), force),
    }


def test_centre_and_face_of_a_uniform_stretch_have_its_strain_and_rate(tmp_path, monkeypatch):
    time, strain = np.array([10.0, 20.0, 40.0]), np.array([0.1, 0.3, 0.5])
    monkeypatch.setattr(necking, "run", lambda *_, **__: uniformly_stretched(SMALL, strain, time))
    answer = neck(tmp_path / "ccx", LAW, tmp_path, SMALL)
    np.testing.assert_allclose(answer.centre_strain, strain)
    np.testing.assert_allclose(answer.centre_rate, [0.01, 0.02, 0.01])
    np.testing.assert_allclose(answer.face_strain, np.broadcast_to(strain[:, None, None], (3, 5, 2)))
    np.testing.assert_allclose(answer.face_rate(2), 0.01)
    np.testing.assert_allclose(answer.nominal_stress, 2.0 * time)  # a quarter of the section is 2 x 1.5 mm
    np.testing.assert_allclose(answer.nominal_strain, 1e-3 * time)
    assert answer.figures()["largest_nominal_stress_MPa"] == pytest.approx(80.0)


def test_the_command_prints_the_figures_and_draws_them(tmp_path, monkeypatch, capsys):
    strain = np.linspace(0.01, 0.3, 12)
    answer = uniformly_stretched(SMALL, strain, 1e3 * strain)
    monkeypatch.setattr(necking, "run", lambda *_, **__: answer)
    ccx, picture, numbers = program(tmp_path / "ccx", capable=True), tmp_path / "neck.png", tmp_path / "neck.json"
    options = ["--elements", "3", "2", "2", "1", "--plot", str(picture), "--json", str(numbers)]
    assert main(["neck", "--ccx", str(ccx), *options]) == 0
    assert "centre_rate_ratio                    1\n" in capsys.readouterr().out
    assert picture.stat().st_size > 5000
    assert '"centre_strain"' in numbers.read_text()


# --- with a ccx -------------------------------------------------------------------------------------------------------


@needs_ccx
def test_the_reaction_of_one_element_is_the_law_in_one_dimension(capsys):
    """Within 1e-4 at K = 1e6 MPa on loading; and all of it on unloading, too, is the volume change of K."""
    assert main(["element"]) == 0
    assert "MISSED" not in capsys.readouterr().out


@needs_ccx
def test_an_element_that_is_stretched_and_turned_by_a_right_angle_carries_its_stress_along(capsys):
    assert main(["turn"]) == 0
    assert capsys.readouterr().out.count("limit 1e-06") == 3


@needs_ccx
def test_a_dumbbell_at_constant_grip_speed_has_a_force_maximum_and_a_neck(tmp_path):
    """On a coarse mesh."""
    dumbbell = Dumbbell(elements=(8, 2, 1, 1), largest_step=0.02, nominal_strain=0.6)
    figures = neck(CCX, LAW, tmp_path, dumbbell).figures()
    assert 15.0 < figures["largest_nominal_stress_MPa"] < 17.0
    assert figures["lowest_nominal_stress_after_MPa"] < 0.8 * figures["largest_nominal_stress_MPa"]
    assert 5.0 < figures["centre_rate_ratio"] < 13.0


@needs_ccx
def test_two_threads_give_what_one_gives(tmp_path):
    """The stress loop of ccx is threaded; the routine shares nothing between calls."""
    dumbbell = Dumbbell(elements=(4, 1, 1, 1), largest_step=0.02, nominal_strain=0.1)
    one, two = (neck(CCX, LAW, tmp_path / str(threads), dumbbell, threads=threads) for threads in (1, 2))
    np.testing.assert_allclose(two.nominal_stress, one.nominal_stress, rtol=1e-5)


@needs_ccx
def test_a_deck_with_too_few_state_variables_stops_at_once(tmp_path):
    """CalculiX passes no words of the routine on: what is said is where it stopped, and its own last words."""
    dumbbell = Dumbbell(elements=(2, 1, 1, 1), nominal_strain=0.1)
    text = neck_deck(LAW, dumbbell, 2e4).replace("\n310\n", "\n200\n")
    with pytest.raises(InputError, match=r"ccx stopped at 0 s with the status 255 and reported no error"):
        run(CCX, text, tmp_path)
