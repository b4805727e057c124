// The C interface on the reference case; the other interfaces are held against it.

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "probation.h"
#include "reference_case.hpp"

namespace {

int count_of(const std::vector<double>& constants) { return static_cast<int>(constants.size()); }

std::string message(std::vector<double> constants) {
  char text[400];
  function_of<decltype(probation_message)>("probation_c", "probation_message")(
      constants.data(), count_of(constants), text, sizeof text);
  return text;
}

std::string message_with(int constant, double value) {
  std::vector<double> constants = constant_list();
  constants[static_cast<std::size_t>(constant - 1)] = value;
  return message(constants);
}

}  // namespace

Answers by_c(bool jaumann) {
  auto* piola = function_of<decltype(probation_second_piola)>("probation_c", "probation_second_piola");
  auto* cauchy = function_of<decltype(probation_cauchy)>("probation_c", "probation_cauchy");
  std::vector<double> state(reference_state);
  Answers out;
  for (const Instant& instant : reference_case()) {
    Answer answer{};
    double stress[6] = {};
    const int status =
        (jaumann ? cauchy : piola)(reference_constants.data(), 11, instant.f.data(), instant.dt, state.data(),
                                   state.data(), stress, answer.tangent.data());
    REQUIRE(status == PROBATION_OK);
    if (jaumann)
      std::memcpy(answer.stress.data(), stress, sizeof stress);
    else
      answer.stress = push_forward(instant.f, stress);
    out.push_back(answer);
  }
  return out;
}

TEST_CASE("the C interface: the literal law on the reference case, in two measures") {
  check_literal_law("C", by_c(true));
  check_same_stress("C", by_c(false), by_c(true));
}

TEST_CASE("the C interface: the stress of the bar after a turn by 90 degrees points where the bar does") {
  const Answers answers = by_c(true);
  const Stress& before = answers[64].stress;
  const Stress& after = answers[84].stress;
  CHECK(std::abs(before[0] - before[1]) > 1.0);
  CHECK(std::abs(before[1] - before[2]) < 1e-10);
  CHECK(std::abs(after[1] - after[0] - reference_case()[84].difference) < 1e-10);
  CHECK(std::abs(after[3]) < 1e-10);
}

TEST_CASE("the C interface: one dimension is the literal law") {
  auto* uniaxial = function_of<decltype(probation_uniaxial)>("probation_c", "probation_uniaxial");
  std::vector<double> state(3 + reference_modes);
  for (const Instant& instant : reference_case()) {
    if (std::isnan(instant.difference)) break;
    const double along = std::sqrt(instant.f[0] * instant.f[0] + instant.f[3] * instant.f[3]);
    double stress = 0.0, tangent = 0.0;
    REQUIRE(uniaxial(reference_constants.data(), 11, std::log(along) - state[2], instant.dt, state.data(),
                     state.data(), &stress, &tangent) == PROBATION_OK);
    CHECK(std::abs(stress - instant.difference) < 1e-10);
  }
}

TEST_CASE("the C interface: many points at once are each point by itself, with P = F S") {
  auto* many = function_of<decltype(probation_first_piola)>("probation_c", "probation_first_piola");
  const Answers single = by_c(false);
  const auto& instants = reference_case();
  std::vector<double> state(2 * reference_state), p(18), a(162);
  int failed = 0;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    std::vector<double> f(instants[i].f.begin(), instants[i].f.end());
    f.insert(f.end(), instants[i].f.begin(), instants[i].f.end());
    REQUIRE(many(reference_constants.data(), 11, 2, f.data(), instants[i].dt, state.data(), state.data(),
                 p.data(), i % 2 == 0 ? a.data() : nullptr, &failed) == PROBATION_OK);
    CHECK(failed == -1);
    // P F^T / J, component 11.
    const double volume = f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) +
                          f[2] * (f[3] * f[7] - f[4] * f[6]);
    for (std::ptrdiff_t point = 0; point < 2; ++point) {
      const double* q = p.data() + 9 * point;
      CHECK(std::abs((q[0] * f[0] + q[1] * f[1] + q[2] * f[2]) / volume - single[i].stress[0]) < 1e-10);
    }
  }
  std::vector<double> inside_out(18, 0.0);
  inside_out[0] = inside_out[4] = inside_out[8] = 1.0;
  CHECK(many(reference_constants.data(), 11, 2, inside_out.data(), 1.0, state.data(), state.data(), p.data(),
             nullptr, &failed) == PROBATION_CUT_STEP);
  CHECK(failed == 1);
}

