#include "probation/kinematics.hpp"

#include <cmath>
#include <sstream>

#include "kernels/kernels.hpp"
#include "probation/errors.hpp"

namespace probation {

void haward_thackray_strain(const Samples& true_strain, Eigen::ArrayXd& result) {
  result.resize(true_strain.size());
  if (kernels::best().samples.haward_thackray(true_strain.data(), true_strain.size(), result.data())) return;
  Eigen::Index first = 0;
  while (std::isfinite(result[first])) ++first;
  std::ostringstream message;
  message << "true_strain[" << first << "] is " << true_strain[first] << "; "
          << (std::isfinite(true_strain[first]) ? "its stretch is beyond all numbers: is it a strain?"
                                                : "a finite number is needed");
  throw InputError(message.str());
}

Eigen::ArrayXd haward_thackray_strain(const Samples& true_strain) {
  Eigen::ArrayXd result;
  haward_thackray_strain(true_strain, result);
  return result;
}

}  // namespace probation
