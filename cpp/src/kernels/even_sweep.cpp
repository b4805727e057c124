// Eq. (6) in the variables of schemes/step.hpp.
// Even steps: the coefficients of every mode are formed once. Compiled once per instruction set.

#include "convolution.hpp"
#include "even_block.hpp"
#include "sweeps.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

/// The forcing of a block.
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

/// Modes, by vectors, that keep a memory: from..to. After `memory` steps the others' states are below 2^-53.
struct Memory {
  int from, to;

  Memory(const Modes& modes, const Steps& steps, int memory) : from(0), to(modes.padded) {
    const int modes_worth_it = memory / 2, steps_worth_it = 4 * memory;
    if (steps.count < steps_worth_it) return;
    // e^(-3 x) (V looks back one step), (2 (1.5 + x))^-8
    const double least = steps.rule == StepRule::exponential ? 12.3 : 9.0;
    const auto forgets = [&](int at) {
      return all_above(load(modes.inverse_ratio + at) * steps.scale[0], least);
    };
    while (from < to && forgets(from)) from += lanes;
    while (to > from && forgets(to - lanes)) to -= lanes;
    if (modes.padded - (to - from) < modes_worth_it) {
      from = 0;
      to = modes.padded;
    }
  }
};

/// The sums over the modes as a convolution of U.
template <int memory>
struct Response {
  double direct = 0.0;         ///< of U alone, for all modes
  double later[memory] = {0};  ///< sums of y after one U of 1, over modes whose memory ends

  void add_to(double* sums, const double* u, int count) {
    const int first = count < memory ? count : memory;
    for (int n = 0; n < first; ++n) sums[n] += direct * u[n];
    later[0] += direct;
    convolve<memory>(later, u + first, count - first, sums + first);
  }
};

/// Modes whose memory ends within `memory` steps: from then on their stress is the convolution of U with
/// their response, and their last states follow from the last steps alone. block_of(size, at) makes the
/// blocks.
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
  const int sides[2][2] = {{0, remembering.from}, {remembering.to, modes.padded}};
  for (const auto& side : sides) in_blocks<largest>(side[0], side[1], forgetful);

  if (!lags && remembering.from == 0 && remembering.to == modes.padded) return;
  stress.add_to(out.stress, u, count);
  if (out.slope) slope.add_to(out.slope, u, count);
}

/// Steps after which the memory of fast modes ends.
template <bool two_step>
constexpr int memory_of_rule = two_step ? 16 : 4;

template <bool two_step>
void sweep(const Modes& modes, const Steps& steps, double* stress) {
  constexpr int largest = two_step ? 5 : 8;
  sweep<memory_of_rule<two_step>, largest>(modes, steps, {stress, nullptr}, [&](auto size, int at) {
    return EvenBlock<two_step, decltype(size)::value>(modes, steps, at);
  });
}

template <bool two_step>
void sweep(const Modes& modes, const Steps& steps, double* stress, const TangentDirection& d) {
  constexpr int largest = two_step ? 3 : 4;
  sweep<memory_of_rule<two_step>, largest>(modes, steps, {stress, d.stress}, [&](auto size, int at) {
    return EvenTangentBlock<two_step, decltype(size)::value>(modes, steps, d, at);
  });
}

}  // namespace

void even_sweep(const Modes& modes, const Steps& steps, double* stress) {
  if (steps.rule == StepRule::bdf2) return sweep<true>(modes, steps, stress);
  sweep<false>(modes, steps, stress);
}

void even_tangent_sweep(const Modes& modes, const Steps& steps, double* stress, const TangentDirection& d) {
  if (steps.rule == StepRule::bdf2) return sweep<true>(modes, steps, stress, d);
  sweep<false>(modes, steps, stress, d);
}

}  // namespace probation::kernels::PROBATION_ISA
