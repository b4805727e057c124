#include "probation/kinematics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "probation/errors.hpp"

using probation::haward_thackray_slope;
using probation::haward_thackray_strain;

TEST_CASE("doubling the length gives seven halves") {
  // L = 2: L^2 - 1/L = 4 - 1/2.
  CHECK(haward_thackray_strain(std::log(2.0)) == doctest::Approx(3.5).epsilon(1e-15));
}

TEST_CASE("near zero the strain is three times the true strain, to the last digit") {
  // e_HT = 3 e + 3/2 e^2 + ...; at e = 1e-12 the second term is 5e-13 of the first.
  CHECK(haward_thackray_strain(1e-12) == doctest::Approx(3e-12).epsilon(1e-12));
}

TEST_CASE("the slope is the derivative") {
  // 2 L^2 + 1/L at L = 2: 8.5.
  CHECK(haward_thackray_slope(std::log(2.0)) == doctest::Approx(8.5).epsilon(1e-15));
  const double step = 1e-6;
  const double difference =
      (haward_thackray_strain(0.7 + step) - haward_thackray_strain(0.7 - step)) / (2 * step);
  CHECK(haward_thackray_slope(0.7) == doctest::Approx(difference).epsilon(1e-9));
}

TEST_CASE("samples are taken one by one") {
  const Eigen::ArrayXd strain = Eigen::Array3d(0.0, std::log(2.0), std::log(0.5));
  const Eigen::ArrayXd result = haward_thackray_strain(strain);
  REQUIRE(result.size() == 3);
  CHECK(result[0] == 0.0);
  CHECK(result[1] == doctest::Approx(3.5).epsilon(1e-15));
  CHECK(result[2] == doctest::Approx(0.25 - 2.0).epsilon(1e-15));
}

TEST_CASE("a sample that is not finite is the caller's mistake") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Eigen::ArrayXd strain = Eigen::Array2d(0.1, bad);
    CHECK_THROWS_AS(haward_thackray_strain(strain), probation::InputError);
  }
}
