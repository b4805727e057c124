// The native CalculiX behaviour, called as CalculiX calls it: arrays of the whole model, numbers from 1.

#include <doctest/doctest.h>

#include <cmath>

#include "reference_case.hpp"

namespace {

using Native = void(const char*, const int*, const int*, const int*, const double*, const double*,
                    const double*, const double*, const double*, const double*, const double*, const double*,
                    const int*, const double*, const double*, const double*, const double*, const int*,
                    const int*, const int*, const int*, const double*, double*, double*, double*, const int*,
                    const double*, const double*, double*, const int*, int);

/// Two elements of three points each; the one that is stepped is point 2 of element 2.
struct CalculixModel {
  std::vector<double> before = std::vector<double>(6 * reference_state, 0.5), after = before;
  std::vector<double> constants = constant_list();
  double stress[6] = {}, stiffness[21] = {}, pnewdt = 1.0;
  static constexpr std::size_t first = 4 * reference_state;

  CalculixModel() {
    for (std::size_t k = 0; k < reference_state; ++k) before[first + k] = 0.0;
  }
  void step(const std::array<double, 9>& f, double dt, int command, double factor_so_far = 1.0) {
    constexpr int rows[6] = {0, 1, 2, 0, 0, 1}, columns[6] = {0, 1, 2, 1, 2, 2};
    double strain[6], zero[9] = {};
    for (int k = 0; k < 6; ++k) {
      double c = 0.0;
      for (int i = 0; i < 3; ++i) c += f[3 * i + rows[k]] * f[3 * i + columns[k]];
      strain[k] = 0.5 * (c - (k < 3 ? 1.0 : 0.0));
    }
    const int element = 2, point = 2, mi[3] = {3, 0, 0}, states = reference_state, none = 0;
    const int type = -100 - static_cast<int>(constants.size());
    pnewdt = factor_so_far;
    function_of<Native>("probation_calculix", "DNLR")(
        "@PROBATION_DNLR", &element, &point, &type, constants.data(), strain, zero, zero, zero, zero, zero,
        zero, &none, zero, &dt, zero, zero, &command, &none, mi, &states, before.data(), after.data(), stress,
        stiffness, &none, zero, zero, &pnewdt, &none, 80);
  }
};

}  // namespace

TEST_CASE("CalculiX: stress and the 21 terms of the symmetrised dS/dE are those of the C interface") {
  CalculixModel model;
  Answers answers, expected = by_c(false);
  for (std::size_t i = 0; i < reference_case().size(); ++i) {
    const Instant& instant = reference_case()[i];
    model.step(instant.f, instant.dt, 0);
    REQUIRE(model.pnewdt == 1.0);
    for (std::size_t k = 0; k < reference_state; ++k)
      model.before[CalculixModel::first + k] = model.after[CalculixModel::first + k];
    Answer answer{};
    answer.stress = push_forward(instant.f, model.stress);
    Tangent& tangent = expected[i].tangent;
    for (int r = 0, term = 0; r < 6; ++r)
      for (int c = 0; c <= r; ++c, ++term) {
        answer.tangent[6 * r + c] = answer.tangent[6 * c + r] = model.stiffness[term];
        tangent[6 * r + c] = tangent[6 * c + r] = 0.5 * (tangent[6 * r + c] + tangent[6 * c + r]);
      }
    answers.push_back(answer);
  }
  check_literal_law("CalculiX", answers);
  check_same_stress("CalculiX", answers, expected);
  check_same_tangent("CalculiX", answers, expected);
  // The neighbours in the array were left alone.
  for (std::size_t k = 0; k < model.after.size(); ++k)
    if (k < CalculixModel::first || k >= CalculixModel::first + reference_state) CHECK(model.after[k] == 0.5);
}

TEST_CASE("CalculiX: without the stiffness the stress is the same") {
  CalculixModel both, alone;
  const Instant& instant = reference_case().front();
  both.step(instant.f, instant.dt, 0);
  alone.step(instant.f, instant.dt, 3);
  for (int k = 0; k < 6; ++k) CHECK(alone.stress[k] == both.stress[k]);
  CHECK(alone.stiffness[0] == 0.0);
}

TEST_CASE("CalculiX: constants that cannot be cut the increment and touch nothing") {
  CalculixModel model;
  model.constants[2] = -1.0;
  model.step(reference_case().front().f, 1.0, 0);
  CHECK(model.pnewdt == 0.25);
  CHECK(model.stress[0] == 0.0);
}

TEST_CASE("CalculiX: an increment that is cut leaves state, stress and stiffness as they were") {
  CalculixModel model;
  std::array<double, 9> f = reference_case().front().f;
  model.before[CalculixModel::first + reference_state - 1] = INFINITY;  // shows once the modes are summed
  const std::vector<double> after = model.after;
  model.step(f, 1.0, 0);
  CHECK(model.pnewdt == 0.25);
  CHECK(model.after == after);
  CHECK(model.stress[0] == 0.0);
  CHECK(model.stiffness[0] == 0.0);
}

TEST_CASE(
    "CalculiX: a coarse increment is made and asks for a smaller one; of all points the smallest factor "
    "counts") {
  CalculixModel coarse, fine;
  coarse.constants.push_back(0.1);
  fine.constants.push_back(0.1);
  const double stretch = 1.05, across = 1.0 / std::sqrt(stretch);
  coarse.step({stretch, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, across}, 10.0, 0);
  CHECK(coarse.pnewdt >= 0.25);
  CHECK(coarse.pnewdt < 1.0);
  CHECK(coarse.stress[0] > 1.0);
  const double factor = coarse.pnewdt;
  coarse.step({stretch, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, across}, 10.0, 0, -1.0);
  CHECK(coarse.pnewdt == factor);
  coarse.step({stretch, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, across}, 10.0, 0, 0.2);
  CHECK(coarse.pnewdt == 0.2);
  fine.step({1.0001, 0.0, 0.0, 0.0, 0.99995, 0.0, 0.0, 0.0, 0.99995}, 0.02, 0);
  CHECK(fine.pnewdt == 1.0);
}
