"""Files for finite-element codes: their own rules, and numbers from closed forms."""

import re
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose

import probation
from probation import InputError, Law, PowerLaw, RateFunction, Spectrum, Weissenberg, export
from probation.exporting.formats import FORMATS
from probation.exporting.numbers import within

E_U, G, ALPHA, RATE = 3220.0, 1.85, 1.045, 1e-3
LAW = Law(unrelaxed_modulus=E_U, alpha=ALPHA, hardening_modulus=G, companion=Weissenberg(0.00464, 0.0367))
CONSTANT = Law(unrelaxed_modulus=E_U, tau_max=5.2, hardening_modulus=2.5)
TAU_MAX = ALPHA * (0.00464 * -3.0 + 0.0367) / RATE  # eq. (11) at 1e-3 1/s
PRONY = ("abaqus-prony", "ansys-prony", "ls-dyna-prony")
CURVES = ("abaqus-plastic", "ls-dyna-mat-024")


@pytest.fixture(scope="module")
def texts():
    """Every format of one law."""
    return {name: export(LAW, name, rate=RATE, name="hdpe", bulk_modulus=2e4).text for name in FORMATS}


def below(text, keyword, comment="**"):
    """Data lines under a keyword, by hand."""
    lines = [line for line in text.splitlines() if not line.startswith(comment)]
    start = next(at for at, line in enumerate(lines) if line.startswith(keyword)) + 1
    end = next((at for at in range(start, len(lines)) if lines[at].startswith("*")), len(lines))
    return lines[start:end]


def columns(row, width):
    return [float(row[at : at + width]) for at in range(0, len(row), width)]


def relaxation(time, tau_max, hardening=G):
    """E(t) = 3 G + (E_u - 3 G) sum p_j e^{-t/tau_j}, from eqs. (4)-(6) at small strain: e_HT = 3 e."""
    ratio = 10.0 ** (-np.arange(50) * 6.0 / 49.0)
    weight = np.sqrt(ratio) / np.sqrt(ratio).sum()
    return 3.0 * hardening + (E_U - 3.0 * hardening) * np.exp(-np.outer(time, 1.0 / (tau_max * ratio))) @ weight


TIMES = np.concatenate([[0.0], np.geomspace(1e-5, 1e3, 60)])


def test_abaqus_prony_is_the_relaxation_modulus(texts):
    young, poisson = map(float, below(texts["abaqus-prony"], "*ELASTIC")[0].split(","))
    rows = np.array([[float(x) for x in row.split(",")] for row in below(texts["abaqus-prony"], "*VISCOELASTIC")])
    shear = young / (2.0 * (1.0 + poisson))
    assert_allclose(young / (3.0 * (1.0 - 2.0 * poisson)), 2e4, rtol=1e-9)
    assert rows[:, 0].sum() < 1.0
    assert (rows[:, 1] == 0.0).all()
    modulus = 1.0 - rows[:, 0].sum() + np.exp(-np.outer(TIMES, 1.0 / rows[:, 2])) @ rows[:, 0]
    assert_allclose(3.0 * shear * modulus, relaxation(TIMES, TAU_MAX), rtol=1e-9)


def test_ansys_prony_is_the_relaxation_modulus_in_commands_of_six_values(texts):
    commands = [line.split(",") for line in texts["ansys-prony"].splitlines() if not line.startswith("!")]
    constants = {row[1]: float(row[3]) for row in commands if row[0] == "MP"}
    data = [row for row in commands if row[0] == "TBDATA"]
    assert all(len(row) <= 8 for row in data)
    assert [int(row[1]) for row in data] == list(range(1, 101, 6))
    assert ["TB", "PRONY", "1", "", "50", "SHEAR"] in commands
    pairs = np.array([float(x) for row in data for x in row[2:]]).reshape(-1, 2)
    shear = constants["EX"] / (2.0 * (1.0 + constants["NUXY"]))
    modulus = 1.0 - pairs[:, 0].sum() + np.exp(-np.outer(TIMES, 1.0 / pairs[:, 1])) @ pairs[:, 0]
    assert_allclose(3.0 * shear * modulus, relaxation(TIMES, TAU_MAX), rtol=1e-9)


