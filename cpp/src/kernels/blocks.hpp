#pragma once
// Blocks of modes whose states fit the registers, time innermost: what all sweeps share.

#include <cstddef>

#include "kernels.hpp"
#include "vector.hpp"

namespace probation::kernels::PROBATION_ISA {

template <int K>
struct Size {
  static constexpr int value = K;
};

/// Calls body(Size<K>, from) for the one K <= largest that is `vectors`.
template <int largest, class Body>
PROBATION_INLINE void in_block(int vectors, int from, Body body) {
  if constexpr (largest > 1)
    if (vectors < largest) return in_block<largest - 1>(vectors, from, body);
  body(Size<largest>{}, from);
}

/// Calls body(Size<K>, at) for the modes from..to in as few blocks of at most `largest` vectors as there can
/// be, all of nearly the same size.
template <int largest, class Body>
PROBATION_INLINE void in_blocks(int from, int to, Body body) {
  const int vectors = (to - from) / lanes;
  for (int blocks = (vectors + largest - 1) / largest; blocks > 0; --blocks) {
    const int K = ((to - from) / lanes + blocks - 1) / blocks;
    in_block<largest>(K, from, body);
    from += K * lanes;
  }
}

PROBATION_INLINE StepCoefficients<Vector> weighted(StepCoefficients<Vector> c, Vector weight) {
  c.forcing *= weight;
  c.curvature *= weight;
  return c;
}

template <class Step>
PROBATION_INLINE StepCoefficients<Vector> weighted(const Modes& modes, std::ptrdiff_t at, double scale,
                                                   double ratio) {
  return weighted(Step::template coefficients<Vector>(load(modes.inverse_ratio + at) * scale, ratio),
                  load(modes.weight + at));
}

/// The largest of values[from..to).
PROBATION_INLINE double largest(const double* values, int from, int to) {
  double found = values[from];
  for (int j = from + 1; j < to; ++j) found = values[j] > found ? values[j] : found;
  return found;
}

using kernels::fold;

struct StressAndSlope {
  Vector stress, slope;
};
template <int vectors>
PROBATION_INLINE StressAndSlope fold(const StressAndSlope& a, const StressAndSlope& b) {
  return {fold<vectors>(a.stress, b.stress), fold<vectors>(a.slope, b.slope)};
}

/// The sums over the lanes of value_at(n), value_at(n + 1) and so on, folded as soon as two are there.
template <int vectors = lanes, class ValueAt>
PROBATION_INLINE auto sums(int n, const ValueAt& value_at) {
  if constexpr (vectors == 1) {
    return value_at(n);
  } else {
    const auto a = sums<vectors / 2>(n, value_at);
    const auto b = sums<vectors / 2>(n + vectors / 2, value_at);
    return fold<vectors>(a, b);
  }
}

/// Adds the sum of what advance(n) returns to stress[n], as many steps at a time as a vector has lanes.
template <class Advance>
PROBATION_INLINE void add_sums(int count, double* stress, Advance advance) {
  int n = 0;
  Vector total[lanes];
  for (; n + lanes <= count; n += lanes) {
#pragma GCC unroll 4
    for (int i = 0; i < lanes; ++i) total[i] = advance(n + i);
    store(stress + n, load(stress + n) + sums(0, [&](int i) { return total[i]; }));
  }
  for (; n < count; ++n) stress[n] += sum(advance(n));
}

/// The same for both, added to stress[n] and slope[n].
template <class Advance>
PROBATION_INLINE void add_both_sums(int count, double* stress, double* slope, Advance advance) {
  int n = 0;
  for (; n + lanes <= count; n += lanes) {
    const StressAndSlope all = sums(n, advance);
    store(stress + n, load(stress + n) + all.stress);
    store(slope + n, load(slope + n) + all.slope);
  }
  for (; n < count; ++n) {
    const StressAndSlope one = advance(n);
    stress[n] += sum(one.stress);
    slope[n] += sum(one.slope);
  }
}

/// `count` of the steps, from `first` on.
PROBATION_INLINE Steps part_of(const Steps& steps, int first, int count) {
  const int fixed = steps.uniform ? 0 : first;
  return {steps.rule,
          count,
          steps.uniform,
          steps.scale + fixed,
          steps.ratio + fixed,
          steps.forcing + first,
          steps.curvature ? steps.curvature + first : nullptr};
}

/// V of step n.
PROBATION_INLINE double curvature_at(const Steps& steps, int n) {
  if (!steps.curvature) return 0.0;
  return steps.uniform && n > 0 ? 0.5 * (steps.forcing[n] - steps.forcing[n - 1]) : steps.curvature[n];
}

}  // namespace probation::kernels::PROBATION_ISA
