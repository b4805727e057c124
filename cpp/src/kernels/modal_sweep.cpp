// The modal recursion: blocks of modes in registers, time innermost. Compiled once per instruction set.

#include <cstddef>

#include "coefficient_rows.hpp"
#include "coupled_step.hpp"
#include "kernels.hpp"
#include "vector.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

// Vectors of four modes whose states fit the registers: of even steps, of uneven ones, of a tangent.
constexpr int largest_block = 7, largest_variable_block = 4, largest_tangent_block = 3;

template <int K>
struct Size {
  static constexpr int value = K;
};

/// K vectors of modes, their coefficients fixed over the run.
template <int K>
struct Block {
  Vector state[K], before[K];
  Vector previous[K], earlier[K], forcing[K], curvature[K];
};

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

template <class Step, bool two_step, bool curved, int K>
PROBATION_INLINE Vector advance(Block<K>& b, double forcing, double curvature) {
  Vector total{};
#pragma GCC unroll 8
  for (int k = 0; k < K; ++k) {
    Vector drive = b.forcing[k] * forcing;
    if constexpr (curved) drive = b.curvature[k] * curvature + drive;
    if constexpr (two_step) drive = b.earlier[k] * b.before[k] + drive;
    const Vector next = b.previous[k] * b.state[k] + drive;
    if constexpr (two_step) b.before[k] = b.state[k];
    b.state[k] = next;
    total += next;
  }
  return total;
}

/// Adds the sum of what advance(n) returns to stress[n], four steps at a time.
template <class Advance>
PROBATION_INLINE void add_sums(int count, double* stress, Advance advance) {
  int n = 0;
  Vector four[lanes];
  for (; n + lanes <= count; n += lanes) {
#pragma GCC unroll 4
    for (int i = 0; i < lanes; ++i) four[i] = advance(n + i);
    store(stress + n, load(stress + n) + sums(four[0], four[1], four[2], four[3]));
  }
  for (; n < count; ++n) stress[n] += sum(advance(n));
}

template <class Step, bool two_step, bool curved, int K>
void uniform_block(const Modes& modes, const Steps& steps, int at, double* stress) {
  Block<K> b;
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    const StepCoefficients<Vector> c = weighted<Step>(modes, j, steps.scale[0], steps.ratio[0]);
    b.previous[k] = c.previous;
    b.earlier[k] = c.before;
    b.forcing[k] = c.forcing;
    b.curvature[k] = c.curvature;
    b.state[k] = load(modes.state + j);
    b.before[k] = load(modes.before + j);
  }
  const double* u = steps.forcing;
  const double* v = steps.curvature;
  add_sums(steps.count, stress,
           [&](int n) { return advance<Step, two_step, curved>(b, u[n], curved ? v[n] : 0.0); });
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    store(modes.state + j, b.state[k]);
    if constexpr (two_step) store(modes.before + j, b.before[k]);
  }
}

/// Calls body(Size<K>, at) for blocks of K vectors of modes, then for ever smaller ones of what is left.
template <int K, class Body>
PROBATION_INLINE void in_blocks(const Modes& modes, int at, Body body) {
  for (; modes.padded - at >= K * lanes; at += K * lanes) body(Size<K>{}, at);
  if constexpr (K > 1) in_blocks<K - 1>(modes, at, body);
}

template <class Step, bool two_step, bool curved>
void uniform_run(const Modes& modes, const Steps& steps, double* stress) {
  in_blocks<largest_block>(modes, 0, [&](auto size, int at) {
    uniform_block<Step, two_step, curved, decltype(size)::value>(modes, steps, at, stress);
  });
}

/// K vectors of modes whose coefficients are formed anew in every step.
template <class Step, bool two_step, bool curved, int K>
void variable_block(const Modes& modes, const Steps& steps, int at, double* stress) {
  Vector state[K], before[K];
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    state[k] = load(modes.state + j);
    before[k] = load(modes.before + j);
  }
  add_sums(steps.count, stress, [&](int n) {
    Vector total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      const StepCoefficients<Vector> c =
          weighted<Step>(modes, at + k * lanes, steps.scale[n], steps.ratio[n]);
      Vector next = c.forcing * steps.forcing[n];
      if constexpr (curved) next = c.curvature * steps.curvature[n] + next;
      if constexpr (two_step) next = c.before * before[k] + next;
      next = c.previous * state[k] + next;
      before[k] = state[k];
      state[k] = next;
      total += next;
    }
    return total;
  });
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    store(modes.state + j, state[k]);
    store(modes.before + j, before[k]);
  }
}

