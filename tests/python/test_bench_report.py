"""Does the bench say what moved and what was reached?"""

import json
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).resolve().parents[2]))

from bench import from_source, machine, markdown, record
from bench.rows import Findings, Row
from bench.targets import GOALS, REQUIRED

from probation import _core


def found(**instructions: float) -> Findings:
    be2 = Row("forward", "ramp", "be2", "engine bE2", 20e-6, 19e-6, 0.1)
    numba = Row("forward", "ramp", "numba_be2", "numba", 600e-6, 590e-6, 0.1, ratios={"be2": 30.0})
    limit = Row("limit", "ramp", "be2", "engine bE2", 20e-6, 19e-6, 0.1, ratios={"limit": 1.25})
    return Findings(rows=[be2, numba, limit], instructions=dict(instructions))


@pytest.fixture
def results(tmp_path, monkeypatch):
    monkeypatch.setattr(record, "RESULTS", tmp_path)
    return tmp_path


def test_a_kernel_that_takes_more_instructions_than_recorded_is_named(results):
    here = machine.describe()
    record.write(found(one=2.0, two=3.0), here)
    lines = record.compare(found(one=2.02, two=3.09), here)  # 1 % and 3 % more; 2 % are noticeable
    assert "  +3.0% instructions: two" in lines
    assert not any("one" in line.split(":")[-1] for line in lines if "instructions:" in line)
    assert "  1 of 2 instruction counts within 2%" in lines


def test_a_run_without_counts_is_compared_by_its_times_alone(results):
    here = machine.describe()
    record.write(found(), here)
    assert "  no instruction counts were recorded then" in record.compare(found(one=2.0), here)
    assert not any("instruction" in line for line in record.compare(found(), here))


def test_the_table_has_a_line_for_every_target(results):
    lines = markdown.lines(found(), machine.describe())
    table = [line for line in lines if line.startswith("| ") and "| wanted |" not in line]
    assert len([line for line in table if "≥" in line or "≤" in line]) == len(GOALS) + len(REQUIRED)
    assert "| bE2 faster than numba, eq. (9) as printed | ≥ 20x | 30x | met |  |" in lines
    # 1 / 1.25 = 80 %
    assert any(
        line.startswith("| bE2 over its FMA limit | ≤ 1.6x | 1.25x | met | 80% of the FMA limit") for line in lines
    )


def test_a_recorded_run_tells_machine_and_flags(results):
    folder = record.write(found(), machine.describe())
    metadata = json.loads((folder / "metadata.json").read_text())
    assert metadata["kernels"].startswith(_core.kernel_build())
    assert metadata["compiler"] == _core.build_information()["compiler"]
    assert "-O" in metadata["flags"]
    assert set(metadata["kernel_flags"]) >= {_core.kernel_build()}


def test_the_steps_of_a_build_are_told_slowest_first():
    log = "# ninja log v6\n0\t500\t1\tquick.o\t0a\n10\t4010\t1\tslow.o\t0b\n"
    assert from_source.slowest(log, 5) == [(4.0, "slow.o"), (0.5, "quick.o")]
