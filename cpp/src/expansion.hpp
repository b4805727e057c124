#pragma once
// The polynomial of kernels::Expansion, evaluated with slopes.

#include <cmath>

#include "kernels/kernels.hpp"
#include "probation/schemes/forcing.hpp"

namespace probation {

/// A single step as the kernels take it; `s` and `ratio` must outlive it.
inline kernels::Steps one_step(const StepForcing<double>& s, const double& ratio) {
  const double* curvature = s.rule == StepRule::exponential ? &s.curvature : nullptr;
  return {s.rule, 1, false, &s.scale, &ratio, &s.forcing, curvature};
}

inline StepForcing<double> values(const StepForcing<Dual>& s) {
  return {s.rule, s.scale.value, s.forcing.value, s.curvature.value};
}

/// A step expanded at `tried`.
struct ExpandedStep {
  StepForcing<double> tried;
  kernels::Expansion at;

  Dual eta(const StepForcing<Dual>& step) const {
    const double inverse = 1.0 / (step.scale.value + tried.scale);
    return {(step.scale.value - tried.scale) * inverse,
            2.0 * tried.scale * inverse * inverse * step.scale.slope};
  }
  bool reaches(const StepForcing<Dual>& step) const {
    return step.rule == tried.rule && std::abs(eta(step).value) <= at.reach;
  }
  /// Sum of z_j at the end of a step nearby, with its slope.
  Dual stress(const StepForcing<Dual>& step) const {
    const Dual e = eta(step);
    const double u = step.forcing.value - tried.forcing, v = step.curvature.value - tried.curvature;
    double sum = 0.0, by_eta = 0.0, by_forcing = 0.0;
    for (int k = kernels::Expansion::terms - 1; k >= 0; --k) {
      by_eta = by_eta * e.value + sum;
      sum = sum * e.value + (at.stress[k] + u * at.by_forcing[k]);
      by_forcing = by_forcing * e.value + at.by_forcing[k];
    }
    const double rest = 1.0 - e.value;
    return {rest * sum + v * at.by_curvature, (rest * by_eta - sum) * e.slope +
                                                  rest * by_forcing * step.forcing.slope +
                                                  at.by_curvature * step.curvature.slope};
  }
  kernels::Nearby nearby(const StepForcing<double>& step) const {
    return {(step.scale - tried.scale) / (step.scale + tried.scale), step.forcing - tried.forcing,
            step.curvature - tried.curvature};
  }
};

}  // namespace probation
