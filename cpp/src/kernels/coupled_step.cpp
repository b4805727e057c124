// Single steps whose inputs depend on the stress at their end. Compiled once per instruction set.
//
// Coefficients near a scale are polynomials (kernels::CoefficientRows), and so is the stress at the end of a
// step: its terms are formed in one pass over the modes before its scale is known. The same pass takes
// the step before.

#include "coupled_step.hpp"

#include <cstddef>

#include "blocks.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

/// The first of some steps.
struct OneStep {
  double scale, ratio, forcing, curvature;

  explicit OneStep(const Steps& steps)
      : scale(steps.scale[0]),
        ratio(steps.ratio[0]),
        forcing(steps.forcing[0]),
        curvature(steps.curvature ? steps.curvature[0] : 0.0) {}
};

constexpr int terms = CoefficientRows::terms;

PROBATION_INLINE Vector polynomial(const double* row, std::ptrdiff_t stride, double distance) {
  Vector value = load(row + (terms - 1) * stride);
#pragma GCC unroll 8
  for (int k = terms - 2; k >= 0; --k) value = value * distance + load(row + k * stride);
  return value;
}

/// Coefficients of the modes of a vector, and how a rule uses them; `curved`: V is not zero. Numbers and
/// pointers are copies: the compiler must assume that stores to the states change what is not.
template <bool curved>
struct ExponentialNear {
  static constexpr bool two_step = false;
  const double *forcing_rows, *curvature_rows;
  std::ptrdiff_t stride;
  double distance, scale, forcing, curvature;

  PROBATION_INLINE explicit ExponentialNear(const NearStep& s)
      : forcing_rows(s.rows.forcing),
        curvature_rows(s.rows.curvature),
        stride(s.rows.stride),
        distance(s.distance),
        scale(s.scale),
        forcing(s.forcing),
        curvature(s.curvature) {}
  PROBATION_INLINE Vector driven(Vector z, Vector, Vector inverse) const { return inverse * z; }
  PROBATION_INLINE Vector taken(std::ptrdiff_t at, Vector z, Vector, Vector inverse, Vector weight) const {
    const Vector c = polynomial(forcing_rows + at, stride, distance);
    Vector next = z + c * (weight * forcing - inverse * scale * z);
    if constexpr (curved) next += polynomial(curvature_rows + at, stride, distance) * (weight * curvature);
    return next;
  }
};

struct RationalNear {
  static constexpr bool two_step = true;
  const double* forcing_rows;
  std::ptrdiff_t stride;
  double distance, of_here, of_before, forcing;

  PROBATION_INLINE explicit RationalNear(const NearStep& s)
      : forcing_rows(s.rows.forcing),
        stride(s.rows.stride),
        distance(s.distance),
        of_here(s.here),
        of_before(s.before),
        forcing(s.forcing) {}
  PROBATION_INLINE Vector driven(Vector z, Vector before, Vector) const {
    return of_here * z + of_before * before;
  }
  PROBATION_INLINE Vector taken(std::ptrdiff_t at, Vector z, Vector before, Vector, Vector weight) const {
    const Vector c = polynomial(forcing_rows + at, stride, distance);
    return c * (of_here * z + (of_before * before + weight * forcing));
  }
};

template <class Near, bool takes, bool looks>
void pass(const Modes& of, std::ptrdiff_t first, const NearStep& taken_step, const NearStep& next_step,
          StressNearby& found) {
  const Modes modes = of;
  const Near taken(taken_step), next(next_step);
  constexpr int count = sizeof found.sums / sizeof *found.sums;
  Vector sum_of[count] = {};
  for (std::ptrdiff_t at = first; at < modes.padded; at += lanes) {
    Vector z = load(modes.state + at), before{};
    const Vector inverse = load(modes.inverse_ratio + at);
    if constexpr (Near::two_step) before = load(modes.before + at);
    if constexpr (takes) {
      const Vector now = taken.taken(at, z, before, inverse, load(modes.weight + at));
      store(modes.before + at, z);
      store(modes.state + at, now);
      before = z;
      z = now;
    }
    if constexpr (looks) {
      const Vector driven = next.driven(z, before, inverse);
      const double* row = next.forcing_rows + at;
#pragma GCC unroll 8
      for (int k = 0; k < terms; ++k) sum_of[k] += load(row + k * next.stride) * driven;
      sum_of[StressNearby::kept] += z;
    }
  }
  if constexpr (looks) {
#pragma GCC unroll 8
    for (int k = 0; k < count; k += lanes)
      store(found.sums + k, sums(k, [&](int term) { return sum_of[term]; }));
  }
}

