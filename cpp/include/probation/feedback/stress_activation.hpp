#pragma once
// Feedback: flow activated by stress (Eyring 1936; Klompen et al. 2005).

#include <cmath>

#include "probation/feedback.hpp"

namespace probation {

/// tau_max times (s / s0) / sinh(s / s0), s the stress and s0 the activation stress [MPa].
struct StressActivationForm {
  static constexpr std::size_t parameters = 1;

  template <class Real>
  static FeedbackShift<Real> shift(const std::array<Real, parameters>& p, Real stress, Real) {
    const Real x = stress / p[0];
    // ln(x / sinh x) is even; a series near zero, and no overflow far from it.
    const Real x2 = x * x;
    const Real size = x < 0.0 ? -x : x;
    Real shift{};
    if (size < 0.05)
      shift = -x2 / 6.0 * (1.0 - x2 / 30.0 * (1.0 - x2 * (4.0 / 63.0)));
    else
      shift = log(2.0 * size) - size - log(1.0 - exp(-2.0 * size));
    return {shift, Real{}};
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
