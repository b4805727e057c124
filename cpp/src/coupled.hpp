#pragma once
// Laws whose times or hardening follow the current stress or plastic work: solved within every step, not
// with values of the step before.

#include <Eigen/Core>
#include <vector>

#include "coefficient_table.hpp"
#include "expansion.hpp"
#include "feedback_set.hpp"
#include "modal_group.hpp"
#include "record_steps.hpp"
#include "stress_continuation.hpp"

namespace probation {

/// State at the end of a step, with derivatives with respect to the stress there.
struct StepEnd {
  Dual relaxed_stress, fluidity;
  FeedbackFactor<Dual> factor;
  StepForcing<Dual> forcing;
};

/// A step that has been solved.
struct CoupledStep : StepEnd {
  Eigen::Index m = 0;
  double ratio = 1.0;   // h / h0
  double stress = 0.0;  // at its end, before the load-bearing area
};

/// Memory of a solve with feedbacks that the next solve reuses.
struct CoupledTables {
  CoefficientTable rational{false}, exponential{true};
};

/// One pass along a record with feedbacks. The unknown of a step is the stress at its end: given it, the
/// memories, the feedbacks' factors, the step's inputs and with them the modes follow in closed form, so that
/// one scalar Newton iteration solves the step for any number of modes and feedbacks. One sweep over
/// the modes per step is enough: the sweep that takes a step also forms the polynomial of the stress at the
/// end of the next one (ExpandedStep), around the scale that the next one is expected to have.
class CoupledSolver {
 public:
  /// `main` holds the initial states; with initial_modal_stress not relaxed, they are set here.
  CoupledSolver(const Law& law, const LawChange& change, const History& history, Scheme scheme, Start start,
                ModalGroup& main, CoupledTables& tables);

  /// Fills stress (n_times) and, if asked for, derivatives (n_times, directions); on entry they hold those of
  /// the extra modes.
  void solve(const RecordInputs<double>& base, const std::vector<Direction>& directions,
             Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix>* derivatives);

 private:
  friend class CoupledTangent;
  friend struct LinearisedStep;

  void begin(const RecordInputs<double>& base);
  /// Goes to step m, with a guess of the state at its end.
  StepEnd enter(Eigen::Index m);
  /// Everything but the modes, at a stress at the end of the step.
  StepEnd evaluate(double stress);
  /// Solves the step; the stress of the extra modes at its end is known.
  void solve_step(const StepEnd& guess, double extra_stress);
  bool iterate(double stress, StepEnd end, double extra_stress);
  void finish(const StepEnd& end, double stress, double correction, double by_forcing);
  /// Ends the step that has been solved: everything but its modes.
  void leave();
  /// Expands the step around a scale.
  bool look(double scale);
  CoefficientTable& table() { return expanded_.near.exponential ? tables_.exponential : tables_.rational; }
  bool given_start() const { return change_.initial_modal_stress.size() > 0; }
  [[noreturn]] void fail() const;

  const Law& law_;
  const LawChange& change_;
  const History& history_;
  Scheme scheme_;
  Start start_;
  ModalGroup& main_;
  CoupledTables& tables_;
  const kernels::Kernels& kernel_;
  double total_weight_, tolerance_ = 0.0;

  const RecordInputs<double>* base_ = nullptr;  // inputs without feedbacks
  double relaxed_start_ = 0.0;
  FeedbackSet feedbacks_;
  FeedbackFactor<Dual> begun_;   // at the start, with slopes along the stress
  StepData<double> strained_{};  // of the current step, from the strain
  StepData<Dual> data_{};        // with the feedbacks: tau_max and the relaxed stress alone
  double stiff_ = 0.0;           // the part of U that depends on the strain alone
  CoupledStep step_;
  double rise_ = 0.0, modulus_ = 0.0;              // of the strain in the step; E_u in its middle
  double law_relaxed_ = 0.0, law_fluidity_ = 0.0;  // at its end, without feedbacks
  double guess_ = 0.0, residual_ = 0.0;            // the stress at the end, and what is left at it
  ExpandedStep expanded_;
  StressContinuation continuation_;
  double stress_here_ = 0.0;
};

}  // namespace probation
