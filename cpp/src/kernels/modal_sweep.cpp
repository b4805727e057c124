// The modal recursion and the table of a build. Compiled once per instruction set.

#include <cstddef>

#include "blocks.hpp"
#include "coefficient_rows.hpp"
#include "coupled_step.hpp"
#include "sweeps.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

void sweep(const Modes& modes, const Steps& steps, double* stress) {
  if (!steps.uniform || steps.count == 1) return uneven_sweep(modes, steps, stress);
  if (steps.rule != StepRule::backward_euler) return even_sweep(modes, steps, stress);
  // A fresh step: usually there is one only.
  for (int n = 0; n < steps.count; ++n) uneven_sweep(modes, part_of(steps, n, 1), stress + n);
}

template <class Step>
Trial try_step(const Modes& modes, const Steps& steps) {
  const double u = steps.forcing[0], v = steps.curvature ? steps.curvature[0] : 0.0;
  Vector stress{}, by_log_scale{}, by_forcing{}, by_curvature{};
  for (int at = 0; at < modes.padded; at += lanes) {
    const Vector x = load(modes.inverse_ratio + at) * steps.scale[0];
    const Vector weight = load(modes.weight + at), z = load(modes.state + at),
                 before = load(modes.before + at);
    const StepCoefficients<Vector> c = Step::template coefficients<Vector>(x, steps.ratio[0]);
    const StepCoefficients<Vector> d = Step::template log_slopes<Vector>(x, steps.ratio[0]);
    stress += c.previous * z + c.before * before + weight * (c.forcing * u + c.curvature * v);
    by_log_scale += d.previous * z + d.before * before + weight * (d.forcing * u + d.curvature * v);
    by_forcing += weight * c.forcing;
    by_curvature += weight * c.curvature;
  }
  return {sum(stress), sum(by_log_scale), sum(by_forcing), sum(by_curvature)};
}

Trial trial(const Modes& modes, const Steps& steps) {
  switch (steps.rule) {
    case StepRule::backward_euler:
      return try_step<BackwardEulerStep>(modes, steps);
    case StepRule::bdf2:
      return try_step<Bdf2Step>(modes, steps);
    case StepRule::exponential:
      return try_step<ExponentialStep>(modes, steps);
  }
  return {};
}

}  // namespace

#define PROBATION_TEXT_OF(name) #name
#define PROBATION_TEXT(name) PROBATION_TEXT_OF(name)
const Kernels table{PROBATION_TEXT(PROBATION_ISA),
                    sweep,
                    tangent_sweep,
                    trial,
                    fill_rows,
                    weigh_rows,
                    look,
                    advance,
                    linearise,
                    drift,
                    move,
                    {form_two_step, form_straight, form_parabolic},
                    {haward_thackray, inspect_steps, secant_changes, all_finite},
                    whiten};

}  // namespace probation::kernels::PROBATION_ISA
