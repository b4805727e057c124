// Stress and its tangent along a direction in which the time scale alone moves, states and slopes in
// registers. Compiled once per instruction set.

#include "quasi_steady.hpp"
#include "scale_table.hpp"
#include "sweeps.hpp"
#include "uneven_bdf2.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

constexpr int largest_block = 3;  // vectors whose states and slopes fit the registers

/// K vectors of modes and of their slopes; weights included.
template <int K>
struct TimeBlock {
  Vector inverse_ratio[K], weight[K], state[K], before[K], slope[K], slope_before[K];

  TimeBlock(const Modes& modes, const TangentDirection& d, int at) {
    for (int k = 0; k < K; ++k) {
      const std::ptrdiff_t j = at + k * lanes;
      inverse_ratio[k] = load(modes.inverse_ratio + j);
      weight[k] = load(modes.weight + j);
      state[k] = load(modes.state + j) * weight[k];
      before[k] = load(modes.before + j) * weight[k];
      slope[k] = load(d.state + j) * weight[k];
      slope_before[k] = load(d.before + j) * weight[k];
    }
  }
  void take(int k, Vector next, Vector change) {
    before[k] = state[k];
    slope_before[k] = slope[k];
    state[k] = next;
    slope[k] = change;
  }
  /// Modes of weight zero only pad the arrays: no direction here changes weights.
  template <bool two_step>
  void put_back(const Modes& modes, const TangentDirection& d, int at) const {
    for (int k = 0; k < K; ++k) {
      const auto put = [&](double* to, Vector z) {
        store(to + at + std::ptrdiff_t{k} * lanes, choose(weight[k] == 0.0, Vector{}, z / weight[k]));
      };
      put(modes.state, state[k]);
      put(d.state, slope[k]);
      if constexpr (two_step) {
        put(modes.before, before[k]);
        put(d.before, slope_before[k]);
      }
    }
  }
};

/// With phi, psi and chi of scale_table.hpp, d phi = x (chi - phi) and d psi = -2 psi - d phi for d ln x.
template <bool curved, int K>
void tabled_block(const Modes& modes, const Steps& steps, const TabledSteps& tabled, int at, double* stress,
                  const TangentDirection& d) {
  TimeBlock<K> b(modes, d, at);
  add_both_sums(steps.count, stress, d.stress, [&](int n) {
    const double* row = tabled.rows[n] + static_cast<std::ptrdiff_t>(at) * ScaleTable::terms;
    const double offset = tabled.offset[n], scale = steps.scale[n], log_scale = d.log_scale[n];
    const double v = curved ? steps.curvature[n] : 0.0, straight = steps.forcing[n] - v;
    StressAndSlope total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      const Vector chi = tabled_chi(row + std::ptrdiff_t{k} * lanes * ScaleTable::terms, offset);
      const Vector x = b.inverse_ratio[k] * scale, phi = 1.0 - x * chi, decayed = 1.0 - x * phi;
      Vector drive = phi * straight, moved = x * (chi - phi) * straight;
      if constexpr (curved) {
        drive += chi * (2.0 * v);
        moved -= (2.0 * chi - phi) * (2.0 * v);
      }
      moved = b.weight[k] * moved - x * (decayed * b.state[k]);
      b.slope[k] = decayed * b.slope[k] + moved * log_scale;
      b.state[k] = decayed * b.state[k] + b.weight[k] * drive;
      total.stress += b.state[k];
      total.slope += b.slope[k];
    }
    return total;
  });
  b.template put_back<false>(modes, d, at);
}

