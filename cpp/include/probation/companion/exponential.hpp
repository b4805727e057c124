#pragma once
// Companion relation, eq. (12): exponential in log10 of the rate.

#include "probation/companion.hpp"

namespace probation {

/// tau_max = coefficient exp(exponent log10(1000 r)), eq. (12); the paper has 27.24 s and -2.1.
class Exponential final : public CompanionRelation {
 public:
  Exponential(double coefficient, double exponent, double rate_floor = default_rate_floor)
      : CompanionRelation(rate_floor), coefficient_(coefficient), exponent_(exponent) {}

  double coefficient() const noexcept { return coefficient_; }  ///< [s]
  double exponent() const noexcept { return exponent_; }

  double log_slope(double) const override { return exponent_ / std::log(10.0); }

 private:
  double form(double rate) const override {
    return coefficient_ * std::exp(exponent_ * std::log10(1000.0 * rate));
  }

  double coefficient_;
  double exponent_;
};

}  // namespace probation
