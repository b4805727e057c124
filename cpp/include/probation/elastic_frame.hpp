#pragma once
// A viscoelastic specimen in series with an elastic frame: how their common force answers to a change.

#include <Eigen/Core>

#include "probation/kinematics.hpp"

namespace probation {

/// Solves y(t) = change(t) + int_0^t R(t - s) d[give(s) y(s)], R(t) = sum_k modulus_k exp(-t / time_k): the
/// change of the stress of a linear viscoelastic solid whose strain answers to that stress itself by give(t)
/// y(t). Causal, one unknown a step; strains are linear in each step, so that a step whose strain is so is
/// exact.
/// @param time             [s], increasing; shape (n_times)
/// @param modulus          [MPa]; shape (n_modes)
/// @param relaxation_time  [s], positive, infinite for an elastic part; shape (n_modes)
/// @param give             d strain / d stress [1/MPa], not above zero; shape (n_times)
/// @param change           [MPa], what the stress would change by were the strain held; shape (n_times)
/// @return                 y [MPa]; shape (n_times)
/// @throws InputError      for shapes that differ
Eigen::ArrayXd stress_behind_frame(const Samples& time, const Samples& modulus,
                                   const Samples& relaxation_time, const Samples& give,
                                   const Samples& change);

}  // namespace probation
