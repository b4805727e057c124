#pragma once
// The stress at the end of a step as a function of the step's inputs, near the scale of a cell of coefficients.

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

/// sum_k row[k] e^k with its slope.
inline Dual polynomial(const double* row, Dual e) {
  double value = row[kernels::CoefficientRows::terms - 1], by_e = 0.0;
  for (int k = kernels::CoefficientRows::terms - 2; k >= 0; --k) {
    by_e = by_e * e.value + value;
    value = value * e.value + row[k];
  }
  return {value, by_e * e.slope};
}

/// A step whose modes have been looked at near the scale of a cell; see kernels::NearStep.
struct ExpandedStep {
  const CoefficientCell* cell = nullptr;
  kernels::NearStep near{true, {}, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0};
  double unit = 1.0;  ///< 1 / a of a two-step rule
  kernels::StressNearby modes{};

  /// Turns to a rule; nothing of its modes is known then.
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
  /// Turns to a cell of the rule's table.
  void set(const CoefficientCell* to) {
    cell = to;
    if (!cell) return;
    near.rows = cell->rows;
    near.slaved = cell->slaved;
  }
  bool reaches(const StepForcing<Dual>& step) const {
    return cell && std::abs(cell->distance(unit * step.scale.value)) <= kernels::CoefficientRows::reach;
  }
  /// How the stress follows the forcing U.
  Dual by_forcing(const StepForcing<Dual>& step) const {
    return unit * polynomial(cell->by_forcing, distance(step));
  }
  /// Sum of z_j at the end of the step.
  Dual stress(const StepForcing<Dual>& step, Dual by_forcing) const {
    const Dual e = distance(step), state = polynomial(modes.by_distance, e);
    const Dual driven = step.forcing * by_forcing;
    if (!near.exponential) return state + driven;
    Dual sum = Dual(modes.kept) - step.scale * state + driven;
    if (near.rows.curvature) sum = sum + step.curvature * polynomial(cell->by_curvature, e);
    return sum;
  }
  /// As the kernel takes it.
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

  Dual distance(const StepForcing<Dual>& step) const {
    const double per_scale = unit * cell->inverse_centre;
    return {step.scale.value * per_scale - 1.0, step.scale.slope * per_scale};
  }
};

}  // namespace probation