TEST_CASE("the C interface: a constant that cannot be is named") {
  CHECK(message(constant_list()).empty());
  CHECK(message_with(1, -1.0) ==
        "probation: constant 1 (unrelaxed_modulus) must be a modulus from 0 to 1e12 MPa");
  CHECK(message_with(3, 0.0).find("constant 3 (bulk_modulus)") != std::string::npos);
  CHECK(message_with(4, 1.5).find("constant 4 (form)") != std::string::npos);
  CHECK(message_with(5, NAN).find("constant 5 (alpha)") != std::string::npos);
  CHECK(message_with(7, INFINITY).find("constant 7 (intercept)") != std::string::npos);
  CHECK(message_with(8, 1e-8).find("constant 8 (rate_floor)") != std::string::npos);
  CHECK(message_with(9, -1.0).find("constant 9 (rate_filter)") != std::string::npos);
  CHECK(message_with(10, 65.0).find("constant 10 (modes)") != std::string::npos);
  CHECK(message_with(11, 0.0).find("constant 12 (beyond decades)") != std::string::npos);
  CHECK(message({3220.0}).find("constant 2 (hardening_modulus)") != std::string::npos);
  CHECK(message({3220.0, 1.8, 2e3, 0.0, 0.0}).find("constant 5 (tau_max)") != std::string::npos);
  std::vector<double> longer = constant_list();
  longer.push_back(1.0);  // the stress tolerance
  CHECK(message(longer).empty());
  longer.push_back(1.0);
  CHECK(message(longer).find("constant 13 ") != std::string::npos);
  CHECK(message_with(11, 400.0).find("constant 11 (decades) must be a positive number of at most 30") !=
        std::string::npos);
}

TEST_CASE("the C interface: the state's size follows the modes, and is 0 where the constants cannot be") {
  auto* size = function_of<decltype(probation_state_size)>("probation_c", "probation_state_size");
  auto* uniaxial =
      function_of<decltype(probation_uniaxial_state_size)>("probation_c", "probation_uniaxial_state_size");
  CHECK(size(reference_constants.data(), 11) == reference_state);
  CHECK(uniaxial(reference_constants.data(), 11) == 3 + reference_modes);
  CHECK(size(reference_constants.data(), 10) == 0);
  CHECK(uniaxial(reference_constants.data(), 10) == 0);
}

TEST_CASE("the C interface: an increment that is cut leaves what the caller gave as it was") {
  auto* uniaxial = function_of<decltype(probation_uniaxial)>("probation_c", "probation_uniaxial");
  auto* many = function_of<decltype(probation_first_piola)>("probation_c", "probation_first_piola");
  auto* cauchy = function_of<decltype(probation_cauchy)>("probation_c", "probation_cauchy");
  std::vector<double> line(3 + reference_modes), state(2 * reference_state);
  double stress = 7.0, tangent = 7.0;
  line.back() = INFINITY;  // shows once the modes are summed
  const std::vector<double> line_before = line;
  CHECK(uniaxial(reference_constants.data(), 11, 0.01, 1.0, line.data(), line.data(), &stress, &tangent) ==
        PROBATION_CUT_STEP);
  CHECK(line == line_before);
  CHECK(stress == 7.0);
  CHECK(tangent == 7.0);

  // In place, the second point fails: the first, which would not, keeps its state.
  std::vector<double> f(18), p(18, 7.0), a(162, 7.0), six(6, 7.0);
  f[0] = f[9] = 1.01;
  for (const std::size_t k : {4U, 8U, 13U, 17U}) f[k] = 1.0;
  state.back() = INFINITY;
  const std::vector<double> state_before = state;
  int failed = 0;
  CHECK(many(reference_constants.data(), 11, 2, f.data(), 1.0, state.data(), state.data(), p.data(), a.data(),
             &failed) == PROBATION_CUT_STEP);
  CHECK(failed == 1);
  CHECK(state == state_before);
  CHECK(p == std::vector<double>(18, 7.0));
  CHECK(a == std::vector<double>(162, 7.0));
  double* second = state.data() + reference_state;
  CHECK(cauchy(reference_constants.data(), 11, f.data(), 1.0, second, second, six.data(), a.data()) ==
        PROBATION_CUT_STEP);
  CHECK(state == state_before);
  CHECK(six == std::vector<double>(6, 7.0));
}

TEST_CASE("the C interface: a coarse increment is made and says so") {
  auto* uniaxial = function_of<decltype(probation_uniaxial)>("probation_c", "probation_uniaxial");
  auto* many = function_of<decltype(probation_first_piola)>("probation_c", "probation_first_piola");
  std::vector<double> constants = constant_list(), line(3 + reference_modes), after = line;
  constants.push_back(0.1);
  double stress = 0.0, tangent = 0.0;
  CHECK(uniaxial(constants.data(), 12, 0.05, 10.0, line.data(), after.data(), &stress, &tangent) ==
        PROBATION_COARSE_STEP);
  CHECK(stress > 1.0);
  CHECK(uniaxial(constants.data(), 12, 1e-4, 0.02, line.data(), after.data(), &stress, &tangent) ==
        PROBATION_OK);

  std::vector<double> f(18), p(18), state(2 * reference_state);
  for (const std::size_t k : {0U, 4U, 8U, 13U, 17U}) f[k] = 1.0;
  f[9] = 1.05;
  int failed = 0;
  CHECK(many(constants.data(), 12, 2, f.data(), 10.0, state.data(), state.data(), p.data(), nullptr,
             &failed) == PROBATION_COARSE_STEP);
  CHECK(failed == 1);
  CHECK(p[9] > 1.0);
}
