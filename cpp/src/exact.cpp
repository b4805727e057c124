#include "probation/schemes/exact.hpp"

#include <cmath>

#include "probation/errors.hpp"
#include "probation/schemes/ramp.hpp"
#include "probation/schemes/step.hpp"
#include "sampled.hpp"

namespace probation {
namespace {

using Eigen::Index;

/// int_0^1 e^{k s} e^{-x (1 - s)} ds, with e^k = grown and e^-x = decayed at hand.
double weighted_exponential(double k, double grown, double x, double decayed) {
  const double gap = k + x;
  return std::abs(gap) > 0.5 ? (grown - decayed) / gap : exponential_difference(k, -x);
}

}  // namespace

void exact_stress(const Law& law, const LawChange& change, const History& history,
                  Eigen::Ref<Eigen::ArrayXd> stress) {
  law.validate();
  change.validate(history.size(), law.spectrum.modes());
  if (!change.feedbacks.empty())
    throw InputError("scheme exact has no closed form for a feedback; use be2, sa2, sa3 or cvode");

  const Sampled time_factor(change.relaxation_time_factor, 1.0),
      modulus_factor(change.unrelaxed_modulus_factor, 1.0);
  const Sampled hardening_factor(change.hardening_factor, 1.0), added(change.added_relaxed_stress, 0.0);
  const Sampled area(change.load_bearing_area, 1.0);
  const Eigen::ArrayXd& strain = history.true_strain();
  const StepRates rates =
      history.rates(history.rate_given() ? Differentiator::three_point : Differentiator::secant);

  const Index modes = law.spectrum.modes(), extra = change.extra_modes.modulus.size();
  const Eigen::ArrayXd& weight = law.spectrum.modal_weight;
  const auto hardening = [&](Index i) { return law.hardening_modulus * hardening_factor[i]; };
  const auto relaxed = [&](Index i) { return hardening(i) * history.haward_thackray_strain()[i] + added[i]; };
  const auto fluidity = [&](Index m, double rate, Index instant) {
    double tau_max = law.tau_max;
    if (law.companion)
      tau_max = law.alpha *
                law.companion->relaxation_time(history.companion_rate(m, rate, law.companion->rate_floor()));
    return 1.0 / (tau_max * time_factor[instant]);
  };

  // z_j = sigma_j - p_j sigma^r, as in schemes/step.hpp.
  Eigen::ArrayXd z = Eigen::ArrayXd::Zero(modes), maxwell = Eigen::ArrayXd::Zero(extra);
  if (change.initial_modal_stress.size() > 0) z = change.initial_modal_stress - weight * relaxed(0);
  const auto total = [&](Index i) {
    return area[i] * (z.sum() + weight.sum() * relaxed(i) + (change.extra_modes.modulus * maxwell).sum());
  };
  stress[0] = total(0);
  for (Index m = 0; m < history.steps(); ++m) {
    const double h = history.step()[m], rise = strain[m + 1] - strain[m];
    const double scale = 0.5 * h * (fluidity(m, rates.begin[m], m) + fluidity(m, rates.end[m], m + 1));
    const double modulus_begin = law.unrelaxed_modulus * modulus_factor[m];
    const double modulus_end = law.unrelaxed_modulus * modulus_factor[m + 1];
    // sigma^r = (G0 + (G1 - G0) s) e_HT + added: for G0 = G1 the bend of e_HT is exact, else its product is
    // straight too.
    const bool even = hardening(m) == hardening(m + 1);
    const double straight = even ? added[m + 1] - added[m] : relaxed(m + 1) - relaxed(m);
    const double twice = std::exp(2.0 * rise), inverse = std::exp(-rise);
    const double stretched = 2.0 * hardening(m) * rise * std::exp(2.0 * strain[m]);
    const double shrunk = hardening(m) * rise * std::exp(-strain[m]);
    for (Index j = 0; j < modes; ++j) {
      const double x = scale / law.spectrum.relaxation_ratio[j];
      const double decayed = decay(x), mean = mean_decay(x, decayed);
      // A straight E_u over a straight strain: E_u e' has its mean and a slope; the slope's part is
      // curvature.
      double drive = (0.5 * (modulus_begin + modulus_end) * rise - straight) * mean;
      drive += 0.5 * (modulus_end - modulus_begin) * rise * curvature_decay(x, mean);
      if (even)
        drive -= stretched * weighted_exponential(2.0 * rise, twice, x, decayed) +
                 shrunk * weighted_exponential(-rise, inverse, x, decayed);
      z[j] = decayed * z[j] + weight[j] * drive;
    }
    for (Index k = 0; k < extra; ++k) {
      const double x = h / change.extra_modes.relaxation_time[k];
      const double decayed = decay(x);
      maxwell[k] = decayed * maxwell[k] + mean_decay(x, decayed) * rise;
    }
    stress[m + 1] = total(m + 1);
  }
}

}  // namespace probation
