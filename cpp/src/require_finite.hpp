#pragma once
// What leaves the engine is finite, or an error says where it is not.

#include "probation/kinematics.hpp"

namespace probation {

/// @param what  what the values are, such as "the stress"
/// @throws ConvergenceError  with the time of the first value that is not finite
void require_finite(const Samples& values, const Eigen::ArrayXd& time, const char* what);

}  // namespace probation
