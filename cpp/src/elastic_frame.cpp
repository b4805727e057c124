#include "probation/elastic_frame.hpp"

#include <cmath>

#include "probation/errors.hpp"

namespace probation {

namespace {

/// Decay of a mode over a step, and what a unit of strain that grows evenly over the step leaves of it.
struct ModeStep {
  double decay = 1.0, gain = 1.0;
  ModeStep(double step, double relaxation_time) {
    if (std::isinf(relaxation_time)) return;
    const double ratio = step / relaxation_time;
    decay = std::exp(-ratio);
    gain = -std::expm1(-ratio) / ratio;
  }
};

}  // namespace

Eigen::ArrayXd stress_behind_frame(const Samples& time, const Samples& modulus,
                                   const Samples& relaxation_time, const Samples& give,
                                   const Samples& change) {
  const Eigen::Index count = time.size(), modes = modulus.size();
  if (give.size() != count || change.size() != count || relaxation_time.size() != modes)
    throw InputError("time, give and change need the same length, and so do modulus and relaxation_time");
  Eigen::ArrayXd stress(count), mode = Eigen::ArrayXd::Zero(modes), gain(modes);
  double strain = 0.0, last_step = -1.0;
  Eigen::ArrayXd decay(modes);
  for (Eigen::Index n = 0; n < count; ++n) {
    if (n == 0) {  // relaxed: the first strain carries nothing yet
      stress[0] = change[0];
      strain = give[0] * stress[0];
      continue;
    }
    const double step = time[n] - time[n - 1];
    if (step != last_step) {
      for (Eigen::Index k = 0; k < modes; ++k) {
        const ModeStep over(step, relaxation_time[k]);
        decay[k] = over.decay;
        gain[k] = over.gain;
      }
      last_step = step;
    }
    mode *= decay;
    const double stiffness = (modulus * gain).sum();
    stress[n] = (change[n] + mode.sum() - stiffness * strain) / (1.0 - stiffness * give[n]);
    const double now = give[n] * stress[n];
    mode += modulus * gain * (now - strain);
    strain = now;
  }
  return stress;
}

}  // namespace probation
