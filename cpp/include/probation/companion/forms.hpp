#pragma once
// The formulas of the companion relation, eqs. (10)-(12): plain functions of numbers, without checks. The
// classes of companion/ and the material point both call these.

#include <algorithm>
#include <cmath>

namespace probation {

constexpr double log_of_ten = 2.302585092994045684;  // d ln / d log10

/// We = tau_max r = slope log10(r) + intercept, eqs. (10), (11).
struct WeissenbergForm {
  double slope, intercept;

  double weissenberg_number(double rate) const noexcept { return slope * std::log10(rate) + intercept; }
  double relaxation_time(double rate) const noexcept { return weissenberg_number(rate) / rate; }
  /// tau = We / r, so d ln tau / d ln r = (dWe / d ln r) / We - 1.
  double log_slope(double rate) const noexcept { return slope / log_of_ten / weissenberg_number(rate) - 1.0; }
};

/// tau_max = coefficient exp(exponent log10(1000 r)), eq. (12).
struct ExponentialForm {
  double coefficient, exponent;

  double relaxation_time(double rate) const noexcept {
    return coefficient * std::exp(exponent * std::log10(1000.0 * rate));
  }
  double log_slope(double) const noexcept { return exponent / log_of_ten; }
};

/// tau_max = coefficient r^exponent.
struct PowerLawForm {
  double coefficient, exponent;

  double relaxation_time(double rate) const noexcept { return coefficient * std::pow(rate, exponent); }
  double log_slope(double) const noexcept { return exponent; }
};

/// tau_max interpolated linearly in (ln r, ln tau_max); the end segments go on beyond the table. The arrays
/// belong to the caller and have `size` entries, at least two.
struct TableForm {
  const double* rates;
  const double* tau_max;
  int size;

  double relaxation_time(double rate) const noexcept {
    const int i = segment(rate);
    return tau_max[i] * std::exp(segment_slope(i) * std::log(rate / rates[i]));
  }
  double log_slope(double rate) const noexcept { return segment_slope(segment(rate)); }

 private:
  int segment(double rate) const noexcept {
    return static_cast<int>(std::upper_bound(rates + 1, rates + size - 1, rate) - rates) - 1;
  }
  double segment_slope(int i) const noexcept {
    return std::log(tau_max[i + 1] / tau_max[i]) / std::log(rates[i + 1] / rates[i]);
  }
};

}  // namespace probation
