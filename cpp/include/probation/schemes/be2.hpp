#pragma once
// bE2, eqs. (8), (9): the two-step backward Euler scheme of Gear (BDF2), with coefficients for uneven steps,
// and a one-step rule at the start and after every jump of the strain rate (plain BDF2 falls to order 1
// across a jump).

#include "probation/schemes/sa2.hpp"
#include "probation/schemes/step.hpp"

namespace probation {

/// Which rule a step uses.
PROBATION_INLINE StepRule be2_rule(bool fresh, double ratio, Start start) {
  if (!fresh && ratio < bdf2_largest_step_ratio) return StepRule::bdf2;
  return start == Start::exponential ? StepRule::exponential : StepRule::backward_euler;
}

/// The part of U that depends on the strain alone.
template <class Real>
PROBATION_INLINE Real be2_stiff(const StepData<Real>& s, Start start) {
  if (be2_rule(s.fresh, s.ratio, start) == StepRule::exponential) return sa2_stiff(s);
  return s.unrelaxed_modulus.next * (s.h * s.end_rate);
}

/// In z-form the relaxed stress enters through the same two-step difference as the unknown, exactly as in
/// eq. (9).
template <class Real, class Stiff>
PROBATION_INLINE StepForcing<Real> be2_step(const StepData<Real>& s, Start start, const Stiff& stiff) {
  const StepRule rule = be2_rule(s.fresh, s.ratio, start);
  if (rule == StepRule::exponential) return sa2_step(s, stiff);
  const Real scale = s.h * s.fluidity.next;
  const Three<Real>& relaxed = s.relaxed_stress;
  if (rule == StepRule::backward_euler) return {rule, scale, stiff - (relaxed.next - relaxed.here), Real{}};
  const Bdf2Difference difference(s.ratio);
  const Real change = difference(relaxed.next, relaxed.here, relaxed.before);
  return {rule, scale, stiff - change, Real{}};
}

}  // namespace probation
