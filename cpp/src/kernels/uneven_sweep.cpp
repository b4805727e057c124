// Eq. (6) in the variables of schemes/step.hpp.
// Steps of any length: every step has its own coefficients. Compiled once per instruction set.

#include "quasi_steady.hpp"
#include "scale_table.hpp"
#include "sweeps.hpp"
#include "uneven_bdf2.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

// Vectors in a block: coefficients from a table or a reciprocal, or formed by an exponential.
constexpr int largest_block = 4, largest_formed_block = 2;

/// K vectors of modes, their states in units of their weights: the forcing drives all of them alike.
template <int K>
struct UnitBlock {
  Vector inverse_ratio[K], unit[K], state[K], before[K];

  PROBATION_INLINE UnitBlock(const Modes& modes, int at) {
    for (int k = 0; k < K; ++k) {
      const std::ptrdiff_t j = at + k * lanes;
      const Vector weight = load(modes.weight + j), z = load(modes.state + j),
                   z_before = load(modes.before + j);
      // A weight of zero is replaced by a tiny one, so that the state can be divided by it.
      const Vector divisor = choose(weight < 1e-150, Vector{} + 1e-150, weight);
      inverse_ratio[k] = load(modes.inverse_ratio + j);
      unit[k] = choose(z * z + z_before * z_before == 0.0, weight, divisor);
      state[k] = z / divisor;
      before[k] = z_before / divisor;
    }
  }
  PROBATION_INLINE void put_back(const Modes& modes, int at) const {
    for (int k = 0; k < K; ++k) {
      const std::ptrdiff_t j = at + k * lanes;
      store(modes.state + j, unit[k] * state[k]);
      store(modes.before + j, unit[k] * before[k]);
    }
  }
};

/// K vectors of modes whose coefficients are formed in every step.
template <class Step, bool two_step, bool curved, int K>
void formed_block(const Modes& modes, const Steps& steps, int at, double* stress) {
  UnitBlock<K> b(modes, at);
  add_sums(steps.count, stress, [&](int n) {
    Vector total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      const auto c = Step::template coefficients<Vector>(b.inverse_ratio[k] * steps.scale[n], steps.ratio[n]);
      Vector next = c.forcing * steps.forcing[n];
      if constexpr (curved) next = c.curvature * steps.curvature[n] + next;
      if constexpr (two_step) next = c.before * b.before[k] + next;
      next = c.previous * b.state[k] + next;
      b.before[k] = b.state[k];
      b.state[k] = next;
      total += b.unit[k] * next;
    }
    return total;
  });
  b.put_back(modes, at);
}

template <class Step, bool two_step, bool curved>
void formed_sweep(const Modes& modes, const Steps& steps, double* stress) {
  in_blocks<largest_formed_block>(0, modes.padded, [&](auto size, int at) {
    formed_block<Step, two_step, curved, decltype(size)::value>(modes, steps, at, stress);
  });
}

void formed_exponential_sweep(const Modes& modes, const Steps& steps, double* stress) {
  if (steps.curvature)
    formed_sweep<ExponentialStep, false, true>(modes, steps, stress);
  else
    formed_sweep<ExponentialStep, false, false>(modes, steps, stress);
}

/// K vectors of modes whose coefficients come from a table, by their first `terms`; `before` is left alone.
template <bool curved, int terms, int K>
void tabled_block(const Modes& modes, const Steps& steps, const TabledSteps& tabled, int at, double* stress) {
  UnitBlock<K> b(modes, at);
  add_sums(steps.count, stress, [&](int n) {
    const double* row = tabled.rows[n] + static_cast<std::ptrdiff_t>(at) * ScaleTable::terms;
    const double offset = tabled.offset[n], scale = steps.scale[n];
    const double v = curved ? steps.curvature[n] : 0.0, straight = steps.forcing[n] - v;
    Vector total{};
    // y+ = e y + phi U + psi V = y + phi (U - V - x y) + 2 chi V
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      const Vector chi = tabled_chi<terms>(row + std::ptrdiff_t{k} * lanes * ScaleTable::terms, offset);
      const Vector x = b.inverse_ratio[k] * scale, phi = 1.0 - x * chi;
      Vector next = b.state[k];
      if constexpr (curved) next += chi * (2.0 * v);
      next += phi * (straight - x * b.state[k]);
      b.state[k] = next;
      total += b.unit[k] * next;
    }
    return total;
  });
  b.put_back(modes, at);
}

