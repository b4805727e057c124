"""A law as it leaves the program, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, fields
from typing import TYPE_CHECKING, Any

from probation._arrays import as_number, as_whole_number
from probation._complaint import quoted
from probation.answers import PARAMETER_KEYS
from probation.errors import InputError
from probation.law.companion import FORMS
from probation.law.modal import Law
from probation.law.spectrum import Spectrum

if TYPE_CHECKING:
    from probation.law.companion import Companion

_NAMES = {outside: inside for inside, outside in PARAMETER_KEYS.items()}
_COMPANION_NAMES = {"tau_max_s": "tau_max", "rate_floor_per_s": "rate_floor", "calibrated_rates_per_s": "calibrated"}


def law_answer(law: Law) -> dict[str, Any]:
    """Parameters, modes and companion relation, as JSON has them.

    ``spectrum`` is there only where the modes are not those of eqs. (4) and (5).
    """
    assert law.spectrum is not None
    answer: dict[str, Any] = {
        "parameters": {PARAMETER_KEYS[name]: getattr(law, name) for name in law.parameter_names},
        "modes": law.modes,
        "decades": law.decades,
        "companion": None if law.companion is None else _companion_answer(law.companion),
    }
    if law.spectrum != Spectrum.log_spaced(law.modes, law.decades):
        answer["spectrum"] = {
            "relaxation_ratio": law.spectrum.relaxation_ratio,
            "modal_weight": law.spectrum.modal_weight,
        }
    return answer


def law_from_answer(answer: object) -> Law:
    """The law that `law_answer` describes; further keys are left alone.

    Raises
    ------
    InputError
        Naming the key that is missing, or that holds what no law can have.
    """
    law = _table(answer, "law")
    parameters = _table(_entry(law, "law", "parameters"), "law.parameters")
    for key in parameters:
        if key not in _NAMES:
            raise InputError(f"law: found no {quoted(key)} that is known, expected what fit --json writes")
    for name in ("unrelaxed_modulus", "hardening_modulus"):
        _entry(parameters, "law.parameters", PARAMETER_KEYS[name])
    spectrum = _spectrum_from(law.get("spectrum"))
    modes = as_whole_number(_entry(law, "law", "modes"), "law.modes")
    if spectrum is not None and len(spectrum.modal_weight) != modes:
        raise InputError(
            f"law.modes: found {modes} together with a spectrum of {len(spectrum.modal_weight)}, expected as many"
        )
    return Law(
        **{_NAMES[key]: as_number(value, f"law.parameters.{key}") for key, value in parameters.items()},
        modes=modes,
        decades=as_number(_entry(law, "law", "decades"), "law.decades"),
        companion=_companion_from(_entry(law, "law", "companion")),
        spectrum=spectrum,
    )


def _companion_answer(companion: Companion) -> dict[str, object]:
    """The form and its parameters as campaign.toml has them, and the floor of the rate."""
    numbers = {
        PARAMETER_KEYS.get(name, name): value
        for name, value in vars(companion).items()
        if isinstance(value, float | tuple) and name not in ("rate_floor", "calibrated")
    }
    return {
        "form": companion.form,
        **numbers,
        "rate_floor_per_s": companion.rate_floor,
        "calibrated_rates_per_s": companion.calibrated,
    }


def _companion_from(answer: object) -> Companion | None:
    if answer is None:
        return None
    table = _table(answer, "law.companion")
    form = _entry(table, "law.companion", "form")
    if not isinstance(form, str) or form not in FORMS:
        raise InputError(f"law.companion.form: found {_shown(form)}, expected one of {', '.join(FORMS)}")
    relation: Any = FORMS[form]
    outside = {name: key for key, name in _COMPANION_NAMES.items()}
    known = {outside.get(declared.name, declared.name): declared for declared in fields(relation)}
    for key in table:
        if key not in known and key != "form":
            raise InputError(f"law.companion: found no {quoted(key)} that is known of the form {form}")
    values = {
        declared.name: _entry(table, "law.companion", key)
        for key, declared in known.items()
        if key in table or declared.default is MISSING
    }
    made: Companion = relation(
        **{name: tuple(value) if isinstance(value, list) else value for name, value in values.items()}
    )
    return made


def _spectrum_from(answer: object) -> Spectrum | None:
    if answer is None:
        return None
    table = _table(answer, "law.spectrum")
    return Spectrum(*(_entry(table, "law.spectrum", key) for key in ("relaxation_ratio", "modal_weight")))


def _table(value: object, place: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise InputError(f"{place}: found {_shown(value)}, expected a table, as fit --json writes it")
    return value


def _entry(table: Mapping[str, Any], place: str, key: str) -> Any:
    if key not in table:
        raise InputError(f"{place}: found no {key}, expected it, as fit --json writes it")
    return table[key]


def _shown(value: object) -> str:
    return quoted(value) if isinstance(value, str) else f"a value of type {type(value).__name__}"
