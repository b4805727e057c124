// material/: pieces by closed forms, and how an update ends where it cannot go on. The whole:
// probation_point_check.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "probation/divided_differences.hpp"
#include "probation/material/constants.hpp"
#include "probation/material/measures.hpp"
#include "probation/material/uniaxial.hpp"

using namespace probation;
using namespace probation::material;

namespace {

/// A single mode of 2 s, E_u 900, G 3, K 1000 MPa.
Parameters one_mode() {
  Parameters p;
  const double constants[] = {900.0, 3.0, 1000.0, 0.0, 2.0, 0.0, 0.0, 1e-7, 0.0, 1.0, 6.0};
  REQUIRE(read_constants(constants, 11, p).ok());
  return p;
}

constexpr Symmetric unit{1.0, 1.0, 1.0, 0.0, 0.0, 0.0};

}  // namespace

TEST_CASE("divided differences of the logarithm keep their digits where arguments meet") {
  // ln[1, 1 + d] = 1 - d/2 + d^2/3 - …, ln[1, 1, 1 + d] = -1/2 + d/3 - d^2/4 + …
  for (const double d : {0.0, 1e-12, 1e-6, 1e-3}) {
    CHECK(log_difference(1.0, 1.0 + d) ==
          doctest::Approx(1.0 - d / 2 + d * d / 3 - d * d * d / 4).epsilon(1e-12));
    CHECK(log_difference(1.0 + d, 1.0, 1.0) == doctest::Approx(-0.5 + d / 3 - d * d / 4).epsilon(1e-9));
  }
  // In long double, by the definition, on both sides of the switch from series to quotients and far away.
  const auto expected = [](long double a, long double b, long double c) {
    const long double ab = (std::log(a) - std::log(b)) / (a - b), bc = (std::log(b) - std::log(c)) / (b - c);
    return static_cast<double>((ab - bc) / (a - c));
  };
  for (const double spread : {0.04, 0.09, 0.0999, 0.11, 0.5, 20.0}) {
    const double a = 0.7, b = 0.7 * (1.0 + 0.3 * spread), c = 0.7 * (1.0 + spread);
    CAPTURE(spread);
    CHECK(log_difference(a, b, c) == doctest::Approx(expected(a, b, c)).epsilon(1e-13));
    CHECK(log_difference(c, a, b) == log_difference(a, b, c));
  }
}

TEST_CASE("principal axes put a tensor together again, also where values meet") {
  for (const Symmetric& s :
       {Symmetric{2.0, 1.0, 3.0, 0.5, -0.2, 0.1}, Symmetric{1.0, 1.0, 1.0, 1e-9, 0.0, 0.0},
        Symmetric{1.0, 4.0, 1.0, 0.0, 0.0, 0.0}, Symmetric{0.0, 0.0, 0.0, 1.0, 1.0, 1.0}}) {
    const Principal p = principal(s);
    const Symmetric back = transform(congruence(p.axes), {p.value[0], p.value[1], p.value[2], 0.0, 0.0, 0.0});
    for (int c = 0; c < 6; ++c) CHECK(std::abs(back[c] - s[c]) < 1e-14);
    CHECK(determinant(p.axes) == doctest::Approx(1.0).epsilon(1e-15));
  }
}

TEST_CASE("one mode held at a strain relaxes exponentially to the hardening stress") {
  // sigma = G e_HT + (E_u e - G e_HT) e^(-t / 2 s) after strain 0.1 at once.
  const Parameters p = one_mode();
  double state[most_uniaxial_state] = {};
  UniaxialStress out;
  REQUIRE(uniaxial_update(p, 0.1, 0.0, state, state, out).ok());
  CHECK(out.true_stress == doctest::Approx(90.0).epsilon(1e-14));
  CHECK(out.tangent == doctest::Approx(900.0).epsilon(1e-14));
  REQUIRE(uniaxial_update(p, 0.0, 3.0, state, state, out).ok());
  const double relaxed = 3.0 * (std::exp(0.2) - std::exp(-0.1));
  CHECK(out.true_stress == doctest::Approx(relaxed + (90.0 - relaxed) * std::exp(-1.5)).epsilon(1e-14));
}

