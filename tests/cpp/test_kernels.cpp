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

TEST_CASE("uniform steps may be taken one by one, be they few or so many that fast modes forget") {
  for (const Kernels* kernel : all_builds())
    for (const StepRule rule : all_rules)
      for (const int count : {1, 2, 3, 4, 5, 7, 8, 15, 16, 17, 63, 64, 65, 101, 240})
        for (const double scale : {1e-6, 0.125, 20.0, 1e4}) {
          CAPTURE(std::string(kernel->name));
          CAPTURE(count);
          CAPTURE(scale);
          Drive drive(count, true);
          drive.scale.setConstant(scale);
          ModalGroup at_once = group(50), one_by_one = at_once;
          ArrayXd first = ArrayXd::Zero(count);
          const ArrayXd second = plain_sweep(one_by_one, drive.steps(rule, false));
          kernel->sweep(at_once.view(), drive.steps(rule, true), first.data());
          check_close(first, second, 1e-12);
          check_close(at_once.state, one_by_one.state, 1e-12);
          check_close(at_once.before, one_by_one.before, 1e-12);
        }
}

TEST_CASE("modes in any order, slow ones among the fast, give the same stress") {
  for (const StepRule rule : all_rules) {
    const Drive drive(200, true);
    ModalGroup sorted = group(50), mixed = sorted, reversed = sorted;
    reversed.inverse_ratio.head(50).reverseInPlace();
    reversed.weight.head(50).reverseInPlace();
    reversed.state.head(50).reverseInPlace();
    reversed.before.head(50).reverseInPlace();
    for (Index j = 0; j < 25; j += 2)
      for (ArrayXd* of : {&mixed.inverse_ratio, &mixed.weight, &mixed.state, &mixed.before})
        std::swap((*of)[j], (*of)[49 - j]);
    ArrayXd expected = ArrayXd::Zero(200), stress = expected;
    best().sweep(sorted.view(), drive.steps(rule, true), expected.data());
    for (ModalGroup* modes : {&mixed, &reversed}) {
      stress.setZero();
      best().sweep(modes->view(), drive.steps(rule, true), stress.data());
      check_close(stress, expected, 1e-13);
    }
  }
}

TEST_CASE("a mode of no weight that is stressed at the start relaxes alone") {
  for (const StepRule rule : all_rules) {
    const Drive drive(100, true);
    ModalGroup modes = group(50);
    modes.weight[49] = 0.0;
    modes.state[49] = modes.before[49] = 3.0;
    ModalGroup plain = modes;
    ArrayXd stress = ArrayXd::Zero(100);
    best().sweep(modes.view(), drive.steps(rule, true), stress.data());
    check_close(stress, plain_sweep(plain, drive.steps(rule, true)), 1e-13);
    CHECK(modes.state[49] == doctest::Approx(plain.state[49]).epsilon(1e-12));
  }
}

TEST_CASE("tangents of uniform steps may be taken one by one, too, from any state and slope") {
  for (const Kernels* kernel : all_builds())
    for (const StepRule rule : all_rules)
      for (const int count : {2, 7, 63, 130})
        for (const double scale : {1e-3, 0.125, 20.0}) {
          CAPTURE(std::string(kernel->name));
          CAPTURE(count);
          CAPTURE(scale);
          Drive drive(count, true);
          drive.scale.setConstant(scale);
          const ArrayXd log_scale = ArrayXd::Constant(count, -0.7);
          struct Swept {
            ModalGroup modes = group(50);
            ArrayXd stress, slope, d_state = 2.0 * modes.state, d_before = 3.0 * modes.before;
          };
          const auto take = [&](Swept& swept, const Steps& steps, int first) {
            ArrayXd scratch(9 * swept.modes.padded());
            const TangentDirection along{nullptr,
                                         nullptr,
                                         log_scale.data() + first,
                                         nullptr,
                                         nullptr,
                                         swept.d_state.data(),
                                         swept.d_before.data(),
                                         swept.slope.data() + first};
            kernel->tangent(swept.modes.view(), steps, swept.stress.data() + first, &along, 1,
                            scratch.data());
          };
          Swept at_once, one_by_one;
          for (Swept* swept : {&at_once, &one_by_one}) swept->stress = swept->slope = ArrayXd::Zero(count);
          take(at_once, drive.steps(rule, true), 0);
          for (int n = 0; n < count; ++n) {
            Steps one = drive.steps(rule, false);
            one.count = 1;
            one.forcing += n;
            if (one.curvature) one.curvature += n;
            take(one_by_one, one, n);
          }
          check_close(at_once.stress, one_by_one.stress, 1e-12);
          check_close(at_once.slope, one_by_one.slope, 1e-12);
          check_close(at_once.modes.state.head(50), one_by_one.modes.state.head(50), 1e-12);
          check_close(at_once.modes.before.head(50), one_by_one.modes.before.head(50), 1e-12);
          check_close(at_once.d_state.head(50), one_by_one.d_state.head(50), 1e-12);
          check_close(at_once.d_before.head(50), one_by_one.d_before.head(50), 1e-12);
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
