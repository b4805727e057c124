#pragma once
// The modes of the law: relaxation times, eq. (4), and modal weights, eq. (5).

#include <Eigen/Core>

namespace probation {

/// Relaxation spectrum. Mode j has the relaxation time relaxation_ratio[j] * tau_max and the weight
/// modal_weight[j]; fastest mode first, as in eq. (4).
struct Spectrum {
  Eigen::ArrayXd relaxation_ratio;  ///< tau_j / tau_max [-]; shape (modes)
  Eigen::ArrayXd modal_weight;      ///< p_j [-]; shape (modes)

  Eigen::Index modes() const noexcept { return relaxation_ratio.size(); }

  /// The paper's spectrum: log-spaced times, eq. (4), weights proportional to sqrt(tau_j), eq. (5).
  ///
  /// N = 50 and d = 6 are part of the definition of tau_max: sum_j p_j tau_j / tau_max is 0.382 there.
  /// @throws InputError  unless 1 <= modes <= 10000 and 0 < decades <= 300
  static Spectrum log_spaced(int modes = 50, double decades = 6.0);

  /// @throws InputError  if the arrays differ in length, are empty, or hold a ratio that is not positive
  ///                     or a weight that is negative or not finite
  void validate() const;
};

}  // namespace probation
