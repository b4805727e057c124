#include "coupled_tangent.hpp"

namespace probation {

using Eigen::Index;

CoupledTangent::CoupledTangent(const CoupledSolver& pass, const Direction& direction, const ModalGroup& unit)
    : pass_(pass),
      direction_(direction),
      d_weight_(direction.modal_weight.sum()),
      unit_(unit),
      unit_extra_(pass.extra_) {
  const History& history = pass.history_;
  form_inputs(pass.law_, pass.change_, history, pass.scheme_, *pass.base_, direction, inputs_);
  for (auto* samples : {&inputs_.fluidity_begin, &inputs_.fluidity_end})
    if (samples->size() == 1) samples->assign(static_cast<std::size_t>(history.steps()), (*samples)[0]);
  if (!pass.extra_.empty()) {
    RecordInputs<Dual> extra;
    extra_inputs(inputs_, extra);
    form_steps(pass.scheme_, pass.start_, history, extra, extra_steps_);
  }
  memory_.assign(pass.change_.feedbacks.size(), Dual(0.0));
  next_memory_ = memory_;
  before_.setZero(unit.padded());
  weight_ = unit.pad(direction.modal_weight);
  log_inverse_ = -unit.pad(direction.log_relaxation_ratio);
  extra_state_.setZero(pass.extra_.padded());
  extra_before_.setZero(pass.extra_.padded());
  extra_weight_ = pass.extra_.pad(direction.extra_modulus);
  extra_log_inverse_ = -pass.extra_.pad(direction.log_extra_time);

  // The start moves too: the stress and sigma^r(0) together.
  const double start = pass.stress_here_, relaxed = pass.inputs_.relaxed_stress[0].value;
  double slope = direction.initial_modal_stress.sum();
  if (!pass.given_start()) {
    const Dual held = inputs_.relaxed_stress[0] * exp(pass.start_shift(start, &direction).log_hardening);
    slope = (slope + pass.total_weight_ * held.slope + d_weight_ * relaxed) /
            (1.0 - pass.total_weight_ * relaxed * pass.begun_.log_hardening.slope);
  }
  stress_ = {start, slope};
  const FeedbackShift<Dual> begun = pass.start_shift(stress_, &direction);
  inputs_.relaxed_stress[0] = inputs_.relaxed_stress[0] * exp(begun.log_hardening);
  inputs_.fluidity_begin[0] = inputs_.fluidity_begin[0] * exp(-begun.log_relaxation_time);
  unit.start_slope(pass.change_, direction, relaxed, inputs_.relaxed_stress[0].slope, state_);
}

double CoupledTangent::take(const CoupledSolver::Step& step, const ModalGroup& unit,
                            const ModalGroup& unit_extra, Eigen::ArrayXd& scratch) {
  const auto i = static_cast<std::size_t>(step.m);
  law_relaxed_ = inputs_.relaxed_stress[i + 1];
  law_fluidity_ = inputs_.fluidity_end[i];
  const double extra = follow_extra(step, unit_extra, scratch);
  // With the stress held, the residual moves by what the direction does; the stress moves to cancel it.
  const double slope = -(follow(step, 0.0, unit, scratch) + extra) / step.by_stress;
  follow(step, slope, unit, scratch);
  state_ = next_state_;
  before_ = next_before_;
  memory_ = next_memory_;
  previous_ = next_;
  stress_ = {step.stress, slope};
  if (step.m + 1 < pass_.history_.steps())
    inputs_.fluidity_begin[i + 1] = inputs_.fluidity_begin[i + 1] * exp(-next_shift_.log_relaxation_time);
  return slope;
}

double CoupledTangent::follow(const CoupledSolver::Step& step, double moved, const ModalGroup& unit,
                              Eigen::ArrayXd& scratch) {
  const Index m = step.m;
  const auto i = static_cast<std::size_t>(m);
  const Dual rise = inputs_.true_strain[i + 1] - inputs_.true_strain[i];
  const Dual modulus = 0.5 * (at(inputs_.unrelaxed_modulus, m) + at(inputs_.unrelaxed_modulus, m + 1));
  next_shift_ = pass_.shift({step.stress, moved}, stress_, rise, modulus, pass_.history_.step()[m], memory_,
                            &direction_, next_memory_);
  const Dual relaxed = law_relaxed_ * exp(next_shift_.log_hardening);
  inputs_.relaxed_stress[i + 1] = relaxed;
  inputs_.fluidity_end[i] = law_fluidity_ * exp(-next_shift_.log_relaxation_time);
  next_ = step_forcing(pass_.scheme_, pass_.start_,
                       step_data(pass_.history_, inputs_, m, previous_.scale, previous_.forcing));
  unit_ = unit;
  next_state_ = state_;
  next_before_ = before_;
  const double du = next_.forcing.slope, dv = next_.curvature.slope;
  const double dx = next_.scale.slope / next_.scale.value;
  double unused = 0.0, slope = 0.0;
  const kernels::TangentDirection view{&du,
                                       &dv,
                                       &dx,
                                       log_inverse_.size() ? log_inverse_.data() : nullptr,
                                       weight_.size() ? weight_.data() : nullptr,
                                       next_state_.data(),
                                       next_before_.data(),
                                       &slope};
  pass_.kernel_.tangent(unit_.view(), one_step(step.forcing, step.ratio), &unused, &view, 1, scratch.data());
  return slope + pass_.total_weight_ * relaxed.slope + d_weight_ * relaxed.value;
}

double CoupledTangent::follow_extra(const CoupledSolver::Step& step, const ModalGroup& unit_extra,
                                    Eigen::ArrayXd& scratch) {
  if (unit_extra.empty()) return 0.0;
  const auto i = static_cast<std::size_t>(step.m);
  unit_extra_ = unit_extra;
  const double du = extra_steps_.forcing[i].slope, dv = extra_steps_.curvature[i].slope;
  double unused = 0.0, slope = 0.0;
  const kernels::TangentDirection view{&du,
                                       &dv,
                                       nullptr,
                                       extra_log_inverse_.size() ? extra_log_inverse_.data() : nullptr,
                                       extra_weight_.size() ? extra_weight_.data() : nullptr,
                                       extra_state_.data(),
                                       extra_before_.data(),
                                       &slope};
  pass_.kernel_.tangent(unit_extra_.view(), one_step(step.extra, step.ratio), &unused, &view, 1,
                        scratch.data());
  return slope;
}

}  // namespace probation
