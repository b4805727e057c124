#include "probation/slider.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "probation/errors.hpp"

using Eigen::ArrayXd;
using probation::behind_backlash;

namespace {
constexpr double at_the_value = std::numeric_limits<double>::quiet_NaN();
}

TEST_CASE(
    "a slider follows at the backlash's width, and stands still while the value comes back through it") {
  ArrayXd value(6), expected(6);
  value << 0.0, 3.0, 1.5, 0.0, -1.0, 0.0;
  expected << 0.0, 2.0, 2.0, 1.0, 0.0, 0.0;
  CHECK((behind_backlash(value, 1.0, at_the_value) == expected).all());
}

TEST_CASE("a slider begins where it is put, as far as the backlash lets it") {
  const ArrayXd value = ArrayXd::Constant(2, 5.0);
  CHECK(behind_backlash(value, 1.0, 5.5)[1] == 5.5);
  CHECK(behind_backlash(value, 1.0, 0.0)[1] == 4.0);
}

TEST_CASE("a slider without backlash is the value itself; one of no values is empty") {
  const ArrayXd value = ArrayXd::LinSpaced(7, 1.0, -2.0);
  CHECK((behind_backlash(value, 0.0, at_the_value) == value).all());
  CHECK(behind_backlash(ArrayXd(), 1.0, at_the_value).size() == 0);
}

TEST_CASE("a backlash of negative width is refused") {
  CHECK_THROWS_AS(behind_backlash(ArrayXd::Zero(3), -1.0, 0.0), probation::InputError);
}
