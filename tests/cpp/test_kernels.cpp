#include "kernels/kernels.hpp"

#include <doctest/doctest.h>

#include <string>

#include "plain_sweep.hpp"

using namespace probation;
using namespace probation::kernels;

TEST_CASE("every build sweeps as the plain recursion does, for every number of modes") {
  for (const Kernels* kernel : all_builds())
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

TEST_CASE("the builds are named, the best first, and one of them runs") {
  const auto builds = all_builds();
  REQUIRE(!builds.empty());
  CHECK(std::string(builds.back()->name) == "portable");
  bool runs = false;
  for (const Kernels* build : builds) runs = runs || build == &best();
  CHECK(runs);
}

TEST_CASE("where the curvature is half the change of the forcing, even steps need not look at it") {
  for (const Kernels* kernel : all_builds())
    for (const int count : {1, 2, 9, 100})
      for (const int modes : {3, 29, 50}) {
        Drive drive(count, true);
        for (int n = 1; n < count; ++n) drive.curvature[n] = 0.5 * (drive.forcing[n] - drive.forcing[n - 1]);
        Steps steps = drive.steps(StepRule::exponential, true);
        ModalGroup plain = group(modes), swept = plain;
        const ArrayXd expected = plain_sweep(plain, steps);
        steps.parabolic = true;
        ArrayXd stress = ArrayXd::Zero(count);
        kernel->sweep(swept.view(), steps, stress.data());
        check_close(stress, expected, 1e-13);
        check_close(swept.state, plain.state, 1e-13);
        check_close(swept.before, plain.before, 1e-13);
      }
}

TEST_CASE("bE2 takes any step and any mode, products of many of them beyond all numbers, too") {
  for (const Kernels* kernel : all_builds()) {
    const Drive drive(20, false);
    ModalGroup plain;
    const Eigen::Array<double, 5, 1> ratio(1e-290, 1e-120, 1e-80, 0.5, 1.0);
    plain.set(ratio, ArrayXd::Constant(5, 0.2));
    ModalGroup swept = plain;
    const ArrayXd expected = plain_sweep(plain, drive.steps(StepRule::bdf2, false));
    ArrayXd stress = ArrayXd::Zero(20);
    kernel->sweep(swept.view(), drive.steps(StepRule::bdf2, false), stress.data());
    check_close(stress, expected, 1e-13);
  }
}
