#include "probation/elastic_frame.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "probation/errors.hpp"

using Eigen::ArrayXd;
using probation::stress_behind_frame;

TEST_CASE("an elastic specimen shares a change with its frame as two springs in series do") {
  const ArrayXd time = ArrayXd::LinSpaced(5, 0.0, 1.0), give = ArrayXd::Constant(5, -0.01);
  ArrayXd change = ArrayXd::LinSpaced(5, 0.0, 3.0);
  const ArrayXd elastic = ArrayXd::Constant(1, std::numeric_limits<double>::infinity());
  const ArrayXd stress = stress_behind_frame(time, ArrayXd::Constant(1, 500.0), elastic, give, change);
  // y = change - E c y with E c = 5.
  for (int n = 0; n < 5; ++n) CHECK(stress[n] == doctest::Approx(change[n] / 6.0).epsilon(1e-14));
}

TEST_CASE("a Maxwell specimen behind a frame relaxes with the time of both, at second order") {
  // y' (1 + c E) + y / T = change' + change / T; with change = t it is
  // y = t - c E T (1 - exp(-t / (T (1 + c E)))).
  const double modulus = 800.0, compliance = 0.01, relaxation = 0.7;
  const double ratio = modulus * compliance;
  double error[2];
  for (int fine = 0; fine < 2; ++fine) {
    const int count = fine ? 401 : 201;
    const ArrayXd time = ArrayXd::LinSpaced(count, 0.0, 4.0);
    const ArrayXd stress =
        stress_behind_frame(time, ArrayXd::Constant(1, modulus), ArrayXd::Constant(1, relaxation),
                            ArrayXd::Constant(count, -compliance), time);
    const ArrayXd exact = time - ratio * relaxation * (1.0 - (-time / (relaxation * (1.0 + ratio))).exp());
    error[fine] = (stress - exact).abs().maxCoeff();
  }
  CHECK(error[1] < 2e-4);
  CHECK(error[0] / error[1] == doctest::Approx(4.0).epsilon(0.1));
}

TEST_CASE("shapes that differ are refused") {
  const ArrayXd three = ArrayXd::Ones(3), two = ArrayXd::Ones(2);
  CHECK_THROWS_AS(stress_behind_frame(three, two, two, three, two), probation::InputError);
}
