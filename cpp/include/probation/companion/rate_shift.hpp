#pragma once
// A rate dependence on top of another one: what an effect adds to a law with or without a companion relation.

#include <memory>
#include <utility>

#include "probation/companion.hpp"
#include "probation/companion/forms.hpp"

namespace probation {

/// tau_max = base(r) exp(-exponent g(x) / g'(0)),
/// x = ln(r / reference_rate),  g = x - ln(1 + curvature x / ln 10).
///
/// It adds -exponent to d ln tau_max / d ln r at the reference rate. With curvature 0 it is a power
/// of the rate. For a law without companion relation the base is 1 s at every rate; the law's alpha then
/// holds tau_max at the reference rate, in s. With exponent g'(0) = 1 - curvature / ln 10 the Weissenberg
/// number is linear in log10(r) and changes by the fraction `curvature` per decade, eq. (11). Where 1 +
/// curvature x / ln 10 is below 0.05 its logarithm is continued by the tangent.
class RateShift final : public CompanionRelation {
 public:
  RateShift(std::shared_ptr<const CompanionRelation> base, double reference_rate, double exponent,
            double curvature, double rate_floor = default_rate_floor)
      : CompanionRelation(base ? base->rate_floor() : rate_floor),
        base_(std::move(base)),
        reference_rate_(reference_rate),
        exponent_(exponent),
        curvature_(curvature / log_of_ten) {
    if (!(reference_rate > 0.0) || !std::isfinite(reference_rate))
      throw InputError("reference_rate must be a positive number of 1/s");
    if (!std::isfinite(exponent)) throw InputError("exponent must be a finite number");
    if (!(curvature_ < 1.0) || !std::isfinite(curvature))
      throw InputError("curvature must be a number below ln 10");
  }

  double log_slope(double rate) const override {
    const double number = weissenberg_number(rate);
    const double slope = curvature_ / (number < least_number ? least_number : number);
    return (base_ ? base_->log_slope(rate) : 0.0) - exponent_ * (1.0 - slope) / (1.0 - curvature_);
  }

 private:
  static constexpr double least_number = 0.05;

  double weissenberg_number(double rate) const { return 1.0 + curvature_ * std::log(rate / reference_rate_); }
  double form(double rate) const override {
    const double number = weissenberg_number(rate);
    const double logarithm =
        number < least_number ? std::log(least_number) + number / least_number - 1.0 : std::log(number);
    const double shift = exponent_ * (std::log(rate / reference_rate_) - logarithm) / (1.0 - curvature_);
    return (base_ ? base_->relaxation_time(rate) : 1.0) * std::exp(-shift);
  }

  std::shared_ptr<const CompanionRelation> base_;
  double reference_rate_, exponent_, curvature_;
};

}  // namespace probation
