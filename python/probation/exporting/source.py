"""The law to export: from a fit, from what ``probation fit --json`` wrote, from a campaign, or as it is."""

from __future__ import annotations

from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from probation._complaint import quoted
from probation._files import read_json
from probation.errors import InputError
from probation.identify.fit import fit
from probation.identify.result import Fit
from probation.law.answer import law_from_answer
from probation.law.modal import Law
from probation.records.campaign import Campaign

if TYPE_CHECKING:
    from collections.abc import Mapping

SCHEMA = "probation.fit/1"
AS_GIVEN = "parameters as given"


def law_and_source(source: Law | Fit | Campaign | str | PathLike[str]) -> tuple[Law, str]:
    """A law, and where it comes from in words.

    Parameters
    ----------
    source : Law, Fit, Campaign, or path
        A campaign is identified; a path is that of a campaign or of the JSON that ``probation fit --json`` wrote.

    Raises
    ------
    InputError
        If a file is neither.
    """
    if isinstance(source, Law):
        return source, AS_GIVEN
    if isinstance(source, Fit):
        return source.law, _words(source.campaign, source.verdict)
    if isinstance(source, Campaign):
        return law_and_source(fit(source, gap=False))
    if not isinstance(source, str | PathLike):
        raise InputError(f"source: found {source!r}, expected a Law, a Fit, a Campaign or a path")
    path = Path(fspath(source))
    if path.suffix.lower() == ".json":
        return _read(path)
    return law_and_source(Campaign.load(path))


def _words(campaign: str, verdict: object) -> str:
    """Where a law comes from, and what its fit says of itself: a parameter may not be determined."""
    said = f": {verdict.removesuffix('.')}" if isinstance(verdict, str) and verdict else ""
    return f"identified on {campaign}{said}"


def _read(path: Path) -> tuple[Law, str]:
    answer = read_json(path, "what fit --json writes")
    schema = answer.get("schema") if isinstance(answer, dict) else None
    if schema != SCHEMA:
        found = "the schema " + quoted(schema) if isinstance(schema, str) else "no schema"
        raise InputError(f"{path}: found {found}, expected {SCHEMA!r}, as fit --json writes it")
    campaign = answer.get("campaign", path.stem)
    if not isinstance(campaign, str):
        raise InputError(f"{path}: campaign: found a value of type {type(campaign).__name__}, expected text")
    try:
        return law_from_answer(_law(answer)), _words(f"{campaign} ({path.name})", answer.get("verdict"))
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def _law(answer: Mapping[str, Any]) -> Mapping[str, Any]:
    if not isinstance(answer.get("law"), dict):
        raise InputError(
            "found no law (its modes and companion relation), expected one; fit again, or give the parameters by --set"
        )
    law: Mapping[str, Any] = answer["law"]
    return law
