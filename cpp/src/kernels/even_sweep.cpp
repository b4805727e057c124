// Even steps: the coefficients of every mode are formed once. Compiled once per instruction set.
//
// With V half the change of U from step to step, the exponential rule z+ = e z + a U + b U-, a = phi + psi /
// 2, b = -psi / 2, is in states y = z - a U driven by U- alone: y+ = e y + (e a + b) U-. So every rule is
//
//   y+ = previous y + before y- + drive X,     z = y + direct U,     X = U or U-.

#include "convolution.hpp"
#include "sweeps.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

// Vectors of four modes whose states fit the registers: one state a mode, or two.
constexpr int largest_block = 8, largest_two_step_block = 5;

struct EvenStep {
  Vector previous, before, drive, direct;
};

EvenStep even_step(const Modes& modes, const Steps& steps, std::ptrdiff_t at) {
  const double scale = steps.scale[0], ratio = steps.ratio[0];
  if (steps.rule == StepRule::exponential) {
    const auto c = weighted<ExponentialStep>(modes, at, scale, ratio);
    if (!steps.curvature) return {c.previous, Vector{}, c.forcing, Vector{}};
    const Vector direct = c.forcing + 0.5 * c.curvature;
    return {c.previous, Vector{}, c.previous * direct - 0.5 * c.curvature, direct};
  }
  const auto c = steps.rule == StepRule::bdf2 ? weighted<Bdf2Step>(modes, at, scale, ratio)
                                              : weighted<BackwardEulerStep>(modes, at, scale, ratio);
  return {c.previous, c.before, c.forcing, Vector{}};
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

  PROBATION_INLINE void take_states(const Modes& modes, double u, int at) {
    for (int k = 0; k < K; ++k) {
      const std::ptrdiff_t j = at + k * lanes;
      const Vector y = load(modes.state + j) - direct[k] * u, y_before = load(modes.before + j);
      // What nothing drives is driven by next to nothing: its state can be divided by that.
      const Vector divisor = choose(drive[k] * drive[k] < 1e-300, Vector{} + 1e-150, drive[k]);
      unit[k] = choose(y * y + y_before * y_before == 0.0, drive[k], divisor);
      state[k] = y / divisor;
      before[k] = y_before / divisor;
    }
  }
  PROBATION_INLINE void clear_states() {
    for (int k = 0; k < K; ++k) {
      unit[k] = drive[k];
      state[k] = before[k] = Vector{};
    }
  }
  PROBATION_INLINE void put_states(double* to, double u, int at) const {
    for (int k = 0; k < K; ++k)
      store(to + at + std::ptrdiff_t{k} * lanes, unit[k] * state[k] + direct[k] * u);
  }

  /// The sum of y+.
  PROBATION_INLINE Vector advance(double x) {
    Vector total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      Vector driven = Vector{} + x;
      if constexpr (two_step) driven = of_before[k] * before[k] + driven;
      const Vector next = previous[k] * state[k] + driven;
      if constexpr (two_step) before[k] = state[k];
      state[k] = next;
      total = unit[k] * next + total;
    }
    return total;
  }
  PROBATION_INLINE double all_direct() const {
    Vector total{};
    for (int k = 0; k < K; ++k) total += direct[k];
    return sum(total);
  }
};

/// A forcing as a block sees it.
struct Inputs {
  double start;         ///< U before the first step, where it is needed
  double first;         ///< X of the first step
  const double* later;  ///< X of the steps after it

  Inputs(double u_before, const double* u, bool lags)
      : start(u_before), first(lags ? u_before : u[0]), later(lags ? u : u + 1) {}
};

/// Adds the sums of y after all steps.
template <class Block>
PROBATION_INLINE void advance(Block& block, const Inputs& x, int count, double* sums_of_y) {
  sums_of_y[0] += sum(block.advance(x.first));
  add_sums(count - 1, sums_of_y + 1, [&](int n) { return block.advance(x.later[n]); });
}

