// The UMAT, called as Abaqus/Standard calls it.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "reference_case.hpp"

namespace {

std::string said;  // what the UMAT said through Abaqus' message routine

using Umat = void(double*, double*, double*, double*, double*, double*, double*, double*, double*, double*,
                  const double*, const double*, const double*, const double*, const double*, const double*,
                  const double*, const double*, const char*, const int*, const int*, const int*, const int*,
                  const double*, const int*, const double*, const double*, double*, const double*,
                  const double*, const double*, const int*, const int*, const int*, const int*, const int*,
                  const int*, std::size_t);

/// One point of an element with `direct` and `shear` components.
struct AbaqusPoint {
  explicit AbaqusPoint(int direct, int shear, std::size_t state_size = reference_state)
      : ndi(direct), nshr(shear), state(state_size) {}

  int ndi, nshr;
  std::vector<double> state;
  std::vector<double> constants = constant_list();
  double stress[6] = {}, tangent[36] = {}, pnewdt = 1.0;

  void step(const std::array<double, 9>& f, double strain_increment, double dt) {
    double scalar = 0.0, six[6] = {}, strain[6] = {}, rise[6] = {strain_increment}, gradient[9],
           start[9] = {};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) gradient[i + 3 * j] = f[3 * i + j];
    const double two[2] = {}, three[3] = {}, nine[9] = {};
    const int ntens = ndi + nshr, nstatv = static_cast<int>(state.size()),
              nprops = static_cast<int>(constants.size());
    const int one = 1;
    pnewdt = 1.0;
    function_of<Umat>("probation_abaqus", "umat_")(
        stress, state.data(), tangent, &scalar, &scalar, &scalar, &scalar, six, six, &scalar, strain, rise,
        two, &dt, &scalar, &scalar, &scalar, &scalar, "PROBATION", &ndi, &nshr, &ntens, &nstatv,
        constants.data(), &nprops, three, nine, &pnewdt, &scalar, start, gradient, &one, &one, &one, &one,
        &one, &one, 80);
  }
};

constexpr std::array<double, 9> unit{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

}  // namespace

// Abaqus' own, here in its place. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" void stdb_abqerr_(const int* level, const char* text, const int*, const double*, const char*,
                             std::size_t length, std::size_t) {
  CHECK(*level == -3);
  said.assign(text, length);
}

TEST_CASE("UMAT: solid elements give what the C interface gives") {
  AbaqusPoint point(3, 3);
  Answers answers;
  for (const Instant& instant : reference_case()) {
    point.step(instant.f, 0.0, instant.dt);
    REQUIRE(point.pnewdt == 1.0);
    Answer answer{};
    for (int r = 0; r < 6; ++r) {
      answer.stress[r] = point.stress[r];
      for (int c = 0; c < 6; ++c) answer.tangent[6 * r + c] = point.tangent[r + 6 * c];
    }
    answers.push_back(answer);
  }
  check_literal_law("UMAT", answers);
  check_same_stress("UMAT", answers, by_c(true));
  check_same_tangent("UMAT", answers, by_c(true));
}

TEST_CASE("UMAT: plane-strain and axisymmetric elements take the first four components") {
  AbaqusPoint solid(3, 3), plane(3, 1);
  const std::array<double, 9> f{1.1, 0.05, 0.0, 0.02, 0.93, 0.0, 0.0, 0.0, 1.01};
  solid.step(f, 0.0, 10.0);
  plane.step(f, 0.0, 10.0);
  for (int r = 0; r < 4; ++r) {
    CHECK(plane.stress[r] == solid.stress[r]);
    for (int c = 0; c < 4; ++c) CHECK(plane.tangent[r + 4 * c] == solid.tangent[r + 6 * c]);
  }
}

TEST_CASE("UMAT: trusses follow the law in one dimension") {
  AbaqusPoint truss(1, 0, 3 + reference_modes);
  for (const Instant& instant : reference_case()) {
    if (std::isnan(instant.difference)) break;
    const double along = std::sqrt(instant.f[0] * instant.f[0] + instant.f[3] * instant.f[3]);
    truss.step(unit, std::log(along) - truss.state[2], instant.dt);
    CHECK(std::abs(truss.stress[0] - instant.difference) < 1e-10);
  }
}

