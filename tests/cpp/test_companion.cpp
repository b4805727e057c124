#include "probation/companion.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "probation/companion/exponential.hpp"
#include "probation/companion/power_law.hpp"
#include "probation/companion/rate_shift.hpp"
#include "probation/companion/table.hpp"
#include "probation/companion/weissenberg.hpp"

using namespace probation;

namespace {

/// d ln tau / d ln r by a central difference in ln r.
void check_slope(const CompanionRelation& companion, double rate) {
  const double step = 1e-5;
  const double up = companion.relaxation_time(rate * std::exp(step));
  const double down = companion.relaxation_time(rate * std::exp(-step));
  CHECK(companion.log_slope(rate) == doctest::Approx(std::log(up / down) / (2 * step)).epsilon(1e-7));
}

}  // namespace

TEST_CASE("eq. (11) by hand") {
  // (0.00464 (-3) + 0.0367) / 0.001 = 22.78 s.
  const Weissenberg companion(0.00464, 0.0367);
  CHECK(companion.relaxation_time(1e-3) == doctest::Approx(22.78).epsilon(1e-13));
  for (const double rate : {1e-7, 5e-5, 2e-3, 1.0}) check_slope(companion, rate);
}

TEST_CASE("eq. (11) gives no time below 1.2e-8 1/s") {
  const Weissenberg companion(0.00464, 0.0367);
  CHECK_NOTHROW(companion.relaxation_time(1.3e-8));
  CHECK_THROWS_AS(companion.relaxation_time(1.2e-8), InputError);
}

TEST_CASE("eq. (12) by hand") {
  // log10(1000 r) is 0 at 1e-3 1/s and 1 at 1e-2 1/s.
  const Exponential companion(27.24, -2.1);
  CHECK(companion.relaxation_time(1e-3) == doctest::Approx(27.24).epsilon(1e-14));
  CHECK(companion.relaxation_time(1e-2) == doctest::Approx(27.24 * std::exp(-2.1)).epsilon(1e-14));
  check_slope(companion, 3e-3);
}

TEST_CASE("a power law of exponent -1 is a constant Weissenberg number") {
  const PowerLaw companion(0.03, -1.0);
  for (const double rate : {1e-6, 1e-3, 5.0})
    CHECK(companion.relaxation_time(rate) * rate == doctest::Approx(0.03));
  check_slope(companion, 2e-3);
}

TEST_CASE("a table is straight in log-log axes and goes on beyond its ends") {
  // Slopes -1 and -2: at 1e-2 the geometric mean of 100 and 1; a decade above the end, 1e-2 of its time.
  const Table companion({1e-3, 1e-1, 1.0}, {100.0, 1.0, 0.01});
  CHECK(companion.relaxation_time(1e-2) == doctest::Approx(10.0).epsilon(1e-14));
  CHECK(companion.relaxation_time(1e-1) == doctest::Approx(1.0).epsilon(1e-14));
  CHECK(companion.relaxation_time(10.0) == doctest::Approx(1e-4).epsilon(1e-13));
  CHECK(companion.relaxation_time(1e-5) == doctest::Approx(1e4).epsilon(1e-13));
  for (const double rate : {1e-5, 5e-3, 0.3, 10.0}) check_slope(companion, rate);
}

TEST_CASE("relations that cannot be are refused") {
  CHECK_THROWS_AS(PowerLaw(1.0, 1.0, 0.0), InputError);
  CHECK_THROWS_AS(PowerLaw(1.0, 1.0, INFINITY), InputError);
  CHECK_THROWS_AS(Table({1.0}, {1.0}), InputError);
  CHECK_THROWS_AS(Table({1.0, 2.0}, {1.0}), InputError);
  CHECK_THROWS_AS(Table({1.0, 1.0}, {1.0, 2.0}), InputError);
  CHECK_THROWS_AS(Table({1.0, 2.0}, {1.0, 0.0}), InputError);
  CHECK_THROWS_AS(Table({1.0, NAN}, {1.0, 2.0}), InputError);
  CHECK_THROWS_AS(PowerLaw(-1.0, 1.0).relaxation_time(1.0), InputError);
  CHECK_THROWS_AS(PowerLaw(1.0, -400.0).relaxation_time(1e-3), InputError);  // infinite
}

TEST_CASE("a rate shift without curvature is a power of the rate on top of what was there") {
  // (1e-2 / 1e-3)^-0.5 of 0.03 / 1e-2 s.
  const RateShift companion(std::make_shared<PowerLaw>(0.03, -1.0), 1e-3, 0.5, 0.0);
  CHECK(companion.relaxation_time(1e-2) == doctest::Approx(3.0 / std::sqrt(10.0)).epsilon(1e-14));
  CHECK(companion.log_slope(1e-2) == doctest::Approx(-1.5).epsilon(1e-14));
  check_slope(companion, 4e-4);
}

TEST_CASE("a rate shift with curvature makes the Weissenberg number linear in the logarithm of the rate") {
  // We = 1 + 0.25 log10(r): 0.75 at 0.1 1/s, 1.5 at 100 1/s.
  const RateShift companion(nullptr, 1.0, 1.0 - 0.25 / std::log(10.0), 0.25);
  CHECK(companion.relaxation_time(1.0) == doctest::Approx(1.0).epsilon(1e-14));
  CHECK(companion.relaxation_time(0.1) == doctest::Approx(0.75 / 0.1).epsilon(1e-13));
  CHECK(companion.relaxation_time(100.0) == doctest::Approx(1.5 / 100.0).epsilon(1e-13));
  for (const double rate : {1e-7, 2e-4, 3.0}) check_slope(companion, rate);
  CHECK_THROWS_AS(RateShift(nullptr, 0.0, 0.5, 0.0), InputError);
  CHECK_THROWS_AS(RateShift(nullptr, 1.0, 0.5, 2.5), InputError);
}
