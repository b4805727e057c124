// Stress and its tangents along directions. Compiled once per instruction set.

#include "blocks.hpp"
#include "sweeps.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

/// Coefficients and their slopes for every mode, in scratch: previous, before, forcing, curvature, then the
/// slopes.
template <class Step>
void tabulate(const Modes& modes, double scale, double ratio, double* scratch) {
  const std::ptrdiff_t m = modes.padded;
  for (std::ptrdiff_t at = 0; at < m; at += lanes) {
    const Vector x = load(modes.inverse_ratio + at) * scale;
    const StepCoefficients<Vector> c = Step::template coefficients<Vector>(x, ratio);
    const StepCoefficients<Vector> d = Step::template log_slopes<Vector>(x, ratio);
    const Vector rows[8] = {c.previous, c.before, c.forcing, c.curvature,
                            d.previous, d.before, d.forcing, d.curvature};
    for (std::ptrdiff_t row = 0; row < 8; ++row) store(scratch + row * m + at, rows[row]);
  }
}

PROBATION_INLINE Vector combine(const double* rows, std::ptrdiff_t m, std::ptrdiff_t at, Vector y,
                                Vector before, double u, double v) {
  return load(rows + at) * y + load(rows + m + at) * before + load(rows + 2 * m + at) * u +
         load(rows + 3 * m + at) * v;
}

template <class Step>
void run(const Modes& modes, const Steps& steps, double* stress, const TangentDirection* directions,
         int count, double* scratch) {
  const std::ptrdiff_t m = modes.padded;
  const double* slopes = scratch + 4 * m;
  double* by_log_scale = scratch + 8 * m;
  for (int n = 0; n < steps.count; ++n) {
    if (n == 0 || !steps.uniform) tabulate<Step>(modes, steps.scale[n], steps.ratio[n], scratch);
    const double u = steps.forcing[n], v = curvature_at(steps, n);
    Vector total{};
    for (std::ptrdiff_t at = 0; at < m; at += lanes) {
      const Vector y = load(modes.state + at), before = load(modes.before + at);
      const Vector next = combine(scratch, m, at, y, before, u, v);
      store(by_log_scale + at, combine(slopes, m, at, y, before, u, v));
      store(modes.before + at, y);
      store(modes.state + at, next);
      total += load(modes.weight + at) * next;
    }
    stress[n] += sum(total);

    for (int k = 0; k < count; ++k) {
      const TangentDirection& d = directions[k];
      const double du = d.forcing ? d.forcing[n] : 0.0, dv = d.curvature ? d.curvature[n] : 0.0;
      const double dx = d.log_scale ? d.log_scale[n] : 0.0;
      Vector change{};
      for (std::ptrdiff_t at = 0; at < m; at += lanes) {
        const Vector y = load(d.state + at);
        const Vector dlnx = d.log_inverse ? load(d.log_inverse + at) + dx : Vector{} + dx;
        const Vector next =
            combine(scratch, m, at, y, load(d.before + at), du, dv) + load(by_log_scale + at) * dlnx;
        store(d.before + at, y);
        store(d.state + at, next);
        change += load(modes.weight + at) * next;
        if (d.weight) change += load(d.weight + at) * load(modes.state + at);
      }
      d.stress[n] += sum(change);
    }
  }
}

bool all_equal(const double* values, int count) {
  bool equal = true;
  for (int n = 1; n < count; ++n) equal &= values[n] == values[0];
  return equal;
}

}  // namespace

void general_tangent_sweep(const Modes& modes, const Steps& steps, double* stress,
                           const TangentDirection* directions, int count, double* scratch) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return run<BackwardEulerStep>(modes, steps, stress, directions, count, scratch);
    case StepRule::bdf2:
      return run<Bdf2Step>(modes, steps, stress, directions, count, scratch);
    case StepRule::exponential:
      return run<ExponentialStep>(modes, steps, stress, directions, count, scratch);
  }
}

void tangent_sweep(const Modes& modes, const Steps& steps, double* stress, const TangentDirection* directions,
                   int count, double* scratch) {
  const TangentDirection& d = directions[0];
  if (count == 1 && d.log_scale && !d.forcing && !d.curvature && !d.log_inverse && !d.weight) {
    if (!steps.uniform) return time_tangent_sweep(modes, steps, stress, d, scratch);
    if (steps.count > 1 && steps.rule != StepRule::backward_euler && all_equal(d.log_scale, steps.count))
      return even_tangent_sweep(modes, steps, stress, d);
  }
  general_tangent_sweep(modes, steps, stress, directions, count, scratch);
}

}  // namespace probation::kernels::PROBATION_ISA
