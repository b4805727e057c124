#include "probation/kinematics.hpp"

#include "kernels/kernels.hpp"
#include "probation/errors.hpp"

namespace probation {

Eigen::ArrayXd haward_thackray_strain(const Samples& true_strain) {
  if (!true_strain.allFinite()) throw InputError("true_strain has a sample that is not finite");
  Eigen::ArrayXd result(true_strain.size());
  kernels::best().samples.haward_thackray(true_strain.data(), true_strain.size(), result.data());
  return result;
}

}  // namespace probation
