#pragma once
// Prandtl's slider: what a quantity takes along behind a backlash.

#include <Eigen/Core>

#include "probation/kinematics.hpp"

namespace probation {

/// A place that stands still until the value has gone `width` from it, and then is taken along (Prandtl 1928;
/// the play of hysteresis models).
/// @param value  shape (n)
/// @param width  in units of the value; not negative
/// @param begin  the place before the first value; NaN: at the first value
/// @return       the place, never further than `width` from the value; shape (n)
/// @throws InputError  for a negative width
Eigen::ArrayXd behind_backlash(const Samples& value, double width, double begin);

}  // namespace probation
