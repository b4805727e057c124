#pragma once
// Single steps whose inputs depend on the stress at their end; declared where the table of a build is made.

#include "kernels.hpp"

namespace probation::kernels::PROBATION_ISA {

void expand(const Modes&, const Steps&, Expansion& found, double* rows);
void take(const Modes&, StepRule, const Nearby&, const double* rows);
StepSlopes linearise(const Modes&, const Steps&, double* rows);
double drift(const Modes&, const Steps&, const StepDirection&, const double* rows);
void move(const Modes&, const StepChange&, const StepDirection&, const double* rows);

}  // namespace probation::kernels::PROBATION_ISA
