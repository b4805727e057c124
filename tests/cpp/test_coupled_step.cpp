// Steps whose inputs depend on the stress at their end: one pass over the modes serves all steps nearby.

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "coefficient_table.hpp"
#include "expansion.hpp"
#include "plain_sweep.hpp"
#include "probation/feedback/power_activation.hpp"
#include "probation/feedback/stress_activation.hpp"
#include "probation/solver.hpp"

using namespace probation;
using namespace probation::kernels;

namespace {

constexpr double ratio = 1.3;

StepForcing<double> step(StepRule rule) {
  return {rule, 0.125, 30.0, rule == StepRule::exponential ? 0.7 : 0.0};
}

/// The modes after a step, as the plain sweep takes it.
double swept(ModalGroup& modes, const StepForcing<double>& taken) {
  double stress = 0.0;
  best().sweep(modes.view(), one_step(taken, ratio), &stress);
  return stress;
}

double largest(const ArrayXd& values) { return values.size() > 0 ? values.abs().maxCoeff() : 0.0; }

}  // namespace

TEST_CASE("a step looked at near its scale is the step itself, for any number of modes and any spectrum") {
  for (const StepRule rule : all_rules)
    for (const int modes : {1, 4, 5, 8, 13, 50})
      for (const bool log_spaced : {true, false})
        for (const double scale : {0.125, 0.1254, 1e-7, 3e3, 4e-3}) {
          ModalGroup start = group(modes);
          if (!log_spaced) start.inverse_ratio[modes / 2] *= 1.01;
          ModalGroup expected = start;
          StepForcing<double> taken = step(rule);
          taken.scale = scale;
          const double stress = swept(expected, taken);

          CoefficientTable table(rule == StepRule::exponential);
          table.set(start, true);
          ExpandedStep expanded;
          expanded.set(rule, ratio);
          expanded.set(table.near(expanded.unit * scale));
          best().look(start.view(), expanded.near, expanded.modes);
          const StepForcing<Dual> asked{rule, taken.scale, taken.forcing, taken.curvature};
          REQUIRE(expanded.reaches(scale));
          CHECK(expanded.stress(asked).stress.value == doctest::Approx(stress).epsilon(1e-12));
          const NearStep same = expanded.taken(asked);
          StressNearby next{};
          best().advance(start.view(), same, &same, next);
          const double rounding = 1e-12 * largest(expected.state) + 1e-14 * largest(expected.before);
          // Modes that are quasi-steady in both steps stay behind.
          const Index followed = start.padded() - same.quasi_steady;
          CHECK(largest((start.state - expected.state).tail(followed)) <= rounding);
          CHECK(largest((start.before - expected.before).tail(followed)) == 0.0);

          // And the step after it, which was looked at in the same pass.
          expanded.modes = next;
          CHECK(expanded.stress(asked).stress.value ==
                doctest::Approx(swept(expected, taken)).epsilon(1e-12));
          CHECK_FALSE(expanded.reaches(1.01 * scale));
        }
}

TEST_CASE("coefficients are those of the rule wherever a scale has been before") {
  for (const bool exponential : {false, true})
    for (const int modes : {1, 13, 50})
      for (const bool log_spaced : {true, false}) {
        ModalGroup of = group(modes);
        if (!log_spaced) of.inverse_ratio[modes / 2] *= 1.01;
        CoefficientTable table(exponential);
        table.set(of, true);
        double scale = 1e-9;
        for (int n = 0; n < 4000; ++n) {  // wide jumps, small steps, and back
          scale *= n % 3 == 0 ? 1e6 : n % 3 == 1 ? 1.0007 : 0.998e-6;
          const CoefficientCell* cell = table.near(scale);
          REQUIRE(cell);
          for (Index j = 0; j < modes; ++j) {
            const double x = scale * of.inverse_ratio[j];
            const StepCoefficients<double> c =
                exponential ? ExponentialStep::coefficients(x, 1.0) : BackwardEulerStep::coefficients(x, 1.0);
            double forcing = 0.0, power = 1.0;
            for (int k = 0; k < CoefficientRows::terms; ++k, power *= cell->distance(scale))
              forcing += cell->rows.forcing[k * cell->rows.stride + j] * power;
            REQUIRE(forcing == doctest::Approx(c.forcing).epsilon(1e-13));
          }
        }
        CHECK(table.near(std::nan("")) == nullptr);
        CHECK(table.near(0.0) == nullptr);
      }
}

