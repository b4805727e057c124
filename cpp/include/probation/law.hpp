#pragma once
// The law, eq. (6), and what an effect may change in it.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "probation/companion.hpp"
#include "probation/feedback.hpp"
#include "probation/spectrum.hpp"

namespace probation {

/// The modal (DNLR) law, eq. (6):
///
///   sigma_j' = p_j E_u e' - (sigma_j - p_j G e_HT) / tau_j,    sigma = sum_j sigma_j.
struct Law {
  double unrelaxed_modulus = 0.0;  ///< E_u [MPa]
  double hardening_modulus = 0.0;  ///< G [MPa]
  double tau_max = 0.0;            ///< [s], where there is no companion relation
  double alpha = 1.0;              ///< [-], where there is: tau_max = alpha companion(rate)
  std::shared_ptr<const CompanionRelation> companion;
  Spectrum spectrum = Spectrum::log_spaced();

  /// @throws InputError  naming the parameter that is not finite or not positive (moduli may be zero)
  void validate() const;
  /// The same but for the spectrum.
  void validate_parameters() const;
};

/// Maxwell elements in parallel to the spectrum: moduli of their own, and times that no rate shifts.
struct ExtraModes {
  Eigen::ArrayXd modulus;          ///< [MPa], not negative; shape (extra modes)
  Eigen::ArrayXd relaxation_time;  ///< [s]; shape (extra modes)
};

/// What an effect changes in the law along one record. Empty arrays change nothing; sampled ones have shape
/// (n_times) or one entry that holds throughout.
struct LawChange {
  Eigen::ArrayXd relaxation_time_factor;    ///< of tau_max, above 0 [-]
  Eigen::ArrayXd unrelaxed_modulus_factor;  ///< of E_u, not negative [-]
  Eigen::ArrayXd hardening_factor;          ///< of G e_HT, of either sign: the relaxed stress may lag [-]
  Eigen::ArrayXd added_relaxed_stress;      ///< on top of it [MPa]
  Eigen::ArrayXd load_bearing_area;         ///< factor of the whole stress, above 0 [-]
  Eigen::ArrayXd initial_modal_stress;  ///< sigma_j(0) [MPa]; shape (modes); empty: relaxed, p_j sigma^r(0)
  ExtraModes extra_modes;
  std::vector<std::shared_ptr<const Feedback>> feedbacks;

  /// @throws InputError  naming the array whose shape does not fit, or its invalid entry
  void validate(Eigen::Index n_times, Eigen::Index modes) const;
};

/// A direction in the space of the law's inputs, along which a sensitivity is taken. An empty array is a zero
/// one; sampled ones have shape (n_times) or one entry.
struct Direction {
  Eigen::ArrayXd unrelaxed_modulus;      ///< d E_u(t) [MPa]
  Eigen::ArrayXd log_relaxation_time;    ///< d ln tau_max(t) [-]
  Eigen::ArrayXd relaxed_stress;         ///< d sigma^r(t) [MPa]
  Eigen::ArrayXd log_load_bearing_area;  ///< d ln A(t) [-]
  Eigen::ArrayXd true_strain;   ///< d e(t) [-]; moves the rates (unless given), tau_max and sigma^r with it
  Eigen::ArrayXd strain_rate;   ///< d e'(t) [1/s], where the history has its own rates
  Eigen::ArrayXd modal_weight;  ///< d p_j [-]; shape (modes)
  Eigen::ArrayXd log_relaxation_ratio;  ///< d ln(tau_j / tau_max) [-]; shape (modes)
  Eigen::ArrayXd initial_modal_stress;  ///< d sigma_j(0) [MPa]; shape (modes)
  Eigen::ArrayXd extra_modulus;         ///< [MPa]; shape (extra modes)
  Eigen::ArrayXd log_extra_time;        ///< d ln of the extra modes' times [-]; shape (extra modes)
  Eigen::Index feedback = -1;           ///< whose parameter changes by one unit; -1: none
  std::size_t feedback_parameter = 0;

  /// @throws InputError  naming the array whose shape does not fit the record (`rate_given`: it has rates of
  /// its own)
  void validate(const LawChange& change, Eigen::Index n_times, Eigen::Index modes, bool rate_given) const;
};

}  // namespace probation
