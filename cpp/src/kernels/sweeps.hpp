#pragma once
// The sweeps of one build; modal_sweep.cpp chooses among them.

#include "kernels.hpp"

namespace probation::kernels::PROBATION_ISA {

/// Even steps. A one-step rule leaves `before` as it was.
void even_sweep(const Modes&, const Steps&, double* stress);

/// Steps of any length; `before` is left one instant behind the state.
void uneven_sweep(const Modes&, const Steps&, double* stress);

void tangent_sweep(const Modes&, const Steps&, double* stress, const TangentDirection*, int directions,
                   double* scratch);

}  // namespace probation::kernels::PROBATION_ISA
