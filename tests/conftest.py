"""Makes tests/reference importable from every test, whatever the folder pytest was started in; spares long tests."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

LONG = {
    "test_catalogue_planted.py",
    "test_compare.py",
    "test_diagnose_large_faults.py",
    "test_diagnose_measured.py",
    "test_diagnose_outside.py",
    "test_diagnosis_calibration_check.py",
    "test_diagnosis_held_out.py",
    "test_diagnosis_paper.py",
    "test_diagnosis_search.py",
    "test_diagnosis_unknown.py",
    "test_one_answer.py",
    "test_pages_in_a_browser.py",
}
"""Files of whole diagnoses. A tracer takes a fifth of their time, and short tests reach the same lines."""


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    """Count no coverage in long tests."""
    plugin = item.config.pluginmanager.getplugin("_cov")
    tracer = getattr(plugin, "cov_controller", None) if item.path.name in LONG else None
    if tracer is None:
        return (yield)
    tracer.pause()
    try:
        return (yield)
    finally:
        tracer.resume()
