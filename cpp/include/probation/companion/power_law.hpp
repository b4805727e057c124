#pragma once
// Companion relation: a power of the rate.

#include "probation/companion.hpp"

namespace probation {

/// tau_max = coefficient r^exponent; exponent -1 is a constant Weissenberg number.
class PowerLaw final : public CompanionRelation {
 public:
  PowerLaw(double coefficient, double exponent, double rate_floor = default_rate_floor)
      : CompanionRelation(rate_floor), coefficient_(coefficient), exponent_(exponent) {}

  double coefficient() const noexcept { return coefficient_; }  ///< [s], at 1 1/s
  double exponent() const noexcept { return exponent_; }

  double log_slope(double) const override { return exponent_; }

 private:
  double form(double rate) const override { return coefficient_ * std::pow(rate, exponent_); }

  double coefficient_;
  double exponent_;
};

}  // namespace probation
