#include "reference_case.hpp"

#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr double pi = 3.14159265358979323846;

/// The law in one dimension as docs/finite-elements.md and the paper print it, mode by mode, nothing shared
/// with the engine: sigma_j <- a sigma_j + p_j [E_u phi de + G ((1 - phi) H1 + (phi - a) H0)].
class LiteralLaw {
 public:
  LiteralLaw() {
    double sum = 0.0;
    constexpr int modes = reference_modes;
    for (int j = 1; j <= modes; ++j) {
      ratio_.push_back(std::pow(10.0, -(modes - j) * 6.0 / (modes - 1)));
      sum += std::sqrt(ratio_.back());
    }
    for (const double r : ratio_) weight_.push_back(std::sqrt(r) / sum);
    stress_.resize(ratio_.size());
  }
  double step(double rise, double dt) {
    const double before = hardening(strain_), after = hardening(strain_ + rise), rate = std::abs(rise) / dt;
    const double tau_max = (0.00464 * std::log10(rate) + 0.0367) / rate;
    strain_ += rise;
    double sum = 0.0;
    for (std::size_t j = 0; j < ratio_.size(); ++j) {
      const double x = dt / (ratio_[j] * tau_max), a = std::exp(-x), phi = -std::expm1(-x) / x;
      stress_[j] =
          a * stress_[j] + weight_[j] * (3220.0 * phi * rise + (1.0 - phi) * after + (phi - a) * before);
      sum += stress_[j];
    }
    return sum;
  }
  double strain() const { return strain_; }

 private:
  static double hardening(double e) { return 1.8 * (std::exp(2.0 * e) - std::exp(-e)); }
  std::vector<double> ratio_, weight_, stress_;
  double strain_ = 0.0;
};

std::vector<Instant> build() {
  LiteralLaw law;
  std::vector<Instant> out;
  for (int i = 0; i < 100; ++i) {
    const double dt = i < 25 ? 4.0 : 0.7;
    const double rise = i < 25 ? 0.004 : i < 50 ? 0.007 : i < 65 ? -0.003 : 0.005;
    const double turn = i < 65 ? 0.0 : i < 85 ? (i - 64) * pi / 40.0 : pi / 2.0;
    const double shear = i < 85 ? 0.0 : 0.01 * (i - 84);
    const double difference = law.step(rise, dt);
    const double along = std::exp(law.strain()), across = std::exp(-0.5 * law.strain());
    const double c = std::cos(turn), s = std::sin(turn);
    // F = R(turn about 3) diag(along, across, across) (1 + shear e1 x e2 + shear/2 e3 x e1)
    const double u[3][3] = {
        {along, along * shear, 0.0}, {0.0, across, 0.0}, {0.5 * across * shear, 0.0, across}};
    Instant instant{{}, dt, shear == 0.0 ? difference : std::nan(""), {c, s, 0.0}};
    for (int j = 0; j < 3; ++j) {
      instant.f[j] = c * u[0][j] - s * u[1][j];
      instant.f[3 + j] = s * u[0][j] + c * u[1][j];
      instant.f[6 + j] = u[2][j];
    }
    out.push_back(instant);
  }
  return out;
}

constexpr int rows[6] = {0, 1, 2, 0, 0, 1}, columns[6] = {0, 1, 2, 1, 2, 2};

double determinant(const std::array<double, 9>& f) {
  return f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) +
         f[2] * (f[3] * f[7] - f[4] * f[6]);
}

}  // namespace

const std::vector<Instant>& reference_case() {
  static const std::vector<Instant> instants = build();
  return instants;
}

Stress push_forward(const std::array<double, 9>& f, const double* second_piola) {
  double s[3][3];
  for (int k = 0; k < 6; ++k) s[rows[k]][columns[k]] = s[columns[k]][rows[k]] = second_piola[k];
  Stress out{};
  for (int k = 0; k < 6; ++k)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        out[k] += f[3 * rows[k] + a] * s[a][b] * f[3 * columns[k] + b] / determinant(f);
  return out;
}

void* symbol_of(const char* interface, const char* symbol) {
  const char* path = std::getenv(interface);
  REQUIRE_MESSAGE(path != nullptr, "the environment names no path for ", interface);
  // A test loads what its build made. NOLINTNEXTLINE(clang-analyzer-optin.taint.GenericTaint)
  void* library = dlopen(path, RTLD_NOW);
  REQUIRE_MESSAGE(library != nullptr, dlerror());
  void* found = dlsym(library, symbol);
  REQUIRE_MESSAGE(found != nullptr, symbol);
  return found;
}

void check_same_stress(const char* interface, const Answers& found, const Answers& expected) {
  REQUIRE(found.size() == expected.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int k = 0; k < 6; ++k) worst = std::max(worst, std::abs(found[i].stress[k] - expected[i].stress[k]));
  std::printf("%-9s stress against C: %.1e MPa\n", interface, worst);
  CHECK(worst <= 1e-10);
}

void check_same_tangent(const char* interface, const Answers& found, const Answers& expected) {
  REQUIRE(found.size() == expected.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int k = 0; k < 36; ++k)
      worst = std::max(worst, std::abs(found[i].tangent[k] - expected[i].tangent[k]));
  std::printf("%-9s tangent against C: %.1e MPa\n", interface, worst);
  CHECK(worst <= 3220.0 * 1e-10);
}

void check_literal_law(const char* interface, const Answers& found) {
  const auto& instants = reference_case();
  double worst = 0.0;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (std::isnan(instants[i].difference)) continue;
    const auto& n = instants[i].bar;
    const Stress& s = found[i].stress;
    const double along = n[0] * n[0] * s[0] + n[1] * n[1] * s[1] + 2.0 * n[0] * n[1] * s[3];
    worst = std::max(worst, std::abs(along - s[2] - instants[i].difference));
  }
  std::printf("%-9s stress against the literal law: %.1e MPa\n", interface, worst);
  CHECK(worst <= 1e-10);
}
