#pragma once
// Outputs of the engine are finite; otherwise an error says at which time they are not.

#include "probation/kinematics.hpp"

namespace probation {

/// @param what  what the values are, such as "the stress"
/// @throws ConvergenceError  with the time of the first value that is not finite
void require_finite(const Samples& values, const Eigen::ArrayXd& time, const char* what);

}  // namespace probation
