"""Where a simulation departs from reality, which effect causes it, and how far the gap shrinks with it."""

from probation.gap.alteration import NOTIONS, Alteration, InitialStress, RateShift
from probation.gap.callable_law import CallableLaw, maxwell_bar
from probation.gap.catalogue import catalogue_json, catalogue_table
from probation.gap.cause import Cause, cause
from probation.gap.dnlr_law import DnlrLaw
from probation.gap.effect import Effect, EffectParameter, Form
from probation.gap.model import CampaignModel
from probation.gap.protocol import GapLaw
from probation.gap.record_view import RecordView, view_of, views_of
from probation.gap.registry import effect, effects, register, unregister
from probation.gap.screen import Column, screen

__all__ = [
    "NOTIONS",
    "Alteration",
    "CallableLaw",
    "CampaignModel",
    "Cause",
    "Column",
    "DnlrLaw",
    "Effect",
    "EffectParameter",
    "Form",
    "GapLaw",
    "InitialStress",
    "RateShift",
    "RecordView",
    "catalogue_json",
    "catalogue_table",
    "cause",
    "effect",
    "effects",
    "maxwell_bar",
    "register",
    "screen",
    "unregister",
    "view_of",
    "views_of",
]
