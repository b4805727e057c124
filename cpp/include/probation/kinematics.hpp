#pragma once
// Kinematics of uniaxial, isochoric tension along a record: true strain, Haward-Thackray strain.

#include <Eigen/Core>

#include "probation/haward_thackray.hpp"

namespace probation {

using Samples = Eigen::Ref<const Eigen::ArrayXd>;

/// Haward-Thackray strain, sample by sample.
/// @param true_strain  e [-], uniaxial, isochoric; shape (n_times)
/// @return             e_HT [-]; shape (n_times)
/// @throws InputError  if a sample is not finite
Eigen::ArrayXd haward_thackray_strain(const Samples& true_strain);

}  // namespace probation
