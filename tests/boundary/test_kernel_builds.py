"""The kernels exist in several builds: all give the same stress, and PROBATION_KERNELS chooses one or says why not."""

import os
import subprocess
import sys
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from probation import _core

PROGRAM = """
import sys
import numpy as np
import probation
from probation import Modification, _core
even = np.concatenate([np.linspace(0.0, 20.0, 400), 20.0 + np.cumsum(np.linspace(0.01, 0.2, 100))])
uneven = np.concatenate([[0.0], np.cumsum(np.random.default_rng(3).uniform(0.02, 0.04, 600))])
rows = []
for time in (even, uneven):
    strain = 0.006 * time + 0.01 * np.sin(0.3 * time)
    for modes in (1, 6, 29, 50):
        law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5, modes=modes)
        shifted = Modification(relaxation_time_factor=np.exp(0.5 * np.sin(time)))
        rows += [law.stress(time, strain, scheme) for scheme in ("be2", "sa2", "sa3")]
        rows += [law.stress(time, strain, scheme, modification=shifted) for scheme in ("be2", "sa2", "sa3")]
        rows += [column for scheme in ("be2", "sa3") for column in law.sensitivity(time, strain, scheme)[1].T]
np.savez(sys.argv[1], build=_core.kernel_build(), **{f"row{i}": row for i, row in enumerate(rows)})
"""


def _run(program, build, *arguments):
    environment = os.environ | {"PROBATION_KERNELS": build}
    return subprocess.run(
        [sys.executable, "-c", program, *arguments], env=environment, capture_output=True, text=True, check=False
    )


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """build -> what PROGRAM finds with it, solved once."""
    folder = tmp_path_factory.mktemp("builds")

    @cache
    def find(build):
        file = folder / f"{build}.npz"
        done = _run(PROGRAM, build, str(file))
        assert done.returncode == 0, done.stderr
        return dict(np.load(file))

    return find


@pytest.mark.parametrize("build", ["portable", "baseline", "v3"])
def test_a_named_build_runs_and_gives_what_plain_cpp_gives(solved, build):
    """To 1e-12 of the largest: the builds differ in how they add and round."""
    for needed in (build, "portable"):
        refused = _run("import probation; probation.Law", needed)
        if refused.returncode != 0:
            assert f"PROBATION_KERNELS is '{needed}'" in refused.stderr
            pytest.skip(f"{needed}: not for this processor, or not built (portable comes with the C++ tests)")
    found, plain = solved(build), solved("portable")
    assert str(found.pop("build")) == build
    assert len(found) == 96
    for name, row in found.items():
        assert_allclose(row, plain[name], rtol=0.0, atol=1e-12 * np.abs(plain[name]).max())


def test_an_unknown_build_stops_the_import_and_names_the_choices():
    done = _run("import probation; probation.Law", "avx1024")
    assert done.returncode != 0
    last = done.stderr.strip().splitlines()[-1]
    assert "PROBATION_KERNELS is 'avx1024'" in last
    assert _core.kernel_build() in last
    assert "\n" not in last


def test_the_best_build_is_taken_where_none_is_named():
    done = _run("from probation import _core; print(_core.kernel_build())", "")
    assert done.returncode == 0
    assert done.stdout.strip() in ("portable", "baseline", "v3")
    if "PROBATION_KERNELS" not in os.environ:
        assert done.stdout.strip() == _core.kernel_build()
