#include "probation/spectrum.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "probation/errors.hpp"
#include "probation/log_spaced.hpp"

namespace probation {

namespace {
constexpr int most_modes = 10000;
constexpr double most_decades = 300.0;  // beyond, 10^-decades is no normal number
}  // namespace

Spectrum Spectrum::log_spaced(int modes, double decades) {
  if (modes < 1) throw InputError("modes is " + std::to_string(modes) + "; at least 1 is needed");
  if (modes > most_modes)
    throw InputError("modes is " + std::to_string(modes) + "; at most " + std::to_string(most_modes) +
                     " make sense");
  if (!(decades > 0.0) || !(decades <= most_decades)) {
    std::ostringstream message;
    message << "decades is " << decades << "; a positive number of at most " << most_decades << " is needed";
    throw InputError(message.str());
  }

  Spectrum spectrum{Eigen::ArrayXd(modes), Eigen::ArrayXd(modes)};
  log_spaced_modes(modes, decades, spectrum.relaxation_ratio.data(), spectrum.modal_weight.data());
  return spectrum;
}

void Spectrum::validate() const {
  if (modes() == 0) throw InputError("the spectrum has no modes");
  if (modal_weight.size() != modes())
    throw InputError("modal_weight has " + std::to_string(modal_weight.size()) +
                     " entries, relaxation_ratio " + std::to_string(modes()) + "; they must match");
  constexpr double smallest_normal = std::numeric_limits<double>::min();  // the inverse of others is infinite
  if (!relaxation_ratio.allFinite() || !(relaxation_ratio >= smallest_normal).all())
    throw InputError("relaxation_ratio has an entry that is not a positive number");
  if (!modal_weight.allFinite() || !(modal_weight >= 0.0).all() || !std::isfinite(modal_weight.sum()))
    throw InputError("modal_weight has an entry that is negative or not finite, or a sum that is not finite");
}

}  // namespace probation
