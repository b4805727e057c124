#include "probation/history.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "probation/errors.hpp"

using namespace probation;
using Eigen::ArrayXd;

namespace {

ArrayXd samples(std::initializer_list<double> values) {
  ArrayXd array(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), array.data());
  return array;
}

ArrayXd uneven() { return samples({0.0, 1.0, 1.5, 3.5, 4.0}); }

}  // namespace

TEST_CASE("three-point rates are exact for a parabola on an uneven grid") {
  // e = t^2, e' = 2t at both ends of every step.
  const History history(uneven(), uneven().square());
  const StepRates rates = history.rates(Differentiator::three_point);
  for (Eigen::Index m = 0; m < history.steps(); ++m) {
    CHECK(rates.begin[m] == doctest::Approx(2 * uneven()[m]).epsilon(1e-13));
    CHECK(rates.end[m] == doctest::Approx(2 * uneven()[m + 1]).epsilon(1e-13));
  }
}

TEST_CASE("backward rates are exact for a parabola but in the first step") {
  const History history(uneven(), uneven().square());
  const StepRates rates = history.rates(Differentiator::backward);
  CHECK(rates.end[0] == 1.0);  // the secant of t^2 from 0 to 1
  for (Eigen::Index m = 1; m < history.steps(); ++m) {
    CHECK(rates.end[m] == doctest::Approx(2 * uneven()[m + 1]).epsilon(1e-13));
    CHECK(rates.begin[m] == rates.end[m - 1]);
  }
}

TEST_CASE("secants are the slopes of the samples") {
  const History history(uneven(), uneven().square());
  const StepRates rates = history.rates(Differentiator::secant);
  for (Eigen::Index m = 0; m < history.steps(); ++m) {
    CHECK(rates.begin[m] == doctest::Approx(uneven()[m] + uneven()[m + 1]).epsilon(1e-13));
    CHECK(rates.end[m] == rates.begin[m]);
  }
}

TEST_CASE("no differentiator looks across a jump") {
  // 0.1 1/s, then -0.2 1/s from t = 1.5 on.
  ArrayXd strain = 0.1 * uneven();
  for (Eigen::Index i = 2; i < 5; ++i) strain[i] = 0.15 - 0.2 * (uneven()[i] - 1.5);
  const History history(uneven(), strain, ArrayXd(), {2});
  for (const auto differentiator :
       {Differentiator::secant, Differentiator::backward, Differentiator::three_point}) {
    const StepRates rates = history.rates(differentiator);
    for (Eigen::Index m = 0; m < 4; ++m) {
      CHECK(rates.begin[m] == doctest::Approx(m < 2 ? 0.1 : -0.2).epsilon(1e-13));
      CHECK(rates.end[m] == doctest::Approx(m < 2 ? 0.1 : -0.2).epsilon(1e-13));
    }
  }
  CHECK(history.fresh(0));
  CHECK_FALSE(history.fresh(1));
  CHECK(history.fresh(2));
}

TEST_CASE("a given rate stays with the nearer side of a jump, the other takes its secant") {
  const ArrayXd time = samples({0.0, 1.0, 2.0, 3.0}), strain = samples({0.0, 0.1, 0.2, 0.0});
  for (const double at_jump : {0.11, -0.19}) {
    const History history(time, strain, samples({0.09, 0.1, at_jump, -0.21}), {2});
    const StepRates rates = history.rates(Differentiator::backward);
    CHECK(rates.end[1] == doctest::Approx(at_jump > 0 ? 0.11 : 0.1));
    CHECK(rates.begin[2] == doctest::Approx(at_jump > 0 ? -0.2 : -0.19));
    CHECK(rates.end[2] == -0.21);
    // Moves follow the same choice: strain moves the secant, a rate moves itself.
    const StepRates moves =
        history.move_rates(samples({0, 0, 1, 3}), samples({5, 6, 7, 8}), Differentiator::backward);
    CHECK(moves.end[1] == (at_jump > 0 ? 7.0 : 1.0));
    CHECK(moves.begin[2] == (at_jump > 0 ? 2.0 : 7.0));
  }
}

TEST_CASE("the rate of a cubic through given rates is theirs") {
  const History history(uneven(), uneven().square(), 2 * uneven());
  const StepRates rates = history.rates(Differentiator::three_point);
  CHECK((rates.begin == 2 * uneven().head(4)).all());
  CHECK((rates.end == 2 * uneven().tail(4)).all());
}

