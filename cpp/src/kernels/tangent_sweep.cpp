// Stress and its tangents along directions. Compiled once per instruction set.

#include "blocks.hpp"
#include "sweeps.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

constexpr int largest_tangent_block = 3;  // vectors of four modes whose states and slopes fit the registers

/// Coefficients and their slopes for every mode, in scratch: previous, before, forcing, curvature, then the
/// slopes.
template <class Step>
void tabulate(const Modes& modes, double scale, double ratio, double* scratch) {
  const std::ptrdiff_t m = modes.padded;
  for (std::ptrdiff_t at = 0; at < m; at += lanes) {
    const Vector x = load(modes.inverse_ratio + at) * scale;
    const StepCoefficients<Vector> c = Step::template coefficients<Vector>(x, ratio);
    const StepCoefficients<Vector> d = Step::template log_slopes<Vector>(x, ratio);
    const Vector rows[8] = {c.previous, c.before, c.forcing, c.curvature,
                            d.previous, d.before, d.forcing, d.curvature};
    for (std::ptrdiff_t row = 0; row < 8; ++row) store(scratch + row * m + at, rows[row]);
  }
}

PROBATION_INLINE Vector combine(const double* rows, std::ptrdiff_t m, std::ptrdiff_t at, Vector y,
                                Vector before, double u, double v) {
  return load(rows + at) * y + load(rows + m + at) * before + load(rows + 2 * m + at) * u +
         load(rows + 3 * m + at) * v;
}

template <class Step>
void tangent_run(const Modes& modes, const Steps& steps, double* stress, const TangentDirection* directions,
                 int count, double* scratch) {
  const std::ptrdiff_t m = modes.padded;
  const double* slopes = scratch + 4 * m;
  double* by_log_scale = scratch + 8 * m;
  for (int n = 0; n < steps.count; ++n) {
    if (n == 0 || !steps.uniform) tabulate<Step>(modes, steps.scale[n], steps.ratio[n], scratch);
    const double u = steps.forcing[n], v = steps.curvature ? steps.curvature[n] : 0.0;
    Vector total{};
    for (std::ptrdiff_t at = 0; at < m; at += lanes) {
      const Vector y = load(modes.state + at), before = load(modes.before + at);
      const Vector next = combine(scratch, m, at, y, before, u, v);
      store(by_log_scale + at, combine(slopes, m, at, y, before, u, v));
      store(modes.before + at, y);
      store(modes.state + at, next);
      total += load(modes.weight + at) * next;
    }
    stress[n] += sum(total);

    for (int k = 0; k < count; ++k) {
      const TangentDirection& d = directions[k];
      const double du = d.forcing ? d.forcing[n] : 0.0, dv = d.curvature ? d.curvature[n] : 0.0;
      const double dx = d.log_scale ? d.log_scale[n] : 0.0;
      Vector change{};
      for (std::ptrdiff_t at = 0; at < m; at += lanes) {
        const Vector y = load(d.state + at);
        const Vector dlnx = d.log_inverse ? load(d.log_inverse + at) + dx : Vector{} + dx;
        const Vector next =
            combine(scratch, m, at, y, load(d.before + at), du, dv) + load(by_log_scale + at) * dlnx;
        store(d.before + at, y);
        store(d.state + at, next);
        change += load(modes.weight + at) * next;
        if (d.weight) change += load(d.weight + at) * load(modes.state + at);
      }
      d.stress[n] += sum(change);
    }
  }
}

/// K vectors of modes and of their slopes where only the time scale moves; weights included, as in Block.
template <int K>
struct TangentBlock {
  Vector state[K], before[K], slope[K], slope_before[K];
  StepCoefficients<Vector> c[K], by_log_scale[K];
};

struct StressAndSlope {
  Vector stress, slope;
};

template <bool two_step, bool curved, int K>
PROBATION_INLINE StressAndSlope advance(TangentBlock<K>& b, double u, double v, double log_scale) {
  StressAndSlope total{};
  const auto apply = [u, v](const StepCoefficients<Vector>& c, Vector y, Vector before, Vector more) {
    more = c.forcing * u + more;
    if constexpr (curved) more = c.curvature * v + more;
    if constexpr (two_step) more = c.before * before + more;
    return c.previous * y + more;
  };
#pragma GCC unroll 8
  for (int k = 0; k < K; ++k) {
    const Vector next = apply(b.c[k], b.state[k], b.before[k], Vector{});
    Vector change = apply(b.by_log_scale[k], b.state[k], b.before[k], Vector{}) * log_scale;
    if constexpr (two_step) change = b.c[k].before * b.slope_before[k] + change;
    change = b.c[k].previous * b.slope[k] + change;
    if constexpr (two_step) {
      b.before[k] = b.state[k];
      b.slope_before[k] = b.slope[k];
    }
    b.state[k] = next;
    b.slope[k] = change;
    total.stress += next;
    total.slope += change;
  }
  return total;
}

