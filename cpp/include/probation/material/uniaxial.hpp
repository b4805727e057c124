#pragma once
// The law at a point in one dimension: trusses, drivers, fits inside other programs.
//
// State, 3 + N numbers, all zero at the start (relaxed, unstrained):
//   0  rate that the companion relation saw last [1/s]    1  tau_max [s]    2  true strain    3…  z_j [MPa]

#include <cmath>

#include "probation/haward_thackray.hpp"
#include "probation/material/modes.hpp"

namespace probation::material {

constexpr int uniaxial_state_size(int modes) noexcept { return 3 + modes; }
constexpr int most_uniaxial_state = uniaxial_state_size(most_modes);

/// True stress [MPa] and its consistent tangent d stress / d strain_increment [MPa].
struct UniaxialStress {
  double true_stress = 0.0;
  double tangent = 0.0;
};

/// One increment of true strain in dt [s] (0: at once). `before` is left alone, unless it is `after`, too.
inline Outcome uniaxial_update(const Parameters& parameters, double strain_increment, double dt,
                               const double* before, double* after, UniaxialStress& out) noexcept {
  const double strain_before = before[2], strain = strain_before + strain_increment;
  if (!(dt >= 0.0) || !std::isfinite(dt) || !(std::abs(strain) < 100.0)) return {Status::cut_step};
  const RateStep rate =
      rate_step(parameters, dt > 0.0 ? std::abs(strain_increment) / dt : 0.0, before[0], dt);
  if (!rate.possible) return {Status::cut_step};

  const double relaxed = parameters.hardening_modulus * haward_thackray_strain(strain);  // eq. (3)
  const double relaxed_before = parameters.hardening_modulus * haward_thackray_strain(strain_before);
  const double relaxed_slope = parameters.hardening_modulus * haward_thackray_slope(strain);
  const StepForcing<double> step = modal_forcing(parameters.unrelaxed_modulus, strain_increment,
                                                 relaxed_before, relaxed, rate.tau_max, dt);
  const bool rate_matters = rate.log_scale != 0.0 && strain_increment != 0.0;
  const ModalSums<1> sums =
      step_modes<1>(parameters, step.scale, &step.forcing, rate_matters, before + 3, after + 3);

  out.true_stress = sums.stress[0] + sums.weight * relaxed;
  out.tangent = sums.mean * (parameters.unrelaxed_modulus - relaxed_slope) + sums.weight * relaxed_slope;
  if (rate_matters) out.tangent += sums.log_slope[0] * rate.log_scale / strain_increment;
  if (!std::isfinite(out.true_stress) || !std::isfinite(out.tangent)) return {Status::cut_step};
  after[0] = rate.seen;
  after[1] = rate.tau_max;
  after[2] = strain;
  return {};
}

}  // namespace probation::material