template <int K>
void uneven_bdf2_block(const Modes& modes, const Steps& steps, const Bdf2Steps& a, int at, double* stress,
                       const TangentDirection& d) {
  TimeBlock<K> b(modes, d, at);
  add_both_sums(steps.count, stress, d.stress, [&](int n) {
    Vector x[K], inverse[K];
    StressAndSlope total{};
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      x[k] = b.inverse_ratio[k] * steps.scale[n];
      inverse[k] = x[k] + a.next[n];
    }
    invert(inverse);
#pragma GCC unroll 8
    for (int k = 0; k < K; ++k) {
      const Vector drive = b.before[k] * a.before[n] + b.weight[k] * steps.forcing[n];
      const Vector next = (b.state[k] * a.here[n] + drive) * inverse[k];
      const Vector change = b.slope[k] * a.here[n] + b.slope_before[k] * a.before[n];
      b.take(k, next, (change - x[k] * (next * d.log_scale[n])) * inverse[k]);
      total.stress += b.state[k];
      total.slope += b.slope[k];
    }
    return total;
  });
  b.template put_back<true>(modes, d, at);
}

TangentDirection later(TangentDirection d, int steps) {
  d.log_scale += steps;
  d.stress += steps;
  return d;
}

/// Calls take(part of the steps, d there, stress there, n) for runs of at most `most` steps.
template <class Take>
void in_runs(const Steps& steps, int most, double* stress, const TangentDirection& d, Take take) {
  for (int n = 0; n < steps.count;) {
    const int rest = steps.count - n;
    n += take(part_of(steps, n, rest < most ? rest : most), later(d, n), stress + n);
  }
}

void bdf2_sweep(const Modes& modes, const Steps& steps, double* stress, const TangentDirection& d,
                double* scratch) {
  in_runs(steps, Bdf2Steps::most, stress, d,
          [&](const Steps& part, const TangentDirection& there, double* stress_there) {
            const Bdf2Steps a(part);
            if (a.in_range(modes, 0, modes.padded))
              in_blocks<largest_block>(0, modes.padded, [&](auto size, int at) {
                uneven_bdf2_block<decltype(size)::value>(modes, part, a, at, stress_there, there);
              });
            else
              general_tangent_sweep(modes, part, stress_there, &there, 1, scratch);
            return part.count;
          });
}

void tabled_sweep(const Modes& modes, const Steps& steps, const TabledSteps& tabled, double* stress,
                  const TangentDirection& d) {
  const QuasiSteadyModes quasi_steady(modes, tabled.lowest);
  quasi_steady.sweep_with_slope(modes, steps, stress, d);
  in_blocks<largest_block>(quasi_steady.from, quasi_steady.to, [&](auto size, int at) {
    constexpr int K = decltype(size)::value;
    if (steps.curvature)
      tabled_block<true, K>(modes, steps, tabled, at, stress, d);
    else
      tabled_block<false, K>(modes, steps, tabled, at, stress, d);
  });
}

/// The last step also stores `before`: it is taken by the general sweep.
void exponential_sweep(const Modes& modes, const Steps& steps, double* stress, const TangentDirection& d,
                       double* scratch) {
  const int last = steps.count - 1;
  const Steps most = part_of(steps, 0, last);
  const bool pays_for_all = table_pays(modes, steps.scale, last);
  in_runs(most, TabledSteps::most, stress, d,
          [&](const Steps& part, const TangentDirection& there, double* stress_there) {
            if (modes.table) {
              const TabledSteps tabled(modes, part.scale, part.count, pays_for_all);
              if (tabled.count > 0) {
                tabled_sweep(modes, part_of(part, 0, tabled.count), tabled, stress_there, there);
                return tabled.count;
              }
            }
            general_tangent_sweep(modes, part, stress_there, &there, 1, scratch);
            return part.count;
          });
  const TangentDirection end = later(d, last);
  general_tangent_sweep(modes, part_of(steps, last, 1), stress + last, &end, 1, scratch);
}

}  // namespace

void time_tangent_sweep(const Modes& modes, const Steps& steps, double* stress, const TangentDirection& d,
                        double* scratch) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return general_tangent_sweep(modes, steps, stress, &d, 1, scratch);
    case StepRule::bdf2:
      return bdf2_sweep(modes, steps, stress, d, scratch);
    case StepRule::exponential:
      return exponential_sweep(modes, steps, stress, d, scratch);
  }
}

}  // namespace probation::kernels::PROBATION_ISA
