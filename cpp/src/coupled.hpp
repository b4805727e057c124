#pragma once
// Laws whose times or hardening follow the current stress or plastic work: solved within every step, not
// lagged.

#include <Eigen/Core>
#include <vector>

#include "expansion.hpp"
#include "feedback_set.hpp"
#include "modal_group.hpp"
#include "record_steps.hpp"
#include "stress_continuation.hpp"

namespace probation {

/// A step that has been solved, with slopes along the stress at its end.
struct CoupledStep {
  Eigen::Index m = 0;
  double ratio = 1.0;             // h / h0
  double stress = 0.0;            // at its end, before the load-bearing area
  Dual relaxed_stress, fluidity;  // there
  FeedbackFactor<Dual> factor;    // there
  StepForcing<Dual> forcing;
};

/// One pass along a record with feedbacks. The unknown of a step is the stress at its end: given it, the
/// memories, the feedbacks' factors, the step's inputs and with them the modes follow in closed form, so that
/// one scalar Newton iteration solves the step for any number of modes and feedbacks. The modes are passed
/// through once: near the step that is tried first, their stress is a polynomial (kernels::Expansion).
class CoupledSolver {
 public:
  /// `main` holds the initial states; with initial_modal_stress not relaxed, they are set here.
  CoupledSolver(const Law& law, const LawChange& change, const History& history, Scheme scheme, Start start,
                ModalGroup& main);

  /// Fills stress (n_times) and, if asked for, derivatives (n_times, directions); on entry they hold those of
  /// the extra modes.
  void solve(const RecordInputs<double>& base, const std::vector<Direction>& directions,
             Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix>* derivatives);

 private:
  friend class CoupledTangent;
  friend struct LinearisedStep;

  void begin(const RecordInputs<double>& base);
  /// Solves step m; the stress of the extra modes at its end is known.
  void solve_step(Eigen::Index m, double extra_stress);
  void take_step();
  void expand(const StepForcing<double>& tried);
  /// Factors at the end of a step, as their slopes along the stress and the fluidity's own drift have them.
  FeedbackFactor<double> continued_factor(double stress_change, double ratio) const;
  bool given_start() const { return change_.initial_modal_stress.size() > 0; }
  [[noreturn]] void fail(Eigen::Index m, double residual) const;

  const Law& law_;
  const LawChange& change_;
  const History& history_;
  Scheme scheme_;
  Start start_;
  ModalGroup& main_;
  const kernels::Kernels& kernel_;
  double total_weight_, tolerance_ = 0.0;

  const RecordInputs<double>* base_ = nullptr;  // what the law gives
  RecordInputs<double> inputs_;                 // what the feedbacks make of it, up to the current instant
  FeedbackSet feedbacks_;
  FeedbackFactor<Dual> begun_;  // at the start, with slopes along the stress
  CoupledStep step_;
  ExpandedStep expanded_;
  Eigen::ArrayXd rows_;
  StressContinuation continuation_;
  double stress_here_ = 0.0, fluidity_here_ = 1.0, fluidity_drift_ = 0.0;
};

}  // namespace probation
