#include "require_finite.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "kernels/kernels.hpp"
#include "probation/errors.hpp"

namespace probation {

void require_finite(const Samples& values, const Eigen::ArrayXd& time, const char* what) {
  if (kernels::best().samples.all_finite(values.data(), values.size())) return;
  Eigen::Index first = 0;
  while (std::isfinite(values[first])) ++first;
  std::ostringstream message;
  message << what << " is not finite at t = " << time[first] << " s (sample " << first
          << "): a parameter, the strain or a step of time is too large or too small for double precision";
  throw ConvergenceError(message.str(), time[first], std::numeric_limits<double>::infinity());
}

}  // namespace probation
