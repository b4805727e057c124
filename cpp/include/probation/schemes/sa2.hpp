#pragma once
// SA2: exact exponential recursion under a forcing that is straight in (reduced) time. Order 2.

#include "probation/schemes/forcing.hpp"

namespace probation {

/// The part of U that depends on the strain alone.
template <class Real>
PROBATION_INLINE Real sa2_stiff(const StepData<Real>& s) {
  const Real rise = s.true_strain.next - s.true_strain.here;
  return s.constant_modulus ? s.unrelaxed_modulus.next * rise
                            : 0.5 * (s.unrelaxed_modulus.here + s.unrelaxed_modulus.next) * rise;
}

/// Exact for piecewise-linear strain at constant tau_max but for the bend of e_HT within a step.
template <class Real, class Stiff>
PROBATION_INLINE StepForcing<Real> sa2_step(const StepData<Real>& s, const Stiff& stiff) {
  return {StepRule::exponential, trapezoid_reduced_time(s),
          stiff - (s.relaxed_stress.next - s.relaxed_stress.here), Real{}};
}

template <class Real>
PROBATION_INLINE StepForcing<Real> sa2_step(const StepData<Real>& s) {
  return sa2_step(s, sa2_stiff(s));
}

}  // namespace probation
