// schemes/step.hpp: the coefficients of a step against extended precision, their slopes against differences.

#include "probation/schemes/step.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "probation/dual.hpp"

using namespace probation;

namespace {

/// phi and psi by their power series in long double: sum (-x)^k / (k+1)!, sum -k (-x)^k / (k+2)!.
struct Series {
  long double mean = 0, curved = 0;
  explicit Series(long double x) {
    long double power = 1, factorial = 1;  // (-x)^k, (k + 1)!
    for (int k = 0; k < 80; ++k) {
      mean += power / factorial;
      factorial *= k + 2;
      curved -= k * power / factorial;
      power *= -x;
    }
  }
};

template <class Step>
void check_slopes(double x, double ratio, double tolerance) {
  const double step = 1e-5;
  const auto up = Step::coefficients(x * std::exp(step), ratio),
             down = Step::coefficients(x * std::exp(-step), ratio);
  const auto slope = Step::log_slopes(x, ratio), here = Step::coefficients(x, ratio);
  const auto check = [&](double found, double above, double below, double size) {
    CHECK(std::abs(found - (above - below) / (2 * step)) <= tolerance * std::abs(size) + 1e-300);
  };
  check(slope.previous, up.previous, down.previous, here.previous + here.forcing);
  check(slope.before, up.before, down.before, here.before);
  check(slope.forcing, up.forcing, down.forcing, here.forcing);
  check(slope.curvature, up.curvature, down.curvature, here.curvature);
}

}  // namespace

TEST_CASE("exponential coefficients keep their digits from tiny to large x") {
  for (const double x : {1e-300, 1e-12, 1e-5, 0.01, 0.0999, 0.1, 0.1001, 0.5, 1.0, 3.0, 10.0}) {
    const Series series(x);
    const auto found = ExponentialStep::coefficients(x, 1.0);
    CAPTURE(x);
    CHECK(found.previous == doctest::Approx(std::exp(-x)).epsilon(1e-15));
    CHECK(found.before == 0.0);
    CHECK(found.forcing == doctest::Approx(static_cast<double>(series.mean)).epsilon(2e-15));
    CHECK(found.curvature == doctest::Approx(static_cast<double>(series.curved)).epsilon(1e-13));
  }
}

TEST_CASE("exponential coefficients at very large x are their limits") {
  // phi -> 1/x, psi -> 1/x - 2/x^2.
  for (const double x : {50.0, 1e3, 1e8, 1e150, 1e300}) {
    const auto found = ExponentialStep::coefficients(x, 1.0);
    CHECK(found.forcing == doctest::Approx(1 / x).epsilon(1e-15));
    CHECK(found.curvature == doctest::Approx(1 / x - 2 / x / x).epsilon(1e-13));
  }
}

TEST_CASE("backward Euler and BDF2 coefficients by hand") {
  // x = 1: 1/2. BDF2 with even steps: a = (3/2, -2, 1/2), so 2/2.5, -0.5/2.5, 1/2.5 at x = 1.
  const auto euler = BackwardEulerStep::coefficients(1.0, 1.0);
  CHECK(euler.previous == 0.5);
  CHECK(euler.forcing == 0.5);
  const auto even = Bdf2Step::coefficients(1.0, 1.0);
  CHECK(even.previous == doctest::Approx(0.8).epsilon(1e-15));
  CHECK(even.before == doctest::Approx(-0.2).epsilon(1e-15));
  CHECK(even.forcing == doctest::Approx(0.4).epsilon(1e-15));
}

TEST_CASE("the two-step difference is exact for parabolas on uneven grids, and zero at rest") {
  // f = t^2 at -1, 0, 2: h f' = 2 * 2t = 8.
  const Bdf2Difference difference(2.0);
  CHECK(difference(4.0, 0.0, 1.0) == doctest::Approx(8.0).epsilon(1e-15));
  for (const double ratio : {0.1, 0.37, 1.0, 2.4}) CHECK(Bdf2Difference(ratio)(0.3, 0.3, 0.3) == 0.0);
}

TEST_CASE("log slopes are the derivatives with respect to ln x") {
  for (const double x : {1e-8, 1e-3, 0.02, 0.099, 0.11, 0.7, 2.0, 20.0, 300.0, 1e4, 1e6}) {
    CAPTURE(x);
    check_slopes<BackwardEulerStep>(x, 1.0, 1e-9);
    for (const double ratio : {0.3, 1.0, 2.4}) check_slopes<Bdf2Step>(x, ratio, 1e-9);
    // Around x = 0.1 the series meets the closed form: both good to 1e-13, so the difference to some 1e-8.
    check_slopes<ExponentialStep>(x, 1.0, 3e-8);
  }
}

TEST_CASE("dual numbers carry derivatives through every function the schemes use") {
  const auto check = [](auto function, double at) {
    const double step = 1e-6 * std::max(1.0, std::abs(at));
    const double difference =
        (function(Dual(at + step)).value - function(Dual(at - step)).value) / (2 * step);
    CHECK(function(Dual(at, 1.0)).slope == doctest::Approx(difference).epsilon(1e-8));
    CHECK(function(Dual(at)).slope == 0.0);
  };
  check([](Dual x) { return (x * x - 3.0 * x) / (x + 2.0) - -x; }, 0.7);
  check([](Dual x) { return exp(x) * log(x) + sqrt(x) + pow(x, Dual(1.7)); }, 1.3);
  check([](Dual x) { return sinh(x) + tanh(x) - expm1(x); }, -0.4);
}
