"""What tests of several files need."""

import pytest


@pytest.fixture(scope="module")
def cluster():
    """Two processes of one thread each, on a port of their own choice; no dashboard."""
    import distributed  # noqa: PLC0415 - slow to load

    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs="CRITICAL"
    ) as started:
        yield started
