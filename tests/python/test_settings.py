"""Constants of the statistics stand in one place, each with what a reader wants to know of it."""

import dataclasses
from pathlib import Path

import pytest

from probation.settings.page import GROUPS, modules_by_setting, settings_page

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("name", GROUPS)
def test_a_setting_says_unit_meaning_origin_and_source(name):
    for field in dataclasses.fields(GROUPS[name]):
        known = field.metadata
        assert known["meaning"].endswith((".", ")")), field.name
        assert known["unit"], field.name
        assert known["origin"] in {"derived", "chosen", "calibrated"}
        assert known["source"] or known["origin"] != "calibrated", field.name


def test_every_setting_is_used_and_every_name_that_is_used_is_a_setting():
    settings = {f"{name.upper()}.{field.name}" for name, group in GROUPS.items() for field in dataclasses.fields(group)}
    assert set(modules_by_setting()) == settings


@pytest.mark.parametrize("name", GROUPS)
def test_settings_are_frozen(name):
    field = dataclasses.fields(GROUPS[name])[0].name
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(GROUPS[name], field, 1.0)


def test_the_page_of_settings_is_what_they_say():
    """Else: ``python -m probation.settings.page > docs/settings.md``."""
    assert (ROOT / "docs/settings.md").read_text(encoding="utf-8") == settings_page()
