#pragma once
// Laws whose times or hardening follow the current stress or plastic work: solved within every step, not
// lagged.

#include <Eigen/Core>
#include <vector>

#include "modal_group.hpp"
#include "record_steps.hpp"

namespace probation {

/// One pass along a record with feedbacks. The unknown of a step is the stress at its end: given it, the
/// memories, the shifts, the step's inputs and with them the modes follow in closed form, so that one scalar
/// Newton iteration solves the step for any number of modes and feedbacks. Tangents follow by the implicit
/// function theorem.
class CoupledSolver {
 public:
  /// `main` and `extra` hold the initial states; with initial_modal_stress not relaxed, main's are set here.
  CoupledSolver(const Law& law, const LawChange& change, const History& history, Scheme scheme, Start start,
                ModalGroup& main, ModalGroup& extra);

  /// Fills stress (n_times) and, if asked for, derivatives (n_times, directions).
  void solve(const RecordInputs<double>& base, const std::vector<Direction>& directions,
             Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix>* derivatives);

 private:
  struct Tangent;

  FeedbackShift<Dual> start_shift(Dual stress, const Direction* direction) const;
  FeedbackShift<Dual> shift(Dual stress_next, Dual stress_here, Dual rise, Dual modulus, double h,
                            const std::vector<Dual>& memory, const Direction* direction,
                            std::vector<Dual>& memory_next) const;

  const Law& law_;
  const LawChange& change_;
  const History& history_;
  Scheme scheme_;
  Start start_;
  ModalGroup& main_;
  ModalGroup& extra_;
};

}  // namespace probation
