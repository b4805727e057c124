#pragma once
// Columns of a record in coordinates in which its noise is white.

#include <Eigen/Core>

#include "probation/kinematics.hpp"

namespace probation {

/// Noise scale_t n_t, n an ARMA(1,1) process, n_t = phi n_{t-1} + e_t + theta e_{t-1}, stationary from the
/// first sample, e of variance one; and more of it in a few directions: its covariance is L^-1 (I - Q
/// diag(shrink) Q^T)^-2 L^-T, L what makes the process white.
class Whitening {
 public:
  using Columns = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param scale       positive; shape (n)
  /// @param phi, theta  of size below one
  /// @param variance    of the first innovations given those before them, until it has settled at one; shape
  ///                    (at least 1)
  /// @param directions  Q, orthonormal; shape (n, k)
  /// @param shrink      shape (k)
  /// @throws InputError for shapes that do not match
  Whitening(const Samples& scale, double phi, double theta, Eigen::ArrayXd variance,
            const Columns& directions, const Samples& shrink);

  /// (I - Q diag(shrink) Q^T) L values; L gives innovations of unit variance, exact from the first sample
  /// (Brockwell & Davis, section 5.3).
  /// @param values  shape (n, m)
  /// @return        shape (n, m)
  /// @throws InputError for another number of rows
  Columns of(const Eigen::Ref<const Columns>& values) const;

 private:
  Eigen::ArrayXd size_, variance_, shrink_;
  double phi_, theta_;
  Columns basis_;  ///< directions, padded by some of zero
};

}  // namespace probation
