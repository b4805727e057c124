#include "probation/companion.hpp"

#include <Eigen/Core>
#include <sstream>

#include "probation/companion/weissenberg.hpp"

namespace probation {

/// Eigen's logarithm takes several rates at once.
void Weissenberg::forms(const double* rate, double* time, std::size_t count) const {
  const auto n = static_cast<Eigen::Index>(count);
  const Eigen::Map<const Eigen::ArrayXd> r(rate, n);
  Eigen::Map<Eigen::ArrayXd>(time, n) = (form_.slope / log_of_ten * r.log() + form_.intercept) / r;
}

void CompanionRelation::throw_no_time(double rate, double time) {
  std::ostringstream message;
  message << "the companion relation gives tau_max = " << time << " s at a strain rate of " << rate
          << " 1/s; a positive time is needed: raise rate_floor or check the coefficients";
  throw InputError(message.str());
}

}  // namespace probation
