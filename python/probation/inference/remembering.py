"""A model that keeps its last answers, for refits that begin where another one ended."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.inference.model import CampaignModel

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.effect import ModificationHook, StrainHook
    from probation.effects.record_view import RecordView
    from probation.law.modification import Modification

KEPT = 4
"""Parameters whose answers are kept."""

MOST_OF_CAUSES = 200
"""Answers of single causes that are kept: then they are all forgotten."""


class RememberingModel(CampaignModel):
    """The same model in one search of one thread: what was worked out for the same parameters is not solved again.

    A refit of specimens that differ begins where one of specimens that are alike ended. Only the noise is another. A
    derivative along one cause changes nothing of the others, and is taken where a step has just ended.
    """

    def __init__(self, model: CampaignModel) -> None:
        super().__init__(model.law, model.views, model.causes)
        self._kept: dict[bytes, tuple[FloatArray, FloatArray]] = {}
        self._driven_views: dict[tuple[StrainHook, RecordView, tuple[float, ...]], RecordView] = {}
        self._changes: dict[tuple[ModificationHook, RecordView, tuple[float, ...]], Modification | None] = {}

    def residual(self, parameters: FloatArray) -> FloatArray:
        """As in `CampaignModel`."""
        known = self._kept.get(parameters.tobytes())
        return super().residual(parameters) if known is None else known[0].copy()

    def residual_and_jacobian(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """As in `CampaignModel`."""
        key = parameters.tobytes()
        known = self._kept.pop(key, None)
        if known is None:
            known = super().residual_and_jacobian(parameters)
            while len(self._kept) >= KEPT:
                del self._kept[next(iter(self._kept))]
        self._kept[key] = known  # the latest stays longest
        return known[0].copy(), known[1].copy()

    def _strained(self, hook: StrainHook, view: RecordView, values: tuple[float, ...]) -> RecordView:
        key = (hook, view, values)
        if key not in self._driven_views:
            if len(self._driven_views) >= MOST_OF_CAUSES:
                self._driven_views.clear()
            self._driven_views[key] = super()._strained(hook, view, values)
        return self._driven_views[key]

    def _changed(self, hook: ModificationHook, seen: RecordView, values: tuple[float, ...]) -> Modification | None:
        key = (hook, seen, values)
        if key not in self._changes:
            if len(self._changes) >= MOST_OF_CAUSES:
                self._changes.clear()
            self._changes[key] = super()._changed(hook, seen, values)
        return self._changes[key]
