#include "probation/kinematics.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

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

TEST_CASE("samples in one pass keep every digit, near zero and far from it") {
  // m (2 + m) + m / L with m = expm1(e) and L = exp(e) in long double.
  const Eigen::Index n = 4001;
  Eigen::ArrayXd strain(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / 2000.0 - 1.0;
    strain[i] = i % 3 == 0   ? 5.0 * u
                : i % 3 == 1 ? std::copysign(std::pow(10.0, -15.0 * std::abs(u)), u)
                             : 300.0 * u;
  }
  const Eigen::ArrayXd found = haward_thackray_strain(strain);
  double worst = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const long double m = std::expm1(static_cast<long double>(strain[i]));
    const long double exact = m * (2.0L + m) + m / std::exp(static_cast<long double>(strain[i]));
    if (strain[i] != 0.0) worst = std::max(worst, static_cast<double>(std::abs((found[i] - exact) / exact)));
  }
  CHECK(worst < 1e-15);
}

TEST_CASE("a stretch beyond all numbers is the caller's mistake, with its sample") {
  for (const double strain : {360.0, 800.0, -720.0, -1e300}) {
    CAPTURE(strain);
    std::string said;
    try {
      haward_thackray_strain(Eigen::Array3d(0.1, strain, 400.0));
    } catch (const probation::InputError& error) {
      said = error.what();
    }
    CHECK(said.find("true_strain[1] is ") == 0);
    CHECK(said.find("beyond all numbers") != std::string::npos);
  }
}
