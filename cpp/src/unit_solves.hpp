#pragma once
// The law along one record as E_u u + G v: unit solves at any tau_max (or alpha), and their slope.
//
// The forcings of both unit solves do not depend on tau_max (or alpha): they are formed once per record.

#include <Eigen/Core>
#include <vector>

#include "modal_group.hpp"
#include "probation/solver.hpp"
#include "record_steps.hpp"

namespace probation {

class UnitSolves {
 public:
  void set_modes(const Spectrum& spectrum);

  /// The steps of a scheme along a history.
  /// @throws InputError  where the companion relation gives no time
  void take(const Law& law, const History& history, Scheme scheme, Start start);
  /// The same record at every `stride`-th instant, by exponential steps: accurate enough for a coarse search.
  void take_thinned(const UnitSolves& full, Eigen::Index stride);

  Eigen::Index size() const { return static_cast<Eigen::Index>(instants_.size()); }
  /// Which instants of the record are solved for.
  const std::vector<Eigen::Index>& instants() const { return instants_; }

  /// Fills u() and v(). `time` is tau_max [s], or alpha.
  void solve(double time);
  const Eigen::ArrayXd& u() const { return u_; }  ///< d stress / d E_u [-]; shape (size)
  const Eigen::ArrayXd& v() const { return v_; }  ///< d stress / d G [-]; shape (size)

  /// The stress itself [MPa] in one sweep; shape (size).
  void stress(double unrelaxed_modulus, double time, double hardening_modulus,
              Eigen::Ref<Eigen::ArrayXd> out);

  /// d stress / d ln tau_max (or ln alpha) [MPa] at the time of the last solve.
  const Eigen::ArrayXd& slope(double unrelaxed_modulus, double hardening_modulus);

 private:
  struct Run {
    Eigen::Index first, count;
    bool uniform;
  };
  /// Forcing and curvature of a unit solve.
  struct Forcing {
    Eigen::ArrayXd forcing, curvature;
  };

  kernels::Steps steps_of(const Run& run, const Forcing& forcing) const;
  void sweep(const Forcing& forcing, double* stress);
  void set_time(double time);
  void combine(double unrelaxed_modulus, double hardening_modulus);
  void keep(const RecordSteps<double>& steps, Forcing& forcing);

  ModalGroup group_;
  double total_weight_ = 1.0;
  bool curved_ = false;  ///< whether the scheme sees the forcing's curvature
  RecordInputs<double> inputs_;
  RecordSteps<double> steps_;
  std::vector<Eigen::Index> instants_;
  std::vector<Run> runs_;
  std::vector<StepRule> rule_;
  std::vector<double> ratio_;
  Eigen::ArrayXd strain_, hardening_;  ///< e and e_HT at the instants
  Eigen::ArrayXd unit_scale_, scale_;  ///< at tau_max (or alpha) of 1, and at the last solve's
  Forcing stiff_, relaxed_, both_;
  Eigen::ArrayXd u_, v_, slope_, ignored_, minus_one_, kernel_scratch_;
  Eigen::ArrayXd slope_state_, slope_before_;
};

}  // namespace probation
