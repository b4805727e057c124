"""A model that keeps its last answers, for refits that begin where another one ended."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.inference.model import CampaignModel

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.model import CauseValues
    from probation.inference.own_force import OwnForce

KEPT = 4
"""Parameters whose answers are kept."""


class RememberingModel(CampaignModel):
    """The same model in one search of one thread: what was worked out for the same parameters is not solved again.

    A refit of specimens that differ begins where one of specimens that are alike ended: only the noise is another. And
    a search asks for its derivatives where it has just been: the force that balances frame and specimen is known.
    Unlike its base it keeps something between calls: one search has it for itself.
    """

    def __init__(self, model: CampaignModel) -> None:
        super().__init__(model.law, model.views, model.causes)
        self._kept: dict[bytes, tuple[FloatArray, FloatArray]] = {}
        self._last: dict[str, tuple[object, OwnForce]] = {}

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

    def balance(
        self, view: RecordView, base: FloatArray, causes: CauseValues, settled: float, near: OwnForce | None = None
    ) -> OwnForce:
        """As in `CampaignModel`."""
        asked = (view, base.tobytes(), causes, settled)
        known, force = self._last.get(view.id, (None, None))
        if force is None or known != asked:
            force = super().balance(view, base, causes, settled, near)
            self._last[view.id] = asked, force
        return force
