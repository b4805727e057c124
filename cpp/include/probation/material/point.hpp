#pragma once
// The law at a point in three dimensions and finite strain.
//
// C = F^T F, e = ln(C) / 2 with the deviator e_d, D = dev(C / J^(2/3)), and the rate is
// r = sqrt(2/3 e_d' : e_d'). Mode j obeys eq. (6) in every component,
//
//   T_j' = p_j (2 E_u / 3) e_d' - (T_j - p_j G D) / tau_j,
//   T = sum_j T_j + K ln J I,    S = T : d ln C / d C.
//
// In incompressible uniaxial tension every T_j is sigma_j diag(2/3, -1/3, -1/3), and sigma_11 - sigma_22 is
// the stress of the one-dimensional law. T is work-conjugate to e and lives in the reference configuration:
// it never rotates.
//
// State, 10 + 6 N numbers, all zero at the start (relaxed, undeformed):
//   0     rate last used in the companion relation [1/s]
//   1     tau_max [s]
//   2     equivalent strain sqrt(2/3 e_d : e_d)
//   3     J - 1
//   4…9   e_d
//   10…   Z_j = T_j - p_j G D [MPa], six components each

#include <algorithm>
#include <cmath>

#include "probation/divided_differences.hpp"
#include "probation/material/modes.hpp"
#include "probation/material/tensor.hpp"

namespace probation::material {

constexpr int point_state_header = 10;
constexpr int point_state_size(int modes) noexcept { return point_state_header + 6 * modes; }
constexpr int most_point_state = point_state_size(most_modes);

/// Second Piola-Kirchhoff stress S [MPa]; dS / dE with E = (C - I) / 2, [MPa], slightly unsymmetric.
struct PointStress {
  Symmetric stress{};
  Fourth tangent{};
};

/// A deformation is valid where the principal values of C, and their inverses, are above this.
constexpr double least_square_stretch = 1e-12;

/// Whether det F is positive and as large as for such a C: F does not turn the material inside out.
inline bool possible_volume(const Matrix3& f) noexcept {
  constexpr double least_volume = 1e-18;  // least_square_stretch^(3/2)
  return determinant(f) > least_volume;
}

namespace detail {

/// C in its principal axes, and what the law makes of it.
struct Deformation {
  Principal right;        // C
  Fourth from_principal;  // components in the principal axes -> in the reference axes
  double log_volume;      // ln J
  Symmetric e_d, d_bar;
};

/// False where C is no valid deformation.
inline bool deform(const Symmetric& right_cauchy_green, Deformation& out) noexcept {
  for (const double component : right_cauchy_green)
    if (!(std::abs(component) < 1.0 / least_square_stretch)) return false;
  out.right = principal(right_cauchy_green);
  const auto& c = out.right.value;
  for (const double value : c)
    if (!(value > least_square_stretch)) return false;
  const std::array<double, 3> e{0.5 * std::log(c[0]), 0.5 * std::log(c[1]), 0.5 * std::log(c[2])};
  out.log_volume = e[0] + e[1] + e[2];
  const double isochoric = std::exp(-2.0 / 3.0 * out.log_volume), mean = (c[0] + c[1] + c[2]) / 3.0;
  Symmetric e_d{}, d_bar{};
  for (int i = 0; i < 3; ++i) {
    e_d[i] = e[i] - out.log_volume / 3.0;
    d_bar[i] = isochoric * (c[i] - mean);
  }
  out.from_principal = congruence(out.right.axes);
  out.e_d = transform(out.from_principal, e_d);
  out.d_bar = transform(out.from_principal, d_bar);
  return true;
}

/// The relaxed stress tensor's shape D, from the e_d that the state keeps.
inline Symmetric relaxed_shape(const Symmetric& e_d) noexcept {
  const Principal p = principal(e_d);
  const std::array<double, 3> c{std::exp(2.0 * p.value[0]), std::exp(2.0 * p.value[1]),
                                std::exp(2.0 * p.value[2])};
  const double mean = (c[0] + c[1] + c[2]) / 3.0;
  return transform(congruence(p.axes), {c[0] - mean, c[1] - mean, c[2] - mean, 0.0, 0.0, 0.0});
}

/// dS / dE in the principal axes of C.
/// @param stress   T with its volumetric part, in these axes
/// @param by_e_d   coefficient of de_d in dT
/// @param by_d     coefficient of dD in dT [MPa]
/// @param slope, direction  what the rate adds: dT = slope (direction : de_d)
inline Fourth principal_tangent(const Deformation& now, const Symmetric& stress, double by_e_d, double by_d,
                                const Symmetric& slope, const Symmetric& direction,
                                double bulk_modulus) noexcept {
  const auto& c = now.right.value;
  const double volume = std::exp(2.0 / 3.0 * now.log_volume);
  double log1[3][3], log2[3][3][3], shape[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      log1[i][j] = j < i ? log1[j][i] : log_difference(c[i], c[j]);
      shape[i][j] = 2.0 / (volume * log1[i][j]);  // d(C / J^(2/3)) = shape de_d, by components
    }
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      for (int k = j; k < 3; ++k) {
        const double value = log_difference(c[i], c[j], c[k]);
        log2[i][j][k] = log2[i][k][j] = log2[j][i][k] = log2[j][k][i] = log2[k][i][j] = log2[k][j][i] = value;
      }

  Fourth m{};  // dT / de
  const double mean_shape = (shape[0][0] + shape[1][1] + shape[2][2]) / 3.0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const double deviator = (i == k ? 1.0 : 0.0) - 1.0 / 3.0;
      m[i][k] =
          (by_e_d + by_d * shape[i][i]) * deviator - by_d / 3.0 * (shape[k][k] - mean_shape) + bulk_modulus;
    }
  for (int s = 3; s < 6; ++s) m[s][s] = 0.5 * (by_e_d + by_d * shape[pairs[s].i][pairs[s].j]);
  for (int r = 0; r < 6; ++r)
    for (int s = 0; s < 6; ++s) m[r][s] += slope[r] * direction[s];

