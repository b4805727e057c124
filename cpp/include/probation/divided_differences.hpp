#pragma once
// Divided differences of the natural logarithm, good to the last digits wherever their arguments meet.

#include <algorithm>
#include <cmath>

namespace probation {

/// ln[a, b] = (ln a - ln b) / (a - b), and 1/a where they meet; a, b > 0.
inline double log_difference(double a, double b) noexcept {
  const double gap = (a - b) / b;
  return gap == 0.0 ? 1.0 / b : std::log1p(gap) / (a - b);
}

/// ln[a, b, c] = (ln[a, b] - ln[b, c]) / (a - c), symmetric in its arguments; -1/(2 a^2) where all meet.
inline double log_difference(double a, double b, double c) noexcept {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double mean = (a + b + c) / 3.0;
  if (a - c > 0.1 * mean) return (log_difference(a, b) - log_difference(b, c)) / (a - c);
  // Taylor: sum over n >= 2 of (-1)^(n-1) / n h(n-2) with h the complete homogeneous polynomials of the
  // distances.
  const double u = a / mean - 1.0, v = b / mean - 1.0, w = c / mean - 1.0;
  double one = 1.0, two = 1.0, three = 1.0, sum = -0.5, sign = 1.0;
  for (int n = 3; n <= 18; ++n, sign = -sign) {
    one *= u;
    two = two * v + one;
    three = three * w + two;
    sum += sign * three / n;
  }
  return sum / (mean * mean);
}

}  // namespace probation
