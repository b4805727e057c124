#pragma once
// Companion relation, eq. (11): the Weissenberg number is linear in log10(rate).

#include "probation/companion.hpp"

namespace probation {

/// We = tau_max r = slope log10(r) + intercept, eqs. (10), (11).
class Weissenberg final : public CompanionRelation {
 public:
  Weissenberg(double slope, double intercept, double rate_floor = default_rate_floor)
      : CompanionRelation(rate_floor), slope_(slope), intercept_(intercept) {}

  double slope() const noexcept { return slope_; }
  double intercept() const noexcept { return intercept_; }

  double log_slope(double rate) const override {
    // tau = We / r, so d ln tau / d ln r = (dWe / d ln r) / We - 1.
    return slope_ / std::log(10.0) / weissenberg_number(rate) - 1.0;
  }

 private:
  double weissenberg_number(double rate) const { return slope_ * std::log10(rate) + intercept_; }
  double form(double rate) const override { return weissenberg_number(rate) / rate; }

  double slope_;
  double intercept_;
};

}  // namespace probation
