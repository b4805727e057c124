"""The table of what the settings earn takes away settings that there are."""

import pytest
from bench.ablation import TAKEN_AWAY

from probation.settings.page import GROUPS


@pytest.mark.parametrize("group", TAKEN_AWAY)
def test_every_setting_that_is_taken_away_exists(group):
    for name in TAKEN_AWAY[group]:
        place, setting = name.split(".")
        assert hasattr(GROUPS[place], setting), name
