"""The constants of user materials: their order, their rules, and the law back from them."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest
from numpy.testing import assert_allclose

from probation import Exponential, InputError, Law, PowerLaw, Table, Weissenberg, export
from probation.exporting.constants import MaterialConstants
from probation.fe import MaterialPoint

E_U, G, ALPHA = 3220.0, 1.85, 1.045
LAW = Law(unrelaxed_modulus=E_U, alpha=ALPHA, hardening_modulus=G, companion=Weissenberg(0.00464, 0.0367))
CONSTANT = Law(unrelaxed_modulus=E_U, tau_max=5.2, hardening_modulus=2.5)


def numbers_under(text, keyword):
    """Texts of the numbers on each line below a keyword, to the next."""
    block = re.search(rf"^\{keyword}[^\n]*\n(.*?)(?=^\*)", text, re.MULTILINE | re.DOTALL)[1]
    return [[entry.strip() for entry in row.split(",")] for row in block.splitlines()]


EXPECTED = [E_U, G, 2e4, 1.0, ALPHA, 0.00464, 0.0367, 1e-7, 0.0, 50.0, 6.0]
"""The order of constants.hpp: E_u, G, K, form, alpha, slope, intercept, floor, filter, modes, decades."""


@pytest.mark.parametrize("name", ["abaqus-umat", "calculix"])
def test_user_material_cards_hold_eight_numbers_a_line_of_twenty_characters(name):
    text = export(LAW, name, bulk_modulus=2e4).text
    numbers = numbers_under(text, "*USER MATERIAL")
    assert [len(row) for row in numbers] == [8, 3]
    assert all("." in entry and len(entry) <= 20 for row in numbers for entry in row)
    assert [float(entry) for row in numbers for entry in row] == EXPECTED
    assert "CONSTANTS=11" in text
    assert numbers_under(text, "*DEPVAR") == [["310"]]  # 10 + 6 N


def test_the_name_that_calculix_loads_is_upper_case_without_an_underscore_in_the_library():
    assert re.search(r"^\*MATERIAL, NAME=@[A-Z]+_[A-Z]+$", export(LAW, "calculix").text, re.MULTILINE)


def test_mgis_properties_are_in_the_order_of_the_constants():
    answer = json.loads(export(LAW, "mgis", bulk_modulus=2e4).text)
    assert list(answer["material_properties"].values()) == EXPECTED
    assert list(answer["material_properties"])[4:8] == [
        "TauMaxOrAlpha",
        "FirstCoefficient",
        "SecondCoefficient",
        "RateFloor",
    ]
    assert (answer["internal_state_variables"], answer["compile_definitions"]) == (310, {})
    longer = json.loads(export(LAW, "mgis", modes=5).text)
    assert longer["compile_definitions"] == {"PROBATION_MGIS_CONSTANTS": 21, "PROBATION_MGIS_MODES": 50}
    assert list(longer["material_properties"])[-1] == "Kernel[9]"


def test_calculix_takes_twenty_one_constants_a_longer_list_is_compiled_in():
    assert "CONSTANTS=21\n" in export(LAW, "calculix", modes=5).text
    with pytest.raises(InputError, match=r"modes: found 23 constants, expected at most 21 in CalculiX; write .* list"):
        export(LAW, "calculix", modes=6)
    assert len(export(LAW, "list", modes=6).content.values) == 23


@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler")
def test_the_c_array_compiles_and_holds_every_digit(tmp_path):
    law = Law(unrelaxed_modulus=1.0 / 3.0, tau_max=1.0 / 7.0, hardening_modulus=1.0 / 9.0)
    export(law, "c", name="hdpe").save(tmp_path / "hdpe.h")
    export(law, "list").save(tmp_path / "hdpe.inc")
    program = (
        '#include <stdio.h>\n#include "hdpe.h"\nstatic const double list[] = {\n#include "hdpe.inc"\n};\n'
        "int main(void) {\n"
        '  for (int i = 0; i < hdpe_constants_count; ++i) printf("%.17g\\n", hdpe_constants[i]);\n'
        "  return hdpe_state_size != 310 || list[4] != hdpe_constants[4];\n}\n"
    )
    (tmp_path / "main.c").write_text(program, encoding="utf-8")
    subprocess.run(["cc", "-Werror", "-Wall", "-o", "main", "main.c"], cwd=tmp_path, check=True)
    done = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=True)
    numbers = [float(line) for line in done.stdout.split()]
    assert numbers[:2] == [1.0 / 3.0, 1.0 / 9.0]
    assert numbers[4] == 1.0 / 7.0


@pytest.mark.parametrize(
    "law",
    [
        CONSTANT,
        LAW,
        Law(unrelaxed_modulus=E_U, alpha=0.9, hardening_modulus=G, companion=Exponential(27.24, -2.1)),
        Law(unrelaxed_modulus=E_U, hardening_modulus=G, companion=PowerLaw(0.03, -0.95), modes=30, decades=5.0),
        Law(unrelaxed_modulus=E_U, hardening_modulus=G, companion=Table((1e-4, 1e-3, 1e-2), (180.0, 23.0, 2.7))),
    ],
    ids=["constant", "weissenberg", "exponential", "power", "table"],
)
@pytest.mark.parametrize("accuracy", [None, 1e-2])
def test_every_law_comes_back_from_its_constants(law, accuracy):
    found = export(law, "mgis", accuracy=accuracy)
    back, written = found.content.law(), found.request.law
    assert_allclose(back.parameters, written.parameters, rtol=0)
    assert back.spectrum == written.spectrum
    assert type(back.companion) is type(law.companion)
    if law.companion is not None:
        rates = np.geomspace(1e-9, 1.0, 20)
        rates = rates[rates > 1e-7]
        assert_allclose(back.companion.relaxation_time(rates), law.companion.relaxation_time(rates), rtol=1e-15)
    if accuracy is not None:
        assert found.content.named()["decades"] == 0.0
        assert len(found.content.values) == 11 + 2 * written.modes + (6 if isinstance(law.companion, Table) else 0)


def test_the_compiled_point_takes_the_constants():
    """To 1e-11 MPa of the scheme sa2, which is its own."""
    time = np.linspace(0.0, 100.0, 501)
    strain = np.interp(time, [0.0, 40.0, 80.0, 100.0], [0.0, 0.2, 0.5, 0.45])
    for law in (LAW, LAW.reduced(modes=7), CONSTANT):
        point, state, stress = MaterialPoint(export(law, "list").content.values), None, [0.0]
        for step, increment in zip(np.diff(time), np.diff(strain), strict=True):
            now, _, state = point.uniaxial(increment, step, state)
            stress.append(now)
        assert_allclose(stress, law.stress(time, strain, "sa2"), atol=1e-11)


def test_fewer_modes_state_their_error_and_keep_it():
    found = export(CONSTANT, "abaqus-umat", accuracy=1e-2)
    assert "5 modes for 50" in found.text.replace("\n**  ", "")
    assert found.checks[0].relative <= found.request.reduction.error <= 1e-2


def test_constants_that_are_no_list_of_a_law_are_refused():
    whole = MaterialConstants.of(LAW, 2e4).values
    for values, complaint in (
        (whole[:9], "found 9"),
        ((*whole, 1.0, 1.0), "found 13"),
        ((*whole[:3], 7.0, *whole[4:]), "7"),
    ):
        with pytest.raises(InputError, match=f"constants: .*{complaint}"):
            MaterialConstants(values).law()
