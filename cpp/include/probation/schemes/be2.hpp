#pragma once
// bE2, eqs. (8), (9): the two-step backward Euler scheme of Gear (BDF2), with coefficients for uneven steps,
// one one-step rule at the start and after every jump of the strain rate (plain BDF2 falls to order 1 across
// a jump).

#include "probation/schemes/sa2.hpp"
#include "probation/schemes/step.hpp"

namespace probation {

/// In z-form the relaxed stress enters through the same two-step difference as the unknown: literally eq.
/// (9).
template <class Real>
PROBATION_INLINE StepForcing<Real> be2_step(const StepData<Real>& s, Start start) {
  const bool fresh = s.fresh || s.ratio >= bdf2_largest_step_ratio;
  if (fresh && start == Start::exponential) return sa2_step(s);
  const Real stiff = s.unrelaxed_modulus.next * (s.h * s.end_rate);
  const Real scale = s.h * s.fluidity.next;
  const Three<Real>& relaxed = s.relaxed_stress;
  if (fresh) return {StepRule::backward_euler, scale, stiff - (relaxed.next - relaxed.here), Real{}};
  const Bdf2Difference difference(s.ratio);
  const Real change = difference(relaxed.next, relaxed.here, relaxed.before);
  return {StepRule::bdf2, scale, stiff - change, Real{}};
}

}  // namespace probation
