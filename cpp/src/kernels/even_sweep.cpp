// Even steps: the coefficients of every mode are formed once. Compiled once per instruction set.

#include "convolution.hpp"
#include "even_block.hpp"
#include "sweeps.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

/// A forcing as a block sees it.
struct Inputs {
  double start;         ///< U before the first step, where it is needed
  double first;         ///< X of the first step
  const double* later;  ///< X of the steps after it

  Inputs(double u_before, const double* u, bool lags)
      : start(u_before), first(lags ? u_before : u[0]), later(lags ? u : u + 1) {}
};

/// What a block's sums are added to, step by step; no slope but for a tangent.
struct Outputs {
  double* stress;
  double* slope;

  Outputs from(int n) const { return {stress + n, slope ? slope + n : nullptr}; }
  PROBATION_INLINE void add(Vector total) const { stress[0] += sum(total); }
  PROBATION_INLINE void add(const StressAndSlope& total) const {
    stress[0] += sum(total.stress);
    slope[0] += sum(total.slope);
  }
};

template <bool two_step, int K>
PROBATION_INLINE void advance_all(EvenBlock<two_step, K>& block, const double* x, int count, Outputs out) {
  add_sums(count, out.stress, [&](int n) { return block.advance(x[n]); });
}
template <bool two_step, int K>
PROBATION_INLINE void advance_all(EvenTangentBlock<two_step, K>& block, const double* x, int count,
                                  Outputs out) {
  add_both_sums(count, out.stress, out.slope, [&](int n) { return block.advance(x[n]); });
}

/// Adds the sums of y after all steps.
template <class Block>
PROBATION_INLINE void advance(Block& block, const Inputs& x, int count, Outputs out) {
  out.add(block.advance(x.first));
  advance_all(block, x.later, count - 1, out.from(1));
}

/// The same, and leaves the block's states at the last two instants; at least two steps.
template <class Block>
PROBATION_INLINE void advance_to_end(Block& block, const Modes& modes, int at, const Inputs& x,
                                     const double* u, int count, Outputs out) {
  const int last = count - 1;
  advance(block, x, last, out);
  block.put_before(modes, u[last - 1], at);
  out.from(last).add(block.advance(x.later[last - 1]));
  block.put_state(modes, u[last], at);
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

/// What U and the U before it add to the sums over the modes, as a convolution.
template <int memory>
struct Response {
  double direct = 0.0;         ///< of U alone, for all modes
  double later[memory] = {0};  ///< sums of y after one U of 1, for modes that forget it

  void add_to(double* sums, const double* u, int count) {
    const int first = count < memory ? count : memory;
    for (int n = 0; n < first; ++n) sums[n] += direct * u[n];
    later[0] += direct;
    convolve<memory>(later, u + first, count - first, sums + first);
  }
};

/// Modes that forget within `memory` steps: from then on their stress is the convolution of U with their
/// response, and their last states follow from the last steps alone. block_of(size, at) makes the blocks.
template <int memory, int largest, class BlockOf>
void sweep(const Modes& modes, const Steps& steps, Outputs out, BlockOf block_of) {
  const double* u = steps.forcing;
  const int count = steps.count;
  const bool lags = steps.curvature != nullptr;
  const Inputs all(lags ? u[0] - 2.0 * steps.curvature[0] : 0.0, u, lags);
  Response<memory> stress, slope;
  const auto keep_direct = [&](const auto& block) {
    stress.direct += block.direct_stress();
    slope.direct += block.direct_slope();
  };

  const Memory remembering(modes, steps, memory);
  in_blocks<largest>(remembering.from, remembering.to, [&](auto size, int at) {
    auto block = block_of(size, at);
    keep_direct(block);
    block.take_states(modes, all.start, at);
    advance_to_end(block, modes, at, all, u, count, out);
  });
  const auto forgetful = [&](auto size, int at) {
    auto block = block_of(size, at);
    keep_direct(block);
    block.take_states(modes, all.start, at);
    advance(block, all, memory, out);
    block.clear_states();
    const double impulse[memory] = {1.0};
    advance(block, Inputs(0.0, impulse, lags), memory, {stress.later, slope.later});
    block.clear_states();
    constexpr int ending = memory + 1;  // one instant more, for what is left of the last step but one
    double ignored[2][ending] = {};
    const double* end = u + (count - ending);
    advance_to_end(block, modes, at, Inputs(end[-1], end, lags), end, ending, {ignored[0], ignored[1]});
  };
  in_blocks<largest>(0, remembering.from, forgetful);
  in_blocks<largest>(remembering.to, modes.padded, forgetful);

  if (!lags && remembering.from == 0 && remembering.to == modes.padded) return;
  stress.add_to(out.stress, u, count);
  if (out.slope) slope.add_to(out.slope, u, count);
}

/// Calls take(two_step, memory) as constants of the rule.
template <class Take>
void by_rule(StepRule rule, Take take) {
  switch (rule) {
    case StepRule::backward_euler:
      return take(Size<false>{}, Size<16>{});
    case StepRule::bdf2:
      return take(Size<true>{}, Size<16>{});
    case StepRule::exponential:
      return take(Size<false>{}, Size<4>{});
  }
}

}  // namespace

void even_sweep(const Modes& modes, const Steps& steps, double* stress) {
  by_rule(steps.rule, [&](auto two_step, auto memory) {
    constexpr bool two = decltype(two_step)::value;
    sweep<decltype(memory)::value, two ? 5 : 8>(modes, steps, {stress, nullptr}, [&](auto size, int at) {
      return EvenBlock<two, decltype(size)::value>(modes, steps, at);
    });
  });
}

void even_tangent_sweep(const Modes& modes, const Steps& steps, double* stress, const TangentDirection& d) {
  by_rule(steps.rule, [&](auto two_step, auto memory) {
    constexpr bool two = decltype(two_step)::value;
    sweep<decltype(memory)::value, two ? 3 : 4>(modes, steps, {stress, d.stress}, [&](auto size, int at) {
      return EvenTangentBlock<two, decltype(size)::value>(modes, steps, d, at);
    });
  });
}

}  // namespace probation::kernels::PROBATION_ISA
