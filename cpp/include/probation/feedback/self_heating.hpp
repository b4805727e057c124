#pragma once
// Feedback: plastic work warms the specimen (Taylor & Quinney 1934; Arruda, Boyce & Jayachandran 1995).

#include <cmath>

#include "probation/feedback.hpp"

namespace probation {

/// A rise of temperature T = heating w, w the plastic work that has not yet left: tau_max times e^(-softening
/// T), sigma^r times e^(-hardening_loss T).
struct SelfHeatingForm {
  static constexpr std::size_t parameters =
      4;  // heating [degC/MPa], cooling_rate [1/s], softening, hardening_loss [1/degC]

  template <class Real>
  static FeedbackFactor<Real> factor(const std::array<Real, parameters>& p, Real, Real memory) {
    const Real rise = p[0] * memory;
    return {exp(p[2] * rise), exp(-p[3] * rise)};
  }
  template <class Real>
  static Real loss_rate(const std::array<Real, parameters>& p) {
    return p[1];
  }
};

class SelfHeating final : public FormulaFeedback<SelfHeatingForm> {
 public:
  SelfHeating(double heating, double cooling_rate, double softening, double hardening_loss)
      : FormulaFeedback({heating, cooling_rate, softening, hardening_loss}) {
    if (!(cooling_rate >= 0.0))
      throw InputError("cooling_rate must be zero (adiabatic) or a positive number of 1/s");
    constexpr const char* names[] = {"heating", "cooling_rate", "softening", "hardening_loss"};
    for (std::size_t i = 0; i < SelfHeatingForm::parameters; ++i)
      if (!std::isfinite(values()[i])) throw InputError(std::string(names[i]) + " must be a finite number");
  }
};

}  // namespace probation
