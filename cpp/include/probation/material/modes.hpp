#pragma once
// One step of all modes of a material point, in one or more components: what 1D and 3D share.
//
// The step is SA2 of schemes/sa2.hpp with the rate of the increment: tau_max belongs to its mid-point, so the
// order is 2. The modal state is z_j = sigma_j - p_j sigma^r: zero in the relaxed state, which is where all
// start.

#include <algorithm>
#include <cmath>

#include "probation/material/parameters.hpp"
#include "probation/material/status.hpp"
#include "probation/schemes/sa2.hpp"

namespace probation::material {

/// The rate used in the companion relation in an increment, and what follows from it.
struct RateStep {
  double seen;       ///< [1/s], filtered, at least the floor; stored in the state
  double tau_max;    ///< [s]
  double log_scale;  ///< d ln x / d ln r of the increment's own rate r, x = dt / tau_j
  bool possible;
};

/// @param rate      r of the increment [1/s]
/// @param previous  `seen` of the increment before [1/s]; 0 at the very start
inline RateStep rate_step(const Parameters& parameters, double rate, double previous, double dt) noexcept {
  double filtered = rate, slope = 1.0;  // slope: d filtered / d rate
  if (dt == 0.0) {
    filtered = previous;  // dt = 0: there is no rate, and all modes answer with E_u
    slope = 0.0;
  } else if (parameters.rate_filter > 0.0 && previous > 0.0) {
    // r_f' = (r - r_f) r / filter: exact for a constant rate.
    const double kept = std::exp(-rate * dt / parameters.rate_filter);
    filtered = kept * previous + (1.0 - kept) * rate;
    slope = 1.0 - kept + kept * (dt / parameters.rate_filter) * (rate - previous);
  }
  const bool above = filtered > parameters.rate_floor;
  const double seen = above ? filtered : parameters.rate_floor;
  const Relaxation relaxation = parameters.relaxation(seen);
  return {seen, relaxation.tau_max, above ? -relaxation.log_slope * slope * rate / seen : 0.0,
          possible_time(relaxation.tau_max) && std::isfinite(seen)};
}

/// The forcing of one component: what sa2_step makes of its strain and its relaxed stress at unit weight.
inline StepForcing<double> modal_forcing(double modulus, double strain_increment, double relaxed_before,
                                         double relaxed_after, double tau_max, double dt) noexcept {
  StepData<double> step{};
  step.fresh = true;
  step.h = dt;
  step.true_strain = {strain_increment, 0.0, 0.0};
  step.unrelaxed_modulus = {modulus, modulus, modulus};
  step.relaxed_stress = {relaxed_after, relaxed_before, relaxed_before};
  const double fluidity = 1.0 / tau_max;
  step.fluidity = {fluidity, fluidity, fluidity};
  step.constant_modulus = step.constant_fluidity = true;
  return sa2_step(step);
}

/// x_j = dt / tau_j, limited: beyond the limit e^-x is below rounding, and an infinite x would give inf * 0.
inline double modal_scale(double scale, double ratio) noexcept {
  constexpr double relaxed = 1e100;
  return std::min(scale / ratio, relaxed);
}

/// Sums over the modes.
template <int Components>
struct ModalSums {
  double stress[Components] = {};     ///< sum of z_j [MPa]
  double log_slope[Components] = {};  ///< its derivative with respect to ln x [MPa]
  double mean = 0.0;                  ///< sum of p_j phi_j: derivative with respect to the forcing
  double weight = 0.0;                ///< sum of p_j
};

/// z_j+ = a z_j + p_j phi U, mode by mode. `before` and `after` hold the components of each mode in turn. The
/// slopes are formed only if asked for.
template <int Components>
inline ModalSums<Components> step_modes(const Parameters& parameters, double scale, const double* forcing,
                                        bool with_slopes, const double* before, double* after) noexcept {
  ModalSums<Components> sums;
  for (int j = 0; j < parameters.modes; ++j, before += Components, after += Components) {
    const double x = modal_scale(scale, parameters.relaxation_ratio[j]), weight = parameters.modal_weight[j];
    const StepCoefficients<double> step = ExponentialStep::coefficients(x, 1.0);
    if (with_slopes) {
      const StepCoefficients<double> slope = ExponentialStep::log_slopes(x, 1.0);
      for (int c = 0; c < Components; ++c)
        sums.log_slope[c] += slope.previous * before[c] + weight * slope.forcing * forcing[c];
    }
    for (int c = 0; c < Components; ++c) {
      after[c] = step.previous * before[c] + weight * step.forcing * forcing[c];
      sums.stress[c] += after[c];
    }
    sums.mean += weight * step.forcing;
    sums.weight += weight;
  }
  return sums;
}

/// Estimated error of each component of the stress that comes from the size of the increment [MPa].
///
/// The update takes the forcing as straight over the increment. SA3 bends it, by the curvature V = (U - U0) /
/// 2, U0 what the forcing would be had it gone on as before: psi_j V more in mode j (schemes/step.hpp), and
/// psi_j / (1 - a_j) V after many increments like this one. U0 is taken from the fastest mode, which follows
/// the forcing: y = U0 tau / dt. The forcing may be even in time or, as at a constant Weissenberg number, in
/// reduced time: the larger bend of the two counts. A jump of the rate counts as a bend.
/// @param tau_max         [s], of this increment
/// @param tau_max_before  [s], of the one before; 0 at the very start
template <int Components>
inline void step_errors(const Parameters& parameters, double scale, double tau_max, double tau_max_before,
                        const double* forcing, const double* before, double* errors) noexcept {
  double share = 0.0;
  int fastest = -1;
  for (int j = 0; j < parameters.modes; ++j) {
    const double ratio = parameters.relaxation_ratio[j], weight = parameters.modal_weight[j];
    if (!(weight > 0.0)) continue;
    if (fastest < 0 || ratio < parameters.relaxation_ratio[fastest]) fastest = j;
    const double x = modal_scale(scale, ratio);
    const StepCoefficients<double> step = ExponentialStep::coefficients(x, 1.0);
    if (x > 0.0) share += weight * step.curvature / (x * step.forcing);
  }
  for (int c = 0; c < Components; ++c) errors[c] = 0.0;
  if (fastest < 0) return;
  const double reduced = scale / parameters.relaxation_ratio[fastest] / parameters.modal_weight[fastest];
  const double in_time = tau_max_before > 0.0 ? reduced * (tau_max / tau_max_before) : 0.0;
  for (int c = 0; c < Components; ++c) {
    const double y = before[fastest * Components + c];
    errors[c] =
        0.5 * share * std::max(std::abs(forcing[c] - reduced * y), std::abs(forcing[c] - in_time * y));
  }
}

/// The factor for the next increment, given the estimated error [MPa] of this one: 1 where it is within the
/// tolerance. The error is proportional to the square of the increment. It is multiplied by three: it is
/// estimated from two increments only, and errors of earlier, larger increments add up.
inline double step_factor(double error, double tolerance) noexcept {
  constexpr double safety = 3.0, aim = 0.9;
  if (!(safety * error > tolerance)) return 1.0;
  return std::max(smallest_cut, aim * std::sqrt(tolerance / (safety * error)));
}

}  // namespace probation::material
