#pragma once
// A block of modes in even steps, with or without the slope along a change of the time scale.
//
// With V half the change of U from step to step, the exponential rule z+ = e z + a U + b U-, a = phi + psi /
// 2, b = -psi / 2, is in states y = z - a U driven by U- alone: y+ = e y + (e a + b) U-. So every rule is
//
//   y+ = previous y + before y- + drive X,     z = y + direct U,     X = U or U-.

#include "blocks.hpp"

namespace probation::kernels::PROBATION_ISA {

struct EvenStep {
  Vector previous, before, drive, direct;
};

/// d / d ln scale: y'+ = previous y' + before y'- + of_y y + drive X,  z' = y' + direct U; bE2: of_y y+.
struct EvenSlope {
  Vector of_y, drive, direct;
};

/// Weights included.
PROBATION_INLINE EvenStep even_step(const Modes& modes, const Steps& steps, std::ptrdiff_t at) {
  const double scale = steps.scale[0], ratio = steps.ratio[0];
  if (steps.rule == StepRule::exponential) {
    const auto c = weighted<ExponentialStep>(modes, at, scale, ratio);
    if (!steps.curvature) return {c.previous, Vector{}, c.forcing, Vector{}};
    const Vector direct = c.forcing + 0.5 * c.curvature;
    return {c.previous, Vector{}, c.previous * direct - 0.5 * c.curvature, direct};
  }
  const auto c = weighted<Bdf2Step>(modes, at, scale, ratio);
  return {c.previous, c.before, c.forcing, Vector{}};
}

PROBATION_INLINE EvenSlope even_slope(const Modes& modes, const Steps& steps, const EvenStep& step,
                                      std::ptrdiff_t at) {
  const Vector x = load(modes.inverse_ratio + at) * steps.scale[0], weight = load(modes.weight + at);
  // All coefficients of bE2 go with 1 / (next + x).
  if (steps.rule == StepRule::bdf2)
    return {-x / (x + Bdf2Difference(steps.ratio[0]).next), Vector{}, Vector{}};
  const auto d = weighted(ExponentialStep::log_slopes<Vector>(x, 1.0), weight);
  if (!steps.curvature) return {d.previous, d.forcing, Vector{}};
  const Vector direct = d.forcing + 0.5 * d.curvature;
  return {d.previous, d.previous * step.direct + step.previous * direct - 0.5 * d.curvature, direct};
}

template <int K>
PROBATION_INLINE Vector total_of(const Vector (&vectors)[K]) {
  Vector total{};
  for (int k = 0; k < K; ++k) total += vectors[k];
  return total;
}

/// K vectors of modes, their states y in units of what X adds to them: w+ = previous w + before w- + X.
template <bool two_step, int K>
struct EvenBlock {
  Vector previous[K], of_before[K], drive[K], direct[K], unit[K], state[K], before[K];

  PROBATION_INLINE EvenBlock(const Modes& modes, const Steps& steps, int at) {
    for (int k = 0; k < K; ++k) {
      const EvenStep step = even_step(modes, steps, at + k * lanes);
      previous[k] = step.previous;
      of_before[k] = step.before;
      drive[k] = step.drive;
      direct[k] = step.direct;
    }
  }

  /// From the modes' states, and U before the first step.
  PROBATION_INLINE void take_states(const Modes& modes, double u, int at) {
    for (int k = 0; k < K; ++k) {
      const std::ptrdiff_t j = at + k * lanes;
      take_state(k, load(modes.state + j) - direct[k] * u, load(modes.before + j));
    }
  }
  PROBATION_INLINE void clear_states() {
    for (int k = 0; k < K; ++k) take_state(k, Vector{}, Vector{});
  }
  PROBATION_INLINE void put_state(const Modes& modes, double u, int at) const { put(modes.state, u, at); }
  PROBATION_INLINE void put_before(const Modes& modes, double u, int at) const { put(modes.before, u, at); }

  /// The sum of y+.
  PROBATION_INLINE Vector advance(double x) {
    Vector total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) total = unit[k] * step(k, x) + total;
    return total;
  }

