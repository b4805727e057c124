#pragma once
// Single steps whose inputs depend on the stress at their end; declared where the table of a build is made.

#include "kernels.hpp"

namespace probation::kernels::PROBATION_ISA {

void look(const Modes&, const NearStep&, StressNearby& found);
void advance(const Modes&, const NearStep& taken, const NearStep* next, StressNearby& found);
StepSlopes linearise(const Modes&, const Steps&, double* rows);
double drift(const Modes&, const Steps&, const StepDirection&, const double* rows);
void move(const Modes&, const StepChange&, const StepDirection&, const double* rows);

}  // namespace probation::kernels::PROBATION_ISA
