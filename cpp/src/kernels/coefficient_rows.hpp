#pragma once
// Coefficients of all modes near one scale; declared where the table of a build is made.

#include "kernels.hpp"

namespace probation::kernels::PROBATION_ISA {

void fill_rows(bool exponential, long count, const double* x, double* forcing, double* curvature,
               long stride);
void weigh_rows(const Modes&, const CoefficientRows&, double* by_forcing, double* by_curvature);

}  // namespace probation::kernels::PROBATION_ISA
