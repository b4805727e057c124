#pragma once
// From the law and a history to the steps of a kernel: everything that is O(n_times), with or without
// derivatives.

#include <type_traits>
#include <vector>

#include "probation/history.hpp"
#include "probation/law.hpp"
#include "probation/schemes/be2.hpp"
#include "probation/schemes/sa3.hpp"
#include "probation/solver.hpp"
#include "record_rates.hpp"
#include "sampled.hpp"

namespace probation {

/// The inputs of eq. (6) along a record; vectors have n_times entries, or one that holds throughout.
/// `fluidity_*` and `end_rate` belong to steps.
template <class Real>
struct RecordInputs {
  std::vector<Real> true_strain, unrelaxed_modulus, relaxed_stress;
  std::vector<Real> fluidity_begin, fluidity_end;  // 1 / tau_max at both ends of a step
  std::vector<Real> end_rate;                      // of bE2; empty: its own difference of the strain
};

/// Steps ready for a kernel, one entry each per step. In a run of even steps, of quantities that are equal
/// in all of them, and of the curvature, only the first entry is filled.
template <class Real>
struct RecordSteps {
  std::vector<StepRule> rule;
  std::vector<double> ratio;
  std::vector<Real> scale, forcing, curvature;

  void resize(std::size_t steps) {
    rule.resize(steps);
    ratio.resize(steps);
    scale.resize(steps);
    forcing.resize(steps);
    curvature.resize(steps);
  }
};

template <class Real>
Real at(const std::vector<Real>& samples, Eigen::Index i) {
  return samples[samples.size() == 1 ? 0 : static_cast<std::size_t>(i)];
}

/// The rate at the end of a step as a difference of its strains.
template <class Real>
Real difference_rate(const StepData<Real>& s) {
  const Three<Real>& strain = s.true_strain;
  if (s.fresh) return (strain.next - strain.here) / s.h;
  return Bdf2Difference(s.ratio)(strain.next, strain.here, strain.before) / s.h;
}

/// The inputs of a scheme in step m. `previous_*` are those of step m - 1.
template <class Real>
StepData<Real> step_data(const History& history, const RecordInputs<Real>& in, Eigen::Index m,
                         Real previous_scale, Real previous_forcing) {
  StepData<Real> s{};
  s.fresh = history.fresh(m);
  s.h = history.step()[m];
  s.ratio = history.ratio(m);
  const Eigen::Index earlier = m > 0 ? m - 1 : 0;
  s.true_strain = {at(in.true_strain, m + 1), at(in.true_strain, m), at(in.true_strain, earlier)};
  s.unrelaxed_modulus = {at(in.unrelaxed_modulus, m + 1), at(in.unrelaxed_modulus, m),
                         at(in.unrelaxed_modulus, earlier)};
  s.relaxed_stress = {at(in.relaxed_stress, m + 1), at(in.relaxed_stress, m), at(in.relaxed_stress, earlier)};
  s.fluidity = {at(in.fluidity_end, m), at(in.fluidity_begin, m), at(in.fluidity_begin, earlier)};
  s.constant_modulus = in.unrelaxed_modulus.size() == 1;
  s.constant_fluidity = in.fluidity_end.size() == 1;
  s.end_rate = in.end_rate.empty() ? difference_rate(s) : at(in.end_rate, m);
  s.previous_scale = previous_scale;
  s.previous_forcing = previous_forcing;
  return s;
}

/// The part of U that depends on the strain alone.
template <class Real>
Real stiff_part(Scheme scheme, Start start, const StepData<Real>& s) {
  switch (scheme) {
    case Scheme::sa2:
      return sa2_stiff(s);
    case Scheme::sa3:
      return sa3_stiff(s);
    default:
      return be2_stiff(s, start);
  }
}

template <class Real, class Stiff>
StepForcing<Real> step_forcing(Scheme scheme, Start start, const StepData<Real>& s, const Stiff& stiff) {
  switch (scheme) {
    case Scheme::sa2:
      return sa2_step(s, stiff);
    case Scheme::sa3:
      return sa3_step(s, stiff);
    default:
      return be2_step(s, start, stiff);
  }
}

template <class Real>
StepForcing<Real> step_forcing(Scheme scheme, Start start, const StepData<Real>& s) {
  return step_forcing(scheme, start, s, stiff_part(scheme, start, s));
}

/// form_steps where E_u is constant: differences of the forcing's integral F = E_u e - sigma^r are all that a
/// step needs (where rates are given bE2 takes E_u e' instead of E_u e). The same numbers as step_forcing to
/// rounding. False, with nothing formed, where SA3's parabola through the fluidity dips below zero.
bool form_steps_at_once(Scheme scheme, Start start, const History& history, const RecordInputs<double>& in,
                        RecordSteps<double>& out);

template <class Real>
void form_steps(Scheme scheme, Start start, const History& history, const RecordInputs<Real>& in,
                RecordSteps<Real>& out) {
  if constexpr (std::is_same_v<Real, double>) {
    const bool rates_of_even_steps = !in.end_rate.empty() && in.fluidity_end.size() == 1;
    if (in.unrelaxed_modulus.size() == 1 && !rates_of_even_steps &&
        form_steps_at_once(scheme, start, history, in, out))
      return;
  }
  const Eigen::Index steps = history.steps();
  out.resize(static_cast<std::size_t>(steps));
  StepForcing<Real> previous{};
  for (Eigen::Index m = 0; m < steps; ++m) {
    const auto i = static_cast<std::size_t>(m);
    previous = step_forcing(scheme, start, step_data(history, in, m, previous.scale, previous.forcing));
    out.rule[i] = previous.rule;
    out.ratio[i] = history.ratio(m);
    out.scale[i] = previous.scale;
    out.forcing[i] = previous.forcing;
    out.curvature[i] = previous.curvature;
  }
}

/// The inputs that the law, changed by an effect, gives along a history; `rates` are of its earlier solves.
void form_inputs(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                 RecordRates& rates, RecordInputs<double>& out);

/// The same with their slopes along a direction.
void form_inputs(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                 const RecordInputs<double>& base, const Direction& direction, RecordInputs<Dual>& out);

/// Inputs of the extra modes: unit modulus, no relaxed stress, unit fluidity (their times are their own).
template <class Real>
void extra_inputs(const RecordInputs<Real>& base, RecordInputs<Real>& out) {
  out.true_strain = base.true_strain;
  out.end_rate = base.end_rate;
  out.unrelaxed_modulus.assign(1, Real(1.0));
  out.relaxed_stress.assign(1, Real(0.0));
  out.fluidity_begin.assign(1, Real(1.0));
  out.fluidity_end.assign(1, Real(1.0));
}

}  // namespace probation
