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
constexpr double newton_tolerance = 1e-9;  // of the last correction, relative; Newton's error is its square

bool small(double correction, double stress) {
  return std::abs(correction) <= newton_tolerance * (1e-3 + std::abs(stress));
}

/// (1 - e^-a) / a with its slope.
Dual mean_decay_of(Dual a) {
  const double decayed = std::exp(-a.value), mean = mean_decay(a.value, decayed);
  return {mean, 0.5 * (curvature_decay(a.value, mean) - mean) * a.slope};
}

template <class Real>
StepForcing<double> values(const StepForcing<Real>& s) {
  return {s.rule, value(s.scale), value(s.forcing), value(s.curvature)};
}

StepForcing<double> values(const RecordSteps<Dual>& steps, std::size_t i) {
  return {steps.rule[i], steps.scale[i].value, steps.forcing[i].value, steps.curvature[i].value};
}

/// Samples of the law, one per instant (or per step), that feedbacks may change one by one.
std::vector<Dual> spread(const std::vector<double>& samples, Index length) {
  std::vector<Dual> all(static_cast<std::size_t>(length));
  for (Index i = 0; i < length; ++i) all[static_cast<std::size_t>(i)] = at(samples, i);
  return all;
}

void add(FeedbackShift<Dual>& total, const FeedbackShift<Dual>& shift) {
  total.log_relaxation_time = total.log_relaxation_time + shift.log_relaxation_time;
  total.log_hardening = total.log_hardening + shift.log_hardening;
}

/// Which parameter of feedback k moves along the direction.
std::size_t moving_parameter(const Direction* direction, std::size_t k) {
  const bool moves = direction && direction->feedback == static_cast<Index>(k);
  return moves ? direction->feedback_parameter : Feedback::no_parameter;
}

}  // namespace

CoupledSolver::CoupledSolver(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                             Start start, ModalGroup& main, ModalGroup& extra)
    : law_(law),
      change_(change),
      history_(history),
      scheme_(scheme),
      start_(start),
      main_(main),
      extra_(extra),
      kernel_(kernels::best()),
      total_weight_(law.spectrum.modal_weight.sum()) {}

FeedbackShift<Dual> CoupledSolver::start_shift(Dual stress, const Direction* direction) const {
  FeedbackShift<Dual> total;
  for (std::size_t k = 0; k < change_.feedbacks.size(); ++k)
    add(total, change_.feedbacks[k]->shift(stress, Dual(0.0), moving_parameter(direction, k)));
  return total;
}

FeedbackShift<Dual> CoupledSolver::shift(Dual stress_next, Dual stress_here, Dual rise, Dual modulus,
                                         double h, const std::vector<Dual>& memory,
                                         const Direction* direction, std::vector<Dual>& memory_next) const {
  // Plastic work of the step, sigma (de - d sigma / E_u), exact for a stress that is straight in it.
  const Dual mean_stress = 0.5 * (stress_here + stress_next);
  const Dual work = mean_stress * (modulus.value > 0.0 ? rise - (stress_next - stress_here) / modulus : rise);
  FeedbackShift<Dual> total;
  for (std::size_t k = 0; k < change_.feedbacks.size(); ++k) {
    const Feedback& feedback = *change_.feedbacks[k];
    const std::size_t parameter = moving_parameter(direction, k);
    const Dual loss = feedback.loss_rate(parameter) * h;
    memory_next[k] = exp(-loss) * memory[k] + mean_decay_of(loss) * work;
    add(total, feedback.shift(stress_next, memory_next[k], parameter));
  }
  return total;
}

void CoupledSolver::solve(const RecordInputs<double>& base, const std::vector<Direction>& directions,
                          Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix>* derivatives) {
  const Sampled area(change_.load_bearing_area, 1.0);
  begin(base);
  stress[0] = area[0] * stress_here_;

  // Tangents run beside, in unit-weight states that the pass itself does not need.
  ModalGroup unit = main_, unit_extra = extra_;
  if (!directions.empty()) unit.to_unit_weight(given_start() ? -inputs_.relaxed_stress[0].value : 0.0);
  std::vector<CoupledTangent> tangents;
  tangents.reserve(directions.size());
  const auto put = [&](std::size_t k, Index instant, double slope) {
    const Sampled log_area(directions[k].log_load_bearing_area, 0.0);
    (*derivatives)(instant, static_cast<Index>(k)) =
        area[instant] * slope + stress[instant] * log_area[instant];
  };
  for (std::size_t k = 0; k < directions.size(); ++k) {
    tangents.emplace_back(*this, directions[k], unit);
    put(k, 0, tangents[k].start_slope());
  }

  Eigen::ArrayXd scratch(9 * std::max(main_.padded(), extra_.padded()));
  for (Index m = 0; m < history_.steps(); ++m) {
    const Step step = solve_step(m);
    stress[m + 1] = area[m + 1] * step.stress;
    for (std::size_t k = 0; k < tangents.size(); ++k)
      put(k, m + 1, tangents[k].take(step, unit, unit_extra, scratch));
    if (!tangents.empty()) {
      double unused = 0.0;
      kernel_.tangent(unit.view(), one_step(step.forcing, step.ratio), &unused, nullptr, 0, scratch.data());
      if (!extra_.empty())
        kernel_.tangent(unit_extra.view(), one_step(step.extra, step.ratio), &unused, nullptr, 0,
                        scratch.data());
    }
    take(step);
  }
}

