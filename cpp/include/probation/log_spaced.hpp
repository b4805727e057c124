#pragma once
// The paper's modes, eqs. (4) and (5), into arrays that the caller owns.

#include <cmath>

namespace probation {

/// Relaxation ratios tau_j / tau_max, eq. (4), and weights proportional to sqrt(tau_j), eq. (5); fastest mode
/// first. Both arrays have `modes` entries, modes >= 1; decades > 0.
inline void log_spaced_modes(int modes, double decades, double* ratio, double* weight) noexcept {
  double sum = 0.0;
  for (int j = 1; j <= modes; ++j) {
    const double distance = modes == 1 ? 0.0 : static_cast<double>(modes - j) / (modes - 1);
    ratio[j - 1] = std::pow(10.0, -distance * decades);  // eq. (4)
    weight[j - 1] = std::sqrt(ratio[j - 1]);             // eq. (5)
    sum += weight[j - 1];
  }
  for (int j = 0; j < modes; ++j) weight[j] /= sum;
}

}  // namespace probation
