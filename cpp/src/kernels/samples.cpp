// Plain loops without branches, which every compiler can vectorise.

#include <cmath>
#include <cstring>

#include "probation/inline.hpp"
#include "sweeps.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

constexpr double largest = 1.7976931348623157e308;
constexpr double smallest_normal = 2.2250738585072014e-308;

/// e_HT = L^2 - 1/L with stretch L = e^x, as m (2 + m) + m / L with m = L - 1, which keeps the digits near
/// zero. With x = n ln 2 + r, |r| <= ln 2 / 2, and q = e^r - 1: m = 2^n q + (2^n - 1), L = 2^n (1 + q).
PROBATION_INLINE double haward_thackray_strain(double x) {
  // Beyond these L^2 is inf, or L is zero and 1/L inf; nan stays what it is.
  double limited = x > 709.0 ? 709.0 : x;
  limited = limited < -709.0 ? -709.0 : limited;
  const double magic = 6755399441055744.0;  // 1.5 * 2^52: rounds, and leaves the integer in the low bits
  const double rounded = limited * 1.4426950408889634074 + magic;
  const double n = rounded - magic;
  const double r = (limited - n * 0.693147180369123816490) - n * 1.90821492927058770002e-10;
  std::uint64_t bits;
  std::memcpy(&bits, &rounded, sizeof bits);
  bits = (bits << 52U) + 0x3FF0000000000000U;
  double power;
  std::memcpy(&power, &bits, sizeof power);
  // (q - r) / r^2 by the polynomial of degree 9 that is best on |r| <= ln 2 / 2, to 1.1e-16 (Chebyshev
  // points), in pairs, so that sums do not wait for one another.
  const double s = r * r, t = s * s;
  const double low = (r * 0.16666666666666667452 + 0.50000000000000010211) +
                     s * (r * 0.0083333333333300644494 + 0.041666666666624161902);
  const double middle = (r * 0.00019841269863040545401 + 0.0013888888917196719247) +
                        s * (r * 2.7557268480309822426e-6 + 0.000024801521322368429162);
  const double high = r * 2.5100375832657858306e-8 + 2.762007588010901454e-7;
  const double q = r + s * (low + t * (middle + t * high));
  const double m = power * q + (power - 1.0);
  return m * (2.0 + m) + m / (power * (1.0 + q));
}

}  // namespace

bool haward_thackray(const double* __restrict true_strain, std::int64_t count, double* __restrict result) {
  std::uint64_t beyond = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const double strain = haward_thackray_strain(true_strain[i]);
    result[i] = strain;
    beyond |= std::fabs(strain) <= largest ? 0U : 1U;
  }
  return beyond == 0;
}

StepTraits inspect_steps(const double* time, std::int64_t count, double allowed_difference) {
  const double first = time[1] - time[0];
  std::uint64_t odd = 0, uneven = 0;
  for (std::int64_t i = 0; i + 1 < count; ++i) {
    const double step = time[i + 1] - time[i];
    odd |= step >= smallest_normal ? 0U : 1U;
    odd |= step <= largest ? 0U : 1U;
    uneven |= std::fabs(step - first) <= allowed_difference ? 0U : 1U;
  }
  return {odd == 0, uneven == 0};
}

/// |d1 / h1 - d0 / h0| > least max(|d0 / h0|, |d1 / h1|), without the divisions.
bool secant_changes(const double* time, const double* values, std::int64_t count, double least) {
  std::uint64_t large = 0;
  for (std::int64_t i = 1; i + 1 < count; ++i) {
    const double before = (values[i] - values[i - 1]) * (time[i + 1] - time[i]);
    const double after = (values[i + 1] - values[i]) * (time[i] - time[i - 1]);
    const double a = std::fabs(before), b = std::fabs(after);
    large |= std::fabs(after - before) > least * (a > b ? a : b) ? 1U : 0U;
  }
  return large != 0;
}

bool all_finite(const double* values, std::int64_t count) {
  std::uint64_t odd = 0;
  for (std::int64_t i = 0; i < count; ++i) odd |= std::fabs(values[i]) <= largest ? 0U : 1U;
  return odd == 0;
}

}  // namespace probation::kernels::PROBATION_ISA
