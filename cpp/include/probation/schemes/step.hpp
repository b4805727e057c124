#pragma once
// One step of one mode, for every scheme: the reference for the step formulas. The loops in src/kernels
// (form_steps, even_sweep, uneven_sweep) and form_curvature of record_steps.cpp repeat them for speed; tests
// hold them together.
//
// With z_j = sigma_j - p_j sigma^r (so that z_j is zero in the relaxed state) eq. (6) reads, per unit weight,
//
//   y' = E_u e' - (sigma^r)' - y / tau_j,     z_j = p_j y_j,
//
// one scalar linear equation with one forcing shared by all modes. Each scheme then is
//
//   y+ = previous * y + before * y- + forcing * U + curvature * V
//
// where the four coefficients depend on x = h / tau_j (and on h / h0) alone. U is the change of the forcing's
// integral F = int E_u de - sigma^r over the step in the scheme's approximation, V its curvature.
//
// The functions are templates: the same line serves a double, a SIMD vector and a dual number. They are
// always inlined because the kernels compile them once per instruction set.

#include <cmath>

#include "probation/inline.hpp"
#include "probation/schemes/step_rule.hpp"

namespace probation {

/// Coefficients of one step; see the head of this file.
template <class Real>
struct StepCoefficients {
  Real previous;   ///< of y
  Real before;     ///< of y-, the value one step earlier
  Real forcing;    ///< of U
  Real curvature;  ///< of V
};

/// The two-step difference of Gear on an uneven grid: h f' ~ a0 f+ + a1 f + a2 f-, with ratio = h / h0.
struct Bdf2Difference {
  double next, here, before;

  PROBATION_INLINE explicit Bdf2Difference(double ratio) : Bdf2Difference(ratio, ratio / (1.0 + ratio)) {}

  /// In differences: exactly zero where f does not change.
  template <class Real>
  PROBATION_INLINE Real operator()(Real f_next, Real f_here, Real f_before) const {
    return next * (f_next - f_here) - before * (f_here - f_before);
  }

 private:
  /// share = ratio / (1 + ratio): one division for (1 + 2 ratio) / (1 + ratio) and ratio^2 / (1 + ratio).
  PROBATION_INLINE Bdf2Difference(double ratio, double share)
      : next(1.0 + share), here(-(1.0 + ratio)), before(ratio * share) {}
};

/// Above this ratio of two successive steps BDF2 is no longer zero-stable (1 + sqrt 2); it starts afresh.
constexpr double bdf2_largest_step_ratio = 2.41;

/// SA3 bends a step as one that is at most so many times as long as the one before.
constexpr double sa3_largest_growth = 4.0;

/// Weight g / (1 + g) of the bend of a step that is g times as long as the one before. The parabola carries g
/// times what the step before errs by; with 4 / (1 + g) in longer ones it carries at most four times as much.
template <class Real>
PROBATION_INLINE Real bend_weight(Real growth) {
  const Real limited = growth < sa3_largest_growth ? growth : Real(sa3_largest_growth);
  return limited / (1.0 + growth);
}

/// e^-x, and a choice, for doubles; the kernels overload both for SIMD vectors.
PROBATION_INLINE double decay(double x) { return std::exp(-x); }
PROBATION_INLINE double choose(bool first, double a, double b) { return first ? a : b; }

/// phi(x) = (1 - e^-x) / x, given e^-x; a series below x = 0.1 keeps the digits.
template <class Real>
PROBATION_INLINE Real mean_decay(Real x, Real decayed) {
  const Real x2 = x * (1.0 / 2.0), x3 = x * (1.0 / 3.0), x4 = x * (1.0 / 4.0), x5 = x * (1.0 / 5.0);
  const Real x6 = x * (1.0 / 6.0), x7 = x * (1.0 / 7.0), x8 = x * (1.0 / 8.0), x9 = x * (1.0 / 9.0);
  const Real series =
      1.0 - x2 * (1.0 - x3 * (1.0 - x4 * (1.0 - x5 * (1.0 - x6 * (1.0 - x7 * (1.0 - x8 * (1.0 - x9)))))));
  return choose(x < 0.1, series, (1.0 - decayed) / x);
}

/// psi(x) = (2 k1 - k0) / x with k0 = 1 - e^-x, k1 = 1 - k0 / x (SA3); about x / 6 at small x.
template <class Real>
PROBATION_INLINE Real curvature_decay(Real x, Real mean) {
  // sum over k >= 1 of -k (-x)^k / (k + 2)!
  const Real tail = 1.0 / 1008 - x * (1.0 / 6720 - x * (1.0 / 51840 - x * (1.0 / 453600)));
  const Real series = x * (1.0 / 6 - x * (1.0 / 12 - x * (1.0 / 40 - x * (1.0 / 180 - x * tail))));
  return choose(x < 0.1, series, 2.0 * (1.0 - mean) / x - mean);
}

/// Backward Euler, order 1: the paper's first step.
struct BackwardEulerStep {
  template <class Real>
  PROBATION_INLINE static StepCoefficients<Real> coefficients(Real x, double) {
    const Real inverse = 1.0 / (1.0 + x);
    return {inverse, Real{}, inverse, Real{}};
  }
  /// Derivatives of the coefficients with respect to ln x.
  template <class Real>
  PROBATION_INLINE static StepCoefficients<Real> log_slopes(Real x, double) {
    const Real inverse = 1.0 / (1.0 + x);
    const Real slope = -x * inverse * inverse;
    return {slope, Real{}, slope, Real{}};
  }
};

/// bE2, eq. (9) on an uneven grid, order 2.
struct Bdf2Step {
  template <class Real>
  PROBATION_INLINE static StepCoefficients<Real> coefficients(Real x, double ratio) {
    const Bdf2Difference a(ratio);
    const Real inverse = 1.0 / (a.next + x);
    return {-a.here * inverse, -a.before * inverse, inverse, Real{}};
  }
  template <class Real>
  PROBATION_INLINE static StepCoefficients<Real> log_slopes(Real x, double ratio) {
    const Bdf2Difference a(ratio);
    const Real inverse = 1.0 / (a.next + x);
    const Real slope = -x * inverse * inverse;
    return {-a.here * slope, -a.before * slope, slope, Real{}};
  }
};

/// SA2 (curvature not used) and SA3: the exact exponential recursion under a straight or a parabolic forcing.
struct ExponentialStep {
  template <class Real>
  PROBATION_INLINE static StepCoefficients<Real> coefficients(Real x, double) {
    const Real decayed = decay(x);
    const Real mean = mean_decay(x, decayed);
    return {decayed, Real{}, mean, curvature_decay(x, mean)};
  }
  template <class Real>
  PROBATION_INLINE static StepCoefficients<Real> log_slopes(Real x, double) {
    const Real decayed = decay(x);
    const Real mean = mean_decay(x, decayed);
    const Real curved = curvature_decay(x, mean);
    // x mean' = e^-x - mean, and x curved = 2 (1 - mean) - x mean differentiated; both free of cancellation
    // at small x.
    const Real mean_slope = x * (curved - mean) * 0.5;
    return {-x * decayed, Real{}, mean_slope, -2.0 * curved - mean_slope};
  }
};

}  // namespace probation
