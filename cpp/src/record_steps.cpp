#include "record_steps.hpp"

#include <algorithm>
#include <cmath>

namespace probation {
namespace {

using Eigen::Index;

Differentiator differentiator_of(Scheme scheme) {
  return scheme == Scheme::be2 ? Differentiator::backward : Differentiator::three_point;
}

std::size_t length(bool constant, Index n) { return constant ? 1 : static_cast<std::size_t>(n); }

/// tau_max at one rate; the last one is kept, since a step mostly ends at the rate at which the next begins.
class CompanionTimes {
 public:
  CompanionTimes(const Law& law, const History& history) : law_(law), history_(history) {}

  double operator()(Index m, double rate) {
    const double seen = history_.companion_rate(m, rate, law_.companion->rate_floor());
    if (seen != last_rate_) {
      last_rate_ = seen;
      last_time_ = law_.alpha * law_.companion->relaxation_time(seen);
    }
    return last_time_;
  }

 private:
  const Law& law_;
  const History& history_;
  double last_rate_ = -1.0, last_time_ = 0.0;
};

}  // namespace

void form_constant_steps(Scheme scheme, Start start, const History& history, const RecordInputs<double>& in,
                         RecordSteps<double>& out) {
  const Index n = history.size(), steps = history.steps();
  out.resize(static_cast<std::size_t>(steps));
  Eigen::ArrayXd integral = in.unrelaxed_modulus[0] * history.true_strain();
  if (in.relaxed_stress.size() > 1) integral -= Eigen::Map<const Eigen::ArrayXd>(in.relaxed_stress.data(), n);
  const double* f = integral.data();
  const double fluidity = in.fluidity_end[0];
  for (Index m = 0; m < steps;) {
    const auto i = static_cast<std::size_t>(m);
    const double h = history.step()[m], ratio = history.ratio(m);
    const bool fresh = history.fresh(m),
               bdf2 = scheme == Scheme::be2 && !fresh && ratio < bdf2_largest_step_ratio;
    const bool euler = scheme == Scheme::be2 && !bdf2 && start == Start::backward_euler;
    out.rule[i] = bdf2 ? StepRule::bdf2 : euler ? StepRule::backward_euler : StepRule::exponential;
    out.ratio[i] = ratio;
    out.scale[i] = h * fluidity;
    out.curvature[i] = 0.0;
    if (bdf2) {
      out.forcing[i] = Bdf2Difference(ratio)(f[m + 1], f[m], f[m - 1]);
    } else {
      out.forcing[i] = f[m + 1] - f[m];
      if (euler && !fresh) {
        // The rate is the three-point difference even where a long step restarts the scheme.
        const Eigen::ArrayXd& e = history.true_strain();
        const double rise = e[m + 1] - e[m];
        out.forcing[i] += in.unrelaxed_modulus[0] * (Bdf2Difference(ratio)(e[m + 1], e[m], e[m - 1]) - rise);
      }
      if (scheme == Scheme::sa3 && !fresh)
        out.curvature[i] = ratio / (1.0 + ratio) * (out.forcing[i] - ratio * out.forcing[i - 1]);
    }
    // The rest of an even stretch, in loops that vectorise.
    const Index end = m + history.uniform_run(m);
    ++m;
    if (m >= end || std::abs(history.ratio(m) - 1.0) > 1e-9) continue;
    const auto fill = [&](auto& samples, auto value) {
      std::fill(samples.begin() + m, samples.begin() + end, value);
    };
    fill(out.rule, scheme == Scheme::be2 ? StepRule::bdf2 : StepRule::exponential);
    fill(out.ratio, 1.0);
    fill(out.scale, h * fluidity);
    double* forcing = out.forcing.data();
    double* curvature = out.curvature.data();
    if (scheme == Scheme::be2) {
      for (Index k = m; k < end; ++k) forcing[k] = 1.5 * (f[k + 1] - f[k]) - 0.5 * (f[k] - f[k - 1]);
    } else {
      for (Index k = m; k < end; ++k) forcing[k] = f[k + 1] - f[k];
      if (scheme == Scheme::sa3)
        for (Index k = m; k < end; ++k) curvature[k] = 0.5 * (f[k + 1] - 2.0 * f[k] + f[k - 1]);
    }
    if (scheme != Scheme::sa3) fill(out.curvature, 0.0);
    m = end;
  }
}

void form_inputs(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                 RecordInputs<double>& out) {
  const Index n = history.size(), steps = history.steps();
  const Sampled time_factor(change.relaxation_time_factor, 1.0),
      modulus_factor(change.unrelaxed_modulus_factor, 1.0);
  const Sampled hardening_factor(change.hardening_factor, 1.0), added(change.added_relaxed_stress, 0.0);

  out.true_strain.assign(history.true_strain().data(), history.true_strain().data() + n);
  out.relaxed_stress.resize(static_cast<std::size_t>(n));
  const double* haward_thackray = history.haward_thackray_strain().data();
  for (Index i = 0; i < n; ++i)
    out.relaxed_stress[static_cast<std::size_t>(i)] =
        law.hardening_modulus * hardening_factor[i] * haward_thackray[i] + added[i];  // eq. (3)

  out.unrelaxed_modulus.resize(length(modulus_factor.constant(), n));
  for (std::size_t i = 0; i < out.unrelaxed_modulus.size(); ++i)
    out.unrelaxed_modulus[i] = law.unrelaxed_modulus * modulus_factor[static_cast<Index>(i)];

  StepRates rates;
  if (law.companion || history.rate_given()) rates = history.rates(differentiator_of(scheme));
  out.end_rate.clear();
  if (history.rate_given()) out.end_rate.assign(rates.end.data(), rates.end.data() + steps);

  const bool constant = !law.companion && time_factor.constant();
  out.fluidity_begin.resize(length(constant, steps));
  out.fluidity_end.resize(length(constant, steps));
  if (!law.companion) {
    for (std::size_t i = 0; i < out.fluidity_end.size(); ++i) {
      const auto m = static_cast<Index>(i);
      out.fluidity_begin[i] = 1.0 / (law.tau_max * time_factor[m]);
      out.fluidity_end[i] = 1.0 / (law.tau_max * time_factor[constant ? m : m + 1]);
    }
    return;
  }
  CompanionTimes companion(law, history);
  for (Index m = 0; m < steps; ++m) {
    const auto i = static_cast<std::size_t>(m);
    out.fluidity_begin[i] = 1.0 / (companion(m, rates.begin[m]) * time_factor[m]);
    out.fluidity_end[i] = 1.0 / (companion(m, rates.end[m]) * time_factor[m + 1]);
  }
}

void form_inputs(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                 const RecordInputs<double>& base, const Direction& direction, RecordInputs<Dual>& out) {
  const Index n = history.size(), steps = history.steps();
  const bool strained = direction.true_strain.size() > 0, rated = direction.strain_rate.size() > 0;
  const Sampled d_modulus(direction.unrelaxed_modulus, 0.0), d_time(direction.log_relaxation_time, 0.0);
  const Sampled d_relaxed(direction.relaxed_stress, 0.0), hardening_factor(change.hardening_factor, 1.0);

  out.true_strain.resize(static_cast<std::size_t>(n));
  out.relaxed_stress.resize(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double strain = history.true_strain()[i], d_strain = strained ? direction.true_strain[i] : 0.0;
    out.true_strain[k] = {strain, d_strain};
    double d_hardening = 0.0;
    if (strained)
      d_hardening = law.hardening_modulus * hardening_factor[i] * haward_thackray_slope(strain) * d_strain;
    out.relaxed_stress[k] = {base.relaxed_stress[k], d_relaxed[i] + d_hardening};
  }

  const bool constant_modulus = base.unrelaxed_modulus.size() == 1 && d_modulus.constant();
  out.unrelaxed_modulus.resize(length(constant_modulus, n));
  for (std::size_t i = 0; i < out.unrelaxed_modulus.size(); ++i)
    out.unrelaxed_modulus[i] = {at(base.unrelaxed_modulus, static_cast<Index>(i)),
                                d_modulus[static_cast<Index>(i)]};

  // Rates move with the strain; given ones only on that side of a jump where the secant stands in for them.
  StepRates rates, d_rates;
  const bool rates_move = rated || strained;
  if (law.companion || history.rate_given()) rates = history.rates(differentiator_of(scheme));
  if (rates_move) {
    const Eigen::ArrayXd still = Eigen::ArrayXd::Zero(n);
    d_rates = history.move_rates(strained ? direction.true_strain : still,
                                 rated ? direction.strain_rate : still, differentiator_of(scheme));
  }
  out.end_rate.clear();
  if (history.rate_given()) {
    out.end_rate.resize(static_cast<std::size_t>(steps));
    for (Index m = 0; m < steps; ++m)
      out.end_rate[static_cast<std::size_t>(m)] = {rates.end[m], rates_move ? d_rates.end[m] : 0.0};
  }

  const bool constant_fluidity = base.fluidity_end.size() == 1 && d_time.constant();
  out.fluidity_begin.resize(length(constant_fluidity, steps));
  out.fluidity_end.resize(length(constant_fluidity, steps));
  // d ln f = -d ln tau_max - (d ln tau / d ln r) dr / r
  const auto log_slope = [&](Index m, double rate, double d_rate) {
    const double floor = law.companion->rate_floor(), seen = history.companion_rate(m, rate, floor);
    return law.companion->log_slope(seen) * history.companion_rate_slope(m, rate, floor) * d_rate / seen;
  };
  for (std::size_t i = 0; i < out.fluidity_end.size(); ++i) {
    const auto m = static_cast<Index>(i);
    double d_begin = -d_time[m], d_end = -d_time[constant_fluidity ? m : m + 1];
    if (law.companion && rates_move) {
      d_begin -= log_slope(m, rates.begin[m], d_rates.begin[m]);
      d_end -= log_slope(m, rates.end[m], d_rates.end[m]);
    }
    const double begin = at(base.fluidity_begin, m), end = at(base.fluidity_end, m);
    out.fluidity_begin[i] = {begin, begin * d_begin};
    out.fluidity_end[i] = {end, end * d_end};
  }
}

}  // namespace probation