template <class Step, bool two_step, bool curved>
void variable_run(const Modes& modes, const Steps& steps, double* stress) {
  in_blocks<largest_variable_block>(modes, 0, [&](auto size, int at) {
    variable_block<Step, two_step, curved, decltype(size)::value>(modes, steps, at, stress);
  });
}

template <class Step, bool two_step>
void variable_run(const Modes& modes, const Steps& steps, double* stress) {
  if (steps.curvature)
    variable_run<Step, two_step, true>(modes, steps, stress);
  else
    variable_run<Step, two_step, false>(modes, steps, stress);
}

/// The last one of even steps.
Steps last_of(const Steps& steps) {
  const int last = steps.count - 1;
  const double* curvature = steps.curvature ? steps.curvature + last : nullptr;
  return {steps.rule, 1, true, steps.scale, steps.ratio, steps.forcing + last, curvature};
}

/// A one-step rule leaves `before` one instant behind `state` too, so that bE2 can go on from it.
template <class Step, bool two_step>
void run(const Modes& modes, const Steps& steps, double* stress) {
  const int last = steps.count - 1;
  if (!steps.uniform || last < 1) return variable_run<Step, two_step>(modes, steps, stress);
  Steps most = steps;
  most.count = two_step ? steps.count : last;
  if (steps.curvature)
    uniform_run<Step, two_step, true>(modes, most, stress);
  else
    uniform_run<Step, two_step, false>(modes, most, stress);
  if constexpr (!two_step) variable_run<Step, two_step>(modes, last_of(steps), stress + last);
}

void sweep(const Modes& modes, const Steps& steps, double* stress) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return run<BackwardEulerStep, false>(modes, steps, stress);
    case StepRule::bdf2:
      return run<Bdf2Step, true>(modes, steps, stress);
    case StepRule::exponential:
      return run<ExponentialStep, false>(modes, steps, stress);
  }
}

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
    const auto put = [&](double* to, Vector z) { store(to + j, weight == 0.0 ? Vector{} : z / weight); };
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
  in_blocks<largest_tangent_block>(modes, 0, [&](auto size, int at) {
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
    tangent_run<Step>(modes, last_of(steps), stress + last, &end, 1, scratch);
  }
}

void tangent(const Modes& modes, const Steps& steps, double* stress, const TangentDirection* directions,
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

template <class Step>
Trial try_step(const Modes& modes, const Steps& steps) {
  const double u = steps.forcing[0], v = steps.curvature ? steps.curvature[0] : 0.0;
  Vector stress{}, by_log_scale{}, by_forcing{}, by_curvature{};
  for (int at = 0; at < modes.padded; at += lanes) {
    const Vector x = load(modes.inverse_ratio + at) * steps.scale[0];
    const Vector weight = load(modes.weight + at), z = load(modes.state + at),
                 before = load(modes.before + at);
    const StepCoefficients<Vector> c = Step::template coefficients<Vector>(x, steps.ratio[0]);
    const StepCoefficients<Vector> d = Step::template log_slopes<Vector>(x, steps.ratio[0]);
    stress += c.previous * z + c.before * before + weight * (c.forcing * u + c.curvature * v);
    by_log_scale += d.previous * z + d.before * before + weight * (d.forcing * u + d.curvature * v);
    by_forcing += weight * c.forcing;
    by_curvature += weight * c.curvature;
  }
  return {sum(stress), sum(by_log_scale), sum(by_forcing), sum(by_curvature)};
}

Trial trial(const Modes& modes, const Steps& steps) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return try_step<BackwardEulerStep>(modes, steps);
    case StepRule::bdf2:
      return try_step<Bdf2Step>(modes, steps);
    case StepRule::exponential:
      return try_step<ExponentialStep>(modes, steps);
  }
  return {};
}

}  // namespace

#define PROBATION_TEXT_OF(name) #name
#define PROBATION_TEXT(name) PROBATION_TEXT_OF(name)
const Kernels table{PROBATION_TEXT(PROBATION_ISA),
                    sweep,
                    tangent,
                    trial,
                    fill_rows,
                    weigh_rows,
                    look,
                    advance,
                    linearise,
                    drift,
                    move};

}  // namespace probation::kernels::PROBATION_ISA