TEST_CASE("a rate against the commanded direction is clipped to the floor, before its modulus is taken") {
  const Eigen::ArrayXi direction = (Eigen::ArrayXi(4) << 1, -1, 0, 1).finished();
  const History history(uneven(), uneven(), ArrayXd(), {}, direction);
  const double floor = 1e-3;
  CHECK(history.companion_rate(0, 0.5, floor) == 0.5);
  CHECK(history.companion_rate(0, -0.5, floor) == floor);
  CHECK(history.companion_rate(1, -0.5, floor) == 0.5);
  CHECK(history.companion_rate(1, 0.5, floor) == floor);
  CHECK(history.companion_rate(2, -0.5, floor) == 0.5);
  CHECK(history.companion_rate(2, 1e-4, floor) == floor);
  CHECK(history.companion_rate_slope(0, 0.5, floor) == 1.0);
  CHECK(history.companion_rate_slope(0, -0.5, floor) == 0.0);
  CHECK(history.companion_rate_slope(1, -0.5, floor) == -1.0);
  CHECK(history.companion_rate_slope(1, 0.5, floor) == 0.0);
  CHECK(history.companion_rate_slope(2, -0.5, floor) == -1.0);
}

TEST_CASE("steps that are even to rounding are one run, and a jump ends it") {
  const ArrayXd time = ArrayXd::LinSpaced(101, 0.0, 17.3);
  const History even(time, time);
  CHECK(even.uniform_run(0) == 100);
  CHECK(even.uniform_run(40) == 60);
  const History jumping(time, time, ArrayXd(), {30});
  CHECK(jumping.uniform_run(0) == 30);
  CHECK(jumping.uniform_run(30) == 70);
  const History other(uneven(), uneven());
  CHECK(other.uniform_run(0) == 1);
  CHECK(other.ratio(0) == 1.0);
  CHECK(other.ratio(2) == 4.0);
}

TEST_CASE("jumps may be given in any order, twice, and at the ends") {
  const History history(uneven(), uneven(), ArrayXd(), {4, 2, 2, 0});
  CHECK(history.fresh(2));
  CHECK_FALSE(history.fresh(3));
  CHECK_THROWS_AS(History(uneven(), uneven(), ArrayXd(), {5}), InputError);
  CHECK_THROWS_AS(History(uneven(), uneven(), ArrayXd(), {-1}), InputError);
}

TEST_CASE("a history that looks for its jumps finds the reversal, and refuses first what cannot be") {
  const ArrayXd time = ArrayXd::LinSpaced(101, 0.0, 100.0);
  ArrayXd strain = 0.01 * time;
  for (Eigen::Index i = 61; i <= 100; ++i) strain[i] = 0.6 - 0.01 * (time[i] - 60.0);
  CHECK(History(FindJumps{}, time, strain).jumps() == History::Indices{60});
  CHECK(History(FindJumps{}, time, 0.01 * time).jumps().empty());
  CHECK(History(FindJumps{}, time, strain).uniform_run(0) == 60);
  strain[3] = NAN;
  CHECK_THROWS_AS(History(FindJumps{}, time, strain), InputError);
}

TEST_CASE("histories that cannot be are refused") {
  CHECK_THROWS_AS(History(samples({0.0}), samples({0.0})), InputError);
  CHECK_THROWS_AS(History(uneven(), samples({0.0, 1.0})), InputError);
  CHECK_THROWS_AS(History(uneven(), uneven(), samples({1.0})), InputError);
  CHECK_THROWS_AS(History(uneven(), uneven(), ArrayXd(), {}, Eigen::ArrayXi::Ones(5)), InputError);
  CHECK_THROWS_AS(History(samples({0.0, 1.0, 1.0}), samples({0, 0, 0})), InputError);
  CHECK_THROWS_AS(History(samples({0.0, NAN}), samples({0, 0})), InputError);
  CHECK_THROWS_AS(History(samples({0.0, 1.0}), samples({0, INFINITY})), InputError);
  CHECK_THROWS_AS(History(samples({0.0, 1.0}), samples({0, 500.0})), InputError);  // e_HT overflows
}
