// Subnormal numbers: a solve flushes them, its caller keeps them.

#include "flush_subnormals.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "probation/errors.hpp"
#include "probation/solver.hpp"

using namespace probation;
using Eigen::ArrayXd;

namespace {

/// Half the smallest normal number, computed when the program runs.
double half_of_the_smallest() {
  volatile double smallest = std::numeric_limits<double>::min();
  smallest = smallest * 0.5;
  return smallest;
}

Law stiff_law() {
  Law law;
  law.unrelaxed_modulus = 3220.0;
  law.tau_max = 5.2;
  law.hardening_modulus = 0.0;
  law.spectrum = Spectrum::log_spaced(12, 4.0);
  return law;
}

/// A ramp, then strain held until e^-t is below all numbers.
History held() {
  constexpr Eigen::Index n = 6000;
  const ArrayXd time = ArrayXd::LinSpaced(n, 0.0, 6000.0);
  return History(time, (0.005 * time).min(0.05));
}

}  // namespace

TEST_CASE("the caller's subnormal numbers survive a solve, also one that fails") {
  Solver solver(held(), SolverOptions());
  ArrayXd stress(6000), too_short(3);
  const double before = half_of_the_smallest();
  solver.stress(stiff_law(), LawChange(), stress);
  CHECK(half_of_the_smallest() == before);
  CHECK(before > 0.0);
  Law bad = stiff_law();
  bad.tau_max = -1.0;
  CHECK_THROWS_AS(solver.stress(bad, LawChange(), stress), InputError);
  CHECK(half_of_the_smallest() == before);
}

#ifdef PROBATION_FLUSHES_SUBNORMALS
TEST_CASE("subnormal numbers are zero within the scope, and as before after it") {
  CHECK(half_of_the_smallest() > 0.0);
  {
    const FlushSubnormals flushing;
    CHECK(half_of_the_smallest() == 0.0);
    {
      const FlushSubnormals again;
      CHECK(half_of_the_smallest() == 0.0);
    }
    CHECK(half_of_the_smallest() == 0.0);
  }
  CHECK(half_of_the_smallest() > 0.0);
}

TEST_CASE("stress that decays for ever reaches zero; bE2's stops at normal numbers, far below any other") {
  for (const Scheme scheme : {Scheme::be2, Scheme::sa2, Scheme::sa3}) {
    SolverOptions options;
    options.scheme = scheme;
    Solver solver(held(), options);
    ArrayXd stress(6000);
    solver.stress(stiff_law(), LawChange(), stress);
    CHECK(stress[9] > 1.0);
    CHECK(std::abs(stress[5999]) <= (scheme == Scheme::be2 ? 1e-300 : 0.0));
  }
}
#endif
