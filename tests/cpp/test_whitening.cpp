#include "probation/whitening.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <vector>

#include "kernels/kernels.hpp"
#include "probation/errors.hpp"

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using probation::InputError;
using probation::Whitening;

namespace {

constexpr double phi = 0.6, theta = -0.3;

/// Covariance of the process: gamma_0 = (1 + 2 phi theta + theta^2) / (1 - phi^2), gamma_1 = phi gamma_0 +
/// theta, gamma_k = phi gamma_{k-1}.
MatrixXd covariance_of_process(const ArrayXd& scale) {
  const double variance = (1.0 + 2.0 * phi * theta + theta * theta) / (1.0 - phi * phi);
  MatrixXd covariance(scale.size(), scale.size());
  for (Eigen::Index i = 0; i < scale.size(); ++i)
    for (Eigen::Index j = 0; j < scale.size(); ++j) {
      const auto lag = static_cast<double>(std::abs(i - j));
      const double entry = lag == 0.0 ? variance : (phi * variance + theta) * std::pow(phi, lag - 1.0);
      covariance(i, j) = scale[i] * scale[j] * entry;
    }
  return covariance;
}

ArrayXd first_variances() {
  std::vector<double> variance{(1.0 + 2.0 * phi * theta + theta * theta) / (1.0 - phi * phi)};
  while (std::fabs(variance.back() - 1.0) > 1e-15)
    variance.push_back(1.0 + theta * theta - theta * theta / variance.back());
  return Eigen::Map<ArrayXd>(variance.data(), static_cast<Eigen::Index>(variance.size()));
}

/// Orthonormal cosines.
Whitening::Columns directions(Eigen::Index count, Eigen::Index some) {
  Whitening::Columns columns(count, some);
  for (Eigen::Index k = 0; k < some; ++k)
    for (Eigen::Index i = 0; i < count; ++i)
      columns(i, k) = std::sqrt((k == 0 ? 1.0 : 2.0) / static_cast<double>(count)) *
                      std::cos(M_PI * static_cast<double>(k) * (static_cast<double>(i) + 0.5) /
                               static_cast<double>(count));
  return columns;
}

}  // namespace

TEST_CASE("columns of the process are white, however many samples and columns there are") {
  for (const Eigen::Index count : {1, 2, 5, 40}) {
    const ArrayXd scale = ArrayXd::LinSpaced(count, 1.0, 2.0);
    const Whitening whitening(scale, phi, theta, first_variances(), directions(count, 0), ArrayXd(0));
    const MatrixXd root = covariance_of_process(scale).llt().matrixL();
    for (Eigen::Index first = 0; first < count; first += 7) {
      const Eigen::Index some = std::min<Eigen::Index>(count - first, 7);
      const MatrixXd white = whitening.of(Whitening::Columns(root.middleCols(first, some).array())).matrix();
      CHECK((white - MatrixXd::Identity(count, count).middleCols(first, some)).norm() < 1e-12);
    }
  }
}

TEST_CASE("where the start has not settled after so many samples, the rest goes on as if it had") {
  // The variance is cut off after three samples; behind them e_t = n_t - phi n_{t-1} - theta e_{t-1}.
  const double theta_slow = 0.97;
  const ArrayXd values = ArrayXd::LinSpaced(200, -1.0, 2.0), one = ArrayXd::Ones(200);
  const ArrayXd variance = (ArrayXd(3) << 1.9, 1.4, 1.3).finished();
  const Whitening whitening(one, 0.0, theta_slow, variance, directions(200, 0), ArrayXd(0));
  const ArrayXd white = whitening.of(Whitening::Columns(values)).col(0);
  CHECK(white[3] == doctest::Approx(values[3] - theta_slow * white[2] * std::sqrt(variance[2])));
  for (int i = 4; i < 200; ++i) CHECK(white[i] == doctest::Approx(values[i] - theta_slow * white[i - 1]));
}

TEST_CASE("directions with more noise shrink, and nothing else does, in every build") {
  const Eigen::Index count = 43;
  const probation::kernels::Kernels* const* builds = probation::kernels::runnable();
  for (const Eigen::Index some : {1, 12, 17}) {
    const Whitening::Columns basis = directions(count, some);
    const ArrayXd shrink = ArrayXd::LinSpaced(some, 0.2, 0.9);
    for (const Eigen::Index columns : {1, 2, 4, 7, 8, 13}) {
      const Whitening::Columns values = directions(count, 20).rightCols(columns) + 0.1;
      const MatrixXd expected =
          values.matrix() -
          basis.matrix() * (shrink.matrix().asDiagonal() * (basis.matrix().transpose() * values.matrix()));
      const Whitening whitening(ArrayXd::Ones(count), 0.0, 0.0, ArrayXd::Ones(1), basis, shrink);
      CHECK((whitening.of(values).matrix() - expected).norm() < 1e-13);
      for (int build = 0; builds[build]; ++build) {
        if (columns % 4 != 0 || some % 12 != 0) continue;
        Whitening::Columns white = values;
        const ArrayXd one = ArrayXd::Ones(count);
        ArrayXd along(columns * some);
        const probation::kernels::ColouredNoise noise{count, one.data(),   0.0,          0.0, one.data(), 1,
                                                      some,  basis.data(), shrink.data()};
        builds[build]->whiten(noise, white.data(), columns, along.data());
        CHECK((white.matrix() - expected).norm() < 1e-13);
      }
    }
  }
}

TEST_CASE("shapes that do not match are refused") {
  const ArrayXd scale = ArrayXd::Ones(5), none(0);
  CHECK_THROWS_AS(Whitening(scale, 0.0, 0.0, ArrayXd::Ones(1), directions(4, 2), ArrayXd::Ones(2)),
                  InputError);
  CHECK_THROWS_AS(Whitening(scale, 0.0, 0.0, ArrayXd::Ones(1), directions(5, 2), ArrayXd::Ones(3)),
                  InputError);
  CHECK_THROWS_AS(Whitening(scale, 0.0, 0.0, none, directions(5, 0), none), InputError);
  const Whitening whitening(scale, 0.0, 0.0, ArrayXd::Ones(1), directions(5, 0), none);
  CHECK_THROWS_WITH_AS(whitening.of(directions(4, 2)), "values has 4 rows; expected 5", InputError);
}