template <class Step, bool two_step, bool curved, int K>
void time_tangent_block(const Modes& modes, const Steps& steps, int at, double* stress,
                        const TangentDirection& d) {
  TangentBlock<K> b;
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    const Vector x = load(modes.inverse_ratio + j) * steps.scale[0];
    const Vector weight = load(modes.weight + j);
    b.c[k] = weighted(Step::template coefficients<Vector>(x, steps.ratio[0]), weight);
    b.by_log_scale[k] = weighted(Step::template log_slopes<Vector>(x, steps.ratio[0]), weight);
    b.state[k] = load(modes.state + j) * weight;
    b.before[k] = load(modes.before + j) * weight;
    b.slope[k] = load(d.state + j) * weight;
    b.slope_before[k] = load(d.before + j) * weight;
  }
  const auto step = [&](int n) {
    return advance<two_step, curved>(b, steps.forcing[n], curved ? steps.curvature[n] : 0.0, d.log_scale[n]);
  };
  int n = 0;
  StressAndSlope four[lanes];
  for (; n + lanes <= steps.count; n += lanes) {
#pragma GCC unroll 4
    for (int i = 0; i < lanes; ++i) four[i] = step(n + i);
    store(stress + n,
          load(stress + n) + sums(four[0].stress, four[1].stress, four[2].stress, four[3].stress));
    store(d.stress + n,
          load(d.stress + n) + sums(four[0].slope, four[1].slope, four[2].slope, four[3].slope));
  }
  for (; n < steps.count; ++n) {
    const StressAndSlope one = step(n);
    stress[n] += sum(one.stress);
    d.stress[n] += sum(one.slope);
  }
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    const Vector weight = load(modes.weight + j);
    // A mode of weight zero is nobody's: no direction here has weights of its own.
    const auto put = [&](double* to, Vector z) {
      store(to + j, choose(weight == 0.0, Vector{}, z / weight));
    };
    put(modes.state, b.state[k]);
    put(d.state, b.slope[k]);
    if constexpr (two_step) {
      put(modes.before, b.before[k]);
      put(d.before, b.slope_before[k]);
    }
  }
}

/// As tangent_run, for even steps along one direction in which only the time scale moves.
template <class Step, bool two_step, bool curved>
void time_tangent_run(const Modes& modes, const Steps& steps, double* stress, const TangentDirection& d) {
  in_blocks<largest_tangent_block>(0, modes.padded, [&](auto size, int at) {
    time_tangent_block<Step, two_step, curved, decltype(size)::value>(modes, steps, at, stress, d);
  });
}

template <class Step, bool two_step>
void tangent_by_rule(const Modes& modes, const Steps& steps, double* stress,
                     const TangentDirection* directions, int count, double* scratch) {
  const int last = steps.count - 1;
  if (count != 1 || !steps.uniform || last < 1)
    return tangent_run<Step>(modes, steps, stress, directions, count, scratch);
  const TangentDirection& d = directions[0];
  if (!d.log_scale || d.forcing || d.curvature || d.log_inverse || d.weight)
    return tangent_run<Step>(modes, steps, stress, directions, count, scratch);
  Steps most = steps;
  most.count = two_step ? steps.count : last;
  if (steps.curvature)
    time_tangent_run<Step, two_step, true>(modes, most, stress, d);
  else
    time_tangent_run<Step, two_step, false>(modes, most, stress, d);
  if constexpr (!two_step) {  // the last step leaves `before` behind, as in run()
    TangentDirection end = d;
    end.log_scale += last;
    end.stress += last;
    tangent_run<Step>(modes, part_of(steps, last, 1), stress + last, &end, 1, scratch);
  }
}

}  // namespace

void tangent_sweep(const Modes& modes, const Steps& steps, double* stress, const TangentDirection* directions,
                   int count, double* scratch) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return tangent_by_rule<BackwardEulerStep, false>(modes, steps, stress, directions, count, scratch);
    case StepRule::bdf2:
      return tangent_by_rule<Bdf2Step, true>(modes, steps, stress, directions, count, scratch);
    case StepRule::exponential:
      return tangent_by_rule<ExponentialStep, false>(modes, steps, stress, directions, count, scratch);
  }
}

}  // namespace probation::kernels::PROBATION_ISA
