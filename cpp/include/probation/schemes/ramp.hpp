#pragma once
// Eq. (7): the closed form for a ramp e = rate t, in a form that holds at every limit.

#include <Eigen/Core>

#include "probation/kinematics.hpp"
#include "probation/law.hpp"

namespace probation {

/// (e^x - e^y) / (x - y), and e^x where they meet.
double exponential_difference(double x, double y);

/// True stress [MPa] of the ramp e = rate t, eq. (7), at the times [s]; shape (n_times).
///
/// As printed, eq. (7) is infinite at tau_j = 1 / rate, undefined at rate = 0 and -1 / (2 tau_j), and loses
/// all digits at small t; this form is the same function without these holes.
/// @throws InputError  if a time is negative, the rate is not finite, or a stress is beyond all numbers
Eigen::ArrayXd ramp_stress(const Law& law, double strain_rate, const Samples& time);

}  // namespace probation
