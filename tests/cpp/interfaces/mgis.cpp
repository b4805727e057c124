// The MGIS behaviour, called as MGIS calls it, and what it declares about itself.

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "reference_case.hpp"

namespace {

struct InitialState {
  const double *gradients, *forces, *mass_density, *properties, *internal, *stored, *dissipated, *external;
};
struct State {
  const double* gradients;
  double* forces;
  const double *mass_density, *properties;
  double *internal, *stored, *dissipated;
  const double* external;
};
struct Data {
  char* error_message;
  double dt;
  double* K;
  double* rdt;
  double* speed_of_sound;
  InitialState s0;
  State s1;
};

constexpr int order[9] = {0, 4, 8, 1, 3, 2, 6, 5, 7};  // 11, 22, 33, 12, 21, 13, 31, 23, 32
const double root = std::sqrt(2.0);

struct MgisPoint {
  std::vector<double> before = std::vector<double>(reference_state), after = before,
                      constants = constant_list();
  double gradient_before[9] = {1, 1, 1}, gradient[9] = {}, stress[9] = {}, k[81] = {}, rdt = 1.0;
  char error[512] = {};

  const char* library = "probation_mgis";

  int step(const std::array<double, 9>& f, double dt, double operation, double stress_measure,
           double tangent_measure) {
    for (int c = 0; c < 9; ++c) gradient[c] = f[static_cast<std::size_t>(order[c])];
    k[0] = operation, k[1] = stress_measure, k[2] = tangent_measure;
    const double temperature = 293.15;
    Data data{
        error,
        dt,
        k,
        &rdt,
        nullptr,
        {gradient_before, stress, nullptr, constants.data(), before.data(), nullptr, nullptr, &temperature},
        {gradient, stress, nullptr, constants.data(), after.data(), nullptr, nullptr, &temperature}};
    return function_of<int(Data*)>(library, "ProbationDNLR_Tridimensional")(&data);
  }
  void accept() {
    before = after;
    std::memcpy(gradient_before, gradient, sizeof gradient);
  }
};

template <class T>
const T* declared(const char* name, const char* library = "probation_mgis") {
  return static_cast<const T*>(symbol_of(library, (std::string("ProbationDNLR_") + name).c_str()));
}

double factor(int c) { return c < 3 ? 1.0 : root; }

}  // namespace

TEST_CASE("MGIS: second Piola-Kirchhoff stress and dS/dE are those of the C interface") {
  MgisPoint point;
  Answers answers;
  for (const Instant& instant : reference_case()) {
    REQUIRE(point.step(instant.f, instant.dt, 4.0, 1.0, 1.0) == 1);
    Answer answer{};
    for (int c = 0; c < 6; ++c) point.stress[c] /= factor(c);
    answer.stress = push_forward(instant.f, point.stress);
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) answer.tangent[6 * r + c] = point.k[6 * r + c] / factor(r) / factor(c);
    answers.push_back(answer);
    point.accept();
  }
  check_literal_law("MGIS", answers);
  check_same_stress("MGIS", answers, by_c(false));
  check_same_tangent("MGIS", answers, by_c(false));
}

TEST_CASE("MGIS: Cauchy stress on request, and its slope d sigma / dF against differences") {
  MgisPoint point;
  const Answers expected = by_c(true);
  for (std::size_t i = 0; i < reference_case().size(); ++i) {
    const Instant& instant = reference_case()[i];
    REQUIRE(point.step(instant.f, instant.dt, 4.0, 0.0, 0.0) == 1);
    for (int c = 0; c < 6; ++c) CHECK(std::abs(point.stress[c] / factor(c) - expected[i].stress[c]) < 1e-10);
    if (i % 33 == 32) {
      MgisPoint moved = point;
      for (int c = 0; c < 9; ++c) {
        double slope[6] = {};
        for (const double h : {2e-6, -2e-6}) {
          std::array<double, 9> f = instant.f;
          f[static_cast<std::size_t>(order[c])] += h;
          REQUIRE(moved.step(f, instant.dt, 0.0, 0.0, 0.0) == 1);
          for (int r = 0; r < 6; ++r) slope[r] += moved.stress[r] / (2.0 * h);
        }
        for (int r = 0; r < 6; ++r) CHECK(std::abs(point.k[9 * r + c] - slope[r]) < 3220.0 * 1e-6);
      }
    }
    point.accept();
  }
}

