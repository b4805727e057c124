"""A law as it leaves the program, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from probation.answers import PARAMETER_KEYS
from probation.errors import InputError
from probation.law.companion import FORMS
from probation.law.modal import Law, Spectrum

if TYPE_CHECKING:
    from collections.abc import Mapping

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


def law_from_answer(answer: Mapping[str, Any]) -> Law:
    """The law that `law_answer` told of.

    Raises
    ------
    InputError
        If a key is missing, or says what no law can have.
    """
    try:
        parameters = {_NAMES[key]: value for key, value in answer["parameters"].items()}
        spectrum = answer.get("spectrum")
        return Law(
            **parameters,
            modes=answer["modes"],
            decades=answer["decades"],
            companion=_companion_from(answer["companion"]),
            spectrum=None if spectrum is None else Spectrum(**spectrum),
        )
    except KeyError as missing:
        raise InputError(f"law: found no {missing.args[0]!r} that is known, expected what fit --json writes") from None
    except (TypeError, AttributeError) as wrong:
        raise InputError(f"law: found {' '.join(str(wrong).split())}, expected what fit --json writes") from None


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


def _companion_from(answer: Mapping[str, Any] | None) -> Companion | None:
    if answer is None:
        return None
    if answer["form"] not in FORMS:
        raise InputError(f"law: found the companion form {answer['form']!r}, expected one of {', '.join(FORMS)}")
    values = {
        _COMPANION_NAMES.get(key, key): tuple(value) if isinstance(value, list) else value
        for key, value in answer.items()
        if key != "form"
    }
    return FORMS[answer["form"]](**values)