template <bool curved, int K>
void tabled_block(const Modes& modes, const Steps& steps, const TabledSteps& tabled, int at, double* stress) {
  const int terms = terms_of_chi(largest(modes.inverse_ratio, at, at + K * lanes) * tabled.highest);
  if (terms <= 5) return tabled_block<curved, 5, K>(modes, steps, tabled, at, stress);
  if (terms == 6) return tabled_block<curved, 6, K>(modes, steps, tabled, at, stress);
  tabled_block<curved, ScaleTable::terms, K>(modes, steps, tabled, at, stress);
}

void tabled_sweep(const Modes& modes, const Steps& steps, const TabledSteps& tabled, double* stress) {
  const QuasiSteadyModes quasi_steady(modes, tabled.lowest);
  quasi_steady.sweep(modes, steps, stress);
  in_blocks<largest_block>(quasi_steady.from, quasi_steady.to, [&](auto size, int at) {
    constexpr int K = decltype(size)::value;
    if (steps.curvature)
      tabled_block<true, K>(modes, steps, tabled, at, stress);
    else
      tabled_block<false, K>(modes, steps, tabled, at, stress);
  });
}

/// The coefficients of the last step are formed, not tabled: it also stores `before`.
void exponential_sweep(const Modes& modes, const Steps& steps, double* stress) {
  const int last = steps.count - 1;
  int n = 0;
  const bool pays_for_all = table_pays(modes, steps.scale, last);
  while (modes.table && n < last) {
    const TabledSteps tabled(modes, steps.scale + n, last - n, pays_for_all);
    const int count = tabled.count > 0               ? tabled.count
                      : last - n < TabledSteps::most ? last - n
                                                     : TabledSteps::most;
    const Steps part = part_of(steps, n, count);
    if (tabled.count > 0)
      tabled_sweep(modes, part, tabled, stress + n);
    else
      formed_exponential_sweep(modes, part, stress + n);
    n += count;
  }
  formed_exponential_sweep(modes, part_of(steps, n, steps.count - n), stress + n);
}

template <int K>
void bdf2_block(const Modes& modes, const Steps& steps, const Bdf2Steps& a, int at, double* stress) {
  UnitBlock<K> b(modes, at);
  add_sums(steps.count, stress, [&](int n) {
    Vector inverse[K], total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) inverse[k] = b.inverse_ratio[k] * steps.scale[n] + a.next[n];
    invert(inverse);
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      const Vector drive = b.before[k] * a.before[n] + steps.forcing[n];
      const Vector next = (b.state[k] * a.here[n] + drive) * inverse[k];
      b.before[k] = b.state[k];
      b.state[k] = next;
      total += b.unit[k] * next;
    }
    return total;
  });
  b.put_back(modes, at);
}

void bdf2_sweep(const Modes& modes, const Steps& steps, double* stress) {
  for (int n = 0; n < steps.count; n += Bdf2Steps::most) {
    const int rest = steps.count - n;
    const Steps part = part_of(steps, n, rest < Bdf2Steps::most ? rest : Bdf2Steps::most);
    const Bdf2Steps a(part);
    if (a.in_range(modes, 0, modes.padded))
      in_blocks<largest_block>(0, modes.padded, [&](auto size, int at) {
        bdf2_block<decltype(size)::value>(modes, part, a, at, stress + n);
      });
    else
      formed_sweep<Bdf2Step, true, false>(modes, part, stress + n);
  }
}

}  // namespace

void uneven_sweep(const Modes& modes, const Steps& steps, double* stress) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return formed_sweep<BackwardEulerStep, false, false>(modes, steps, stress);
    case StepRule::bdf2:
      return bdf2_sweep(modes, steps, stress);
    case StepRule::exponential:
      return exponential_sweep(modes, steps, stress);
  }
}

}  // namespace probation::kernels::PROBATION_ISA
