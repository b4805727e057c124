#pragma once
// Identification of the law on one record after another: E_u, tau_max (or alpha) and G of each.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include "probation/solver.hpp"

namespace probation {

enum class IdentifyMethod {
  variable_projection,  ///< a search in ln tau_max alone; E_u and G, linear in the law, are projected out
  levenberg_marquardt,  ///< all three at once
};

/// How the identification of a record ended.
enum class IdentifyStatus : std::int8_t {
  converged = 0,
  at_a_bound = 1,  ///< a parameter stopped at a bound, or tau_max (alpha) at the end of its range
  did_not_converge = 2,
  not_determined = 3,  ///< a parameter has no influence on the record: its error is infinite
  not_finite = 4,      ///< a sample is not finite or far too large, or a noise is not positive
  times_do_not_increase = 5,
  too_few_samples = 6,  ///< no more samples than parameters
  impossible_rate = 7,  ///< the companion relation gives no time at a rate of the record
};

struct IdentifyOptions {
  Scheme scheme = Scheme::sa3;
  Start start = Start::exponential;
  IdentifyMethod method = IdentifyMethod::variable_projection;
  std::array<bool, 3> held{false, false, false};  ///< which keep the law's value
  Eigen::Array3d lower = Eigen::Array3d::Zero();  ///< of E_u [MPa], tau_max [s] or alpha [-], G [MPa]
  Eigen::Array3d upper = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  bool find_jumps = true;  ///< of the strain rate, record by record
  int substeps = 1;        ///< steps of the scheme from sample to sample

  /// @throws InputError  if every parameter is held, a bound is invalid, the scheme has no sensitivities or
  /// substeps is below 1
  void validate() const;
};

struct Identified {
  Eigen::Array3d parameters;      ///< E_u [MPa], tau_max [s] or alpha [-], G [MPa]
  Eigen::Array3d standard_error;  ///< white noise, s^2 (J^T J)^-1; 0 where held
  double rms_residual;            ///< [MPa]
  IdentifyStatus status;
  int iterations;  ///< solves of the whole record with their slopes
};

/// Identifies records one after another and keeps its arrays from record to record.
class Identifier {
 public:
  /// @param law  the spectrum, the companion relation and the values of held parameters
  Identifier(const Law& law, const IdentifyOptions& options);
  ~Identifier();
  Identifier(Identifier&&) noexcept;
  Identifier& operator=(Identifier&&) noexcept;

  /// An invalid record gets a status and NaN; it throws nothing.
  /// @param time, true_strain  at every substep [s], [-]; shape ((n_samples - 1) * substeps + 1)
  /// @param true_stress  at the samples [MPa]; shape (n_samples)
  /// @param noise  standard deviation of the stress, for its ratios within the record [MPa]; shape
  /// (n_samples) or empty
  Identified operator()(const Eigen::ArrayXd& time, const Eigen::ArrayXd& true_strain,
                        const Eigen::ArrayXd& true_stress, const Eigen::ArrayXd& noise);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace probation
