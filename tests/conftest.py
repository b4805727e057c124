"""Makes tests/reference importable from every test, whatever the folder pytest was started in; spares long tests."""

import re
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

LONG = re.compile("test_(bench|catalogue_planted|compare|diagnose|diagnosis|one_answer|pages_in_a_browser)")
"""Files of whole diagnoses. A tracer takes two fifths of their time, and short tests reach most of the same lines."""


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    """Count no coverage in long tests."""
    plugin = item.config.pluginmanager.getplugin("_cov")
    tracer = getattr(plugin, "cov_controller", None) if LONG.match(item.path.name) else None
    if tracer is None:
        return (yield)
    tracer.pause()
    try:
        return (yield)
    finally:
        tracer.resume()
