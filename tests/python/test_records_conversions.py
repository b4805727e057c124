"""From what machines measure to true strain and true stress, and from their units to ours."""

import doctest
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from probation.errors import InputError
from probation.records import conversions, header, units
from probation.records.reading import read_record

LENGTH, AREA = 50.0, 8.0  # mm, mm²


@pytest.fixture
def read(tmp_path):
    def write_and_read(headings, rows, **options):
        path = tmp_path / "record.csv"
        lines = [headings, *(",".join(map(repr, row)) for row in rows)]
        path.write_text("\n".join(lines), encoding="utf-8")
        return read_record(path, **options)

    return write_and_read


def doubling(strain_at_double, stress):
    """Eleven samples that end at stretch 2 in whichever measure of strain."""
    return [(float(at), strain_at_double * at / 10, stress) for at in range(11)]


@pytest.mark.parametrize(
    ("heading", "at_double"),
    [
        ("Engineering strain", 1.0),
        ("Engineering strain (%)", 100.0),
        ("Displacement (mm)", 50.0),
        ("Displacement (cm)", 5.0),
        ("Extension (in)", 50.0 / 25.4),
        ("True strain", math.log(2.0)),
    ],
)
def test_doubling_the_length_is_true_strain_log_two(read, heading, at_double):
    """λ = 1 + e = 1 + u/L0 = 2 at e = 1 = 100 %, u = L0 = 50 mm = 5 cm."""
    rows = doubling(at_double, 3.0)
    record = read(f"Time (s),{heading},True stress (MPa)", rows, specimen={"gauge_length_mm": LENGTH})
    assert record.true_strain[-1] == pytest.approx(math.log(2.0), rel=1e-14)
    assert record.true_stress[-1] == 3.0


def test_stretch_is_read_as_such(read):
    rows = [(float(at), 1.0 + at / 10, 3.0) for at in range(11)]
    record = read("Time (s),Stretch,Engineering stress (MPa)", rows)
    assert record.true_strain[-1] == pytest.approx(math.log(2.0), rel=1e-14)
    assert record.true_stress[-1] == pytest.approx(6.0, rel=1e-14)


@pytest.mark.parametrize(
    ("heading", "value", "expected"),
    [
        ("Engineering stress (MPa)", 3.0, 6.0),
        ("Engineering stress (kPa)", 3000.0, 6.0),
        ("Engineering stress (N/mm²)", 3.0, 6.0),
        ("Engineering stress (N/mm^2)", 3.0, 6.0),
        ("Force (N)", 24.0, 6.0),
        ("Load (kN)", 0.024, 6.0),
        ("True stress (Pa)", 3.0e6, 3.0),
    ],
)
def test_engineering_stress_and_force_grow_with_the_stretch(read, heading, value, expected):
    """σ = s·λ = F/A0·λ at λ = 2: 3 MPa, or 24 N over 8 mm², become 6 MPa; true stress stays."""
    record = read(f"Time (s),Engineering strain,{heading}", doubling(1.0, value), specimen={"area_mm2": AREA})
    assert record.true_stress[-1] == pytest.approx(expected, rel=1e-14)
    assert any("constant volume" in warning for warning in record.warnings) == (expected == 6.0)


@pytest.mark.parametrize(("force", "value"), [("Engineering stress (MPa)", 3.0), ("Force (N)", 24.0)])
@pytest.mark.parametrize("poisson", [0.5, 0.4, 0.0])
def test_a_measured_transverse_strain_gives_the_section(read, force, value, poisson):
    """At λ = 2 the section is A0 e^(-2 ν ln 2) = A0 / 4^ν: of constant volume at ν = 1/2, as it was at ν = 0."""
    rows = [(*row, -poisson * math.log1p(row[1])) for row in doubling(1.0, value)]
    record = read(f"Time (s),Engineering strain,{force},transverse_strain", rows, specimen={"area_mm2": AREA})
    assert record.true_stress[-1] == pytest.approx(3.0 * 4.0**poisson, rel=1e-14)
    assert any("measured transverse strain" in warning for warning in record.warnings)
    assert not any("constant volume" in warning for warning in record.warnings)