/// Coefficients without weights, and their derivatives with respect to ln x.
template <class Step>
StepSlopes linearise_by(const Modes modes, const OneStep step, double* rows) {
  const std::ptrdiff_t m = modes.padded;
  Vector by_log_scale{}, by_forcing{}, by_curvature{};
  for (std::ptrdiff_t at = 0; at < m; at += lanes) {
    const Vector x = load(modes.inverse_ratio + at) * step.scale;
    const Vector weight = load(modes.weight + at);
    const StepCoefficients<Vector> c = Step::template coefficients<Vector>(x, step.ratio);
    const StepCoefficients<Vector> d = Step::template log_slopes<Vector>(x, step.ratio);
    const Vector slope = d.previous * load(modes.state + at) +
                         (d.before * load(modes.before + at) +
                          weight * (d.forcing * step.forcing + d.curvature * step.curvature));
    const Vector parts[5] = {c.previous, c.before, c.forcing, c.curvature, slope};
    for (std::ptrdiff_t row = 0; row < 5; ++row) store(rows + row * m + at, parts[row]);
    by_log_scale += slope;
    by_forcing += weight * c.forcing;
    by_curvature += weight * c.curvature;
  }
  return {sum(by_log_scale), sum(by_forcing), sum(by_curvature)};
}

}  // namespace

void look(const Modes& modes, const NearStep& next, StressNearby& found) {
  if (next.exponential)
    return pass<ExponentialNear<false>, false, true>(modes, next.quasi_steady, next, next, found);
  pass<RationalNear, false, true>(modes, 0, next, next, found);
}

void advance(const Modes& modes, const NearStep& taken, const NearStep* next, StressNearby& found) {
  const bool curved = taken.rows.curvature != nullptr;
  if (next && next->exponential == taken.exponential) {
    if (!taken.exponential) return pass<RationalNear, true, true>(modes, 0, taken, *next, found);
    const int first = taken.quasi_steady < next->quasi_steady ? taken.quasi_steady : next->quasi_steady;
    if (curved) return pass<ExponentialNear<true>, true, true>(modes, first, taken, *next, found);
    return pass<ExponentialNear<false>, true, true>(modes, first, taken, *next, found);
  }
  if (!taken.exponential)
    pass<RationalNear, true, false>(modes, 0, taken, taken, found);
  else if (curved)
    pass<ExponentialNear<true>, true, false>(modes, 0, taken, taken, found);
  else
    pass<ExponentialNear<false>, true, false>(modes, 0, taken, taken, found);
  if (next) look(modes, *next, found);
}

StepSlopes linearise(const Modes& modes, const Steps& steps, double* rows) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return linearise_by<BackwardEulerStep>(modes, OneStep(steps), rows);
    case StepRule::bdf2:
      return linearise_by<Bdf2Step>(modes, OneStep(steps), rows);
    case StepRule::exponential:
      return linearise_by<ExponentialStep>(modes, OneStep(steps), rows);
  }
  return {};
}

double drift(const Modes& modes, const Steps& steps, const StepDirection& direction, const double* rows) {
  const std::ptrdiff_t m = modes.padded;
  const OneStep step(steps);
  const StepDirection d = direction;
  Vector change{};
  for (std::ptrdiff_t at = 0; at < m; at += lanes) {
    const Vector z = load(d.state + at);
    Vector next = load(rows + at) * z + load(rows + m + at) * load(d.before + at);
    if (d.weight)
      next += load(d.weight + at) *
              (load(rows + 2 * m + at) * step.forcing + load(rows + 3 * m + at) * step.curvature);
    if (d.log_inverse) next += load(d.log_inverse + at) * load(rows + 4 * m + at);
    store(d.before + at, z);
    store(d.state + at, next);
    change += next;
  }
  return sum(change);
}

void move(const Modes& modes, const StepChange& change, const StepDirection& d, const double* rows) {
  const std::ptrdiff_t m = modes.padded;
  const StepChange by = change;
  const double* weight = modes.weight;
  double* state = d.state;
  for (std::ptrdiff_t at = 0; at < m; at += lanes)
    store(state + at, load(state + at) + load(rows + 4 * m + at) * by.log_scale +
                          load(weight + at) * (load(rows + 2 * m + at) * by.forcing +
                                               load(rows + 3 * m + at) * by.curvature));
}

}  // namespace probation::kernels::PROBATION_ISA