TEST_CASE("its slopes are differences of the step, and so are those of a linearised one") {
  for (const StepRule rule : all_rules) {
    ModalGroup start = group(13);
    const StepForcing<double> at = step(rule);
    CoefficientTable table(rule == StepRule::exponential);
    table.set(start, true);
    ExpandedStep expanded;
    expanded.set(rule, ratio);
    expanded.set(table.near(expanded.unit * at.scale));
    best().look(start.view(), expanded.near, expanded.modes);
    ArrayXd rows(5 * start.padded());
    const StepSlopes slopes = best().linearise(start.view(), one_step(at, ratio), rows.data());
    const auto difference = [&](auto move) {
      StepForcing<double> up = at, down = at;
      move(up, 1e-5);
      move(down, -1e-5);
      ModalGroup one = start, other = start;
      return (swept(one, up) - swept(other, down)) / 2e-5;
    };
    const double by_log_scale = difference([](StepForcing<double>& s, double d) { s.scale *= std::exp(d); });
    const double by_forcing = difference([](StepForcing<double>& s, double d) { s.forcing += d; });
    const double by_curvature = difference([](StepForcing<double>& s, double d) { s.curvature += d; });
    const auto slope = [&](const StepForcing<Dual>& moved) { return expanded.stress(moved).stress.slope; };
    CHECK(slope({rule, {at.scale, at.scale}, 30.0, at.curvature}) ==
          doctest::Approx(by_log_scale).epsilon(1e-7));
    CHECK(slope({rule, at.scale, {30.0, 1.0}, at.curvature}) == doctest::Approx(by_forcing).epsilon(1e-7));
    CHECK(slopes.by_log_scale == doctest::Approx(by_log_scale).epsilon(1e-7));
    CHECK(slopes.by_forcing == doctest::Approx(by_forcing).epsilon(1e-7));
    if (rule != StepRule::exponential) continue;
    CHECK(slope({rule, at.scale, 30.0, {at.curvature, 1.0}}) == doctest::Approx(by_curvature).epsilon(1e-7));
    CHECK(slopes.by_curvature == doctest::Approx(by_curvature).epsilon(1e-7));
  }
}

TEST_CASE(
    "a violent feedback on few steps is solved, and the more steps the nearer is the stress to its limit") {
  Law law;
  law.unrelaxed_modulus = 3220.0;
  law.tau_max = 5.2;
  law.hardening_modulus = 2.5;
  LawChange change;
  change.feedbacks = {std::make_shared<StressActivation>(0.3)};
  for (const Scheme scheme : {Scheme::be2, Scheme::sa2, Scheme::sa3}) {
    SolverOptions options;
    options.scheme = scheme;
    const auto at_end = [&](Index n) {
      const ArrayXd time = ArrayXd::LinSpaced(n, 0.0, 100.0);
      ArrayXd stress(n);
      Solver(History(time, 0.005 * time), options).stress(law, change, stress);
      return stress[n - 1];
    };
    const double limit = at_end(8001);
    CHECK(std::abs(at_end(2001) - limit) < std::abs(at_end(20) - limit));
  }
}

TEST_CASE("activation factors are their closed forms on both sides of a series, and even") {
  const StressActivation sinh_form(20.0);
  const PowerActivation power_form(30.0, 2.5);
  for (const double x : {1e-6, 0.01, 0.0499, 0.0501, 0.4, 3.0, 40.0})
    for (const double sign : {-1.0, 1.0}) {
      const Dual found = sinh_form.factor({20.0 * sign * x, 1.0}, 0.0, Feedback::no_parameter).fluidity;
      CHECK(found.value == doctest::Approx(std::sinh(x) / x).epsilon(1e-14));
      const double slope = sign * (std::cosh(x) - std::sinh(x) / x) / x / 20.0;
      if (x > 0.005) CHECK(found.slope == doctest::Approx(slope).epsilon(1e-9));
      CHECK(power_form.factor(30.0 * sign * x, 0.0, Feedback::no_parameter).fluidity.value ==
            doctest::Approx(1.0 + std::pow(x, 2.5)).epsilon(1e-14));
    }
  CHECK(power_form.factor({0.0, 1.0}, 0.0, Feedback::no_parameter).fluidity.slope == 0.0);
}
