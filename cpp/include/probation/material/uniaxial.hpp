#pragma once
// The law at a point in one dimension: trusses, drivers, fits inside other programs.
//
// State, 3 + N numbers, all zero at the start (relaxed, unstrained):
//   0  rate last used in the companion relation [1/s]    1  tau_max [s]    2  true strain    3…  z_j [MPa]

#include <algorithm>
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

/// One increment of true strain in dt [s] (0: at once). `after` may be `before`. Where there is no update,
/// nothing is written.
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
  double modes_after[most_modes];  // kept only once all is known to be finite
  const ModalSums<1> sums =
      step_modes<1>(parameters, step.scale, &step.forcing, rate_matters, before + 3, modes_after);

  UniaxialStress made;
  made.true_stress = sums.stress[0] + sums.weight * relaxed;
  made.tangent = sums.mean * (parameters.unrelaxed_modulus - relaxed_slope) + sums.weight * relaxed_slope;
  if (rate_matters) made.tangent += sums.log_slope[0] * rate.log_scale / strain_increment;
  if (!std::isfinite(made.true_stress) || !std::isfinite(made.tangent)) return {Status::cut_step};
  Outcome outcome;
  if (parameters.stress_tolerance > 0.0) {
    double error = 0.0;
    step_errors<1>(parameters, step.scale, rate.tau_max, before[1], &step.forcing, before + 3, &error);
    outcome.step_factor = step_factor(error, parameters.stress_tolerance);
  }
  out = made;
  after[0] = rate.seen;
  after[1] = rate.tau_max;
  after[2] = strain;
  std::copy(modes_after, modes_after + parameters.modes, after + 3);
  return outcome;
}

}  // namespace probation::material
