#include "probation/law.hpp"

#include <cmath>
#include <sstream>

#include "probation/errors.hpp"

namespace probation {
namespace {

void require(double found, bool good, const char* parameter, const char* expected) {
  if (good && std::isfinite(found)) return;
  std::ostringstream message;
  message << parameter << " is " << found << "; " << expected;
  throw InputError(message.str());
}

enum class Sign { any, not_negative, positive };

bool allowed(double value, Sign sign) {
  if (!std::isfinite(value)) return false;
  return sign == Sign::any || value > 0.0 || (sign == Sign::not_negative && value == 0.0);
}

const char* expected(Sign sign) {
  switch (sign) {
    case Sign::positive:
      return "a positive number";
    case Sign::not_negative:
      return "a finite number, not negative,";
    default:
      return "a finite number";
  }
}

void require_samples(const Eigen::ArrayXd& samples, Eigen::Index n_times, const char* name, Sign sign) {
  if (samples.size() > 1 && samples.size() != n_times)
    throw InputError(std::string(name) + " has " + std::to_string(samples.size()) + " samples; 1 or " +
                     std::to_string(n_times) + " are needed to match time");
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    if (allowed(samples[i], sign)) continue;
    std::ostringstream message;
    message << name << "[" << i << "] is " << samples[i] << "; " << expected(sign) << " is needed";
    throw InputError(message.str());
  }
}

void require_entries(const Eigen::ArrayXd& values, Eigen::Index expected, const char* name,
                     const char* counted) {
  if (values.size() == 0 || values.size() == expected) return;
  throw InputError(std::string("direction.") + name + " has " + std::to_string(values.size()) +
                   " entries; there are " + std::to_string(expected) + " " + counted);
}

}  // namespace

void Law::validate() const {
  validate_parameters();
  spectrum.validate();
}

void Law::validate_parameters() const {
  require(unrelaxed_modulus, unrelaxed_modulus >= 0.0, "unrelaxed_modulus",
          "a modulus in MPa, not negative, is needed");
  require(hardening_modulus, hardening_modulus >= 0.0, "hardening_modulus",
          "a modulus in MPa, not negative, is needed");
  if (companion)
    require(alpha, alpha > 0.0, "alpha", "a positive number is needed");
  else
    require(tau_max, tau_max > 0.0, "tau_max", "a positive time in s is needed");
}

void LawChange::validate(Eigen::Index n_times, Eigen::Index modes) const {
  require_samples(relaxation_time_factor, n_times, "relaxation_time_factor", Sign::positive);
  require_samples(unrelaxed_modulus_factor, n_times, "unrelaxed_modulus_factor", Sign::not_negative);
  // Any sign: a relaxed stress that lags behind e_HT is still positive where e_HT is negative again.
  require_samples(hardening_factor, n_times, "hardening_factor", Sign::any);
  require_samples(added_relaxed_stress, n_times, "added_relaxed_stress", Sign::any);
  require_samples(load_bearing_area, n_times, "load_bearing_area", Sign::positive);
  if (initial_modal_stress.size() != 0 && initial_modal_stress.size() != modes)
    throw InputError("initial_modal_stress has " + std::to_string(initial_modal_stress.size()) +
                     " entries; the spectrum has " + std::to_string(modes) + " modes");
  if (!initial_modal_stress.allFinite())
    throw InputError("initial_modal_stress has an entry that is not finite");
  if (extra_modes.modulus.size() != extra_modes.relaxation_time.size())
    throw InputError("extra_modes has " + std::to_string(extra_modes.modulus.size()) + " moduli and " +
                     std::to_string(extra_modes.relaxation_time.size()) +
                     " relaxation times; they must match");
  require_samples(extra_modes.relaxation_time, extra_modes.relaxation_time.size(),
                  "extra_modes.relaxation_time", Sign::positive);
  require_samples(extra_modes.modulus, extra_modes.modulus.size(), "extra_modes.modulus", Sign::not_negative);
  for (const auto& feedback : feedbacks)
    if (!feedback) throw InputError("feedbacks holds an empty entry");
}

void Direction::validate(const LawChange& change, Eigen::Index n_times, Eigen::Index modes,
                         bool rate_given) const {
  require_samples(unrelaxed_modulus, n_times, "direction.unrelaxed_modulus", Sign::any);
  require_samples(log_relaxation_time, n_times, "direction.log_relaxation_time", Sign::any);
  require_samples(relaxed_stress, n_times, "direction.relaxed_stress", Sign::any);
  require_samples(log_load_bearing_area, n_times, "direction.log_load_bearing_area", Sign::any);
  require_entries(true_strain, n_times, "true_strain", "instants");
  require_entries(strain_rate, n_times, "strain_rate", "instants");
  if (strain_rate.size() > 0 && !rate_given)
    throw InputError("direction.strain_rate needs a history with its own rates");
  require_entries(modal_weight, modes, "modal_weight", "modes");
  require_entries(log_relaxation_ratio, modes, "log_relaxation_ratio", "modes");
  require_entries(initial_modal_stress, modes, "initial_modal_stress", "modes");
  require_entries(extra_modulus, change.extra_modes.modulus.size(), "extra_modulus", "extra modes");
  require_entries(log_extra_time, change.extra_modes.modulus.size(), "log_extra_time", "extra modes");
  if (feedback < 0) return;
  const auto k = static_cast<std::size_t>(feedback);
  if (k >= change.feedbacks.size())
    throw InputError("direction.feedback is " + std::to_string(feedback) + "; the change has " +
                     std::to_string(change.feedbacks.size()) + " feedbacks");
  if (feedback_parameter >= change.feedbacks[k]->parameters())
    throw InputError("direction.feedback_parameter is " + std::to_string(feedback_parameter) +
                     "; that feedback has " + std::to_string(change.feedbacks[k]->parameters()) +
                     " parameters");
}

}  // namespace probation
