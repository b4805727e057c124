#pragma once
// The stress at the end of a step as a function of the step's inputs, near the scale of a cell of
// coefficients.

#include <cmath>

#include "coefficient_table.hpp"
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

/// sum_k row[k] e^k and its derivative in e; the latter needs fewer digits: Newton's iteration corrects it.
inline Dual polynomial(const double* row, double e) {
  static_assert(kernels::CoefficientRows::terms == 6);
  const double square = e * e;
  return {(row[0] + row[1] * e) + square * ((row[2] + row[3] * e) + square * (row[4] + row[5] * e)),
          row[1] + e * (2.0 * row[2] + 3.0 * row[3] * e)};
}

/// Sum of z_j at the end of a step, and its derivative with respect to U.
struct StressAtEnd {
  Dual stress;
  double by_forcing;
};

/// A step expanded around the scale of a cell; see kernels::NearStep.
struct ExpandedStep {
  const CoefficientCell* cell = nullptr;
  kernels::NearStep near{true, {}, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0};
  double unit = 1.0;  ///< 1 / a of a two-step rule
  kernels::StressNearby modes{};

  /// Sets the rule; the expansion of the modes must be formed again.
  void set(StepRule rule, double ratio) {
    cell = nullptr;
    if (rule == rule_ && (ratio == ratio_ || rule != StepRule::bdf2)) return;
    rule_ = rule;
    ratio_ = ratio;
    near.exponential = rule == StepRule::exponential;
    unit = near.here = 1.0;
    near.before = 0.0;
    if (rule != StepRule::bdf2) return;
    const Bdf2Difference a(ratio);
    unit = 1.0 / a.next;
    near.here = -a.here * unit;
    near.before = -a.before * unit;
  }
  /// Sets the cell of the rule's table.
  void set(const CoefficientCell* to) {
    cell = to;
    if (!cell) return;
    near.rows = cell->rows;
    near.quasi_steady = cell->quasi_steady;
  }
  bool reaches(double scale) const {
    return cell && std::abs(cell->distance(unit * scale)) <= kernels::CoefficientRows::reach;
  }
  /// Derivatives with respect to the stress are accurate to some digits only.
  StressAtEnd stress(const StepForcing<Dual>& step) const {
    const double per_scale = unit * cell->inverse_centre;
    const double e = step.scale.value * per_scale - 1.0, e_slope = step.scale.slope * per_scale;
    const Dual forced = polynomial(cell->by_forcing, e), state = polynomial(modes.sums, e);
    const double by_forcing = unit * forced.value;
    const double driven = by_forcing * step.forcing.value,
                 driven_slope =
                     by_forcing * step.forcing.slope + unit * forced.slope * step.forcing.value * e_slope;
    if (!near.exponential) return {{state.value + driven, state.slope * e_slope + driven_slope}, by_forcing};
    Dual sum{(modes.sums[kernels::StressNearby::kept] - step.scale.value * state.value) + driven,
             driven_slope - (step.scale.slope * state.value + step.scale.value * state.slope * e_slope)};
    if (near.rows.curvature) {
      const Dual curved = polynomial(cell->by_curvature, e);
      sum.value += step.curvature.value * curved.value;
      sum.slope += step.curvature.slope * curved.value + step.curvature.value * curved.slope * e_slope;
    }
    return {sum, by_forcing};
  }
  /// The step as an argument of the kernel.
  kernels::NearStep taken(const StepForcing<Dual>& step) const {
    kernels::NearStep s = near;
    s.distance = cell->distance(unit * step.scale.value);
    s.scale = step.scale.value;
    s.forcing = unit * step.forcing.value;
    s.curvature = step.curvature.value;
    return s;
  }

 private:
  StepRule rule_ = StepRule::exponential;
  double ratio_ = 0.0;
};

}  // namespace probation
