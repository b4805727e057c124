#pragma once
// The fit residual (model - data) of one record and its derivatives, at any parameters.

#include <Eigen/Core>

#include "identify/box_fit.hpp"
#include "unit_solves.hpp"

namespace probation {

/// Parameters, their cost and, once differentiated, J^T J and J^T r along E_u, ln tau_max (or ln alpha) and
/// G.
struct FitPoint {
  double unrelaxed_modulus = 0.0, log_time = 0.0, hardening_modulus = 0.0;
  double cost = 0.0;                                ///< weighted sum of squares
  bool modulus_free = true, hardening_free = true;  ///< no bound holds them
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

class RecordFit {
 public:
  UnitSolves solves;

  /// The data at the samples among the instants of `solves`, in units of the noise (of one where there is
  /// none).
  /// @param substeps  instants from sample to sample; a thinned record has samples only
  void take_data(const Eigen::ArrayXd& true_stress, const Eigen::ArrayXd& noise, Eigen::Index substeps);

  /// At this tau_max (or alpha), with the best E_u and G within their bounds.
  FitPoint project(double log_time, const Bounds& modulus, const Bounds& hardening);
  /// At these parameters.
  FitPoint evaluate(double unrelaxed_modulus, double log_time, double hardening_modulus);
  /// Fills normal and gradient of the point that was projected or evaluated last.
  void differentiate(FitPoint& point);

  /// Moves the residual of the point that was differentiated last along its derivatives.
  void move(const Eigen::Vector3d& step);
  double cost() const { return residual_.square().sum(); }
  double data_square() const { return data_.square().sum(); }
  double rms() const;  ///< of the unweighted residual [MPa]

 private:
  void solve(double log_time);
  const Eigen::ArrayXd* sampled(const Eigen::ArrayXd* solved, Eigen::ArrayXd& kept) const;
  void form_residual(FitPoint& point);

  Eigen::ArrayXd data_, weight_;  ///< the weight is empty where all are one
  Eigen::Index every_ = 1;        ///< instants of `solves` from sample to sample
  Eigen::ArrayXd sampled_u_, sampled_v_, slope_, residual_;
  const Eigen::ArrayXd* u_ = nullptr;
  const Eigen::ArrayXd* v_ = nullptr;
};

/// The inverse of J^T J over the parameters that are free; zero elsewhere.
struct FreeInverse {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  bool determined = true;  ///< the data determine every free parameter
};
FreeInverse invert(const Eigen::Matrix3d& normal, const std::array<bool, 3>& free);

}  // namespace probation
