#pragma once
// All feedbacks of a record together: their memories, and their factors at a stress.

#include <memory>
#include <vector>

#include "probation/feedback.hpp"
#include "probation/law.hpp"

namespace probation {

/// Plastic work of a step, sigma (de - d sigma / E_u), exact for a stress that is straight in it.
template <class Real>
Real plastic_work(Real stress_next, Real stress_here, Real rise, Real modulus) {
  const Real mean_stress = 0.5 * (stress_here + stress_next);
  return mean_stress * (modulus > Real(0.0) ? rise - (stress_next - stress_here) / modulus : rise);
}

/// Which parameter of feedback k moves along the direction.
inline std::size_t moving_parameter(const Direction& direction, std::size_t k) {
  return direction.feedback == static_cast<Eigen::Index>(k) ? direction.feedback_parameter
                                                            : Feedback::no_parameter;
}

/// Step by step: enter() a step, ask at() for stresses at its end, settle() at the solution, differentiate
/// there if asked to, leave().
class FeedbackSet {
 public:
  explicit FeedbackSet(const std::vector<std::shared_ptr<const Feedback>>& feedbacks);

  /// Factors at the start of the record, where all memories are zero.
  FeedbackFactor<Dual> at_start(Dual stress) const;
  FeedbackFactor<Dual> at_start(Dual stress, const Direction& direction) const;

  void enter(double h, double stress_here, double rise, double modulus);
  /// Factors at a stress at the end of the step, with slopes along it. There must be a feedback.
  FeedbackFactor<Dual> at(double stress);
  /// Ends the step: the solution is the stress of the last call of at() plus `moved`.
  void settle(double moved);
  void leave();

  /// Derivatives of the memories and of the factors along one direction.
  struct Slopes {
    std::vector<double> memory, memory_next;
    FeedbackFactor<double> log_factor;  // d ln fluidity, d ln hardening
  };
  Slopes still() const;
  /// Prepares hold(): derivatives of the factors with respect to the memories.
  void differentiate(double stress);
  /// Derivatives at the end of the current step at a fixed stress there; `work` is that of the step.
  void hold(double stress, Dual work, const Direction& direction, Slopes& slopes) const;
  /// Adds what a change `moved` of the stress does.
  void release(double moved, Slopes& slopes) const;

 private:
  struct One {
    const Feedback* feedback = nullptr;
    double loss_rate = 0.0;
    double kept = 1.0, taken = 1.0;    // of the memory, and of the work, in a step of h_
    double memory = 0.0;               // at the beginning of the step
    Dual next;                         // at its end, with its slope along the stress
    FeedbackFactor<double> by_memory;  // d ln factor / d memory
  };
  std::vector<One> all_;
  double h_ = 0.0, stress_here_ = 0.0, rise_ = 0.0, compliance_ = 0.0;
};

}  // namespace probation
