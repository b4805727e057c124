#include "probation/schemes/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "probation/errors.hpp"

namespace probation {

namespace {

/// (1 - e^-x) / x for x >= 0.
double mean_decay(double x) { return x == 0.0 ? 1.0 : -std::expm1(-x) / x; }

/// factor (e^x - e^y) / (x - y): finite wherever the product is, for the exponential comes in two halves.
double times_exponential_difference(double factor, double x, double y) {
  const double half = std::exp(0.5 * std::max(x, y));
  return half * (half * (factor * mean_decay(std::abs(x - y))));
}

}  // namespace

double exponential_difference(double x, double y) {
  return std::exp(std::max(x, y)) * mean_decay(std::abs(x - y));
}

Eigen::ArrayXd ramp_stress(const Law& law, double strain_rate, const Samples& time) {
  // Modes that are faster than this have relaxed, to the last digit.
  constexpr double relaxed = 1e100;
  law.validate();
  if (!std::isfinite(strain_rate)) throw InputError("strain_rate is not finite");
  double tau_max = law.tau_max;
  if (law.companion)
    tau_max = law.alpha *
              law.companion->relaxation_time(std::max(std::abs(strain_rate), law.companion->rate_floor()));

  Eigen::ArrayXd stress = Eigen::ArrayXd::Zero(time.size());
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const double t = time[i], strain = strain_rate * t;
    if (!(t >= 0.0) || !std::isfinite(t)) {
      std::ostringstream message;
      message << "time[" << i << "] is " << t << "; a ramp starts at time 0";
      throw InputError(message.str());
    }
    if (t == 0.0) continue;
    for (Eigen::Index j = 0; j < law.spectrum.modes(); ++j) {
      // eq. (7) in x = t / tau_j and the strain
      const double x = t / (law.spectrum.relaxation_ratio[j] * tau_max);
      const double weight = law.spectrum.modal_weight[j];
      stress[i] += weight * law.unrelaxed_modulus * mean_decay(x) * strain;
      const double seen = std::min(x, relaxed), hardening = weight * law.hardening_modulus * seen;
      if (hardening > 0.0)
        stress[i] += times_exponential_difference(hardening, 2.0 * strain, -seen) -
                     times_exponential_difference(hardening, -strain, -seen);
    }
    if (!std::isfinite(stress[i])) {
      std::ostringstream message;
      message << "at time[" << i << "] = " << t << " s a ramp of strain_rate = " << strain_rate
              << " 1/s has the true strain " << strain << ", and its stress is beyond all numbers";
      throw InputError(message.str());
    }
  }
  return stress;
}

}  // namespace probation
