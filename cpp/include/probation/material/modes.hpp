#pragma once
// One step of all modes of a material point, in one or more components: what 1D and 3D share.
//
// The step is SA2 of schemes/sa2.hpp with the rate of the increment: tau_max belongs to its mid-point, so the
// order is 2. The modal state is z_j = sigma_j - p_j sigma^r: zero in the relaxed state, which is where all
// start.

#include <cmath>

#include "probation/material/parameters.hpp"
#include "probation/material/status.hpp"
#include "probation/schemes/sa2.hpp"

namespace probation::material {

/// The rate that the companion relation sees in an increment, and what follows from it.
struct RateStep {
  double seen;       ///< [1/s], filtered, at least the floor; what the state keeps
  double tau_max;    ///< [s]
  double log_scale;  ///< d ln x / d ln r of the increment's own rate r, x = dt / tau_j
  bool possible;
};

/// @param rate      r of the increment [1/s]
/// @param previous  what the state kept [1/s]; 0 at the very start
inline RateStep rate_step(const Parameters& parameters, double rate, double previous, double dt) noexcept {
  double filtered = rate, slope = 1.0;  // slope: d filtered / d rate
  if (dt == 0.0) {
    filtered = previous;  // no time, no rate: all modes answer with E_u, whatever their times
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
          possible_time(relaxation.tau_max)};
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

/// What is left of the modes once they are summed.
template <int Components>
struct ModalSums {
  double stress[Components] = {};     ///< sum of z_j [MPa]
  double log_slope[Components] = {};  ///< its derivative with respect to ln x [MPa]
  double mean = 0.0;                  ///< sum of p_j phi_j: derivative with respect to the forcing
  double weight = 0.0;                ///< sum of p_j
};

/// z_j+ = a z_j + p_j phi U, mode by mode. `before` and `after` hold the components of each mode in turn;
/// they may be the same array. The slopes are formed only if asked for.
template <int Components>
inline ModalSums<Components> step_modes(const Parameters& parameters, double scale, const double* forcing,
                                        bool with_slopes, const double* before, double* after) noexcept {
  ModalSums<Components> sums;
  for (int j = 0; j < parameters.modes; ++j, before += Components, after += Components) {
    const double x = scale / parameters.relaxation_ratio[j], weight = parameters.modal_weight[j];
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

}  // namespace probation::material
