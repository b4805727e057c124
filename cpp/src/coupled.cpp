#include "coupled.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "coupled_tangent.hpp"
#include "probation/errors.hpp"

namespace probation {
namespace {

using Eigen::Index;
constexpr int most_iterations = 50;
// Of Newton's last correction, relative. The stress errs by its square, slopes at the solution by itself.
constexpr double tolerance_of_stress = 1e-7, tolerance_of_slopes = 1e-12;

bool small(double correction, double stress, double tolerance) {
  return std::abs(correction) <= tolerance * (1e-3 + std::abs(stress));
}

/// Samples of the law, one per instant (or per step), that feedbacks may change one by one.
void spread(const std::vector<double>& samples, Index length, std::vector<double>& all) {
  if (samples.size() == 1)
    all.assign(static_cast<std::size_t>(length), samples[0]);
  else
    all = samples;
}

Dual moved(Dual a, double by) { return {a.value + a.slope * by, a.slope}; }

/// How the forcing of an even step depends on the last sample of the strain, over E_u.
double end_weight(StepRule rule) { return rule == StepRule::bdf2 ? Bdf2Difference(1.0).next : 1.0; }

Three<Dual> constants(const Three<double>& three) { return {three.next, three.here, three.before}; }

/// In bE2 and SA2 the scale is linear in the fluidity at the end and U in the relaxed stress there; `guess`
/// has these slopes.
StepForcing<Dual> straight(const StepForcing<Dual>& guess, Dual fluidity, Dual relaxed) {
  return {guess.rule, Dual(guess.scale.value) + Dual(guess.scale.slope) * fluidity,
          Dual(guess.forcing.value) + Dual(guess.forcing.slope) * relaxed, Dual()};
}

/// A step of which nothing moves yet.
StepData<Dual> constants(const StepData<double>& s) {
  return {s.fresh,
          s.h,
          s.ratio,
          constants(s.true_strain),
          constants(s.unrelaxed_modulus),
          constants(s.relaxed_stress),
          constants(s.fluidity),
          s.end_rate,
          s.constant_modulus,
          s.constant_fluidity,
          s.previous_scale,
          s.previous_forcing};
}

}  // namespace

CoupledSolver::CoupledSolver(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                             Start start, ModalGroup& main)
    : law_(law),
      change_(change),
      history_(history),
      scheme_(scheme),
      start_(start),
      main_(main),
      kernel_(kernels::best()),
      total_weight_(law.spectrum.modal_weight.sum()),
      feedbacks_(change.feedbacks),
      rows_(4 * main.padded()) {}

void CoupledSolver::solve(const RecordInputs<double>& base, const std::vector<Direction>& directions,
                          Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix>* derivatives) {
  const Sampled area(change_.load_bearing_area, 1.0);
  tolerance_ = directions.empty() ? tolerance_of_stress : tolerance_of_slopes;
  begin(base);
  stress[0] = area[0] * stress_here_;
  std::vector<CoupledTangent> tangents;
  tangents.reserve(directions.size());
  const auto put = [&](std::size_t k, Index instant, double slope) {
    const Sampled log_area(directions[k].log_load_bearing_area, 0.0);
    (*derivatives)(instant, static_cast<Index>(k)) =
        area[instant] * slope + stress[instant] * log_area[instant];
  };
  for (std::size_t k = 0; k < directions.size(); ++k) {
    tangents.emplace_back(*this, directions[k]);
    put(k, 0, tangents[k].start_slope());
  }
  LinearisedStep linearised(main_.padded());
  for (Index m = 0; m < history_.steps(); ++m) {
    solve_step(m, stress[m + 1]);
    stress[m + 1] = area[m + 1] * step_.stress;
    if (!tangents.empty()) linearised.at(*this);
    for (std::size_t k = 0; k < tangents.size(); ++k)
      put(k, m + 1, tangents[k].take(linearised, (*derivatives)(m + 1, static_cast<Index>(k))));
    take_step();
  }
}

void CoupledSolver::begin(const RecordInputs<double>& base) {
  const Index n = history_.size(), modes = law_.spectrum.modes();
  base_ = &base;
  inputs_ = base;
  spread(base.relaxed_stress, n, inputs_.relaxed_stress);
  spread(base.fluidity_begin, n - 1, inputs_.fluidity_begin);
  spread(base.fluidity_end, n - 1, inputs_.fluidity_end);

  // s = sum of the modal stresses; for a relaxed start it depends on s through the hardening's factor.
  const double base_relaxed = at(base.relaxed_stress, 0);
  double s = given_start() ? change_.initial_modal_stress.sum() : total_weight_ * base_relaxed;
  begun_ = feedbacks_.at_start({s, 1.0});
  for (int i = 0; i < most_iterations && !given_start(); ++i) {
    const Dual relaxed = total_weight_ * base_relaxed * begun_.hardening;
    const double correction = (relaxed.value - s) / (1.0 - relaxed.slope);
    s += correction;
    begun_ = feedbacks_.at_start({s, 1.0});
    if (small(correction, s, tolerance_of_slopes)) break;
  }
  step_.factor = begun_;
  fluidity_here_ = begun_.fluidity.value;
  const double relaxed = base_relaxed * begun_.hardening.value;
  inputs_.relaxed_stress[0] = relaxed;
  inputs_.fluidity_begin[0] *= begun_.fluidity.value;
  if (given_start())
    main_.state.head(modes) = change_.initial_modal_stress - law_.spectrum.modal_weight * relaxed;
  stress_here_ = s;
}

void CoupledSolver::solve_step(Index m, double extra_stress) {
  const double law_relaxed = at(base_->relaxed_stress, m + 1), law_fluidity = at(base_->fluidity_end, m);
  StepData<Dual> data =
      constants(step_data(history_, inputs_, m, step_.forcing.scale.value, step_.forcing.forcing.value));
  const double rise = data.true_strain.next.value - data.true_strain.here.value;
  const double modulus = 0.5 * (at(inputs_.unrelaxed_modulus, m) + at(inputs_.unrelaxed_modulus, m + 1));
  feedbacks_.enter(data.h, stress_here_, rise, modulus);
  step_.m = m;
  step_.ratio = data.ratio;
  // Newton on the stress at the end of the step, from a continuation of the steps before. There the modes are
  // passed through without waiting for the feedbacks, whose factors go on with the stress, too.
  const double change = continuation_.change(data.fresh, data.ratio, rise);
  double residual = 0.0;
  StepForcing<Dual> guess;
  double guessed_fluidity = 0.0, guessed_relaxed = 0.0;
  const auto guess_at = [&](double fluidity, double relaxed) {
    guessed_fluidity = fluidity;
    guessed_relaxed = relaxed;
    data.fluidity.next = {fluidity, 1.0};
    data.relaxed_stress.next = {relaxed, 1.0};
    guess = step_forcing(scheme_, start_, data);
  };
  const FeedbackFactor<double> factor = continued_factor(change, data.ratio);
  guess_at(law_fluidity * factor.fluidity, law_relaxed * factor.hardening);
  bool passed = guess.rule != StepRule::exponential;  // whose expansion would not reach the solution
  if (passed) expand(values(guess));
  // Where that leads nowhere, a straight continuation may lead there.
  for (double stress : {stress_here_ + change, stress_here_ + continuation_.straight(data.fresh, data.ratio)})
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      step_.factor = feedbacks_.at({stress, 1.0});
      step_.relaxed_stress = law_relaxed * step_.factor.hardening;
      step_.fluidity = law_fluidity * step_.factor.fluidity;
      const auto seen = [&] {
        if (scheme_ != Scheme::sa3)
          return straight(guess, step_.fluidity - guessed_fluidity, step_.relaxed_stress - guessed_relaxed);
        data.relaxed_stress.next = step_.relaxed_stress;
        data.fluidity.next = step_.fluidity;
        return step_forcing(scheme_, start_, data);
      };
      StepForcing<Dual> forcing = seen();
      if (!passed || !expanded_.reaches(forcing)) {
        guess_at(step_.fluidity.value, step_.relaxed_stress.value);
        forcing = seen();
        expand(values(forcing));
        passed = true;
      }
      const Dual excess = expanded_.stress(forcing) + total_weight_ * step_.relaxed_stress +
                          Dual(extra_stress - stress, -1.0);
      residual = excess.value;
      const double compliance = -1.0 / excess.slope, correction = excess.value * compliance;
      if (!std::isfinite(correction)) break;
      stress += correction;
      if (!small(correction, stress, tolerance_)) continue;
      continuation_.add(stress - stress_here_, rise,
                        compliance * expanded_.at.by_forcing[0] * modulus * end_weight(forcing.rule));
      const double fluidity_here = fluidity_here_;
      fluidity_here_ = step_.factor.fluidity.value + step_.factor.fluidity.slope * correction;
      fluidity_drift_ =
          fluidity_here_ - fluidity_here - step_.factor.fluidity.slope * (stress - stress_here_);
      // So near the solution that everything goes straight there.
      feedbacks_.settle(correction);
      step_.stress = stress;
      step_.relaxed_stress = moved(step_.relaxed_stress, correction);
      step_.fluidity = moved(step_.fluidity, correction);
      step_.factor = {moved(step_.factor.fluidity, correction), moved(step_.factor.hardening, correction)};
      step_.forcing = {forcing.rule, moved(forcing.scale, correction), moved(forcing.forcing, correction),
                       moved(forcing.curvature, correction)};
      return;
    }
  fail(m, std::abs(residual));
}

