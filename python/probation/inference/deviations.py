"""What a specimen that differs does to the stress that a model predicts: one column for each way of differing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.inference.parameter import SYMBOLS, outside_name
from probation.inference.wrapped_law import WrappedLaw

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.inference.protocol import GapLaw

AREA, START = "area", "strain_offset"
"""What else differs from specimen to specimen: the section, and the strain at which the specimen is first loaded."""

TITLES = {outside_name(name): symbol for name, symbol in SYMBOLS.items()}
TITLES |= {AREA: "the section", START: "the start of the strain"}
"""Deviations for people."""

_KNOWN = {
    "unrelaxed_modulus_MPa": "unrelaxed_modulus",
    "tau_max_s": "tau",
    "alpha": "tau",
    "hardening_modulus_MPa": "hardening_modulus",
    AREA: AREA,
    START: START,
}

_STEP = 1e-6
"""Strain over which the start is shifted for a difference quotient [-]."""


def deviation_names(law: GapLaw) -> tuple[str, ...]:
    """What specimens may differ in: the law's parameters, held ones too, the section and the start of the strain."""
    return (*_material(law, law.start)[0], AREA, START)


def kind_of_deviation(name: str) -> str:
    """Which of `records.specimens.DEVIATIONS` states its size; of another law's parameter, by its unit."""
    return _KNOWN.get(name, "tau" if name.endswith("_s") else "unrelaxed_modulus")


def deviation_columns(model: CampaignModel, parameters: FloatArray) -> list[FloatArray]:
    """Change of each record's stress by deviations of 1, by record; each of shape (n_samples, n_deviations) [MPa].

    Deviations of parameters and of the section are relative; that of the start is the strain at which the specimen
    begins to be strained.

    Parameters
    ----------
    model : CampaignModel
        With the causes that act.
    parameters : ndarray, shape (n_parameters,)
    """
    law, base = _whole(model.law, parameters[: model.base_count])
    whole = CampaignModel(law, model.views, model.causes)
    values = np.append(base, parameters[model.base_count :])
    residual, slopes = whole.residual_and_jacobian(values)
    stress = residual + whole.data
    late = [view.driven(_late(view.true_strain, view.stride)) for view in whole.views]
    shifted = np.concatenate([whole.moved(*views, values) for views in zip(whole.views, late, strict=True)])
    count = len(_material(law, base)[0])
    columns = np.column_stack([slopes[:, :count] * np.abs(base[:count]), stress, shifted / _STEP])
    return [columns[rows] for _, rows in model.parts]


def _late(true_strain: FloatArray, stride: int) -> FloatArray:
    """The strain of a specimen that begins to be strained a little later, from the first sample to the second."""
    return true_strain - _STEP * np.minimum(np.arange(len(true_strain)) / stride, 1.0)


def _material(law: GapLaw, parameters: FloatArray) -> tuple[tuple[str, ...], FloatArray]:
    """Names and values of all parameters of the material, held or not; without those of a law around its law."""
    while isinstance(law, WrappedLaw):
        parameters = parameters[: len(law.law.parameter_names)]
        law = law.law
    whole, values = _whole(law, parameters)
    return whole.parameter_names, values


def _whole(law: GapLaw, parameters: FloatArray) -> tuple[GapLaw, FloatArray]:
    """The law with no parameter held, and all its parameters: specimens differ in what is held, too."""
    if isinstance(law, WrappedLaw):
        count = len(law.law.parameter_names)
        inner, values = _whole(law.law, parameters[:count])
        return law.around(inner), np.append(values, parameters[count:])
    if isinstance(law, DnlrLaw):
        return DnlrLaw(law.law), law.law_at(parameters).parameters
    return law, parameters
