#include "probation/companion.hpp"

#include <sstream>

namespace probation {

void CompanionRelation::throw_no_time(double rate, double time) {
  std::ostringstream message;
  message << "the companion relation gives tau_max = " << time << " s at a strain rate of " << rate
          << " 1/s; a positive time is needed: raise rate_floor or check the coefficients";
  throw InputError(message.str());
}

}  // namespace probation
