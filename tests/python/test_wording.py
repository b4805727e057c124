"""A value is printed to two significant digits of its standard error."""

import pytest

from probation.wording import chance, change, percentage, plus_minus, times


@pytest.mark.parametrize(
    ("value", "se", "text"),
    [
        (3223.3391, 2.4812, "3223.3 ± 2.5"),
        (1.85, 8.5e-5, "1.850000 ± 0.000085"),
        (1.6543, 0.0996, "1.65 ± 0.10"),
        (2093.4, 254.4, "2093 ± 254"),
        (3220.0, 0.0, "3220"),
    ],
)
def test_the_error_decides_the_digits(value: float, se: float, text: str):
    assert plus_minus(value, se) == text


@pytest.mark.parametrize(
    ("part", "sign", "text"),
    [(0.000861, "", "0.086"), (0.1249, "", "12"), (0.998, "", "100"), (1.27, "+", "+130"), (-36.2, "+", "-3600")],
)
def test_percentages_have_no_exponent(part: float, sign: str, text: str):
    assert percentage(part, sign) == text


@pytest.mark.parametrize(
    ("probability", "text"), [(1.0, "> 99 %"), (0.996, "> 99 %"), (0.91, "91 %"), (0.004, "< 1 %")]
)
def test_a_probability_that_came_out_is_never_a_certainty(probability: float, text: str):
    assert chance(probability) == text


@pytest.mark.parametrize(("ratio", "text"), [(0.9624, "0.962"), (316.4, "316"), (1848.0, "1850"), (2.5e6, "2500000")])
def test_how_many_times_has_no_exponent(ratio: float, text: str):
    assert times(ratio) == text


@pytest.mark.parametrize(
    ("before", "after", "text"),
    [
        (4.0, 0.2, "falls from 4 to 0.2 MPa"),
        (0.6646, 0.7651, "rises from 0.665 to 0.765 MPa"),
        (0.16451, 0.16449, "falls from 0.165 to 0.164 MPa"),
        (0.1652, 0.1651, "stays at 0.165 MPa"),
    ],
)
def test_a_misfit_falls_only_where_one_sees_it_fall(before: float, after: float, text: str):
    assert change(before, after) == text
    verb, rest = text.split(" ", 1)
    assert change(before, after, "would ") == f"would {verb.removesuffix('s')} {rest}"
