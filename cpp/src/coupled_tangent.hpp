#pragma once
// Sensitivities of a pass with feedbacks, along one direction, step by step beside it.

#include <Eigen/Core>
#include <vector>

#include "coupled.hpp"

namespace probation {

/// Everything of one direction that is kept from step to step, with its slope; modes in unit-weight states.
class CoupledTangent {
 public:
  /// `unit` holds the unit-weight states of the pass at its start.
  CoupledTangent(const CoupledSolver& pass, const Direction& direction, const ModalGroup& unit);

  /// Slope of the stress at the start.
  double start_slope() const { return stress_.slope; }

  /// Slope of the stress at the end of a step that the pass has solved; `unit` and `unit_extra` are the
  /// states before it, scratch has 9 entries per mode.
  double take(const CoupledSolver::Step& step, const ModalGroup& unit, const ModalGroup& unit_extra,
              Eigen::ArrayXd& scratch);

 private:
  /// The slope that the step has if the stress at its end moves by `moved`; the new states go to next_*.
  double follow(const CoupledSolver::Step& step, double moved, const ModalGroup& unit,
                Eigen::ArrayXd& scratch);
  double follow_extra(const CoupledSolver::Step& step, const ModalGroup& unit_extra, Eigen::ArrayXd& scratch);

  const CoupledSolver& pass_;
  const Direction& direction_;
  double d_weight_;            // of all modal weights together
  RecordInputs<Dual> inputs_;  // actual ones (shifts included) up to the current instant
  RecordSteps<Dual> extra_steps_;
  std::vector<Dual> memory_, next_memory_;
  Dual stress_;
  StepForcing<Dual> previous_, next_;
  FeedbackShift<Dual> next_shift_;
  Dual law_relaxed_, law_fluidity_;  // of the current step, before the feedbacks
  ModalGroup unit_, unit_extra_;     // copies that the kernel may advance
  Eigen::ArrayXd state_, before_, next_state_, next_before_, log_inverse_, weight_;
  Eigen::ArrayXd extra_state_, extra_before_, extra_log_inverse_, extra_weight_;
};

}  // namespace probation