def test_ls_dyna_prony_has_eighteen_terms_at_most_in_ten_columns(texts):
    """Fewer modes: the area under E(t) to any time is met to 3e-6 (the refit) and seven digits (the columns)."""
    title, first, second, *rows = below(texts["ls-dyna-prony"], "*MAT_GENERAL_VISCOELASTIC", comment="$")
    assert title == "hdpe"
    assert columns(first, 10) == [1.0, 9.5e-10, 2e4]
    assert columns(second, 10) == [0.0]
    assert len(rows) <= 18
    assert all(len(row) == 20 for row in rows)
    terms = np.array([columns(row, 10) for row in rows])
    assert_allclose(terms[terms[:, 1] == 0.0, 0], [G])
    decaying = terms[terms[:, 1] > 0.0]
    times = TIMES[1:]
    area = 3.0 * (G * times + -np.expm1(-np.outer(times, decaying[:, 1])) @ (decaying[:, 0] / decaying[:, 1]))
    ratio = TAU_MAX * 10.0 ** (-np.arange(50) * 6.0 / 49.0)
    weight = np.sqrt(ratio) / np.sqrt(ratio).sum()
    wanted = 3.0 * G * times + (E_U - 3.0 * G) * -np.expm1(-np.outer(times, 1.0 / ratio)) @ (weight * ratio)
    assert_allclose(area, wanted, rtol=5e-6)


def law_curve(rate, strain):
    """Eq. (7), the closed form of a ramp, with tau_max of eq. (11)."""
    tau_max = ALPHA * (0.00464 * np.log10(rate) + 0.0367) / rate
    law = Law(unrelaxed_modulus=E_U, tau_max=tau_max, hardening_modulus=G)
    return probation.ramp_stress(law, rate, strain / rate)


def abaqus_curves(text):
    pieces = re.split(r"^\*PLASTIC", text, flags=re.MULTILINE)[1:]
    curves = []
    for piece in pieces:
        head, *rows = piece.splitlines()
        rate = float(head.partition("RATE=")[2] or 0.0)
        curves.append((rate, np.array([[float(x) for x in row.split(",")] for row in rows])[:, ::-1]))
    return curves


def ls_dyna_curves(text):
    rates = [float(row) for row in below(text, "*DEFINE_TABLE", "$")[1:]]
    pieces = re.split(r"^\*DEFINE_CURVE", text, flags=re.MULTILINE)[1:]
    curves = []
    for rate, piece in zip(rates, pieces, strict=True):
        _, *rows = [row for row in piece.strip().splitlines() if row[0] not in "$*"]
        assert all(len(row) == 40 for row in rows)
        curves.append((rate, np.array([columns(row, 20) for row in rows])))
    return curves


@pytest.mark.parametrize(("name", "read"), [("abaqus-plastic", abaqus_curves), ("ls-dyna-mat-024", ls_dyna_curves)])
def test_flow_curves_are_ramps_of_the_law_and_keep_the_rules_of_the_codes(texts, name, read):
    curves = read(texts[name])
    if name == "abaqus-plastic":  # first the one for rate 0
        assert curves[0][0] == 0.0
        assert (curves[0][1] == curves[1][1]).all()
        del curves[0]
    rates = [rate for rate, _ in curves]
    assert rates == sorted(set(rates))
    assert_allclose([rates[0], rates[-1]], [5e-5, 1e-2], rtol=1e-9)
    for rate, points in curves:
        plastic, stress = points.T
        assert plastic[0] == 0.0
        assert (np.diff(plastic) > 0.0).all()
        strain = plastic + stress / E_U
        assert_allclose(stress[1:], law_curve(rate, np.concatenate([[0.0], strain[1:]]))[1:], rtol=1e-4)
        assert_allclose(stress[0], law_curve(rate, np.array([0.0, strain[0] + 1e-4]))[1], rtol=1e-3)
    for (_, slow), (_, fast) in pairwise(curves):
        assert (fast[:, 0] == slow[:, 0]).all()
        assert (fast[:, 1] > slow[:, 1]).all()


@pytest.mark.parametrize("name", CURVES)
def test_the_round_trip_of_a_table_errs_by_no_more_than_its_yield_offset_and_its_tolerance(name):
    """Up to the first yield stress the code is elastic: E_u times the offset, 0.32 MPa; then 5e-4 of the largest."""
    check = export(LAW, name).checks[0]
    assert check.name == "round_trip"
    assert check.error <= 0.322 + 5e-4 * law_curve(1e-2, np.array([0.0, 1.5]))[1]


def test_the_material_card_of_mat_024_has_fields_of_ten_columns_and_asks_for_fine_curves(texts):
    title, first, second, *_ = below(texts["ls-dyna-mat-024"], "*MAT_PIECEWISE", comment="$")
    assert (title, columns(first, 10)[2]) == ("hdpe", E_U)
    assert_allclose(columns(first, 10)[3], 0.5 - E_U / 6.0 / 2e4, rtol=1e-6)  # (1 - E / 3K) / 2
    assert columns(second, 10) == [0.0, 0.0, 1000.0, 0.0, 1.0]
    assert columns(below(texts["ls-dyna-mat-024"], "*DEFINE_CURVE", comment="$")[0], 10)[-1] == 1000.0


