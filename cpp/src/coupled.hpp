#pragma once
// Laws whose times or hardening follow the current stress or plastic work: solved within every step, not
// lagged.

#include <Eigen/Core>
#include <vector>

#include "modal_group.hpp"
#include "record_steps.hpp"

namespace probation {

class CoupledTangent;

/// A single step as the kernels take it; `s` and `ratio` must outlive it.
inline kernels::Steps one_step(const StepForcing<double>& s, const double& ratio) {
  const double* curvature = s.rule == StepRule::exponential ? &s.curvature : nullptr;
  return {s.rule, 1, false, &s.scale, &ratio, &s.forcing, curvature};
}

/// One pass along a record with feedbacks. The unknown of a step is the stress at its end: given it, the
/// memories, the shifts, the step's inputs and with them the modes follow in closed form, so that one scalar
/// Newton iteration solves the step for any number of modes and feedbacks. Tangents follow by the implicit
/// function theorem (coupled_tangent.hpp).
class CoupledSolver {
 public:
  /// `main` and `extra` hold the initial states; with initial_modal_stress not relaxed, main's are set here.
  CoupledSolver(const Law& law, const LawChange& change, const History& history, Scheme scheme, Start start,
                ModalGroup& main, ModalGroup& extra);

  /// Fills stress (n_times) and, if asked for, derivatives (n_times, directions).
  void solve(const RecordInputs<double>& base, const std::vector<Direction>& directions,
             Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix>* derivatives);

 private:
  friend class CoupledTangent;

  /// A step that has been solved.
  struct Step {
    Eigen::Index m;
    double ratio;                 // h / h0
    double stress;                // at its end, before the load-bearing area
    double by_stress;             // slope of Newton's residual there
    double extra_stress;          // of it, by the extra modes
    StepForcing<double> forcing;  // of the main modes
    StepForcing<double> extra;    // of the extra modes
    FeedbackShift<Dual> shift;    // at its end
  };

  void begin(const RecordInputs<double>& base);
  Step solve_step(Eigen::Index m);
  void take(const Step& step);

  /// Newton's residual of step m at a stress, with its slope; leaves the step's actual inputs in inputs_.
  Dual residual(Eigen::Index m, double stress, double extra_stress, StepForcing<Dual>& forcing,
                FeedbackShift<Dual>& now);
  FeedbackShift<Dual> start_shift(Dual stress, const Direction* direction) const;
  /// Shift at the end of a step of h seconds, and the memories there.
  FeedbackShift<Dual> shift(Dual stress_next, Dual stress_here, Dual rise, Dual modulus, double h,
                            const std::vector<Dual>& memory, const Direction* direction,
                            std::vector<Dual>& memory_next) const;
  bool given_start() const { return change_.initial_modal_stress.size() > 0; }

  const Law& law_;
  const LawChange& change_;
  const History& history_;
  Scheme scheme_;
  Start start_;
  ModalGroup& main_;
  ModalGroup& extra_;
  const kernels::Kernels& kernel_;
  double total_weight_;

  const RecordInputs<double>* base_ = nullptr;  // what the law gives
  RecordInputs<Dual> inputs_;                   // what the feedbacks make of it, up to the current instant
  RecordSteps<Dual> extra_steps_;
  std::vector<Dual> memory_, memory_next_;
  Dual previous_scale_, previous_forcing_;
  FeedbackShift<Dual> begun_;  // shift at the start, with its slope along the stress
  double stress_here_ = 0.0, stress_change_ = 0.0;
};

}  // namespace probation