/// The same, and leaves the block's states at the last two instants; at least two steps.
template <class Block>
PROBATION_INLINE void advance_to_end(Block& block, const Modes& modes, int at, const Inputs& x,
                                     const double* u, int count, double* sums_of_y) {
  const int last = count - 1;
  advance(block, x, last, sums_of_y);
  block.put_states(modes.before, u[last - 1], at);
  sums_of_y[last] += sum(block.advance(x.later[last - 1]));
  block.put_states(modes.state, u[last], at);
}

/// Which modes, by vectors, remember: from..to. Of the others' states `memory` steps leave nothing (2^-53).
struct Memory {
  int from, to;

  Memory(const Modes& modes, const Steps& steps, int memory) : from(0), to(modes.padded) {
    const int vectors_worth_it = memory / 8, steps_worth_it = 4 * memory;
    if (steps.count < steps_worth_it) return;
    // e^(-3 x) (V looks back one step), (1 + x)^-16, (2 (1.5 + x))^-8
    const double least = steps.rule == StepRule::exponential ? 12.3
                         : steps.rule == StepRule::bdf2      ? 47.9
                                                             : 9.0;
    const auto forgets = [&](int at) {
      const Vector x = load(modes.inverse_ratio + at) * steps.scale[0];
      return x[0] > least && x[1] > least && x[2] > least && x[3] > least;
    };
    while (from < to && forgets(from)) from += lanes;
    while (to > from && forgets(to - lanes)) to -= lanes;
    if (modes.padded - (to - from) < vectors_worth_it * lanes) {
      from = 0;
      to = modes.padded;
    }
  }
};

/// Modes that forget within `memory` steps: from then on their stress is the convolution of U with their
/// response to a single U of 1, and their last states follow from the last steps alone.
template <int largest, bool two_step, int memory>
void even_sweep(const Modes& modes, const Steps& steps, double* stress) {
  const double* u = steps.forcing;
  const int count = steps.count;
  const bool lags = steps.curvature != nullptr;
  const Inputs all(lags ? u[0] - 2.0 * steps.curvature[0] : 0.0, u, lags);
  double direct = 0.0, response[memory] = {};

  const Memory remembering(modes, steps, memory);
  in_blocks<largest>(remembering.from, remembering.to, [&](auto size, int at) {
    EvenBlock<two_step, decltype(size)::value> block(modes, steps, at);
    direct += block.all_direct();
    block.take_states(modes, all.start, at);
    advance_to_end(block, modes, at, all, u, count, stress);
  });
  const auto forgetful = [&](auto size, int at) {
    EvenBlock<two_step, decltype(size)::value> block(modes, steps, at);
    direct += block.all_direct();
    block.take_states(modes, all.start, at);
    advance(block, all, memory, stress);
    block.clear_states();
    const double impulse[memory] = {1.0};
    advance(block, Inputs(0.0, impulse, lags), memory, response);
    block.clear_states();
    constexpr int ending = memory + 1;  // one instant more, for what is left of the last step but one
    double ignored[ending] = {};
    const double* end = u + (count - ending);
    advance_to_end(block, modes, at, Inputs(end[-1], end, lags), end, ending, ignored);
  };
  in_blocks<largest>(0, remembering.from, forgetful);
  in_blocks<largest>(remembering.to, modes.padded, forgetful);

  if (!lags && remembering.from == 0 && remembering.to == modes.padded) return;
  const int first = count < memory ? count : memory;
  for (int n = 0; n < first; ++n) stress[n] += direct * u[n];
  response[0] += direct;
  convolve<memory>(response, u + first, count - first, stress + first);
}

}  // namespace

void even_sweep(const Modes& modes, const Steps& steps, double* stress) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return even_sweep<largest_block, false, 16>(modes, steps, stress);
    case StepRule::bdf2:
      return even_sweep<largest_two_step_block, true, 16>(modes, steps, stress);
    case StepRule::exponential:
      return even_sweep<largest_block, false, 4>(modes, steps, stress);
  }
}

}  // namespace probation::kernels::PROBATION_ISA