def test_headers_are_comments_in_plain_ascii_and_tell_the_round_trip(texts):
    prefixes = {"abaqus": "**", "calculix": "**", "ansys": "!", "ls": "$"}
    for name, text in texts.items():
        assert text.isascii()
        assert "at most" in text
        prefix = prefixes.get(name.partition("-")[0])
        if prefix is not None:
            comments = [line for line in text.splitlines() if line.startswith(prefix)]
            assert len(comments) > 10
            assert max(map(len, text.splitlines())) <= (256 if name == "ansys-prony" else 120)
        if name in PRONY + CURVES:
            assert "left out" in text


def test_what_a_prony_series_leaves_out_is_told_at_this_and_other_rates():
    """tau_max constant in the table: ten times the rate gives ten times the flow stress; the law hardly more."""
    checks = {check.name: check for check in export(LAW, "abaqus-prony", rate=RATE, strain=0.3).checks}
    assert checks["round_trip"].relative < 1e-6
    assert checks["at_this_rate"].relative < 0.05
    assert checks["ten_times_faster"].relative > 1.0
    assert checks["ten_times_slower"].relative > 0.5


@pytest.mark.parametrize(
    ("value", "width"),
    [(3220.0, 10), (1.0 / 3.0, 20), (9.5e-10, 9), (107333.33333333333, 10), (-2.0e-308, 12), (1e22, 8), (0.0, 3)],
)
def test_a_number_is_written_as_precisely_as_its_field_allows(value, width):
    text = within(value, width)
    assert len(text) <= width
    assert "." in text
    assert_allclose(float(text), value, rtol=10.0 ** (4 - width))


RATIO = np.geomspace(1e-19, 1.0, 20)
SPARSE = Spectrum(RATIO, 1.0 / RATIO / np.sum(1.0 / RATIO))  # every decade flows alike: no mode can be spared

REFUSED = [
    (LAW, "abaqus-prony", {}, r"rate: found none, .* add --rate"),
    (CONSTANT, "abaqus-plastic", {}, r"rates: found none, .*a constant tau_max says nothing"),
    (
        Law(unrelaxed_modulus=E_U, hardening_modulus=G, companion=PowerLaw(1e-5, -1.3)),
        "ls-dyna-mat-024",
        {"rates": [1e-4, 1e-3]},
        r"rates: found less stress at 0\.001 than at 0\.0001 1/s \(at plastic strain .*\)",
    ),
    (
        Law(unrelaxed_modulus=30.0, tau_max=5.2, hardening_modulus=2.5),
        "abaqus-plastic",
        {"rates": [1e-3], "strain": 1.5},
        r"strain: found a plastic strain that falls on a ramp at 0\.001 1/s",
    ),
    (
        Law(unrelaxed_modulus=6.0, tau_max=5.2, hardening_modulus=2.5),
        "ansys-prony",
        {},
        r"hardening_modulus: found 2\.5 MPa, expected less than a third of E_u",
    ),
    (Law(unrelaxed_modulus=E_U, tau_max=5.2, hardening_modulus=0.0), "abaqus-prony", {}, r"sum to less than 1"),
    (
        Law(unrelaxed_modulus=E_U, hardening_modulus=G, companion=RateFunction(lambda rate: 0.03 / rate)),
        "calculix",
        {},
        r"companion: found the form 'function', expected .* weissenberg, exponential, power, table",
    ),
    (
        Law(unrelaxed_modulus=E_U, tau_max=5.2, hardening_modulus=G, modes=65),
        "c",
        {},
        r"modes: found 65, expected at most 64",
    ),
    (
        Law(unrelaxed_modulus=E_U, tau_max=5.2, hardening_modulus=G, spectrum=SPARSE),
        "ls-dyna-prony",
        {"accuracy": 1e-5},
        r"modes: found 20, expected at most 17",
    ),
    (LAW, "umat", {}, r"format is 'umat'; expected one of abaqus-umat"),
    (LAW, "c", {"name": "2 hdpe"}, r"name: found '2 hdpe'"),
    (LAW, "c", {"density": -1.0}, r"density: found -1\.0"),
    (LAW, "abaqus-plastic", {"rates": [1e-3, 1e-3]}, r"rates: found .* expected them increasing"),
    (LAW, "abaqus-plastic", {"bulk_modulus": 100.0}, r"bulk_modulus: found 100, expected more than E_u / 3"),
]


@pytest.mark.parametrize(("law", "name", "options", "complaint"), REFUSED)
def test_what_a_format_cannot_hold_is_refused_in_one_line(law, name, options, complaint):
    with pytest.raises(InputError, match=complaint) as caught:
        export(law, name, **options)
    assert "\n" not in str(caught.value)