TEST_CASE("UMAT: what cannot be is said through Abaqus and cuts the increment") {
  const auto complaint = [](AbaqusPoint point) {
    said.clear();
    point.step(unit, 0.0, 1.0);
    CHECK(point.pnewdt == 0.25);
    return said;
  };
  AbaqusPoint point(3, 3);
  point.constants[4] = -1.0;
  CHECK(complaint(point) == "probation: constant 5 (alpha) must be a number from 1e-30 to 1e30");
  CHECK(complaint(AbaqusPoint(2, 1)).find("this element is not offered") != std::string::npos);
  CHECK(complaint(AbaqusPoint(3, 3, reference_state - 1)).find("too few state variables") !=
        std::string::npos);
}

TEST_CASE("UMAT: a deformation turned inside out only cuts the increment") {
  AbaqusPoint point(3, 3);
  said.clear();
  point.step({-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, 0.0, 1.0);
  CHECK(point.pnewdt == 0.25);
  CHECK(said.empty());
}

TEST_CASE("UMAT: hosts without Abaqus' routine can ask what is wrong") {
  using Message = void(const double*, const int*, char*, const int*);
  std::vector<double> constants = constant_list();
  constants[9] = 0.0;
  const int count = 11, capacity = 200;
  char text[200];
  function_of<Message>("probation_abaqus", "probation_umat_message")(constants.data(), &count, text,
                                                                     &capacity);
  CHECK(std::string(text) == "probation: constant 10 (modes) must be a whole number from 1 to 64");
}

TEST_CASE("UMAT: an increment that is cut leaves state, stress and tangent as they were") {
  const auto untouched = [](AbaqusPoint point, const std::array<double, 9>& f, double rise, double dt) {
    const std::vector<double> state = point.state;
    std::fill(std::begin(point.stress), std::end(point.stress), 7.0);
    std::fill(std::begin(point.tangent), std::end(point.tangent), 7.0);
    point.step(f, rise, dt);
    CHECK(point.pnewdt == 0.25);
    CHECK(point.state == state);
    for (const double component : point.stress) CHECK(component == 7.0);
    for (const double entry : point.tangent) CHECK(entry == 7.0);
  };
  AbaqusPoint point(3, 3), truss(1, 0, 3 + reference_modes);
  std::array<double, 9> stretched = unit;
  stretched[0] = 1.01;
  point.step(stretched, 0.0, 1.0);
  truss.step(unit, 0.01, 1.0);
  stretched[0] = 1e7;  // no deformation
  untouched(point, stretched, 0.0, 1.0);
  untouched(truss, unit, 200.0, 1.0);
  stretched[0] = 1.02;
  point.state.back() = INFINITY;  // shows only once the modes are summed
  untouched(point, stretched, 0.0, 1.0);
  truss.state.back() = INFINITY;
  untouched(truss, unit, 0.01, 1.0);
  point.constants[10] = 400.0;  // decades
  untouched(point, stretched, 0.0, 1.0);
}

TEST_CASE("UMAT: a coarse increment is made, and PNEWDT asks for a smaller one; a fine one leaves it") {
  std::array<double, 9> stretched = unit;
  stretched[0] = 1.05, stretched[4] = stretched[8] = 1.0 / std::sqrt(1.05);
  AbaqusPoint coarse(3, 3), unwatched(3, 3), truss(1, 0, 3 + reference_modes);
  coarse.constants.push_back(0.1);
  truss.constants.push_back(0.1);
  coarse.step(stretched, 0.0, 10.0);
  unwatched.step(stretched, 0.0, 10.0);
  truss.step(unit, std::log(1.05), 10.0);
  CHECK(coarse.pnewdt >= 0.25);
  CHECK(coarse.pnewdt < 1.0);
  CHECK(unwatched.pnewdt == 1.0);
  CHECK(truss.pnewdt == doctest::Approx(coarse.pnewdt).epsilon(1e-12));
  CHECK(coarse.state == unwatched.state);
  CHECK(coarse.stress[0] == unwatched.stress[0]);
  AbaqusPoint fine(3, 3);
  fine.constants.push_back(0.1);
  stretched[0] = 1.0001, stretched[4] = stretched[8] = 1.0 / std::sqrt(1.0001);
  fine.step(stretched, 0.0, 0.02);
  CHECK(fine.pnewdt == 1.0);
}