  // dS = L o (dT / de : L o dE) + T : d2 ln C
  Fourth out{};
  for (int r = 0; r < 6; ++r)
    for (int s = 0; s < 6; ++s) {
      const auto [a, b] = pairs[r];
      const auto [k, l] = pairs[s];
      double sum = log1[a][b] * m[r][s] * log1[k][l];
      if (b == k) sum += log2[a][b][l] * stress[place[a][l]];
      if (a == k) sum += log2[a][b][l] * stress[place[b][l]];
      if (b == l) sum += log2[a][b][k] * stress[place[a][k]];
      if (a == l) sum += log2[a][b][k] * stress[place[b][k]];
      out[r][s] = sum;
    }
  return out;
}

inline Matrix3 transposed(const Matrix3& m) noexcept {
  return {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}};
}

}  // namespace detail

/// One increment to the deformation C (at its end) in dt [s] (0: at once). `after` may be `before`, or null:
/// then no state is kept. out.tangent is filled only if asked for. Where there is no update, nothing is
/// written.
inline Outcome point_update(const Parameters& parameters, const Symmetric& right_cauchy_green, double dt,
                            const double* before, double* after, PointStress& out,
                            bool with_tangent = true) noexcept {
  detail::Deformation now{};
  if (!(dt >= 0.0) || !std::isfinite(dt) || !detail::deform(right_cauchy_green, now))
    return {Status::cut_step};

  Symmetric e_d_before{}, rise{};
  for (int c = 0; c < 6; ++c) {
    e_d_before[c] = before[4 + c];
    rise[c] = now.e_d[c] - e_d_before[c];
  }
  const double rise_squared = contract(rise, rise);
  const RateStep rate =
      rate_step(parameters, dt > 0.0 ? std::sqrt(2.0 / 3.0 * rise_squared) / dt : 0.0, before[0], dt);
  if (!rate.possible) return {Status::cut_step};

  const double modulus = 2.0 / 3.0 * parameters.unrelaxed_modulus, hardening = parameters.hardening_modulus;
  const Symmetric d_bar_before = detail::relaxed_shape(e_d_before);
  Symmetric forcing{};
  double scale = 0.0;
  for (int c = 0; c < 6; ++c) {
    const StepForcing<double> step = modal_forcing(modulus, rise[c], hardening * d_bar_before[c],
                                                   hardening * now.d_bar[c], rate.tau_max, dt);
    forcing[c] = step.forcing;
    scale = step.scale;
  }
  const bool rate_matters = with_tangent && rate.log_scale != 0.0 && rise_squared > 0.0;
  const double* const modes_before = before + point_state_header;
  double modes_after[6 * most_modes];  // kept only once all is known to be finite
  const ModalSums<6> sums =
      step_modes<6>(parameters, scale, forcing.data(), rate_matters, modes_before, modes_after);

  // In the principal axes of C: S = L o T.
  const Fourth to_principal = congruence(detail::transposed(now.right.axes));
  Symmetric stress{};
  for (int c = 0; c < 6; ++c) stress[c] = sums.stress[c] + sums.weight * hardening * now.d_bar[c];
  stress = transform(to_principal, stress);
  for (int c = 0; c < 3; ++c) stress[c] += parameters.bulk_modulus * now.log_volume;
  Symmetric second_piola{};
  for (int c = 0; c < 6; ++c)
    second_piola[c] = log_difference(now.right.value[pairs[c].i], now.right.value[pairs[c].j]) * stress[c];
  PointStress made;
  made.stress = transform(now.from_principal, second_piola);
  if (!all_finite(made.stress)) return {Status::cut_step};

  if (with_tangent) {
    Symmetric slope{}, direction{};
    if (rate_matters) {
      for (int c = 0; c < 6; ++c) slope[c] = sums.log_slope[c] * rate.log_scale / rise_squared;
      slope = transform(to_principal, slope);
      direction = transform(to_principal, rise);  // d ln r = rise : de_d / (rise : rise)
    }
    const Fourth tangent =
        detail::principal_tangent(now, stress, sums.mean * modulus, (sums.weight - sums.mean) * hardening,
                                  slope, direction, parameters.bulk_modulus);
    made.tangent = carry(now.from_principal, tangent);
    if (!all_finite(made.tangent)) return {Status::cut_step};
  }

  Outcome outcome;
  if (parameters.stress_tolerance > 0.0) {
    Symmetric errors{};
    step_errors<6>(parameters, scale, rate.tau_max, before[1], forcing.data(), modes_before, errors.data());
    outcome.step_factor = step_factor(std::sqrt(1.5 * contract(errors, errors)), parameters.stress_tolerance);
  }
  out = made;
  if (after == nullptr) return outcome;
  after[0] = rate.seen;
  after[1] = rate.tau_max;
  after[2] = std::sqrt(2.0 / 3.0 * contract(now.e_d, now.e_d));
  after[3] = std::expm1(now.log_volume);
  for (int c = 0; c < 6; ++c) after[4 + c] = now.e_d[c];
  std::copy_n(modes_after, 6 * parameters.modes, after + point_state_header);
  return outcome;
}

}  // namespace probation::material
