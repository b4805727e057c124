#pragma once
// The inputs of a scheme at one step, and the scale, U and V of schemes/step.hpp that follow from them.

#include "probation/dual.hpp"
#include "probation/schemes/step.hpp"

namespace probation {

/// bE2's first step after the start or a jump. Backward Euler is the paper's: at h = 0.5 s its error is 0.58
/// MPa in experiment 1 and biases E_u by 1 %. The exponential step is exact for a ramp with constant
/// hardening; the default.
enum class Start { exponential, backward_euler };

/// A sampled quantity at the end of the step, at its beginning, and one instant earlier.
template <class Real>
struct Three {
  Real next{}, here{}, before{};
};

/// Inputs of one step. `before` values and previous_* are meaningless where the step is fresh.
template <class Real>
struct StepData {
  bool fresh;    ///< first after the start or a jump
  double h;      ///< [s]
  double ratio;  ///< h / h0
  Three<Real> true_strain;
  Three<Real> unrelaxed_modulus;  ///< [MPa]
  Three<Real> relaxed_stress;     ///< [MPa]
  Three<Real> fluidity;           ///< f = 1 / tau_max [1/s]
  Real end_rate{};                ///< [1/s], the rate at the end of the step
  bool constant_modulus;          ///< E_u does not vary along the record
  bool constant_fluidity;         ///< nor does tau_max
  Real previous_scale{};          ///< scale of the step before
  Real previous_forcing{};        ///< U of the step before
};

/// Inputs of one modal step: x_j = scale / r_j, and U, V of schemes/step.hpp.
template <class Real>
struct StepForcing {
  StepRule rule{};
  Real scale{};
  Real forcing{};
  Real curvature{};
};

/// int E_u de over the step: both follow the parabola through three instants (a straight line in a fresh
/// step).
template <class Real>
PROBATION_INLINE Real modulus_work(const StepData<Real>& s) {
  const Real rise = s.true_strain.next - s.true_strain.here;
  if (s.constant_modulus) return s.unrelaxed_modulus.next * rise;
  const Real change = s.unrelaxed_modulus.next - s.unrelaxed_modulus.here;
  const Real trapezoid = s.unrelaxed_modulus.here * rise + 0.5 * change * rise;
  if (s.fresh) return trapezoid;
  // With bends b of the two parabolas (half the second derivative times h^2), the exact integral adds (E' b_e
  // - b_E e') / 6.
  const double weight = bend_weight(s.ratio);
  const Real strain_bend = weight * (rise - s.ratio * (s.true_strain.here - s.true_strain.before));
  const Real modulus_bend =
      weight * (change - s.ratio * (s.unrelaxed_modulus.here - s.unrelaxed_modulus.before));
  return trapezoid + (change * strain_bend - modulus_bend * rise) / 6.0;
}

/// The step of reduced time, int dt / tau_max, by the trapezoid rule.
template <class Real>
PROBATION_INLINE Real trapezoid_reduced_time(const StepData<Real>& s) {
  return (0.5 * s.h) * (s.fluidity.here + s.fluidity.next);
}

}  // namespace probation
