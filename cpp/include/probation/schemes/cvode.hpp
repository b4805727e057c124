#pragma once
// The law by CVODE (SUNDIALS): BDF of variable order, diagonal Jacobian. It shares nothing with the other
// schemes but the law itself, in the form of eq. (6) as it is printed.

#include <Eigen/Core>

#include "probation/history.hpp"
#include "probation/law.hpp"

namespace probation {

struct CvodeOptions {
  double relative_tolerance = 1e-10;
  double absolute_tolerance = 1e-10;  ///< of each modal stress [MPa]
  long max_steps = 200000;            ///< between two samples
};

struct CvodeStatistics {
  long steps = 0;
  long rate_evaluations = 0;
  long error_test_failures = 0;
  long nonlinear_iterations = 0;
  long nonlinear_failures = 0;
  long restarts = 0;  ///< at jumps and kinks of the strain rate
  int last_order = 0;
};

/// Integrates eq. (6) through every sample, none stepped across, and starts afresh wherever the strain rate
/// jumps or kinks. `stress` has shape (n_times).
/// @throws ConvergenceError  with the time and CVODE's reason
CvodeStatistics cvode_stress(const Law& law, const LawChange& change, const History& history,
                             const CvodeOptions& options, Eigen::Ref<Eigen::ArrayXd> stress);

}  // namespace probation
