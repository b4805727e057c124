#pragma once
// Companion relation: a power of the rate.

#include "probation/companion.hpp"
#include "probation/companion/forms.hpp"

namespace probation {

/// tau_max = coefficient r^exponent; exponent -1 is a constant Weissenberg number.
class PowerLaw final : public CompanionRelation {
 public:
  PowerLaw(double coefficient, double exponent, double rate_floor = default_rate_floor)
      : CompanionRelation(rate_floor), form_{coefficient, exponent} {}

  double coefficient() const noexcept { return form_.coefficient; }  ///< [s], at 1 1/s
  double exponent() const noexcept { return form_.exponent; }

  double log_slope(double rate) const override { return form_.log_slope(rate); }

 private:
  double form(double rate) const override { return form_.relaxation_time(rate); }

  PowerLawForm form_;
};

}  // namespace probation
