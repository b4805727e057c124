#pragma once
// The recursion of step.hpp, one mode and one step at a time, and steps and modes to try kernels on.

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "kernels/kernels.hpp"
#include "modal_group.hpp"
#include "probation/schemes/step.hpp"
#include "probation/spectrum.hpp"

namespace probation::kernels {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr StepRule all_rules[] = {StepRule::backward_euler, StepRule::bdf2, StepRule::exponential};

/// Steps with a forcing and a curvature of no particular shape; in uniform ones the curvature is the
/// forcing's.
struct Drive {
  ArrayXd scale, ratio, forcing, curvature;

  Drive(int count, bool uniform) : scale(count), ratio(count), forcing(count), curvature(count) {
    for (int n = 0; n < count; ++n) {
      scale[n] = uniform ? 0.125 : 0.125 * (1.0 + 0.4 * std::sin(1.0 + n));
      ratio[n] = uniform || n == 0 ? 1.0 : scale[n] / scale[n - 1];
      forcing[n] = 30.0 + 10.0 * std::cos(0.3 * n);
      curvature[n] = uniform && n > 0 ? 0.5 * (forcing[n] - forcing[n - 1]) : std::sin(0.7 * n + 0.5);
    }
  }
  Steps steps(StepRule rule, bool uniform) const {
    return {rule,
            static_cast<int>(scale.size()),
            uniform,
            scale.data(),
            ratio.data(),
            forcing.data(),
            rule == StepRule::exponential ? curvature.data() : nullptr};
  }
};

inline ModalGroup group(int modes) {
  const Spectrum spectrum = Spectrum::log_spaced(modes, 5.0);
  ModalGroup made;
  made.set(spectrum.relaxation_ratio, spectrum.modal_weight);
  for (Index j = 0; j < modes; ++j) {
    made.state[j] = made.weight[j] * (1.0 + 0.1 * static_cast<double>(j));
    made.before[j] = 0.9 * made.state[j];
  }
  return made;
}

inline StepCoefficients<double> coefficients(StepRule rule, double x, double ratio) {
  if (rule == StepRule::bdf2) return Bdf2Step::coefficients(x, ratio);
  if (rule == StepRule::exponential) return ExponentialStep::coefficients(x, ratio);
  return BackwardEulerStep::coefficients(x, ratio);
}

/// The recursion of step.hpp, one mode and one step at a time.
inline ArrayXd plain_sweep(ModalGroup& modes, const Steps& steps) {
  ArrayXd stress = ArrayXd::Zero(steps.count);
  for (int n = 0; n < steps.count; ++n)
    for (Index j = 0; j < modes.padded(); ++j) {
      const auto c = coefficients(steps.rule, steps.scale[n] * modes.inverse_ratio[j], steps.ratio[n]);
      const double drive =
          c.forcing * steps.forcing[n] + c.curvature * (steps.curvature ? steps.curvature[n] : 0.0);
      const double next = c.previous * modes.state[j] + c.before * modes.before[j] + modes.weight[j] * drive;
      modes.before[j] = modes.state[j];
      modes.state[j] = next;
      stress[n] += next;
    }
  return stress;
}

inline void check_close(const ArrayXd& found, const ArrayXd& expected, double tolerance) {
  REQUIRE(found.size() == expected.size());
  CHECK((found - expected).abs().maxCoeff() <= tolerance * expected.abs().maxCoeff());
}

inline std::vector<const Kernels*> all_builds() {
  std::vector<const Kernels*> builds;
  for (const Kernels* const* build = runnable(); *build; ++build) builds.push_back(*build);
  return builds;
}

}  // namespace probation::kernels
