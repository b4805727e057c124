// Single steps whose inputs depend on the stress at their end. Compiled once per instruction set.
//
// The coefficients of bE2 and backward Euler go with 1 / (a + x). With q = x / (a + x), t = 1 - 2 q and eta =
// (x' - x) / (x' + x) they become, at x' instead of x,
//
//   1 / (a + x') = (1 - eta) / (1 - eta t) / (a + x),     |t| <= 1,
//
// so that one pass over the modes gives the step's stress for all x' nearby as a polynomial in eta. Those of
// the exponential rule have no such form: there the first two terms serve very nearby.

#include "coupled_step.hpp"

#include <cstddef>

#include "vector.hpp"

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

constexpr double rational_reach = 6e-4;     // eta^4 is 1e-13
constexpr double exponential_reach = 1e-8;  // eta^2 is 1e-16

// Numbers and pointers are taken by value: stores to rows could otherwise change them, as far as a compiler
// knows.

template <class Step>
void expand_rational(const Modes modes, const OneStep step, Expansion& found, double* rows) {
  const std::ptrdiff_t m = modes.padded;
  Vector stress[4] = {}, by_forcing[3] = {};
  for (std::ptrdiff_t at = 0; at < m; at += lanes) {
    const Vector x = load(modes.inverse_ratio + at) * step.scale;
    const StepCoefficients<Vector> c = Step::template coefficients<Vector>(x, step.ratio);
    const Vector t = 1.0 - 2.0 * (x * c.forcing);
    Vector forcing = load(modes.weight + at) * c.forcing;
    Vector next =
        c.previous * load(modes.state + at) + (c.before * load(modes.before + at) + forcing * step.forcing);
    store(rows + at, next);
    store(rows + m + at, t);
    store(rows + 2 * m + at, forcing);
#pragma GCC unroll 4
    for (Vector& total : stress) {
      total += next;
      next *= t;
    }
#pragma GCC unroll 3
    for (Vector& total : by_forcing) {
      total += forcing;
      forcing *= t;
    }
  }
  store(found.stress, sums(stress[0], stress[1], stress[2], stress[3]));
  store(found.by_forcing, sums(by_forcing[0], by_forcing[1], by_forcing[2], Vector{}));
  found.by_curvature = 0.0;
  found.reach = rational_reach;
}

void expand_exponential(const Modes modes, const OneStep step, Expansion& found, double* rows) {
  const std::ptrdiff_t m = modes.padded;
  Vector stress{}, stress_slope{}, by_forcing{}, by_forcing_slope{}, by_curvature{};
  for (std::ptrdiff_t at = 0; at < m; at += lanes) {
    const Vector x = load(modes.inverse_ratio + at) * step.scale;
    const Vector weight = load(modes.weight + at), z = load(modes.state + at);
    const StepCoefficients<Vector> c = ExponentialStep::coefficients<Vector>(x, step.ratio);
    const StepCoefficients<Vector> d = ExponentialStep::log_slopes<Vector>(x, step.ratio);
    const Vector next = c.previous * z + weight * (c.forcing * step.forcing + c.curvature * step.curvature);
    const Vector slope = d.previous * z + weight * (d.forcing * step.forcing + d.curvature * step.curvature);
    const Vector forcing = weight * c.forcing, curvature = weight * c.curvature;
    const Vector parts[4] = {next, slope, forcing, curvature};
    for (std::ptrdiff_t row = 0; row < 4; ++row) store(rows + row * m + at, parts[row]);
    stress += next;
    stress_slope += slope;
    by_forcing += forcing;
    by_forcing_slope += weight * d.forcing;
    by_curvature += curvature;
  }
  found = {};
  found.stress[0] = sum(stress);
  found.stress[1] = found.stress[0] + 2.0 * sum(stress_slope);  // d ln x = 2 d eta
  found.by_forcing[0] = sum(by_forcing);
  found.by_forcing[1] = found.by_forcing[0] + 2.0 * sum(by_forcing_slope);
  found.by_curvature = sum(by_curvature);
  found.reach = exponential_reach;
}

/// Coefficients, unweighted, and what d ln x does.
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

void expand(const Modes& modes, const Steps& steps, Expansion& found, double* rows) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return expand_rational<BackwardEulerStep>(modes, OneStep(steps), found, rows);
    case StepRule::bdf2:
      return expand_rational<Bdf2Step>(modes, OneStep(steps), found, rows);
    case StepRule::exponential:
      return expand_exponential(modes, OneStep(steps), found, rows);
  }
}

void take(const Modes& of, StepRule rule, const Nearby& nearby, const double* rows) {
  const Modes modes = of;
  const Nearby to = nearby;
  const std::ptrdiff_t m = modes.padded;
  for (std::ptrdiff_t at = 0; at < m; at += lanes) {
    Vector next = load(rows + at);
    if (rule == StepRule::exponential) {
      next += load(rows + m + at) * (2.0 * to.eta) + load(rows + 2 * m + at) * to.forcing +
              load(rows + 3 * m + at) * to.curvature;
    } else {
      const Vector turned = load(rows + m + at) * to.eta;
      next += load(rows + 2 * m + at) * to.forcing;
      next *= 1.0 - to.eta;
      next += next * (turned * (1.0 + turned * (1.0 + turned)));
    }
    store(modes.before + at, load(modes.state + at));
    store(modes.state + at, next);
  }
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
