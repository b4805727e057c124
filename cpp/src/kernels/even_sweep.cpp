// Even steps: the coefficients of every mode are formed once. Compiled once per instruction set.

#include "blocks.hpp"
#include "slaved.hpp"
#include "sweeps.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

// Vectors of four modes whose states fit the registers: one state a mode, or two.
constexpr int largest_block = 8, largest_two_step_block = 5;

/// y+ = previous * y + before * y- + forcing * U, or a one-step rule.
template <bool two_step, int K>
void one_forcing_block(const Modes& modes, const Steps& steps, int at, double* stress) {
  Vector state[K], before[K], of_state[K], of_before[K], of_forcing[K];
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    const auto c = two_step ? weighted<Bdf2Step>(modes, j, steps.scale[0], steps.ratio[0])
                   : steps.rule == StepRule::exponential
                       ? weighted<ExponentialStep>(modes, j, steps.scale[0], steps.ratio[0])
                       : weighted<BackwardEulerStep>(modes, j, steps.scale[0], steps.ratio[0]);
    of_state[k] = c.previous;
    of_before[k] = c.before;
    of_forcing[k] = c.forcing;
    state[k] = load(modes.state + j);
    before[k] = load(modes.before + j);
  }
  add_sums(steps.count, stress, [&](int n) {
    const double u = steps.forcing[n];
    Vector total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      Vector drive = of_forcing[k] * u;
      if constexpr (two_step) drive = of_before[k] * before[k] + drive;
      const Vector next = of_state[k] * state[k] + drive;
      if constexpr (two_step) before[k] = state[k];
      state[k] = next;
      total += next;
    }
    return total;
  });
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    store(modes.state + j, state[k]);
    if constexpr (two_step) store(modes.before + j, before[k]);
  }
}

template <int largest, bool two_step>
void one_forcing(const Modes& modes, const Steps& steps, int from, int to, double* stress) {
  in_blocks<largest>(from, to, [&](auto size, int at) {
    one_forcing_block<two_step, decltype(size)::value>(modes, steps, at, stress);
  });
}

/// The exponential rule under U and any V.
template <int K>
void curved_block(const Modes& modes, const Steps& steps, int at, double* stress) {
  Vector state[K], of_state[K], of_forcing[K], of_curvature[K];
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    const auto c = weighted<ExponentialStep>(modes, j, steps.scale[0], steps.ratio[0]);
    of_state[k] = c.previous;
    of_forcing[k] = c.forcing;
    of_curvature[k] = c.curvature;
    state[k] = load(modes.state + j);
  }
  add_sums(steps.count, stress, [&](int n) {
    const double u = steps.forcing[n], v = steps.curvature[n];
    Vector total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      state[k] = of_state[k] * state[k] + (of_forcing[k] * u + of_curvature[k] * v);
      total += state[k];
    }
    return total;
  });
  for (int k = 0; k < K; ++k) store(modes.state + at + std::ptrdiff_t{k} * lanes, state[k]);
}

/// The exponential rule where V is half the change of U: z+ = e z + a U + b U-, a = phi + psi / 2, b = -psi
/// / 2. The states y = z - a U see U- alone,
///
///   y+ = e y + (e a + b) U-,    sum z+ = sum y+ + U sum a,
///
/// which saves a third of the work. Returns sum a.
template <int K>
double parabolic_block(const Modes& modes, const Steps& steps, int at, double* stress) {
  Vector state[K], of_state[K], of_forcing[K], direct[K], all_direct{};
  const double start = steps.forcing[0] - 2.0 * steps.curvature[0];
  const int last = steps.count - 1;
  for (int k = 0; k < K; ++k) {
    const std::ptrdiff_t j = at + k * lanes;
    const auto c = weighted<ExponentialStep>(modes, j, steps.scale[0], steps.ratio[0]);
    direct[k] = c.forcing + 0.5 * c.curvature;
    all_direct += direct[k];
    of_state[k] = c.previous;
    of_forcing[k] = c.previous * direct[k] - 0.5 * c.curvature;
    state[k] = of_state[k] * (load(modes.state + j) - direct[k] * start) + of_forcing[k] * start;
  }
  const auto total_of = [&] {
    Vector total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) total += state[k];
    return total;
  };
  stress[0] += sum(total_of());
  add_sums(last, stress + 1, [&](int n) {
    const double u = steps.forcing[n];
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) state[k] = of_state[k] * state[k] + of_forcing[k] * u;
    return total_of();
  });
  for (int k = 0; k < K; ++k)
    store(modes.state + at + std::ptrdiff_t{k} * lanes, state[k] + direct[k] * steps.forcing[last]);
  return sum(all_direct);
}

void exponential_sweep(const Modes& modes, const Steps& steps, double* stress) {
  const SlavedModes slaved(modes, steps.scale[0]);
  slaved.sweep(modes, steps, stress);
  if (!steps.curvature)
    return one_forcing<largest_block, false>(modes, steps, slaved.from, slaved.to, stress);
  if (steps.parabolic) {
    double direct = 0.0;
    in_blocks<largest_block>(slaved.from, slaved.to, [&](auto size, int at) {
      direct += parabolic_block<decltype(size)::value>(modes, steps, at, stress);
    });
    const double* u = steps.forcing;
    for (int n = 0; n < steps.count; ++n) stress[n] += direct * u[n];
    return;
  }
  in_blocks<largest_two_step_block>(slaved.from, slaved.to, [&](auto size, int at) {
    curved_block<decltype(size)::value>(modes, steps, at, stress);
  });
}

}  // namespace

void even_sweep(const Modes& modes, const Steps& steps, double* stress) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return one_forcing<largest_block, false>(modes, steps, 0, modes.padded, stress);
    case StepRule::bdf2:
      return one_forcing<largest_two_step_block, true>(modes, steps, 0, modes.padded, stress);
    case StepRule::exponential:
      return exponential_sweep(modes, steps, stress);
  }
}

}  // namespace probation::kernels::PROBATION_ISA