TEST_CASE("equal stretch in all directions is K ln J, and nothing relaxes") {
  // S = sigma J / l^2 with l = 1.1, sigma = K ln J / J.
  const Parameters p = one_mode();
  std::vector<double> state(most_point_state);
  PointStress out;
  REQUIRE(point_update(p, {1.21, 1.21, 1.21, 0.0, 0.0, 0.0}, 5.0, state.data(), state.data(), out).ok());
  for (int c = 0; c < 6; ++c)
    CHECK(std::abs(out.stress[c] - (c < 3 ? 3000.0 * std::log(1.1) / 1.21 : 0.0)) < 1e-11);
  CHECK(state[3] == doctest::Approx(1.331 - 1.0).epsilon(1e-13));
  CHECK(state[2] < 1e-15);
}

TEST_CASE("simple shear at once is the elastic Hencky solid with mu = E_u / 3") {
  // F = 1 + g e1 x e2: Cauchy s12 = 2 mu e / sqrt(1 + g^2/4), e = asinh(g/2): T12 of the turned logarithm.
  const Parameters p = one_mode();
  const double g = 0.4;
  const Matrix3 f{{{1.0, g, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  std::vector<double> state(most_point_state);
  PointStress out;
  REQUIRE(point_update(p, right_cauchy_green(f), 0.0, state.data(), state.data(), out).ok());
  const PointStress cauchy = cauchy_jaumann(out, f);
  CHECK(cauchy.stress[3] ==
        doctest::Approx(600.0 * std::asinh(g / 2) / std::sqrt(1.0 + g * g / 4)).epsilon(1e-13));
  CHECK(std::abs(cauchy.stress[0] + cauchy.stress[1]) < 1e-11);
}

TEST_CASE("a state that is stepped in place is stepped as if it were not") {
  const Parameters p = one_mode();
  std::vector<double> here(most_point_state), before(most_point_state), after(most_point_state);
  PointStress in_place, apart;
  for (const double shear : {0.1, 0.3, -0.2}) {
    const Symmetric c{1.2, 0.9, 1.0, shear, 0.0, 0.05};
    REQUIRE(point_update(p, c, 1.0, here.data(), here.data(), in_place).ok());
    REQUIRE(point_update(p, c, 1.0, before.data(), after.data(), apart).ok());
    before = after;
    CHECK(in_place.stress == apart.stress);
    CHECK(here == after);
  }
}

TEST_CASE("increments that no material survives ask for a smaller step") {
  const Parameters p = one_mode();
  std::vector<double> state(most_point_state);
  PointStress out;
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  const auto status = [&](const Symmetric& c, double dt) {
    return point_update(p, c, dt, state.data(), state.data(), out).status;
  };
  CHECK(status(unit, -1.0) == Status::cut_step);
  CHECK(status(unit, nan) == Status::cut_step);
  CHECK(status(unit, infinite) == Status::cut_step);
  CHECK(status({-1.0, 1.0, 1.0, 0.0, 0.0, 0.0}, 1.0) == Status::cut_step);
  CHECK(status({1.0, 1.0, 1.0, 2.0, 0.0, 0.0}, 1.0) == Status::cut_step);
  CHECK(status({1.0, nan, 1.0, 0.0, 0.0, 0.0}, 1.0) == Status::cut_step);
  CHECK(std::all_of(state.begin(), state.end(), [](double value) { return value == 0.0; }));
  CHECK(status(unit, 1.0) == Status::ok);

  UniaxialStress stress;
  for (const double rise : {nan, infinite, 200.0})
    CHECK(uniaxial_update(p, rise, 1.0, state.data(), state.data(), stress).status == Status::cut_step);
  CHECK(uniaxial_update(p, 0.1, -1.0, state.data(), state.data(), stress).status == Status::cut_step);
}

TEST_CASE("a companion that gives no time at a rate asks for a smaller step") {
  // We = 0.1 - 0.1 log10(r): none at 10 1/s and above.
  Parameters p = one_mode();
  p.form = Form::weissenberg;
  p.coefficients[0] = -0.1;
  p.coefficients[1] = 0.1;
  double state[most_uniaxial_state] = {};
  UniaxialStress stress;
  CHECK(uniaxial_update(p, 1.0, 0.05, state, state, stress).status == Status::cut_step);
  CHECK(uniaxial_update(p, 1e-3, 0.05, state, state, stress).ok());
}

TEST_CASE("below the floor the companion relation sees the floor, on loading and unloading") {
  Parameters p = one_mode();
  p.form = Form::power;
  p.coefficients[0] = 0.02;
  p.coefficients[1] = -1.0;
  p.rate_floor = 1e-3;
  double state[most_uniaxial_state] = {};
  UniaxialStress stress;
  for (const double rate : {1e-5, -1e-5, 0.0}) {
    REQUIRE(uniaxial_update(p, rate, 1.0, state, state, stress).ok());
    CHECK(state[0] == 1e-3);
    CHECK(state[1] == doctest::Approx(20.0));
  }
}

TEST_CASE("the filtered rate follows a jump over the filter's strain") {
  // r_f = r + (r0 - r) e^(-strain / filter): from 1e-3 to 1e-2 over a strain of 0.02, filter 0.01.
  Parameters p = one_mode();
  p.rate_filter = 0.01;
  double state[most_uniaxial_state] = {};
  UniaxialStress stress;
  REQUIRE(uniaxial_update(p, 1e-3, 1.0, state, state, stress).ok());
  CHECK(state[0] == 1e-3);
  for (int i = 0; i < 10; ++i) REQUIRE(uniaxial_update(p, 0.002, 0.2, state, state, stress).ok());
  CHECK(state[0] == doctest::Approx(1e-2 - 9e-3 * std::exp(-2.0)).epsilon(1e-12));
}

TEST_CASE("an update that fails late leaves state, stress and tangent as they were") {
  Parameters p = one_mode();
  REQUIRE(p.set_log_spaced(3, 2.0));
  // The last mode is no number: the first two were stepped when it shows.
  std::vector<double> state(most_point_state, 0.25);
  state[0] = state[1] = 1.0;
  state[point_state_header + 2 * 6] = std::numeric_limits<double>::infinity();
  const std::vector<double> untouched = state;
  PointStress out;
  out.stress.fill(7.0);
  out.tangent[0][0] = 7.0;
  CHECK(point_update(p, {1.1, 1.0, 1.0, 0.0, 0.0, 0.0}, 1.0, state.data(), state.data(), out).status ==
        Status::cut_step);
  CHECK(state == untouched);
  CHECK(out.stress[0] == 7.0);
  CHECK(out.tangent[0][0] == 7.0);

  std::vector<double> line(most_uniaxial_state, 0.25);
  line[5] = std::numeric_limits<double>::infinity();
  const std::vector<double> as_before = line;
  UniaxialStress stress{7.0, 7.0};
  CHECK(uniaxial_update(p, 0.1, 1.0, line.data(), line.data(), stress).status == Status::cut_step);
  CHECK(line == as_before);
  CHECK(stress.true_stress == 7.0);
  CHECK(stress.tangent == 7.0);
}

TEST_CASE("a tangent that is not finite cuts the increment, though the stress is finite") {
  // S = T / c is 4e306 MPa, dS / dE about E_u / c^2 = 7e311 MPa.
  Parameters p = one_mode();
  p.unrelaxed_modulus = 1e300;
  std::vector<double> state(most_point_state);
  PointStress out;
  const Symmetric squeezed{1e-6, 1.0, 1.0, 0.0, 0.0, 0.0};
  CHECK(point_update(p, squeezed, 1.0, state.data(), state.data(), out, false).ok());
  state.assign(most_point_state, 0.0);
  CHECK(point_update(p, squeezed, 1.0, state.data(), state.data(), out).status == Status::cut_step);
}

TEST_CASE("modes that relax at once have a finite tangent") {
  // The ratio 10^-30 with a long increment: x = 1e60 and more; e^-x times x came out as 0 times inf at
  // 10^-400.
  Parameters p = one_mode();
  REQUIRE(p.set_log_spaced(5, most_decades));
  p.form = Form::power;
  p.coefficients[0] = 0.02;
  p.coefficients[1] = -0.9;
  p.relaxation_ratio[0] = 0.0;
  std::vector<double> state(most_point_state);
  PointStress out;
  REQUIRE(point_update(p, {1.1, 1.0, 1.0, 0.0, 0.0, 0.0}, 1e20, state.data(), state.data(), out).ok());
  CHECK(all_finite(out.tangent));
}

TEST_CASE("constants have ranges within which nothing overflows") {
  const auto bad = [](int constant, double value) {
    double constants[] = {900.0, 3.0, 1000.0, 1.0, 1.0, 0.00464, 0.0367, 1e-7, 0.0, 50.0, 6.0, 0.1};
    constants[constant - 1] = value;
    Parameters p;
    return read_constants(constants, 12, p).constant;
  };
  for (const int constant : {1, 2, 3}) CHECK(bad(constant, 1.1e12) == constant);
  for (const int constant : {3, 5, 8}) CHECK(bad(constant, 0.9e-30) == constant);
  for (const int constant : {5, 6, 7, 9}) CHECK(bad(constant, 1.1e30) == constant);
  for (const double decades : {400.0, 31.0, -1.0}) CHECK(bad(11, decades) == 11);
  CHECK(bad(12, -1.0) == 12);
  CHECK(bad(12, 0.0) == 0);
  CHECK(bad(1, 1e12) == 0);
}

namespace {

/// The paper's law; stress_tolerance [MPa] in the last place.
Parameters paper_law(double stress_tolerance) {
  Parameters p;
  const double constants[] = {3220.0, 1.8,  2e4, 1.0,  1.0, 0.00464,
                              0.0367, 1e-7, 0.0, 50.0, 6.0, stress_tolerance};
  REQUIRE(read_constants(constants, 12, p).ok());
  return p;
}

/// Loading at a rate that varies between 0 and 0.01 1/s, ending on the way back.
double path(double t) { return 0.2 * std::sin(t / 40.0) + 0.05 * (1.0 - std::cos(t / 10.0)); }
constexpr double path_end = 90.0;

/// One increment of the path in tension, in one dimension or three; the stress is the axial one less the
/// others.
struct Bar {
  bool three_dimensional;
  std::vector<double> state = std::vector<double>(most_point_state);
  double stress = 0.0;

  Outcome step(const Parameters& p, double from, double to) {
    if (!three_dimensional) {
      UniaxialStress out;
      const Outcome outcome =
          uniaxial_update(p, path(to) - path(from), to - from, state.data(), state.data(), out);
      stress = out.true_stress;
      return outcome;
    }
    const double e = path(to);
    PointStress out;
    const Symmetric c{std::exp(2.0 * e), std::exp(-e), std::exp(-e), 0.0, 0.0, 0.0};
    const Outcome outcome = point_update(p, c, to - from, state.data(), state.data(), out);
    stress = c[0] * out.stress[0] - c[1] * out.stress[1];
    return outcome;
  }
};

}  // namespace

TEST_CASE("a coarse increment asks for a smaller one and is made all the same, a fine one does not") {
  for (const bool three_dimensional : {false, true}) {
    CAPTURE(three_dimensional);
    Bar coarse{three_dimensional}, unwatched{three_dimensional}, fine{three_dimensional};
    const Outcome found = coarse.step(paper_law(0.1), 0.0, 5.0);
    CHECK(found.ok());
    CHECK(found.step_factor < 1.0);
    CHECK(found.step_factor >= smallest_cut);
    CHECK(unwatched.step(paper_law(0.0), 0.0, 5.0).step_factor == 1.0);
    CHECK(coarse.stress == unwatched.stress);
    CHECK(coarse.state == unwatched.state);
    CHECK(fine.step(paper_law(0.1), 0.0, 0.01).step_factor == 1.0);
  }
}

TEST_CASE("an increment at once, which relaxes nothing, is exact") {
  Parameters p = paper_law(1e-6);
  std::vector<double> state(most_uniaxial_state);
  UniaxialStress out;
  CHECK(uniaxial_update(p, 0.01, 0.0, state.data(), state.data(), out).step_factor == 1.0);
}

TEST_CASE("increments chosen by their factors keep the stress within the tolerance") {
  for (const bool three_dimensional : {false, true})
    for (const double tolerance : {1.0, 0.1, 0.02}) {
      const Parameters p = paper_law(tolerance);
      Bar bar{three_dimensional}, reference{three_dimensional};
      double t = 0.0, h = 5.0, worst = 0.0;
      int increments = 0;
      while (t < path_end) {
        Bar tried = bar;
        const double end = std::min(t + h, path_end);
        const Outcome outcome = tried.step(p, t, end);
        REQUIRE(outcome.ok());
        if (outcome.step_factor < 1.0) {
          h = outcome.step_factor * (end - t);
          continue;
        }
        constexpr int parts = 40;
        for (int k = 0; k < parts; ++k)
          REQUIRE(
              reference
                  .step(p, t + (end - t) * k / parts, k + 1 == parts ? end : t + (end - t) * (k + 1) / parts)
                  .ok());
        bar = tried;
        worst = std::max(worst, std::abs(bar.stress - reference.stress));
        t = end;
        h *= 1.5;
        ++increments;
      }
      MESSAGE((three_dimensional ? "3D" : "1D"), ", tolerance ", tolerance, " MPa: ", increments,
              " increments, largest error ", worst, " MPa");
      CHECK(worst < tolerance);
      CHECK(worst > 0.02 * tolerance);  // not by far too many
    }
}