void CoupledSolver::begin(const RecordInputs<double>& base) {
  const Index n = history_.size(), modes = law_.spectrum.modes();
  base_ = &base;
  inputs_.true_strain = spread(base.true_strain, n);
  inputs_.relaxed_stress = spread(base.relaxed_stress, n);
  inputs_.unrelaxed_modulus =
      spread(base.unrelaxed_modulus, static_cast<Index>(base.unrelaxed_modulus.size()));
  inputs_.fluidity_begin = spread(base.fluidity_begin, n - 1);
  inputs_.fluidity_end = spread(base.fluidity_end, n - 1);
  if (!base.end_rate.empty()) inputs_.end_rate = spread(base.end_rate, n - 1);
  if (!extra_.empty()) {
    RecordInputs<Dual> extra;
    extra_inputs(inputs_, extra);
    form_steps(scheme_, start_, history_, extra, extra_steps_);
  }
  memory_.assign(change_.feedbacks.size(), Dual(0.0));
  memory_next_ = memory_;

  // s = sum of the modal stresses; for a relaxed start it depends on s through the shift of the hardening.
  const double base_relaxed = at(base.relaxed_stress, 0);
  double s = given_start() ? change_.initial_modal_stress.sum() : total_weight_ * base_relaxed;
  begun_ = start_shift({s, 1.0}, nullptr);
  for (int i = 0; i < most_iterations && !given_start(); ++i) {
    const Dual relaxed = total_weight_ * base_relaxed * exp(begun_.log_hardening);
    const double correction = (relaxed.value - s) / (1.0 - relaxed.slope);
    s += correction;
    begun_ = start_shift({s, 1.0}, nullptr);
    if (small(correction, s)) break;
  }
  const double relaxed = base_relaxed * std::exp(begun_.log_hardening.value);
  inputs_.relaxed_stress[0] = relaxed;
  inputs_.fluidity_begin[0] = inputs_.fluidity_begin[0] * std::exp(-begun_.log_relaxation_time.value);
  if (given_start())
    main_.state.head(modes) = change_.initial_modal_stress - law_.spectrum.modal_weight * relaxed;
  stress_here_ = s;
}

Dual CoupledSolver::residual(Index m, double stress, double extra_stress, StepForcing<Dual>& forcing,
                             FeedbackShift<Dual>& now) {
  const auto i = static_cast<std::size_t>(m);
  const Dual rise = inputs_.true_strain[i + 1] - inputs_.true_strain[i];
  const Dual modulus = 0.5 * (at(inputs_.unrelaxed_modulus, m) + at(inputs_.unrelaxed_modulus, m + 1));
  now = shift({stress, 1.0}, stress_here_, rise, modulus, history_.step()[m], memory_, nullptr, memory_next_);
  const Dual relaxed = at(base_->relaxed_stress, m + 1) * exp(now.log_hardening);
  inputs_.relaxed_stress[i + 1] = relaxed;
  inputs_.fluidity_end[i] = at(base_->fluidity_end, m) * exp(-now.log_relaxation_time);
  forcing =
      step_forcing(scheme_, start_, step_data(history_, inputs_, m, previous_scale_, previous_forcing_));
  const StepForcing<double> plain = values(forcing);
  const double ratio = history_.ratio(m);
  const kernels::Trial trial = kernel_.trial(main_.view(), one_step(plain, ratio));
  return {trial.stress + total_weight_ * relaxed.value + extra_stress - stress,
          trial.by_log_scale * forcing.scale.slope / forcing.scale.value +
              trial.by_forcing * forcing.forcing.slope + trial.by_curvature * forcing.curvature.slope +
              total_weight_ * relaxed.slope - 1.0};
}

CoupledSolver::Step CoupledSolver::solve_step(Index m) {
  Step step{};
  step.m = m;
  step.ratio = history_.ratio(m);
  if (!extra_.empty()) {
    step.extra = values(extra_steps_, static_cast<std::size_t>(m));
    kernel_.sweep(extra_.view(), one_step(step.extra, step.ratio), &step.extra_stress);
  }
  // Newton on the stress at the end of the step, from a straight continuation. The last evaluation is at the
  // converged stress, so that the step's inputs are those of the solution.
  step.stress = stress_here_ + (history_.fresh(m) ? 0.0 : stress_change_ * step.ratio);
  StepForcing<Dual> forcing;
  bool converged = false;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Dual found = residual(m, step.stress, step.extra_stress, forcing, step.shift);
    step.by_stress = found.slope;
    if (converged) {
      step.forcing = values(forcing);
      return step;
    }
    const double correction = -found.value / found.slope;
    if (!std::isfinite(correction)) break;
    converged = small(correction, step.stress);
    step.stress += correction;
  }
  std::ostringstream message;
  message << "the feedback's stress did not converge at t = " << history_.time()[m + 1]
          << " s; a finer time grid may help";
  throw ConvergenceError(message.str(), history_.time()[m + 1],
                         std::abs(residual(m, step.stress, step.extra_stress, forcing, step.shift).value));
}

void CoupledSolver::take(const Step& step) {
  const auto i = static_cast<std::size_t>(step.m);
  double unused = 0.0;
  kernel_.sweep(main_.view(), one_step(step.forcing, step.ratio), &unused);
  memory_.swap(memory_next_);
  for (Dual& memory : memory_) memory.slope = 0.0;
  inputs_.relaxed_stress[i + 1].slope = 0.0;
  inputs_.fluidity_end[i].slope = 0.0;
  if (step.m + 1 < history_.steps())
    inputs_.fluidity_begin[i + 1] =
        inputs_.fluidity_begin[i + 1] * std::exp(-step.shift.log_relaxation_time.value);
  previous_scale_ = step.forcing.scale;
  previous_forcing_ = step.forcing.forcing;
  stress_change_ = step.stress - stress_here_;
  stress_here_ = step.stress;
}

}  // namespace probation
