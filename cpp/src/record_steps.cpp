#include "record_steps.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/kernels.hpp"

namespace probation {
namespace {

using Eigen::Index;

Differentiator differentiator_of(Scheme scheme) {
  return scheme == Scheme::be2 ? Differentiator::backward : Differentiator::three_point;
}

std::size_t length(bool constant, Index n) { return constant ? 1 : static_cast<std::size_t>(n); }

/// out[m] = value(m) for m in from..to: loops that vectorise.
template <class Value>
void fill(std::vector<double>& out, Index from, Index to, Value value) {
  double* const to_fill = out.data();
  for (Index m = from; m < to; ++m) to_fill[m] = value(m);
}

/// Whether the strain enters through given rates: bE2's end of a step.
bool rate_drives(Scheme scheme, const RecordInputs<double>& in) {
  return scheme == Scheme::be2 && !in.end_rate.empty();
}

/// The forcing of even steps from..to, from differences of true strain and relaxed stress.
template <class Rise>
void form_even_forcing(Scheme scheme, double modulus, const double* strain, Rise relaxed_rise, Index from,
                       Index to, std::vector<double>& forcing) {
  const auto rise = [modulus, strain, relaxed_rise](Index m) {
    return modulus * (strain[m + 1] - strain[m]) - relaxed_rise(m);
  };
  if (scheme == Scheme::be2)
    fill(forcing, from, to, [rise](Index m) { return 1.5 * rise(m) - 0.5 * rise(m - 1); });
  else
    fill(forcing, from, to, rise);
}

/// Steps from..to where nothing restarts; tau_max constant. Their scale stands at both ends.
void form_even_steps(Scheme scheme, const History& history, const RecordInputs<double>& in, Index from,
                     Index to, RecordSteps<double>& out) {
  const double modulus = in.unrelaxed_modulus[0];
  const double* strain = history.true_strain().data();
  const double* relaxed = in.relaxed_stress.data();
  if (in.relaxed_stress.size() > 1)
    form_even_forcing(
        scheme, modulus, strain, [relaxed](Index m) { return relaxed[m + 1] - relaxed[m]; }, from, to,
        out.forcing);
  else
    form_even_forcing(scheme, modulus, strain, [](Index) { return 0.0; }, from, to, out.forcing);
  const auto first = static_cast<std::size_t>(from), last = static_cast<std::size_t>(to - 1);
  out.ratio[first] = 1.0;
  out.scale[first] = out.scale[last] = history.step()[from] * in.fluidity_end[0];
  if (scheme == Scheme::sa3) out.curvature[first] = 0.5 * (out.forcing[first] - out.forcing[first - 1]);
}

/// The same for steps from..to of any length under any tau_max, from >= 1; whether every scale is positive.
bool form_uneven_steps(Scheme scheme, const double* h, const RecordInputs<double>& in, const double* f,
                       Index from, Index to, RecordSteps<double>& out) {
  const kernels::StepPasses& form = kernels::best().form;
  const bool steady = in.fluidity_end.size() == 1, rated = rate_drives(scheme, in);
  const kernels::StepSamples samples{to - from,
                                     h + from,
                                     f + from,
                                     steady ? nullptr : in.fluidity_begin.data() + from,
                                     in.fluidity_end.data() + (steady ? 0 : from),
                                     rated ? in.end_rate.data() + from : nullptr,
                                     in.unrelaxed_modulus[0]};
  const kernels::FormedSteps steps{out.ratio.data() + from, out.scale.data() + from,
                                   out.forcing.data() + from, out.curvature.data() + from};
  switch (scheme) {
    case Scheme::sa2:
      return form.straight(samples, steps);
    case Scheme::sa3:
      return form.parabolic(samples, steps);
    default:
      return form.two_step(samples, steps);
  }
}

/// sa3_step's curvature, from the forcing and scale of a step and of the one before.
void form_curvature(Index m, RecordSteps<double>& out) {
  const auto i = static_cast<std::size_t>(m);
  const double growth = out.scale[i] / out.scale[i - 1];
  out.curvature[i] = bend_weight(growth) * (out.forcing[i] - out.forcing[i - 1] * growth);
}

}  // namespace

bool form_steps_at_once(Scheme scheme, Start start, const History& history, const RecordInputs<double>& in,
                        RecordSteps<double>& out) {
  constexpr Index shortest_even = 8;
  const Index n = history.size(), steps = history.steps();
  const bool steady = in.fluidity_end.size() == 1;
  out.resize(static_cast<std::size_t>(steps));
  std::vector<double> integral;
  const auto forcing_integral = [&] {
    if (!integral.empty()) return integral.data();
    integral.resize(static_cast<std::size_t>(n));
    const double modulus = rate_drives(scheme, in) ? 0.0 : in.unrelaxed_modulus[0];
    fill(integral, 0, n,
         [&](Index i) { return modulus * history.true_strain()[i] - at(in.relaxed_stress, i); });
    return integral.data();
  };
  const double* h = history.step().data();
  std::fill(out.rule.begin(), out.rule.end(), scheme == Scheme::be2 ? StepRule::bdf2 : StepRule::exponential);

  const auto restart = [&](Index m) {
    const auto i = static_cast<std::size_t>(m);
    const StepForcing<double> step = step_forcing(scheme, start, step_data(history, in, m, 0.0, 0.0));
    out.rule[i] = step.rule;
    out.ratio[i] = history.ratio(m);
    out.scale[i] = step.scale;
    out.forcing[i] = step.forcing;
    out.curvature[i] = 0.0;
  };
  restart(0);
  for (Index m = 1; m < steps;) {
    Index end = m + history.uniform_run(m);
    if (steady && end - m >= shortest_even && !history.fresh(m) && std::abs(history.ratio(m) - 1.0) <= 1e-9) {
      form_even_steps(scheme, history, in, m, end, out);
    } else {
      // The first of even steps differs from the one before: it is not even itself.
      end = m + 1;
      while (steady && end < steps && history.uniform_run(end) < shortest_even) ++end;
      if (!steady) end = steps;
      if (!form_uneven_steps(scheme, h, in, forcing_integral(), m, end, out) && !steady) return false;
      const History::Indices& jumps = history.jumps();
      for (auto jump = std::lower_bound(jumps.begin(), jumps.end(), m); jump != jumps.end() && *jump < end;
           ++jump) {
        restart(*jump);
        if (scheme == Scheme::sa3 && *jump + 1 < end) form_curvature(*jump + 1, out);
      }
      const bool even = m - 1 + history.uniform_run(m - 1) >= end;
      for (Index k = m; scheme == Scheme::be2 && !even && k < end; ++k)
        if (out.ratio[static_cast<std::size_t>(k)] >= bdf2_largest_step_ratio) restart(k);
    }
    m = end;
  }
  return true;
}

void form_inputs(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                 RecordRates& rates, RecordInputs<double>& out) {
  const Index n = history.size(), steps = history.steps();
  const Sampled time_factor(change.relaxation_time_factor, 1.0),
      modulus_factor(change.unrelaxed_modulus_factor, 1.0);
  const Sampled hardening_factor(change.hardening_factor, 1.0), added(change.added_relaxed_stress, 0.0);

  out.true_strain.assign(history.true_strain().data(), history.true_strain().data() + n);
  out.relaxed_stress.resize(static_cast<std::size_t>(n));
  const double* haward_thackray = history.haward_thackray_strain().data();
  if (hardening_factor.constant() && added.constant())
    fill(out.relaxed_stress, 0, n,
         [haward_thackray, slope = law.hardening_modulus * hardening_factor[0], more = added[0]](Index i) {
           return slope * haward_thackray[i] + more;
         });
  else
    fill(out.relaxed_stress, 0, n, [&](Index i) {
      return law.hardening_modulus * hardening_factor[i] * haward_thackray[i] + added[i];  // eq. (3)
    });

  out.unrelaxed_modulus.resize(length(modulus_factor.constant(), n));
  for (std::size_t i = 0; i < out.unrelaxed_modulus.size(); ++i)
    out.unrelaxed_modulus[i] = law.unrelaxed_modulus * modulus_factor[static_cast<Index>(i)];

  out.end_rate.clear();
  if (history.rate_given() && scheme == Scheme::be2) {
    const Eigen::ArrayXd& end = rates.rates(history, scheme).end;
    out.end_rate.assign(end.data(), end.data() + steps);
  }

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
  const RecordRates::Fluidity& seen = rates.fluidity(history, scheme, law.companion);
  if (time_factor.constant()) {
    const double inverse = 1.0 / (law.alpha * time_factor[0]);
    fill(out.fluidity_begin, 0, steps,
         [begin = seen.begin.data(), inverse](Index m) { return begin[m] * inverse; });
    fill(out.fluidity_end, 0, steps, [end = seen.end.data(), inverse](Index m) { return end[m] * inverse; });
    return;
  }
  fill(out.fluidity_begin, 0, steps, [&](Index m) { return seen.begin[m] / (law.alpha * time_factor[m]); });
  fill(out.fluidity_end, 0, steps, [&](Index m) { return seen.end[m] / (law.alpha * time_factor[m + 1]); });
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
