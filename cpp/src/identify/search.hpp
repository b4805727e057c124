#pragma once
// Searches for the least cost of one record.

#include <vector>

#include "identify/record_fit.hpp"
#include "probation/identify/identify.hpp"

namespace probation {

/// Bounds of a search.
struct SearchSpace {
  std::array<bool, 3> held;
  Bounds modulus, log_time, hardening;  ///< equal ends where held
};

struct Search {
  FitPoint point;                                  ///< differentiated
  Eigen::Vector3d step = Eigen::Vector3d::Zero();  ///< on to the minimum, along E_u, ln time, G
  FreeInverse inverse;
  IdentifyStatus status = IdentifyStatus::converged;
  int iterations = 0;
};

/// Relative accuracy of a search that is asked for no less.
constexpr double finest_accuracy = 1e-8;

/// From a first ln time to the minimum of the projected cost nearby: its derivative's zero, by steps of
/// Gauss-Newton and the secant, within a bracket.
Search variable_projection(RecordFit& fit, const SearchSpace& space, double log_time,
                           double accuracy = finest_accuracy);

/// From a first ln time, and the best moduli there, by damped steps in all parameters.
Search levenberg_marquardt(RecordFit& fit, const SearchSpace& space, double log_time);

/// Where the projected cost of a (thinned) record has its low minima over all of log_time, lowest first; one
/// that is much higher than the lowest is left out.
std::vector<double> coarse_search(RecordFit& fit, const SearchSpace& space);

}  // namespace probation
