#pragma once
// Feedback: flow activated by a power of the stress (Norton 1929; Hutchinson 1976).

#include <cmath>

#include "probation/feedback.hpp"

namespace probation {

/// tau_max over 1 + (|s| / s0)^exponent, s the stress and s0 the activation stress [MPa].
struct PowerActivationForm {
  static constexpr std::size_t parameters = 2;  // activation_stress [MPa], exponent [-]

  template <class Real>
  static FeedbackFactor<Real> factor(const std::array<Real, parameters>& p, Real stress, Real) {
    const Real size = stress < 0.0 ? -stress : stress;
    if (!(size > 0.0)) return {};
    return {1.0 + pow(size / p[0], p[1]), 1.0};
  }
  template <class Real>
  static Real loss_rate(const std::array<Real, parameters>&) {
    return Real{};
  }
};

class PowerActivation final : public FormulaFeedback<PowerActivationForm> {
 public:
  PowerActivation(double activation_stress, double exponent)
      : FormulaFeedback({activation_stress, exponent}) {
    if (!(activation_stress > 0.0) || !std::isfinite(activation_stress))
      throw InputError("activation_stress must be a positive number of MPa");
    if (!(exponent >= 1.0) || !std::isfinite(exponent))
      throw InputError("exponent must be a number of at least 1");
  }
};

}  // namespace probation
