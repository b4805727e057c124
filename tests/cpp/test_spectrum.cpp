#include "probation/spectrum.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "probation/errors.hpp"

using probation::InputError;
using probation::Spectrum;

TEST_CASE("fifty modes over six decades are the paper's") {
  const Spectrum spectrum = Spectrum::log_spaced();
  REQUIRE(spectrum.modes() == 50);
  CHECK(spectrum.relaxation_ratio[49] == 1.0);
  CHECK(spectrum.relaxation_ratio[0] == doctest::Approx(1e-6).epsilon(1e-14));
  // Eq. (4): neighbours differ by 10^(6/49).
  CHECK(spectrum.relaxation_ratio[30] / spectrum.relaxation_ratio[29] ==
        doctest::Approx(std::pow(10.0, 6.0 / 49)));
  CHECK(spectrum.modal_weight.sum() == doctest::Approx(1.0).epsilon(1e-15));
  // docs/law.md: sum of p_j tau_j / tau_max is 0.382 (1/3 in the continuum).
  CHECK((spectrum.modal_weight * spectrum.relaxation_ratio).sum() == doctest::Approx(0.382).epsilon(1e-3));
}

TEST_CASE("two modes two decades apart weigh one to ten") {
  // Eq. (5): sqrt(0.01) : sqrt(1), that is 1/11 and 10/11.
  const Spectrum spectrum = Spectrum::log_spaced(2, 2.0);
  CHECK(spectrum.modal_weight[0] == doctest::Approx(1.0 / 11).epsilon(1e-15));
  CHECK(spectrum.modal_weight[1] == doctest::Approx(10.0 / 11).epsilon(1e-15));
}

TEST_CASE("one mode is the slowest one, whatever the decades") {
  const Spectrum spectrum = Spectrum::log_spaced(1, 6.0);
  CHECK(spectrum.relaxation_ratio[0] == 1.0);
  CHECK(spectrum.modal_weight[0] == 1.0);
}

TEST_CASE("a spectrum that cannot be is refused") {
  CHECK_THROWS_AS(Spectrum::log_spaced(0), InputError);
  CHECK_THROWS_AS(Spectrum::log_spaced(5, 0.0), InputError);
  CHECK_THROWS_AS(Spectrum::log_spaced(5, std::numeric_limits<double>::quiet_NaN()), InputError);
  const auto refuse = [](const Eigen::ArrayXd& ratio, const Eigen::ArrayXd& weight) {
    CHECK_THROWS_AS((Spectrum{ratio, weight}.validate()), InputError);
  };
  refuse(Eigen::ArrayXd(), Eigen::ArrayXd());
  refuse(Eigen::Array2d(0.1, 1.0), Eigen::Array3d(0.1, 0.2, 0.7));
  refuse(Eigen::Array2d(0.0, 1.0), Eigen::Array2d(0.5, 0.5));
  refuse(Eigen::Array2d(0.1, 1.0), Eigen::Array2d(-0.5, 0.5));
  CHECK_NOTHROW((Spectrum{Eigen::Array2d(0.1, 1.0), Eigen::Array2d(0.0, 0.5)}.validate()));
}
