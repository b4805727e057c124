"""What `fit --json` wrote, as `export` reads it: any value of any type in any place."""

from __future__ import annotations

import copy
import json
from typing import TYPE_CHECKING, Any

from fuzz import odd
from fuzz.bytes_damage import damaged
from fuzz.case import Case
from fuzz.content import from_bytes

if TYPE_CHECKING:
    from random import Random

NAME, SHARE = "fit.json", 10

_CONSTANT = {
    "parameters": {"unrelaxed_modulus_MPa": 3220.0, "tau_max_s": 5.2, "hardening_modulus_MPa": 2.5},
    "modes": 12,
    "decades": 4.0,
    "companion": None,
}
_COMPANION = {
    "parameters": {"unrelaxed_modulus_MPa": 3220.0, "alpha": 1.045, "hardening_modulus_MPa": 1.85},
    "modes": 50,
    "decades": 6.0,
    "companion": {
        "form": "weissenberg",
        "slope": 0.00464,
        "intercept": 0.0367,
        "rate_floor_per_s": 1e-7,
        "calibrated_rates_per_s": [5e-5, 1e-2],
    },
}
_TABLE = {
    "parameters": {"unrelaxed_modulus_MPa": 3220.0, "alpha": 1.0, "hardening_modulus_MPa": 1.85},
    "modes": 3,
    "decades": 6.0,
    "companion": {
        "form": "table",
        "rates": [1e-4, 1e-3, 1e-2],
        "tau_max_s": [200.0, 30.0, 4.0],
        "rate_floor_per_s": 1e-7,
        "calibrated_rates_per_s": None,
    },
    "spectrum": {"relaxation_ratio": [0.001, 0.03, 1.0], "modal_weight": [0.1, 0.3, 0.6]},
}
LAWS = (_CONSTANT, _COMPANION, _TABLE)
_KEYS = (
    "beta",
    "",
    "form",
    "tau_max_s",
    "alpha",
    "unrelaxed_modulus",
    "rate_floor",
    "calibrated",
    "self",
    "\x1b[31m",
    "a b",
    "spectrum",
)
_TEXTS = (
    "", "{", "[]", "null", "nan", '"text"', "3", "[" * 20_000, '{"schema":' * 2_000, "{}", '{"schema": null}',
    '{"schema": "probation.fit/2"}', '{"schema": ["probation.fit/1"]}', '{"schema": {"a": 1}}', "9" * 5000,
    "\ufeff{}", '{"schema": "\\ud800"}', "{'schema': 1}", "x" * 100_000,
)  # fmt: skip
_FORMATS = (
    ("c",), ("abaqus-umat",), ("calculix",), ("mgis",), ("list",), ("abaqus-prony", "--rate", "1e-3"),
    ("ansys-prony", "--rate", "1e-3"), ("ls-dyna-prony", "--rate", "1e-3"),
    ("abaqus-plastic", "--rates", "1e-4,1e-2", "--strain", "1"),
    ("ls-dyna-mat-024", "--rates", "1e-4,1e-2", "--strain", "1"), ("c", "--accuracy", "1e-2"),
    ("mgis", "--json", "-"),
)  # fmt: skip


def answer(law: dict[str, Any]) -> dict[str, Any]:
    """What `fit --json` writes of a law, as far as `export` reads it."""
    return {"schema": "probation.fit/1", "version": "0.1.0", "campaign": "hdpe-7", "law": copy.deepcopy(law)}


def make(chance: Random) -> Case:
    """An answer with one to three values, keys or bytes that went wrong."""
    tree = answer(chance.choice(LAWS))
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        _change(tree, chance)
    text = json.dumps(tree, ensure_ascii=chance.random() < 0.5, indent=1)
    if chance.random() < 0.1:
        text = chance.choice(_TEXTS)
    data = text.encode(chance.choice(("utf-8",) * 9 + ("utf-16", "utf-8-sig")), "surrogatepass")
    if chance.random() < 0.1:
        data = damaged(data, chance)
    command = ("export", "fit-7.json", "--format", *chance.choice(_FORMATS))
    return Case(NAME, command, {"fit-7.json": from_bytes(data)})


def _change(tree: dict[str, Any], chance: Random) -> None:
    """Change one entry somewhere in a tree."""
    holders = list(_holders(tree))
    holder = chance.choice(holders)
    key = chance.choice(list(holder) if isinstance(holder, dict) else list(range(len(holder))))
    match chance.choice(("value",) * 6 + ("lost", "key", "more", "swap", "deep")):
        case "value":
            holder[key] = copy.deepcopy(chance.choice(odd.JSON_VALUES))
        case "lost":
            del holder[key]
        case "key" if isinstance(holder, dict):
            holder[chance.choice(_KEYS)] = holder.pop(key)
        case "more" if isinstance(holder, dict):
            holder[chance.choice(_KEYS)] = copy.deepcopy(chance.choice(odd.JSON_VALUES))
        case "more":
            holder += [holder[key]] * chance.choice((1, 100))
        case "swap":
            other = chance.choice(holders)
            if other is not tree and other is not holder:
                holder[key] = copy.deepcopy(other)
        case "deep":
            for _ in range(chance.choice((3, 100))):
                holder[key] = [holder[key]]


def _holders(tree: Any) -> Any:
    """Every table and list with something in it."""
    if isinstance(tree, dict | list) and tree:
        yield tree
        for value in tree.values() if isinstance(tree, dict) else tree:
            yield from _holders(value)
