#pragma once
// Stress and tangent of the material point in the measures that finite-element codes use.

#include "probation/material/point.hpp"

namespace probation::material {

/// Cauchy stress [MPa] and what Abaqus calls the Jacobian: the tangent of the Jaumann rate of the Kirchhoff
/// stress over J, [MPa], to be applied to tensor shears twice or to engineering shears once.
inline PointStress cauchy_jaumann(const PointStress& point, const Matrix3& f) noexcept {
  const Fourth forward = congruence(f);
  const double inverse_volume = 1.0 / determinant(f);
  PointStress out{transform(forward, point.stress), carry(forward, point.tangent)};
  for (double& component : out.stress) component *= inverse_volume;
  const Symmetric& s = out.stress;
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = pairs[r];
      const auto [k, l] = pairs[c];
      double& entry = out.tangent[r][c];
      entry *= inverse_volume;
      if (j == l) entry += 0.5 * s[place[i][k]];
      if (j == k) entry += 0.5 * s[place[i][l]];
      if (i == l) entry += 0.5 * s[place[j][k]];
      if (i == k) entry += 0.5 * s[place[j][l]];
    }
  return out;
}

/// First Piola-Kirchhoff stress P = F S [MPa] and dP / dF [MPa], index [3 i + J][3 k + L].
struct FirstPiola {
  Matrix3 stress{};
  std::array<std::array<double, 9>, 9> tangent{};
};

inline FirstPiola first_piola(const PointStress& point, const Matrix3& f, bool with_tangent = true) noexcept {
  FirstPiola out;
  for (int i = 0; i < 3; ++i)
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a) out.stress[i][b] += f[i][a] * point.stress[place[a][b]];
  if (!with_tangent) return out;
  for (int i = 0; i < 3; ++i)
    for (int b = 0; b < 3; ++b)
      for (int k = 0; k < 3; ++k)
        for (int d = 0; d < 3; ++d) {
          double sum = i == k ? point.stress[place[b][d]] : 0.0;
          for (int a = 0; a < 3; ++a)
            for (int c = 0; c < 3; ++c) sum += f[i][a] * point.tangent[place[a][b]][place[c][d]] * f[k][c];
          out.tangent[3 * i + b][3 * k + d] = sum;
        }
  return out;
}

/// d Cauchy / dF [MPa], index [component][3 k + L].
inline std::array<std::array<double, 9>, 6> cauchy_slope(const FirstPiola& piola, const Matrix3& f) noexcept {
  const double inverse_volume = 1.0 / determinant(f);
  std::array<std::array<double, 9>, 6> out{};
  for (int r = 0; r < 6; ++r) {
    const auto [i, j] = pairs[r];
    double stress = 0.0;
    for (int b = 0; b < 3; ++b) stress += inverse_volume * piola.stress[i][b] * f[j][b];
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        // d J / d F = cofactor of F.
        const int k1 = (k + 1) % 3, k2 = (k + 2) % 3, l1 = (l + 1) % 3, l2 = (l + 2) % 3;
        double sum = -stress * (f[k1][l1] * f[k2][l2] - f[k1][l2] * f[k2][l1]);
        for (int b = 0; b < 3; ++b) sum += piola.tangent[3 * i + b][3 * k + l] * f[j][b];
        if (j == k) sum += piola.stress[i][l];
        out[r][3 * k + l] = inverse_volume * sum;
      }
  }
  return out;
}

}  // namespace probation::material