  PROBATION_INLINE Vector step(int k, double x) {
    Vector driven = Vector{} + x;
    if constexpr (two_step) driven = of_before[k] * before[k] + driven;
    const Vector next = previous[k] * state[k] + driven;
    if constexpr (two_step) before[k] = state[k];
    state[k] = next;
    return next;
  }
  PROBATION_INLINE void take_state(int k, Vector y, Vector y_before) {
    // A drive of zero is replaced by a tiny one, so that the state can be divided by it.
    const Vector divisor = choose(drive[k] * drive[k] < 1e-300, Vector{} + 1e-150, drive[k]);
    unit[k] = choose(y * y + y_before * y_before == 0.0, drive[k], divisor);
    state[k] = y / divisor;
    before[k] = y_before / divisor;
  }
  PROBATION_INLINE double direct_stress() const { return sum(total_of(direct)); }
  PROBATION_INLINE double direct_slope() const { return 0.0; }
  PROBATION_INLINE Vector z(int k, double u) const { return unit[k] * state[k] + direct[k] * u; }

 private:
  PROBATION_INLINE void put(double* to, double u, int at) const {
    for (int k = 0; k < K; ++k) store(to + at + std::ptrdiff_t{k} * lanes, z(k, u));
  }
};

/// The same with slopes along a direction in which the time scale alone moves, by one factor for all steps.
/// The states that it takes and puts are those of unit weights.
template <bool two_step, int K>
struct EvenTangentBlock {
  EvenBlock<two_step, K> base;
  Vector weight[K], of_y[K], drive[K], direct[K], of_w[K], slope[K], slope_before[K];
  double* const to_slope;
  double* const to_slope_before;

  PROBATION_INLINE EvenTangentBlock(const Modes& modes, const Steps& steps, const TangentDirection& d, int at)
      : base(modes, steps, at), to_slope(d.state), to_slope_before(d.before) {
    const double log_scale = d.log_scale[0];
    for (int k = 0; k < K; ++k) {
      const std::ptrdiff_t j = at + k * lanes;
      weight[k] = load(modes.weight + j);
      const EvenStep step{base.previous[k], base.of_before[k], base.drive[k], base.direct[k]};
      const EvenSlope moved = even_slope(modes, steps, step, j);
      of_y[k] = moved.of_y * log_scale;
      drive[k] = moved.drive * log_scale;
      direct[k] = moved.direct * log_scale;
    }
  }

  PROBATION_INLINE void take_states(const Modes& modes, double u, int at) {
    for (int k = 0; k < K; ++k) {
      const std::ptrdiff_t j = at + k * lanes;
      base.take_state(k, load(modes.state + j) * weight[k] - base.direct[k] * u,
                      load(modes.before + j) * weight[k]);
      slope[k] = load(to_slope + j) * weight[k] - direct[k] * u;
      slope_before[k] = load(to_slope_before + j) * weight[k];
      of_w[k] = of_y[k] * base.unit[k];
    }
  }
  PROBATION_INLINE void clear_states() {
    base.clear_states();
    for (int k = 0; k < K; ++k) {
      slope[k] = slope_before[k] = Vector{};
      of_w[k] = of_y[k] * base.unit[k];
    }
  }
  PROBATION_INLINE void put_state(const Modes& modes, double u, int at) const {
    put(modes.state, to_slope, u, at);
  }
  PROBATION_INLINE void put_before(const Modes& modes, double u, int at) const {
    put(modes.before, to_slope_before, u, at);
  }

  PROBATION_INLINE double direct_stress() const { return base.direct_stress(); }
  PROBATION_INLINE double direct_slope() const { return sum(total_of(direct)); }

  /// The sums of y+ and of its slope.
  PROBATION_INLINE StressAndSlope advance(double x) {
    StressAndSlope total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      const Vector here = base.state[k], next = base.step(k, x);
      total.stress = base.unit[k] * next + total.stress;
      Vector moved = of_w[k] * (two_step ? next : here);
      if constexpr (two_step) {
        moved += base.of_before[k] * slope_before[k];
        slope_before[k] = slope[k];
      } else {
        moved += drive[k] * x;
      }
      slope[k] = base.previous[k] * slope[k] + moved;
      total.slope += slope[k];
    }
    return total;
  }

 private:
  /// Modes of weight zero only pad the arrays: no direction here changes weights.
  PROBATION_INLINE void put(double* to, double* slope_to, double u, int at) const {
    for (int k = 0; k < K; ++k) {
      const std::ptrdiff_t j = at + k * lanes;
      store(to + j, choose(weight[k] == 0.0, Vector{}, base.z(k, u) / weight[k]));
      store(slope_to + j, choose(weight[k] == 0.0, Vector{}, (slope[k] + direct[k] * u) / weight[k]));
    }
  }
};

}  // namespace probation::kernels::PROBATION_ISA
