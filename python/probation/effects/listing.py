"""The catalogue of effects, for people and for programs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.registry import effects

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation.effects.effect import Effect, EffectParameter


def catalogue_json(chosen: Iterable[Effect] | None = None) -> list[dict[str, object]]:
    """The effects as plain data: names, parameters, units, bounds, priors, physics, sources.

    Parameters
    ----------
    chosen : iterable of Effect, optional
        All if left out.
    """
    return [
        {
            "name": effect.name,
            "title": effect.title,
            "kind": effect.kind,
            "physics": effect.physics,
            "source": effect.source,
            "shows_in": effect.shows_in,
            "forms": [
                {
                    "name": form.name,
                    "placements": list(effect.placements(form)),
                    "parameters": [_parameter(parameter) for parameter in form.parameters],
                }
                for form in effect.forms
            ],
        }
        for effect in (effects() if chosen is None else chosen)
    ]


def catalogue_table(chosen: Iterable[Effect] | None = None) -> str:
    """The same as text."""
    lines: list[str] = []
    for effect in effects() if chosen is None else chosen:
        lines.append(f"{effect.name} ({effect.kind})")
        lines += [f"  {line}" for line in effect.physics.splitlines()]
        lines.append(f"  Shows in: {effect.shows_in}.")
        lines.append(f"  Source: {effect.source}.")
        for form in effect.forms:
            where = " or ".join(
                {"all": "all records", "one": "one record"}[placement] for placement in effect.placements(form)
            )
            lines.append(f"  {form.name}, in {where}:")
            for parameter in form.parameters:
                unit = f" {parameter.unit}" if parameter.unit else ""
                lines.append(
                    f"    {parameter.name}  {parameter.lower:g} to {parameter.upper:g}{unit}; "
                    f"{_prior(parameter)}: {parameter.reason}"
                )
        lines.append("")
    return "\n".join(lines)


def _parameter(parameter: EffectParameter) -> dict[str, object]:
    return {
        "name": parameter.name,
        "unit": parameter.unit,
        "bounds": [parameter.lower, parameter.upper],
        "prior": {
            "centre": parameter.centre,
            "scale": parameter.scale,
            "of_logarithm": parameter.log,
            "reason": parameter.reason,
        },
    }


def _prior(parameter: EffectParameter) -> str:
    if parameter.scale == float("inf"):
        return "any alike" if not parameter.log else "any alike in its logarithm"
    if parameter.log:
        return f"about {parameter.centre:g}, a factor of {2.718281828**parameter.scale:.2g} either way"
    return f"about {parameter.centre:g} ± {parameter.scale:g}"
