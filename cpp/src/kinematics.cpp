#include "probation/kinematics.hpp"

#include "probation/errors.hpp"

namespace probation {

Eigen::ArrayXd haward_thackray_strain(const Samples& true_strain) {
  if (!true_strain.allFinite()) throw InputError("true_strain has a sample that is not finite");
  return true_strain.unaryExpr([](double strain) { return haward_thackray_strain(strain); });
}

}  // namespace probation