void CoupledSolver::expand(const StepForcing<double>& tried) {
  expanded_.tried = tried;
  kernel_.expand(main_.view(), one_step(expanded_.tried, step_.ratio), expanded_.at, rows_.data());
}

FeedbackFactor<double> CoupledSolver::continued_factor(double stress_change, double ratio) const {
  const Dual &fluidity = step_.factor.fluidity, &hardening = step_.factor.hardening;
  const double continued = fluidity.value + fluidity.slope * stress_change + ratio * fluidity_drift_;
  return {continued > 0.0 ? continued : fluidity.value, hardening.value + hardening.slope * stress_change};
}

void CoupledSolver::fail(Index m, double residual) const {
  std::ostringstream message;
  message << "the feedback's stress did not converge at t = " << history_.time()[m + 1]
          << " s; a finer time grid may help";
  throw ConvergenceError(message.str(), history_.time()[m + 1], residual);
}

void CoupledSolver::take_step() {
  const auto i = static_cast<std::size_t>(step_.m);
  kernel_.take(main_.view(), step_.forcing.rule, expanded_.nearby(values(step_.forcing)), rows_.data());
  feedbacks_.leave();
  inputs_.relaxed_stress[i + 1] = step_.relaxed_stress.value;
  inputs_.fluidity_end[i] = step_.fluidity.value;
  if (step_.m + 1 < history_.steps()) inputs_.fluidity_begin[i + 1] *= step_.factor.fluidity.value;
  stress_here_ = step_.stress;
}

}  // namespace probation
