#pragma once
// Deformation paths on which a material point is checked.

#include <cmath>

#include "probation/material/tensor.hpp"

namespace probation::tools {

using material::Matrix3;
using material::Symmetric;

inline Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}

/// Rotation by an angle about (1, 2, 2) / 3 (Rodrigues).
inline Matrix3 rotation(double angle) {
  const double n[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3}, c = std::cos(angle), s = std::sin(angle);
  Matrix3 out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[i][j] = (i == j ? c : 0.0) + (1.0 - c) * n[i] * n[j];
  out[0][1] -= s * n[2], out[1][0] += s * n[2];
  out[0][2] += s * n[1], out[2][0] -= s * n[1];
  out[1][2] -= s * n[0], out[2][1] += s * n[0];
  return out;
}

/// A smooth path through shear, stretch and a little volume change; u goes from 0 to 1, and so does its rate
/// from half to one and a half times the mean.
inline Matrix3 smooth_deformation(double u) {
  const double a = 0.5 * u * (1.0 + u), wave = std::sin(2.0 * u) * u;
  return {{{std::exp(0.6 * a), 0.25 * a, 0.0},
           {0.05 * wave, std::exp(-0.28 * a), 0.1 * a},
           {-0.08 * a, 0.0, std::exp(-0.31 * a) + 0.02 * wave}}};
}

inline double smooth_strain(double u) { return 0.3 * u * (1.0 + u); }

/// C of incompressible uniaxial tension along 1.
inline Symmetric uniaxial_right_cauchy_green(double true_strain) {
  const double axial = std::exp(2.0 * true_strain), lateral = std::exp(-true_strain);
  return {axial, lateral, lateral, 0.0, 0.0, 0.0};
}

/// Increments of true strain and time: a ramp, a rate some ten times higher, a crawl, unloading, loading
/// again. The rates are not round: a table may have its kinks at round ones.
struct Increment {
  double strain, time;
};
inline Increment jumpy_increment(int i) {
  if (i < 60) return {0.00213, 1.97};
  if (i < 120) return {0.00417, 0.37};
  if (i < 130) return {1.3e-7, 1.1};
  if (i < 160) return {-0.00219, 1.93};
  return {0.00307, 1.0 + 0.5 * std::sin(0.3 * i)};
}
constexpr int jumpy_increments = 240;

}  // namespace probation::tools