TEST_CASE("MGIS: first Piola-Kirchhoff stress is J sigma F^-T, here checked through P F^T = J sigma") {
  MgisPoint point;
  const Instant& instant = reference_case()[99];
  REQUIRE(point.step(instant.f, 100.0, 4.0, 0.0, 0.0) == 1);
  const double sigma = point.stress[0];
  REQUIRE(point.step(instant.f, 100.0, 4.0, 2.0, 2.0) == 1);
  const auto& f = instant.f;
  const double volume = f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) +
                        f[2] * (f[3] * f[7] - f[4] * f[6]);
  CHECK(std::abs(point.stress[0] * f[0] + point.stress[3] * f[1] + point.stress[5] * f[2] - volume * sigma) <
        1e-9);
}

TEST_CASE("MGIS: a prediction changes neither state nor stress") {
  MgisPoint point;
  point.stress[0] = 7.0;
  REQUIRE(point.step(reference_case()[0].f, 0.0, -4.0, 1.0, 1.0) == 1);
  CHECK(point.stress[0] == 7.0);
  for (const double value : point.after) CHECK(value == 0.0);
  // At the start and at once: the elastic moduli, K + 4/9 E_u along an axis, K - 2/9 E_u across (mu = E_u /
  // 3).
  CHECK(point.k[0] == doctest::Approx(2000.0 + 4.0 / 9.0 * 3220.0).epsilon(1e-12));
  CHECK(point.k[1] == doctest::Approx(2000.0 - 2.0 / 9.0 * 3220.0).epsilon(1e-12));
  CHECK(point.k[21] == doctest::Approx(2.0 / 3.0 * 3220.0).epsilon(1e-12));
}

TEST_CASE("MGIS: what cannot be is said in the error message") {
  MgisPoint point;
  point.constants[1] = NAN;
  CHECK(point.step(reference_case()[0].f, 1.0, 4.0, 1.0, 1.0) == -1);
  CHECK(std::string(point.error) ==
        "probation: constant 2 (hardening_modulus) must be a modulus from 0 to 1e12 MPa");
  CHECK(point.rdt == 0.25);
}

TEST_CASE("MGIS: what the library declares fits what it does") {
  using Text = const char*;
  CHECK(*declared<unsigned short>("mfront_mkt") == 1);
  CHECK(*declared<unsigned short>("BehaviourType") == 2);
  CHECK(*declared<unsigned short>("nMaterialProperties") == 11);
  CHECK(std::string(declared<Text>("MaterialProperties")[0]) == "UnrelaxedModulus");
  CHECK(std::string(declared<Text>("MaterialProperties")[10]) == "Decades");
  CHECK(*declared<unsigned short>("nInternalStateVariables") == reference_state);
  CHECK(std::string(declared<Text>("InternalStateVariables")[0]) == "State[0]");
  CHECK(std::string(declared<Text>("InternalStateVariables")[309]) == "State[309]");
  CHECK(std::string(declared<Text>("Gradients")[0]) == "DeformationGradient");
  CHECK(std::string(declared<Text>("ThermodynamicForces")[0]) == "Stress");
}

TEST_CASE("MGIS: an increment that is cut leaves state, stress and operator as they were") {
  MgisPoint point;
  point.before.back() = INFINITY;  // shows once the modes are summed
  point.after.assign(point.after.size(), 7.0);
  CHECK(point.step(reference_case()[0].f, 1.0, 4.0, 1.0, 1.0) == -1);
  CHECK(point.rdt == 0.25);
  for (const double value : point.after) CHECK(value == 7.0);
  CHECK(point.stress[0] == 0.0);
  CHECK(point.k[0] == 4.0);  // the request
}

TEST_CASE("MGIS: a coarse increment is made, returns 0 and asks for a smaller one by rdt") {
  MgisPoint coarse, unwatched;
  coarse.library = "probation_mgis_tolerance";
  CHECK(*declared<unsigned short>("nMaterialProperties", coarse.library) == 12);
  CHECK(std::string(declared<const char*>("MaterialProperties", coarse.library)[11]) == "StressTolerance");
  coarse.constants.push_back(0.1);
  const double stretch = 1.05, across = 1.0 / std::sqrt(stretch);
  const std::array<double, 9> f{stretch, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, across};
  CHECK(coarse.step(f, 10.0, 4.0, 1.0, 1.0) == 0);
  CHECK(coarse.rdt >= 0.25);
  CHECK(coarse.rdt < 1.0);
  CHECK(unwatched.step(f, 10.0, 4.0, 1.0, 1.0) == 1);
  CHECK(unwatched.rdt == 1.0);
  CHECK(coarse.after == unwatched.after);
  MgisPoint fine;
  fine.library = coarse.library;
  fine.constants.push_back(0.1);
  CHECK(fine.step({1.0001, 0.0, 0.0, 0.0, 0.99995, 0.0, 0.0, 0.0, 0.99995}, 0.02, 4.0, 1.0, 1.0) == 1);
  CHECK(fine.rdt == 1.0);
}
