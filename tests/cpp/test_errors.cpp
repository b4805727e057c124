#include "probation/errors.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

using probation::ConvergenceError;
using probation::InputError;

TEST_CASE("an input error is an invalid argument and keeps its message") {
  try {
    throw InputError("time has a sample that is not finite");
  } catch (const std::invalid_argument& error) {
    CHECK(std::string(error.what()) == "time has a sample that is not finite");
  }
}

TEST_CASE("a convergence error says when and how far from converged") {
  const ConvergenceError error("too many steps", 12.5, 0.25);
  CHECK(std::string(error.what()) == "too many steps");
  CHECK(error.time() == 12.5);
  CHECK(error.residual_norm() == 0.25);
}

TEST_CASE("the two have different owners: neither catches the other") {
  CHECK_THROWS_AS(throw ConvergenceError("cause", 0.0, 0.0), std::runtime_error);
  CHECK_THROWS_AS(throw InputError("cause"), std::logic_error);
}
