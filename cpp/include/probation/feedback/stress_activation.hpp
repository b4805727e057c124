#pragma once
// Feedback: flow activated by stress (Eyring 1936; Klompen et al. 2005).

#include <cmath>

#include "probation/feedback.hpp"

namespace probation {

/// tau_max times (s / s0) / sinh(s / s0), s the stress and s0 the activation stress [MPa].
struct StressActivationForm {
  static constexpr std::size_t parameters = 1;

  template <class Real>
  static FeedbackFactor<Real> factor(const std::array<Real, parameters>& p, Real stress, Real) {
    // sinh(x) / x is even; a series near zero, where the two exponentials cancel.
    const Real x = stress / p[0];
    const Real size = x < 0.0 ? -x : x;
    if (size < 0.05) {
      const Real x2 = x * x;
      return {1.0 + x2 * (1.0 / 6.0) * (1.0 + x2 * (1.0 / 20.0) * (1.0 + x2 * (1.0 / 42.0))), 1.0};
    }
    const Real grown = exp(size);
    return {0.5 * (grown - 1.0 / grown) / size, 1.0};
  }
  template <class Real>
  static Real loss_rate(const std::array<Real, parameters>&) {
    return Real{};
  }
};

class StressActivation final : public FormulaFeedback<StressActivationForm> {
 public:
  explicit StressActivation(double activation_stress) : FormulaFeedback({activation_stress}) {
    if (!(activation_stress > 0.0) || !std::isfinite(activation_stress))
      throw InputError("activation_stress must be a positive number of MPa");
  }
};

}  // namespace probation
