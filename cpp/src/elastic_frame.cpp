#include "probation/elastic_frame.hpp"

#include <cmath>

#include "probation/errors.hpp"
#include "probation/schemes/step.hpp"

namespace probation {

namespace {

/// Relative difference below which two steps are one: evenly spaced times differ in their last digits.
constexpr double SAME_STEP = 1e-9;

}  // namespace

Eigen::ArrayXd stress_behind_frame(const Samples& time, const Samples& modulus,
                                   const Samples& relaxation_time, const Samples& give,
                                   const Samples& change) {
  const Eigen::Index count = time.size(), modes = modulus.size();
  if (count == 0 || give.size() != count || change.size() != count || relaxation_time.size() != modes)
    throw InputError(
        "time, give and change need the same length, at least 1, and so do modulus "
        "and relaxation_time");
  Eigen::ArrayXd stress(count), mode = Eigen::ArrayXd::Zero(modes), decayed(modes), stiffness(modes);
  stress[0] = change[0];  // relaxed: the first strain carries nothing yet
  double strain = give[0] * stress[0], last_step = 0.0, whole = 0.0;
  for (Eigen::Index n = 1; n < count; ++n) {
    const double step = time[n] - time[n - 1];
    if (std::abs(step - last_step) > SAME_STEP * last_step) {
      for (Eigen::Index k = 0; k < modes; ++k) {
        const double x = step / relaxation_time[k];
        decayed[k] = decay(x);
        stiffness[k] = modulus[k] * mean_decay(x, decayed[k]);
      }
      whole = stiffness.sum();
      last_step = step;
    }
    mode *= decayed;
    stress[n] = (change[n] + mode.sum() - whole * strain) / (1.0 - whole * give[n]);
    const double now = give[n] * stress[n];
    mode += stiffness * (now - strain);
    strain = now;
  }
  return stress;
}

}  // namespace probation
