#pragma once
// The sweeps of one build, and the steps they take; modal_sweep.cpp chooses among them.

#include "kernels.hpp"

namespace probation::kernels::PROBATION_ISA {

/// Even steps by bE2 or the exponential rule, two at least; `before` is left one instant behind the state.
void even_sweep(const Modes&, const Steps&, double* stress);

/// Steps of any length; `before` is left one instant behind the state.
void uneven_sweep(const Modes&, const Steps&, double* stress);

/// Along any directions; states and slopes live in memory.
void general_tangent_sweep(const Modes&, const Steps&, double* stress, const TangentDirection* directions,
                           int count, double* scratch);

/// Along one in which the time scale alone moves, by one factor for all steps, which are even and two at
/// least.
void even_tangent_sweep(const Modes&, const Steps&, double* stress, const TangentDirection&);

/// Along one in which the time scale alone moves; uneven steps.
void time_tangent_sweep(const Modes&, const Steps&, double* stress, const TangentDirection&, double* scratch);

/// The fastest sweep that can take the steps.
void tangent_sweep(const Modes&, const Steps&, double* stress, const TangentDirection* directions, int count,
                   double* scratch);

/// See StepPasses.
bool form_two_step(const StepSamples&, const FormedSteps&);
bool form_straight(const StepSamples&, const FormedSteps&);
bool form_parabolic(const StepSamples&, const FormedSteps&);

/// See SamplePasses.
bool haward_thackray(const double* true_strain, std::int64_t count, double* result);
StepTraits inspect_steps(const double* time, std::int64_t count, double allowed_difference);
bool secant_changes(const double* time, const double* values, std::int64_t count, double least);
bool all_finite(const double* values, std::int64_t count);

/// See Whiten.
void whiten(const ColouredNoise&, double* values, std::int64_t columns, double* along);

}  // namespace probation::kernels::PROBATION_ISA
