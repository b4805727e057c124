"""The worker that the tests of this folder share."""

from collections.abc import Iterator

import pytest

from fuzz.pool import Workers


@pytest.fixture(scope="session")
def workers() -> Iterator[Workers]:
    """One process: these tests take one core."""
    with Workers(1) as started:
        yield started
