#pragma once
// Symmetric tensors as six components in the order 11, 22, 33, 12, 13, 23 (no factors on shears),
// fourth-order ones with both minor symmetries as 6 x 6 of their components, and deformation gradients as 3 x
// 3, row by row.

#include <array>
#include <cmath>

namespace probation::material {

using Symmetric = std::array<double, 6>;
using Fourth = std::array<std::array<double, 6>, 6>;
using Matrix3 = std::array<std::array<double, 3>, 3>;

struct Pair {
  int i, j;
};
constexpr std::array<Pair, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
/// Index of component ij among the six.
constexpr int place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
/// Weight of a component in a double contraction: 1, or 2 for shears.
constexpr Symmetric multiplicity{1.0, 1.0, 1.0, 2.0, 2.0, 2.0};

inline bool all_finite(const Symmetric& a) noexcept {
  double sum = 0.0;  // zero unless an entry is inf or nan
  for (const double component : a) sum += component - component;
  return sum == 0.0;
}
inline bool all_finite(const Fourth& a) noexcept {
  double sum = 0.0;
  for (const auto& row : a)
    for (const double component : row) sum += component - component;
  return sum == 0.0;
}

constexpr double trace(const Symmetric& a) noexcept { return a[0] + a[1] + a[2]; }

inline double contract(const Symmetric& a, const Symmetric& b) noexcept {
  double sum = 0.0;
  for (int c = 0; c < 6; ++c) sum += multiplicity[c] * a[c] * b[c];
  return sum;
}

inline double determinant(const Matrix3& m) noexcept {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// F^T F.
inline Symmetric right_cauchy_green(const Matrix3& f) noexcept {
  Symmetric c{};
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 3; ++i) c[k] += f[i][pairs[k].i] * f[i][pairs[k].j];
  return c;
}

/// T with (A s A^T) = T s for symmetric s.
inline Fourth congruence(const Matrix3& a) noexcept {
  Fourth t{};
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = pairs[r];
      const auto [k, l] = pairs[c];
      t[r][c] = a[i][k] * a[j][l] + (k == l ? 0.0 : a[i][l] * a[j][k]);
    }
  return t;
}

inline Symmetric transform(const Fourth& t, const Symmetric& s) noexcept {
  Symmetric out{};
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) out[r] += t[r][c] * s[c];
  return out;
}

/// T m T^T: a fourth-order tensor transformed in all four indices.
inline Fourth carry(const Fourth& t, const Fourth& m) noexcept {
  Fourth half{}, out{};
  for (int r = 0; r < 6; ++r)
    for (int k = 0; k < 6; ++k)
      for (int c = 0; c < 6; ++c) half[r][c] += t[r][k] * m[k][c];
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c)
      for (int k = 0; k < 6; ++k) out[r][c] += half[r][k] * t[c][k];
  return out;
}

/// Eigenvalues, and eigenvectors in the columns.
struct Principal {
  std::array<double, 3> value;
  Matrix3 axes;
};

/// By Jacobi rotations: orthogonal axes to the last digit, also where eigenvalues meet.
inline Principal principal(const Symmetric& s) noexcept {
  Matrix3 a{{{s[0], s[3], s[4]}, {s[3], s[1], s[5]}, {s[4], s[5], s[2]}}};
  Matrix3 q{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  for (int sweep = 0; sweep < 20; ++sweep) {
    const double off = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
    const double size = a[0][0] * a[0][0] + a[1][1] * a[1][1] + a[2][2] * a[2][2];
    if (!(off > 1e-36 * size)) break;
    for (int k = 3; k < 6; ++k) {
      const auto [p, r] = pairs[k];
      if (a[p][r] == 0.0) continue;
      const double theta = (a[r][r] - a[p][p]) / (2.0 * a[p][r]);
      const double t = (theta < 0.0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
      const double cosine = 1.0 / std::sqrt(t * t + 1.0), sine = t * cosine;
      const int other = 3 - p - r;
      const double turned = t * a[p][r], ap = a[other][p], ar = a[other][r];
      a[p][p] -= turned;
      a[r][r] += turned;
      a[p][r] = a[r][p] = 0.0;
      a[other][p] = a[p][other] = cosine * ap - sine * ar;
      a[other][r] = a[r][other] = sine * ap + cosine * ar;
      for (auto& row : q) {
        const double qp = row[p], qr = row[r];
        row[p] = cosine * qp - sine * qr;
        row[r] = sine * qp + cosine * qr;
      }
    }
  }
  return {{a[0][0], a[1][1], a[2][2]}, q};
}

}  // namespace probation::material
