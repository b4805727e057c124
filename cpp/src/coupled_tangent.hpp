#pragma once
// Sensitivities of a pass with feedbacks, step by step along with it, by the implicit function theorem: first
// the derivatives along the direction at a fixed stress at the end of the step, then the change of the stress
// that keeps the residual zero, and what follows from that change.

#include <Eigen/Core>
#include <vector>

#include "coupled.hpp"

namespace probation {

/// What is the same for all directions in a step that the pass has solved.
struct LinearisedStep {
  explicit LinearisedStep(Eigen::Index padded) : rows(5 * padded) {}
  void at(CoupledSolver& pass);

  Eigen::ArrayXd rows;
  StepForcing<double> forcing;
  kernels::StepSlopes slopes{};
  kernels::StepChange by_stress{};  // how scale, U and V follow the stress
  double residual_by_stress = 0.0;
};

/// Everything of one direction that is kept from step to step, as slopes.
class CoupledTangent {
 public:
  CoupledTangent(const CoupledSolver& pass, const Direction& direction);

  /// Slope of the stress at the start.
  double start_slope() const { return d_stress_; }

  /// Slope of the stress at the end of the step; that of the extra modes is known.
  double take(const LinearisedStep& linearised, double extra);

 private:
  const CoupledSolver& pass_;
  const Direction& direction_;
  double d_weight_;            // of all modal weights together
  RecordInputs<Dual> inputs_;  // actual ones (feedbacks included) up to the current instant
  FeedbackSet::Slopes feedback_;
  StepForcing<Dual> previous_;
  double d_stress_;
  Eigen::ArrayXd state_, before_, log_inverse_, weight_;
};

}  // namespace probation
