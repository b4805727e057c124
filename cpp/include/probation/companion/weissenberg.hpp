#pragma once
// Companion relation, eq. (11): the Weissenberg number is linear in log10(rate).

#include "probation/companion.hpp"
#include "probation/companion/forms.hpp"

namespace probation {

/// We = tau_max r = slope log10(r) + intercept, eqs. (10), (11).
class Weissenberg final : public CompanionRelation {
 public:
  Weissenberg(double slope, double intercept, double rate_floor = default_rate_floor)
      : CompanionRelation(rate_floor), form_{slope, intercept} {}

  double slope() const noexcept { return form_.slope; }
  double intercept() const noexcept { return form_.intercept; }

  double log_slope(double rate) const override { return form_.log_slope(rate); }

 private:
  double form(double rate) const override { return form_.relaxation_time(rate); }
  void forms(const double* rate, double* time, std::size_t count) const override;  // in companion.cpp

  WeissenbergForm form_;
};

}  // namespace probation
