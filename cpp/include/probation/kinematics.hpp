#pragma once
// Kinematics of uniaxial, isochoric tension along a record: true strain, Haward-Thackray strain.

#include <Eigen/Core>

#include "probation/haward_thackray.hpp"

namespace probation {

using Samples = Eigen::Ref<const Eigen::ArrayXd>;

/// Haward-Thackray strain, sample by sample.
/// @param true_strain  e [-], uniaxial, isochoric; shape (n_times)
/// @return             e_HT [-]; shape (n_times)
/// @throws InputError  naming the first sample that is not finite, or whose stretch is beyond all numbers
Eigen::ArrayXd haward_thackray_strain(const Samples& true_strain);
void haward_thackray_strain(const Samples& true_strain, Eigen::ArrayXd& result);

}  // namespace probation
