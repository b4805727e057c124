#include "probation/schemes/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "probation/errors.hpp"

namespace probation {

double exponential_difference(double x, double y) {
  const double gap = std::abs(x - y);
  const double mean = gap == 0.0 ? 1.0 : -std::expm1(-gap) / gap;
  return std::exp(std::max(x, y)) * mean;
}

Eigen::ArrayXd ramp_stress(const Law& law, double strain_rate, const Samples& time) {
  law.validate();
  if (!std::isfinite(strain_rate)) throw InputError("strain_rate is not finite");
  double tau_max = law.tau_max;
  if (law.companion)
    tau_max = law.alpha *
              law.companion->relaxation_time(std::max(std::abs(strain_rate), law.companion->rate_floor()));

  Eigen::ArrayXd stress = Eigen::ArrayXd::Zero(time.size());
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const double t = time[i];
    if (!(t >= 0.0) || !std::isfinite(t))
      throw InputError("time[" + std::to_string(i) + "] is " + std::to_string(t) +
                       "; a ramp starts at time 0");
    for (Eigen::Index j = 0; j < law.spectrum.modes(); ++j) {
      const double tau = law.spectrum.relaxation_ratio[j] * tau_max;
      const double elastic = law.unrelaxed_modulus * strain_rate * tau * -std::expm1(-t / tau);
      const double hardening = law.hardening_modulus / tau * t *
                               (exponential_difference(2.0 * strain_rate * t, -t / tau) -
                                exponential_difference(-strain_rate * t, -t / tau));
      stress[i] += law.spectrum.modal_weight[j] * (elastic + hardening);  // eq. (7)
    }
  }
  return stress;
}

}  // namespace probation
