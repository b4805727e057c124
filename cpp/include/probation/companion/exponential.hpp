#pragma once
// Companion relation, eq. (12): exponential in log10 of the rate.

#include "probation/companion.hpp"
#include "probation/companion/forms.hpp"

namespace probation {

/// tau_max = coefficient exp(exponent log10(1000 r)), eq. (12); the paper has 27.24 s and -2.1.
class Exponential final : public CompanionRelation {
 public:
  Exponential(double coefficient, double exponent, double rate_floor = default_rate_floor)
      : CompanionRelation(rate_floor), form_{coefficient, exponent} {}

  double coefficient() const noexcept { return form_.coefficient; }  ///< [s]
  double exponent() const noexcept { return form_.exponent; }

  double log_slope(double rate) const override { return form_.log_slope(rate); }

 private:
  double form(double rate) const override { return form_.relaxation_time(rate); }

  ExponentialForm form_;
};

}  // namespace probation