def test_a_film_that_grows_narrower_than_thinner_has_no_section_from_its_width(read):
    """A Poisson ratio of 0.6 across the width: the volume would shrink by 0.2 ln 2 = 14 %, which no solid does."""
    rows = [(*row, -0.6 * math.log1p(row[1])) for row in doubling(1.0, 3.0)]
    record = read("Time (s),Engineering strain,Engineering stress (MPa),transverse_strain", rows)
    assert record.true_stress[-1] == pytest.approx(6.0, rel=1e-14)
    assert any("constant volume: by the measured transverse strain" in warning for warning in record.warnings)


def test_small_engineering_strain_keeps_its_digits():
    """ln(1 + e) = e - e²/2 + …: at e = 1e-10 the second term is below the sixteenth digit of 1."""
    strain = conversions.true_strain_from("engineering_strain", np.array([1e-10]))
    assert strain[0] == pytest.approx(1e-10 - 5e-21, rel=1e-15)


@given(strain=st.floats(-3.0, 3.0), stress=st.floats(-1e3, 1e3))
def test_every_measure_of_the_same_test_gives_the_same_record(strain, stress):
    """A true strain and stress, written down as machines would, come back."""
    stretch = math.exp(strain)
    measures = {
        "true_strain": strain,
        "engineering_strain": stretch - 1.0,
        "stretch": stretch,
        "displacement": LENGTH * (stretch - 1.0),
    }
    forces = {"true_stress": stress, "engineering_stress": stress / stretch, "force": AREA * stress / stretch}
    for role, value in measures.items():
        values = np.array([value])
        assert conversions.true_strain_from(role, values, LENGTH) == pytest.approx(strain, abs=1e-14)
        lengthened = conversions.stretch_from(role, values, LENGTH)
        for force_role, force in forces.items():
            found = conversions.true_stress_from(force_role, np.array([force]), lengthened, AREA)
            assert found == pytest.approx(stress, rel=1e-12)


@pytest.mark.parametrize(
    ("value", "unit", "target", "expected"),
    [
        (1.0, "MPa", "MPa", 1.0),
        (1.0, "Mpa", "MPa", 1.0),
        (1.0, "GPa", "MPa", 1000.0),
        (2.0, "kN", "N", 2000.0),
        (2.0, "min", "s", 120.0),
        (2.0, "m", "mm", 2000.0),
        (1.0, "%/s", "1/s", 0.01),
        (60.0, "1/min", "1/s", 1.0),
        (3.0, "s^-1", "1/s", 3.0),
        (3.0, "/s", "1/s", 3.0),
        (0.0, "K", "degC", -273.15),
        (20.0, "C", "degC", 20.0),
        (20.0, "°C", "degC", 20.0),
        (212.0, "°F", "degC", 100.0),
        (0.5, "-", "dimensionless", 0.5),
        (0.5, "mm/mm", "dimensionless", 0.5),
    ],
)
def test_units_are_converted_as_laboratories_spell_them(value, unit, target, expected):
    assert units.convert(np.array([value]), unit, target) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("unit", ["mm", "N", "s", "foo", "MPa*", "x y", "mPa"])
def test_a_unit_that_is_no_stress_is_refused(unit):
    with pytest.raises(ValueError, match="unit"):
        units.convert(np.zeros(1), unit, "MPa")


def test_a_displacement_needs_the_gauge_length(read):
    with pytest.raises(InputError, match="displacement but no gauge_length_mm"):
        read("Time (s),Displacement (mm),True stress (MPa)", doubling(50.0, 3.0))


def test_a_force_needs_the_area(read):
    with pytest.raises(InputError, match="force but no area_mm2"):
        read("Time (s),True strain,Force (N)", doubling(0.7, 3.0))


def test_compression_to_nothing_is_refused_by_its_row(read):
    """Engineering strain -1 is reached at the eleventh sample, in row 12."""
    with pytest.raises(InputError, match=r"row 12, column 'Engineering strain': found -1, a stretch of 0"):
        read("Time (s),Engineering strain,True stress (MPa)", doubling(-1.0, 3.0))


@pytest.mark.parametrize("module", [conversions, header, units])
def test_the_examples_in_the_docstrings_hold(module):
    outcome = doctest.testmod(module, extraglobs={"np": np})
    assert outcome.attempted > 0
    assert outcome.failed == 0
