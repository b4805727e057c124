"""The page of all settings, docs/settings.md: ``python -m probation.settings.page > docs/settings.md``."""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import fields
from pathlib import Path
from typing import Any

from probation.settings.calibrated import CALIBRATED
from probation.settings.certificate import CERTIFICATE
from probation.settings.companion import COMPANION
from probation.settings.comparison import COMPARISON
from probation.settings.design import DESIGN
from probation.settings.detection import DETECTION
from probation.settings.effects import EFFECTS
from probation.settings.evidence import EVIDENCE
from probation.settings.field import FIELD
from probation.settings.identification import IDENTIFICATION
from probation.settings.noise import NOISE
from probation.settings.reading import READING
from probation.settings.remainder import REMAINDER
from probation.settings.search import SEARCH
from probation.settings.smoothing import SMOOTHING

GROUPS: dict[str, Any] = {
    "reading": READING,
    "smoothing": SMOOTHING,
    "detection": DETECTION,
    "effects": EFFECTS,
    "noise": NOISE,
    "evidence": EVIDENCE,
    "calibrated": CALIBRATED,
    "search": SEARCH,
    "remainder": REMAINDER,
    "design": DESIGN,
    "comparison": COMPARISON,
    "certificate": CERTIFICATE,
    "companion": COMPANION,
    "identification": IDENTIFICATION,
    "field": FIELD,
}
"""By the file in ``probation/settings``."""

_INTRODUCTION = """\
# Settings

Every constant on which a verdict, a probability or a reported size depends. They stand in
`python/probation/settings`, one frozen dataclass a subject, and the modules take them from there.
Constants of numerical methods (steps of difference quotients, limits of iterations, rounding) stay
where they are used.

Origin: *derived* from an argument, *calibrated* on data (which, it says), or *chosen* by judgement.
`python -m bench.ablation` solves and scores campaigns with other values (docs/ablation.md).
"""


def settings_page() -> str:
    """The page as Markdown."""
    parts, modules = [_INTRODUCTION], modules_by_setting()
    for name, group in GROUPS.items():
        rows = [
            f"| `{field.name}` | {_value(getattr(group, field.name))} | {field.metadata['unit']} | "
            f"{field.metadata['meaning']} | {_origin(field.metadata)} | "
            f"{', '.join(f'`{module}`' for module in modules[f'{name.upper()}.{field.name}'])} |"
            for field in fields(group)
        ]
        doc = type(group).__doc__ or ""
        heading = "| setting | value | unit | meaning | origin | used in |\n|---|---|---|---|---|---|"
        parts.append("\n".join([f"## `{name}`\n\n{doc}\n", heading, *rows, ""]))
    return "\n".join(parts)


def modules_by_setting() -> dict[str, list[str]]:
    """By group and name, as they stand in the sources: the modules of the library that use a setting."""
    package = Path(__file__).parents[1]
    setting = re.compile(rf"\b(?:{'|'.join(GROUPS).upper()})\.[a-z_0-9]+")
    modules = defaultdict(list)
    for path in sorted(package.rglob("*.py")):
        for name in sorted(set(setting.findall(path.read_text(encoding="utf-8")))):
            modules[name].append(path.relative_to(package).as_posix())
    return modules


def _value(value: float | str | tuple[Any, ...]) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_value, value))
    return value if isinstance(value, str) else f"{value:g}"


def _origin(known: Any) -> str:
    return f"{known['origin']}: {known['source']}" if known["source"] else str(known["origin"])


if __name__ == "__main__":
    print(settings_page(), end="")
