// The best moduli within a box, unit solves against the solver, and identification of one record.

#include <doctest/doctest.h>

#include <cmath>

#include "identify/box_fit.hpp"
#include "probation/companion/weissenberg.hpp"
#include "probation/identify/identify.hpp"
#include "unit_solves.hpp"

using namespace probation;
using Eigen::Array3d;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Law law_of(bool companion) {
  Law law;
  law.unrelaxed_modulus = 3220.0;
  law.hardening_modulus = 2.5;
  law.tau_max = 5.2;
  if (companion) {
    law.companion = std::make_shared<Weissenberg>(0.00464, 0.0367);
    law.alpha = 1.1;
  }
  return law;
}

ArrayXd times(Index n, bool even) {
  ArrayXd time(n);
  time[0] = 0.0;
  for (Index i = 1; i < n; ++i) time[i] = time[i - 1] + (even || i % 3 > 0 ? 0.5 : 0.75);
  return time;
}

ArrayXd strain_at(const ArrayXd& time) { return 0.004 * time + 0.02 * (0.05 * time).sin(); }

}  // namespace

TEST_CASE("the fit of a pair is the least squares solution, or lies on the box") {
  // u = (1, 0), v = (1, 1), d = (3, 2): d = u + 2 v.
  const PairSums sums{1.0, 1.0, 2.0, 3.0, 5.0};
  const Bounds open{0.0, infinite};
  const PairFit inside = fit_pair(sums, open, open);
  CHECK(inside.u == doctest::Approx(1.0));
  CHECK(inside.v == doctest::Approx(2.0));
  CHECK(inside.u_free);
  // v held at 3: a = (d - 3 v).u = 3 - 3 = 0, at its bound.
  const PairFit held = fit_pair(sums, open, {3.0, 3.0});
  CHECK(held.u == doctest::Approx(0.0));
  CHECK(held.v == 3.0);
  CHECK_FALSE(held.v_free);
  // v at most 1: a = (d - v).u = 2.
  const PairFit bounded = fit_pair(sums, open, {0.0, 1.0});
  CHECK(bounded.u == doctest::Approx(2.0));
  CHECK(bounded.v == doctest::Approx(1.0));
  // The opposite data: both zero.
  const PairFit none = fit_pair({1.0, 1.0, 2.0, -3.0, -5.0}, open, open);
  CHECK(none.u == 0.0);
  CHECK(none.v == 0.0);
}

TEST_CASE("E_u u + G v is the stress, and its slope that of a tangent") {
  for (const bool companion : {false, true})
    for (const bool even : {true, false})
      for (const Scheme scheme : {Scheme::be2, Scheme::sa2, Scheme::sa3}) {
        const Law law = law_of(companion);
        const ArrayXd time = times(301, even);
        const History history(time, strain_at(time), ArrayXd(), {100});
        Solver solver(history, {scheme, Start::exponential, {}});
        const auto directions = parameter_directions(law, {}, history);
        ArrayXd stress(301);
        RowMajorMatrix columns(301, 3);
        solver.tangent(law, {}, directions, stress, columns);
        UnitSolves solves;
        solves.set_modes(law.spectrum);
        solves.take(law, history, scheme, Start::exponential);
        const double parameter = companion ? law.alpha : law.tau_max;
        solves.solve(parameter);
        const double scale = stress.abs().maxCoeff();
        CHECK((3220.0 * solves.u() + 2.5 * solves.v() - stress).abs().maxCoeff() < 1e-12 * scale);
        CHECK((solves.u() - columns.col(0).array()).abs().maxCoeff() < 1e-12 * scale);
        CHECK((solves.slope(3220.0, 2.5) - parameter * columns.col(1).array()).abs().maxCoeff() <
              1e-11 * scale);
        ArrayXd at_once(301);
        solves.stress(3220.0, parameter, 2.5, at_once);
        CHECK((at_once - stress).abs().maxCoeff() < 1e-12 * scale);
      }
}

TEST_CASE("data of the law itself give its parameters back") {
  for (const bool companion : {false, true})
    for (const Scheme scheme : {Scheme::be2, Scheme::sa3})
      for (const IdentifyMethod method :
           {IdentifyMethod::variable_projection, IdentifyMethod::levenberg_marquardt}) {
        const Law law = law_of(companion);
        const ArrayXd time = times(301, false), strain = strain_at(time);
        ArrayXd stress(301);
        Solver(History(time, strain), {scheme, Start::exponential, {}}).stress(law, {}, stress);
        IdentifyOptions options;
        options.scheme = scheme;
        options.method = method;
        options.find_jumps = false;
        Identifier identify(law, options);
        const Identified found = identify(time, strain, stress, ArrayXd());
        CHECK(found.status == IdentifyStatus::converged);
        const Array3d truth(3220.0, companion ? 1.1 : 5.2, 2.5);
        CHECK((found.parameters / truth - 1.0).abs().maxCoeff() < 1e-7);
        CHECK(found.rms_residual < 1e-6);
      }
}

TEST_CASE("what is held stays, and what is bounded stays within") {
  const Law law = law_of(false);
  const ArrayXd time = times(301, true), strain = strain_at(time);
  ArrayXd stress(301);
  Solver(History(time, strain), {Scheme::sa3, Start::exponential, {}}).stress(law, {}, stress);
  for (const IdentifyMethod method :
       {IdentifyMethod::variable_projection, IdentifyMethod::levenberg_marquardt}) {
    IdentifyOptions options;
    options.method = method;
    options.held = {true, false, false};
    const Identified held = Identifier(law, options)(time, strain, stress, ArrayXd());
    CHECK(held.parameters[0] == 3220.0);
    CHECK(held.standard_error[0] == 0.0);
    CHECK(held.parameters[1] == doctest::Approx(5.2).epsilon(1e-6));
    options.held = {false, true, false};
    CHECK(Identifier(law, options)(time, strain, stress, ArrayXd()).parameters[1] == 5.2);
    options.held = {false, false, false};
    options.upper[1] = 4.0;
    const Identified bounded = Identifier(law, options)(time, strain, stress, ArrayXd());
    CHECK(bounded.status == IdentifyStatus::at_a_bound);
    CHECK(bounded.parameters[1] == doctest::Approx(4.0).epsilon(1e-12));
  }
}

TEST_CASE("bad records get a status, never an exception") {
  const Law law = law_of(false);
  const ArrayXd time = times(50, true), strain = strain_at(time), stress = 100.0 * strain;
  Identifier identify(law, {});
  const auto status = [&](const ArrayXd& t, const ArrayXd& e, const ArrayXd& s, const ArrayXd& noise = {}) {
    const Identified found = identify(t, e, s, noise);
    CHECK(found.parameters.isNaN().all());
    return found.status;
  };
  ArrayXd gap = stress, turned = time, torn = strain;
  gap[20] = std::nan("");
  std::swap(turned[4], turned[5]);
  torn[10] = 1000.0;
  CHECK(status(time, strain, gap) == IdentifyStatus::not_finite);
  CHECK(status(time, gap, stress) == IdentifyStatus::not_finite);
  CHECK(status(time, torn, stress) == IdentifyStatus::not_finite);
  CHECK(status(turned, strain, stress) == IdentifyStatus::times_do_not_increase);
  CHECK(status(time.head(3), strain.head(3), stress.head(3)) == IdentifyStatus::too_few_samples);
  CHECK(status(time, strain, stress, ArrayXd::Zero(50)) == IdentifyStatus::not_finite);
  const Identified still = identify(time, ArrayXd::Zero(50), stress, ArrayXd());
  CHECK(still.status == IdentifyStatus::not_determined);
}
