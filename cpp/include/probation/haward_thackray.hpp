#pragma once
// Haward-Thackray strain of one true strain, uniaxial and isochoric.

#include <cmath>

namespace probation {

/// Haward-Thackray strain, e_HT = L^2 - 1/L with stretch L = exp(e).   Source: below eq. (3).
inline double haward_thackray_strain(double true_strain) noexcept {
  // L^2 - 1/L with m = L - 1: expm1 keeps the digits near zero strain, and one of it is enough.
  const double m = std::expm1(true_strain);
  return m * (2.0 + m) + m / (1.0 + m);
}

/// d e_HT / d e = 2 L^2 + 1/L.
inline double haward_thackray_slope(double true_strain) noexcept {
  return 2.0 * std::exp(2.0 * true_strain) + std::exp(-true_strain);
}

}  // namespace probation
