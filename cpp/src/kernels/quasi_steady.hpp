#pragma once
// Quasi-steady modes, so fast that nothing of their state is left after a step: e^-x is below
// rounding, and the exponential rule is
//
//   phi = 1 / x,   psi = 1 / x - 2 / x^2,   sum z+ = (U + V) sum p / x - 2 V sum p / x^2.

#include "blocks.hpp"

namespace probation::kernels::PROBATION_ISA {

constexpr double quasi_steady_from = 36.8;  // e^-x < 2^-53

/// The modes from..to, by vectors, keep their states; those outside are quasi-steady. sum p / q and sum p /
/// q^2 are theirs, q = inverse_ratio.
struct QuasiSteadyModes {
  int from, to;
  double first = 0.0, second = 0.0;

  /// For steps no smaller than `scale`.
  QuasiSteadyModes(const Modes& modes, double scale) : from(0), to(modes.padded) {
    const auto quasi_steady = [&](int at) {
      return all_above(load(modes.inverse_ratio + at) * scale, quasi_steady_from);
    };
    while (from < to && quasi_steady(from)) from += lanes;
    while (to > from && quasi_steady(to - lanes)) to -= lanes;
    Vector totals[2] = {};
    for_each(modes, [&](int at) {
      const Vector q = load(modes.inverse_ratio + at), share = load(modes.weight + at) / q;
      totals[0] += share;
      totals[1] += share / q;
    });
    first = sum(totals[0]);
    second = sum(totals[1]);
  }

  template <class Body>
  void for_each(const Modes& modes, Body body) const {
    for (int at = 0; at < from; at += lanes) body(at);
    for (int at = to; at < modes.padded; at += lanes) body(at);
  }

  /// Adds their stress, and sets their states from the last two steps.
  void sweep(const Modes& modes, const Steps& steps, double* stress) const {
    if (from == 0 && to == modes.padded) return;
    const int count = steps.count;
    const double* u = steps.forcing;
    const double* v = steps.curvature;
    if (v) {
      for (int n = 0; n < count; ++n) {
        const double inverse = 1.0 / steps.scale[n];
        stress[n] += inverse * (first * (u[n] + v[n]) - 2.0 * second * inverse * v[n]);
      }
    } else {
      for (int n = 0; n < count; ++n) stress[n] += first / steps.scale[n] * u[n];
    }
    for_each(modes, [&](int at) {
      const Vector weight = load(modes.weight + at);
      const Vector before = count > 1 ? weight * state(modes, steps, count - 2, at) : load(modes.state + at);
      store(modes.before + at, before);
      store(modes.state + at, weight * state(modes, steps, count - 1, at));
    });
  }

  /// The same along a direction in which the time scale alone moves, in unit-weight states; `before` is left
  /// alone. d z+ = -p (U / x + V / x - 4 V / x^2) d ln x.
  void sweep_with_slope(const Modes& modes, const Steps& steps, double* stress,
                        const TangentDirection& d) const {
    if (from == 0 && to == modes.padded) return;
    const int last = steps.count - 1;
    for (int n = 0; n <= last; ++n) {
      const double inverse = 1.0 / steps.scale[steps.uniform ? 0 : n];
      const double v = steps.curvature ? steps.curvature[n] : 0.0, all = first * (steps.forcing[n] + v);
      stress[n] += inverse * (all - 2.0 * second * inverse * v);
      d.stress[n] -= d.log_scale[n] * inverse * (all - 4.0 * second * inverse * v);
    }
    const double v = steps.curvature ? steps.curvature[last] : 0.0;
    for_each(modes, [&](int at) {
      const Vector x = load(modes.inverse_ratio + at) * steps.scale[steps.uniform ? 0 : last];
      store(modes.state + at, state(modes, steps, last, at));
      store(d.state + at, (4.0 * v / x - (steps.forcing[last] + v)) / x * d.log_scale[last]);
    });
  }

 private:
  /// Per unit weight.
  static Vector state(const Modes& modes, const Steps& steps, int n, int at) {
    const Vector x = load(modes.inverse_ratio + at) * steps.scale[steps.uniform ? 0 : n];
    const double v = steps.curvature ? steps.curvature[n] : 0.0;
    return (steps.forcing[n] + v - 2.0 * v / x) / x;
  }
};

}  // namespace probation::kernels::PROBATION_ISA
