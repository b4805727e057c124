"""A law from ``--set NAME=VALUE`` and ``--companion FORM:NUMBERS``."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING

from probation.answers import PARAMETER_KEYS
from probation.commands.delivery import named_numbers
from probation.errors import InputError
from probation.histories.named import nearest
from probation.law.companion import Companion, Exponential, PowerLaw, Table, Weissenberg
from probation.law.modal import Law

if TYPE_CHECKING:
    from probation._arrays import FloatArray

_TWO_NUMBERS: dict[str, tuple[str, type[Weissenberg | Exponential | PowerLaw]]] = {
    "weissenberg": ("SLOPE,INTERCEPT", Weissenberg),
    "exponential": ("C,E", Exponential),
    "power": ("C,E", PowerLaw),
}
_FORMS = (*_TWO_NUMBERS, "table")
_NAMES = {key: name for name, key in PARAMETER_KEYS.items()}
_SETTABLE = (*_NAMES, "modes", "decades", "accuracy")


def add_law_options(parser: argparse.ArgumentParser) -> None:
    """Add ``--set`` and ``--companion``."""
    group = parser.add_argument_group("law")
    group.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="unrelaxed_modulus_MPa, hardening_modulus_MPa and tau_max_s (or, with --companion, alpha: 1 if left out); "
        "modes (50) and decades (6); accuracy: fewer modes, refitted; the stress errs by no more (1e-3: 9 modes)",
    )
    group.add_argument(
        "--companion",
        metavar="FORM:NUMBERS",
        help="tau_max from the strain rate: weissenberg:SLOPE,INTERCEPT (eq. 11: 0.00464,0.0367), "
        "exponential:C,E (eq. 12: 27.24,-2.1), power:C,E, or table:FILE with the headings rate_per_s,tau_max_s",
    )


def read_settings(entries: list[str]) -> dict[str, float]:
    """Values of ``--set`` by name.

    Raises
    ------
    InputError
        For an unknown name (suggesting the nearest) or what is no finite number.
    """
    values = named_numbers(entries, "--set")
    for name, value in values.items():
        if name not in _SETTABLE:
            raise InputError(f"--set: found the unknown name {name!r}; {nearest(name, _SETTABLE)}")
        if not math.isfinite(value):
            raise InputError(f"--set {name}: found {value}, expected a finite number")
    return values


def law_from_options(options: argparse.Namespace) -> Law:
    """The law that the options ask for.

    Raises
    ------
    InputError
        If a parameter is unknown, missing, superfluous or impossible.
    """
    values = read_settings(options.set)
    companion = None if options.companion is None else companion_from(options.companion)
    return make_law(values, companion)


def make_law(values: dict[str, float], companion: Companion | None) -> Law:
    """A law from parameters by their outside names.

    Raises
    ------
    InputError
        If a parameter is missing, superfluous or impossible.
    """
    if companion is not None and "tau_max_s" in values:
        raise InputError(
            "--set tau_max_s: found it together with --companion, expected alpha; tau_max comes from the companion"
        )
    if companion is None and "alpha" in values:
        raise InputError("--set alpha: found it without --companion, expected tau_max_s or a companion relation")
    needed = ["unrelaxed_modulus_MPa", "hardening_modulus_MPa", *(["tau_max_s"] if companion is None else [])]
    missing = [name for name in needed if name not in values]
    if missing:
        raise InputError(
            f"--set: found no {' and no '.join(missing)}, expected them; add "
            + " ".join(f"--set {name}=VALUE" for name in missing)
        )
    from probation.law.spectrum import spectrum_of  # noqa: PLC0415 - scipy is slow to load

    modes = values.get("modes", 50.0)
    if not modes.is_integer():
        raise InputError(f"--set modes: found {modes:g}, expected a whole number")
    decades, accuracy = values.get("decades", 6.0), values.get("accuracy")
    parameters = {_NAMES[key]: value for key, value in values.items() if key in _NAMES}
    return Law(
        unrelaxed_modulus=parameters["unrelaxed_modulus"],
        hardening_modulus=parameters["hardening_modulus"],
        tau_max=parameters.get("tau_max"),
        alpha=parameters.get("alpha"),
        decades=decades,
        companion=companion,
        spectrum=spectrum_of(int(modes), decades, accuracy),
    )


def companion_from(text: str) -> Companion:
    """``weissenberg:0.00464,0.0367`` to a companion relation.

    Raises
    ------
    InputError
        For an unknown form (suggesting the nearest), or numbers or a file that do not fit it.
    """
    form, _, rest = text.partition(":")
    if form not in _FORMS:
        raise InputError(f"--companion: found the unknown form {form!r}; {nearest(form, _FORMS)}")
    if form == "table":
        if not rest:
            raise InputError("--companion table: found no file, expected table:FILE")
        return _table_from(Path(rest))
    wanted, relation = _TWO_NUMBERS[form]
    try:
        first, second = (float(part) for part in rest.split(","))
    except ValueError:
        raise InputError(f"--companion {form}: found {rest!r}, expected {form}:{wanted}") from None
    if not (math.isfinite(first) and math.isfinite(second)):
        raise InputError(f"--companion {form}: found {rest!r}, expected finite numbers {form}:{wanted}")
    return relation(first, second)


def _table_from(path: Path) -> Table:
    """Rates and relaxation times from a file with the headings rate_per_s,tau_max_s."""
    from probation._complaint import bad_input, listed  # noqa: PLC0415 - only a table needs them
    from probation.records.opening import open_file  # noqa: PLC0415
    from probation.records.options import ReadOptions  # noqa: PLC0415

    table = open_file(path, ReadOptions())[2].tables[0]
    columns: dict[str, FloatArray] = {}
    for column in table.columns:
        label = column.label.strip().casefold()
        for name, headings in (("rate", ("rate", "strain_rate")), ("tau_max", ("tau_max",))):
            if label.startswith(headings):
                columns[name] = table.numbers(column)
    if len(columns) != 2:
        labels = listed((column.label for column in table.columns), "and")
        raise bad_input(path, f"the columns {labels}", "the headings rate_per_s,tau_max_s", row=table.header_row)
    try:
        return Table(tuple(columns["rate"].tolist()), tuple(columns["tau_max"].tolist()))
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
