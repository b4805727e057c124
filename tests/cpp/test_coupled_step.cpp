// Steps whose inputs depend on the stress at their end: one pass over the modes serves all steps nearby.

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>

#include "expansion.hpp"
#include "kernels/kernels.hpp"
#include "modal_group.hpp"
#include "probation/feedback/power_activation.hpp"
#include "probation/feedback/stress_activation.hpp"
#include "probation/solver.hpp"
#include "probation/spectrum.hpp"

using namespace probation;
using namespace probation::kernels;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

constexpr StepRule all_rules[] = {StepRule::backward_euler, StepRule::bdf2, StepRule::exponential};
constexpr double ratio = 1.3;

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

StepForcing<double> step(StepRule rule) {
  return {rule, 0.125, 30.0, rule == StepRule::exponential ? 0.7 : 0.0};
}

/// The modes after a step, as the plain sweep takes it.
double swept(ModalGroup& modes, const StepForcing<double>& taken) {
  double stress = 0.0;
  best().sweep(modes.view(), one_step(taken, ratio), &stress);
  return stress;
}

double largest(const ArrayXd& values) { return values.abs().maxCoeff(); }

}  // namespace

TEST_CASE("a step expanded nearby is the step itself, for any number of modes") {
  for (const StepRule rule : all_rules)
    for (const int modes : {1, 4, 5, 8, 13, 50})
      for (const double off : {-1.0, 0.0, 1.0}) {
        ModalGroup start = group(modes), expected = start;
        ExpandedStep expanded{step(rule), {}};
        ArrayXd rows(4 * start.padded());
        best().expand(start.view(), one_step(expanded.tried, ratio), expanded.at, rows.data());
        CHECK((start.state == expected.state).all());
        const double eta = 0.99 * off * expanded.at.reach;
        StepForcing<double> taken = expanded.tried;
        taken.scale *= (1.0 + eta) / (1.0 - eta);
        if (rule != StepRule::exponential) taken.forcing += 1e-3 * off;
        const double stress = swept(expected, taken);
        const StepForcing<Dual> asked{rule, taken.scale, taken.forcing, taken.curvature};
        CHECK(expanded.reaches(asked));
        CHECK(expanded.stress(asked).value == doctest::Approx(stress).epsilon(1e-12));
        best().take(start.view(), rule, expanded.nearby(taken), rows.data());
        CHECK(largest(start.state - expected.state) <= 1e-12 * largest(expected.state));
        CHECK(largest(start.before - expected.before) == 0.0);
        taken.scale *= 1.01;
        CHECK_FALSE(expanded.reaches({rule, taken.scale, taken.forcing, taken.curvature}));
      }
}

TEST_CASE("its slopes are differences of the step, and so are those of a linearised one") {
  for (const StepRule rule : all_rules) {
    ModalGroup start = group(13);
    ExpandedStep expanded{step(rule), {}};
    ArrayXd rows(5 * start.padded());
    best().expand(start.view(), one_step(expanded.tried, ratio), expanded.at, rows.data());
    const StepSlopes slopes = best().linearise(start.view(), one_step(expanded.tried, ratio), rows.data());
    const auto difference = [&](auto move) {
      StepForcing<double> up = expanded.tried, down = expanded.tried;
      move(up, 1e-5);
      move(down, -1e-5);
      ModalGroup one = start, other = start;
      return (swept(one, up) - swept(other, down)) / 2e-5;
    };
    const double by_log_scale = difference([](StepForcing<double>& s, double d) { s.scale *= std::exp(d); });
    const double by_forcing = difference([](StepForcing<double>& s, double d) { s.forcing += d; });
    const double by_curvature = difference([](StepForcing<double>& s, double d) { s.curvature += d; });
    const double scale = expanded.tried.scale;
    CHECK(expanded.stress({rule, {scale, scale}, 30.0, expanded.tried.curvature}).slope ==
          doctest::Approx(by_log_scale).epsilon(1e-7));
    CHECK(expanded.stress({rule, scale, {30.0, 1.0}, expanded.tried.curvature}).slope ==
          doctest::Approx(by_forcing).epsilon(1e-7));
    CHECK(slopes.by_log_scale == doctest::Approx(by_log_scale).epsilon(1e-7));
    CHECK(slopes.by_forcing == doctest::Approx(by_forcing).epsilon(1e-7));
    if (rule == StepRule::exponential)
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
