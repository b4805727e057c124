#include "kernels/kernels.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "modal_group.hpp"
#include "probation/schemes/step.hpp"
#include "probation/spectrum.hpp"

using namespace probation;
using namespace probation::kernels;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

constexpr StepRule all_rules[] = {StepRule::backward_euler, StepRule::bdf2, StepRule::exponential};

/// Steps with a forcing and a curvature of no particular shape.
struct Drive {
  ArrayXd scale, ratio, forcing, curvature;

  Drive(int count, bool uniform) : scale(count), ratio(count), forcing(count), curvature(count) {
    for (int n = 0; n < count; ++n) {
      scale[n] = uniform ? 0.125 : 0.125 * (1.0 + 0.4 * std::sin(1.0 + n));
      ratio[n] = uniform || n == 0 ? 1.0 : scale[n] / scale[n - 1];
      forcing[n] = 30.0 + 10.0 * std::cos(0.3 * n);
      curvature[n] = std::sin(0.7 * n);
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

ModalGroup group(int modes) {
  const Spectrum spectrum = Spectrum::log_spaced(modes, 5.0);
  ModalGroup made;
  made.set(spectrum.relaxation_ratio, spectrum.modal_weight);
  for (Index j = 0; j < modes; ++j) {
    made.state[j] = made.weight[j] * (1.0 + 0.1 * static_cast<double>(j));
    made.before[j] = 0.9 * made.state[j];
  }
  return made;
}

StepCoefficients<double> coefficients(StepRule rule, double x, double ratio) {
  if (rule == StepRule::bdf2) return Bdf2Step::coefficients(x, ratio);
  if (rule == StepRule::exponential) return ExponentialStep::coefficients(x, ratio);
  return BackwardEulerStep::coefficients(x, ratio);
}

/// The recursion of step.hpp, one mode and one step at a time.
ArrayXd plain_sweep(ModalGroup& modes, const Steps& steps) {
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

void check_close(const ArrayXd& found, const ArrayXd& expected, double tolerance) {
  REQUIRE(found.size() == expected.size());
  CHECK((found - expected).abs().maxCoeff() <= tolerance * expected.abs().maxCoeff());
}

}  // namespace

TEST_CASE("every build sweeps as the plain recursion does, for every number of modes") {
  for (const Kernels* kernel : {&baseline::table, &best()})
    for (const StepRule rule : all_rules)
      for (int modes = 1; modes <= 60; ++modes)
        for (const bool uniform : {true, false}) {
          CAPTURE(std::string(kernel->name));
          CAPTURE(modes);
          const Drive drive(37, uniform);
          ModalGroup plain = group(modes), swept = plain;
          const ArrayXd expected = plain_sweep(plain, drive.steps(rule, uniform));
          ArrayXd stress = ArrayXd::Zero(37);
          kernel->sweep(swept.view(), drive.steps(rule, uniform), stress.data());
          check_close(stress, expected, 1e-13);
          check_close(swept.state, plain.state, 1e-13);
          // What bE2 needs to go on, whatever the rule.
          check_close(swept.before, plain.before, 1e-13);
        }
}

TEST_CASE("uniform steps may be taken one by one") {
  for (const StepRule rule : all_rules)
    for (const int count : {1, 2, 3, 4, 5, 7, 8, 64, 101}) {
      const Drive drive(count, true);
      ModalGroup at_once = group(50), one_by_one = at_once;
      ArrayXd first = ArrayXd::Zero(count), second = first;
      best().sweep(at_once.view(), drive.steps(rule, true), first.data());
      best().sweep(one_by_one.view(), drive.steps(rule, false), second.data());
      check_close(first, second, 1e-12);
      check_close(at_once.state, one_by_one.state, 1e-12);
      check_close(at_once.before, one_by_one.before, 1e-12);
    }
}

TEST_CASE("a sweep adds to the stress that is there, and modes of weight zero add nothing") {
  const Drive drive(9, true);
  ModalGroup modes = group(5);  // padded to eight
  REQUIRE(modes.padded() == 8);
  ModalGroup again = modes;
  ArrayXd from_zero = ArrayXd::Zero(9), from_seven = ArrayXd::Constant(9, 7.0);
  best().sweep(modes.view(), drive.steps(StepRule::bdf2, true), from_zero.data());
  best().sweep(again.view(), drive.steps(StepRule::bdf2, true), from_seven.data());
  check_close(from_seven, from_zero + 7.0, 1e-14);
  CHECK((modes.state.tail(3) == 0.0).all());
}

TEST_CASE("a trial is the step it does not take, and its sums are derivatives") {
  for (const StepRule rule : all_rules) {
    const Drive drive(1, true);
    const ModalGroup start = group(13);
    const auto stress_at = [&](double d_log_scale, double d_forcing, double d_curvature) {
      Drive moved = drive;
      moved.scale *= std::exp(d_log_scale);
      moved.forcing += d_forcing;
      moved.curvature += d_curvature;
      ModalGroup modes = start;
      double stress = 0.0;
      best().sweep(modes.view(), moved.steps(rule, false), &stress);
      return stress;
    };
    ModalGroup modes = start;
    const Trial trial = best().trial(modes.view(), drive.steps(rule, false));
    CHECK((modes.state == start.state).all());
    CHECK(trial.stress == doctest::Approx(stress_at(0, 0, 0)).epsilon(1e-13));
    const double step = 1e-5;
    CHECK(trial.by_log_scale ==
          doctest::Approx((stress_at(step, 0, 0) - stress_at(-step, 0, 0)) / (2 * step)).epsilon(1e-7));
    CHECK(trial.by_forcing == doctest::Approx((stress_at(0, 1, 0) - stress_at(0, -1, 0)) / 2).epsilon(1e-9));
    CHECK(trial.by_curvature ==
          doctest::Approx((stress_at(0, 0, 1) - stress_at(0, 0, -1)) / 2).epsilon(1e-9));
  }
}

TEST_CASE("decays reach zero without a trace of infinities") {
  const Drive drive(5, true);
  for (const double tau : {1e-290, 1e-9, 1e290}) {
    ModalGroup modes;
    modes.set(Eigen::Array3d(tau, 0.5 * tau, 1.0), Eigen::Array3d(0.2, 0.3, 0.5));
    ArrayXd stress = ArrayXd::Zero(5);
    best().sweep(modes.view(), drive.steps(StepRule::exponential, true), stress.data());
    CHECK(stress.allFinite());
  }
}
