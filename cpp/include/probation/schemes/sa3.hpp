#pragma once
// SA3 (Sorvari & Hamalainen 2010), read as the exact exponential recursion under the parabola through three
// instants of the forcing, in reduced time where tau_max varies. The original text was not available: this
// reading is ours. Order 3 on smooth histories; on rough measured strain it is no better than
// SA2. Order 2 where tau_max follows rates that are differences of the strain (give the rates for order 3),
// and under feedbacks.

#include "probation/schemes/sa2.hpp"

namespace probation {

/// The step of reduced time under the parabola through f-, f, f+.
template <class Real>
PROBATION_INLINE Real parabolic_reduced_time(const StepData<Real>& s) {
  if (s.constant_fluidity) return s.h * s.fluidity.next;
  const Real bend = bend_weight(s.ratio) *
                    ((s.fluidity.next - s.fluidity.here) - s.ratio * (s.fluidity.here - s.fluidity.before));
  return s.h * (0.5 * (s.fluidity.here + s.fluidity.next) - bend / 6.0);
}

/// The part of U that depends on the strain alone.
template <class Real>
PROBATION_INLINE Real sa3_stiff(const StepData<Real>& s) {
  return s.fresh ? sa2_stiff(s) : modulus_work(s);
}

template <class Real, class Stiff>
PROBATION_INLINE StepForcing<Real> sa3_step(const StepData<Real>& s, const Stiff& stiff) {
  if (s.fresh) return sa2_step(s, stiff);
  Real scale = parabolic_reduced_time(s);
  if (!(scale > 0.0))
    return sa2_step(s, stiff);  // f fell by more than 13 times: the parabola dips below zero
  const Real change = stiff - (s.relaxed_stress.next - s.relaxed_stress.here);
  const Real growth = scale / s.previous_scale;
  return {StepRule::exponential, scale, change, bend_weight(growth) * (change - s.previous_forcing * growth)};
}

}  // namespace probation
