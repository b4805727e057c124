#include "coupled_tangent.hpp"

namespace probation {
namespace {

using Eigen::Index;

/// factor times a law's sample, both with slopes; the factor's slope is that of its logarithm.
Dual scaled(Dual sample, double factor, double d_log_factor) {
  const double value = sample.value * factor;
  return {value, sample.slope * factor + value * d_log_factor};
}

kernels::StepChange change_of(const StepForcing<Dual>& step) {
  return {step.scale.slope / step.scale.value, step.forcing.slope, step.curvature.slope};
}

double stress_change(const kernels::StepSlopes& slopes, const kernels::StepChange& change) {
  return slopes.by_log_scale * change.log_scale + slopes.by_forcing * change.forcing +
         slopes.by_curvature * change.curvature;
}

}  // namespace

void LinearisedStep::at(CoupledSolver& pass) {
  const CoupledStep& step = pass.step_;
  forcing = values(step.forcing);
  slopes = pass.kernel_.linearise(pass.main_.view(), one_step(forcing, step.ratio), rows.data());
  by_stress = change_of(step.forcing);
  residual_by_stress =
      stress_change(slopes, by_stress) + pass.total_weight_ * step.relaxed_stress.slope - 1.0;
  pass.feedbacks_.differentiate(step.stress);
}

CoupledTangent::CoupledTangent(const CoupledSolver& pass, const Direction& direction)
    : pass_(pass),
      direction_(direction),
      d_weight_(direction.modal_weight.sum()),
      feedback_(pass.feedbacks_.still()),
      before_(Eigen::ArrayXd::Zero(pass.main_.padded())) {
  const History& history = pass.history_;
  form_inputs(pass.law_, pass.change_, history, pass.scheme_, *pass.base_, direction, inputs_);
  for (auto* samples : {&inputs_.fluidity_begin, &inputs_.fluidity_end})
    if (samples->size() == 1) samples->assign(static_cast<std::size_t>(history.steps()), (*samples)[0]);
  weight_ = pass.main_.pad(direction.modal_weight);
  log_inverse_ = -pass.main_.pad(direction.log_relaxation_ratio);

  // The start moves too: the stress and sigma^r(0) together.
  const double start = pass.stress_here_, relaxed = pass.relaxed_start_;
  d_stress_ = direction.initial_modal_stress.sum();
  if (!pass.given_start()) {
    const Dual held = inputs_.relaxed_stress[0] * pass.feedbacks_.at_start(start, direction).hardening;
    const double by_stress = relaxed * pass.begun_.hardening.slope / pass.begun_.hardening.value;
    d_stress_ = (d_stress_ + pass.total_weight_ * held.slope + d_weight_ * relaxed) /
                (1.0 - pass.total_weight_ * by_stress);
  }
  const FeedbackFactor<Dual> begun = pass.feedbacks_.at_start({start, d_stress_}, direction);
  inputs_.relaxed_stress[0] = inputs_.relaxed_stress[0] * begun.hardening;
  inputs_.fluidity_begin[0] = inputs_.fluidity_begin[0] * begun.fluidity;
  ModalGroup unit = pass.main_;
  unit.to_unit_weight(pass.given_start() ? -relaxed : 0.0);
  unit.start_slope(pass.change_, direction, relaxed, inputs_.relaxed_stress[0].slope, state_);
  state_ *= unit.weight;
  if (weight_.size() > 0) state_ += weight_ * unit.state;
}

double CoupledTangent::take(const LinearisedStep& linearised, double extra) {
  const CoupledStep& step = pass_.step_;
  const FeedbackFactor<Dual>& factor = step.factor;
  const Index m = step.m;
  const auto i = static_cast<std::size_t>(m);
  StepData<Dual> data = step_data(pass_.history_, inputs_, m, previous_.scale, previous_.forcing);

  const Dual modulus = 0.5 * (at(inputs_.unrelaxed_modulus, m) + at(inputs_.unrelaxed_modulus, m + 1));
  const Dual work = plastic_work<Dual>(step.stress, {pass_.stress_here_, d_stress_},
                                       data.true_strain.next - data.true_strain.here, modulus);
  pass_.feedbacks_.hold(step.stress, work, direction_, feedback_);
  Dual& relaxed = inputs_.relaxed_stress[i + 1];
  Dual& fluidity = inputs_.fluidity_end[i];
  relaxed = data.relaxed_stress.next =
      scaled(relaxed, factor.hardening.value, feedback_.log_factor.hardening);
  fluidity = data.fluidity.next = scaled(fluidity, factor.fluidity.value, feedback_.log_factor.fluidity);
  previous_ = step_forcing(pass_.scheme_, pass_.start_, data);

  const kernels::Modes modes = pass_.main_.view();
  const kernels::StepDirection view{log_inverse_.size() ? log_inverse_.data() : nullptr,
                                    weight_.size() ? weight_.data() : nullptr, state_.data(), before_.data()};
  const double drift =
      pass_.kernel_.drift(modes, one_step(linearised.forcing, step.ratio), view, linearised.rows.data());
  const kernels::StepChange held = change_of(previous_);
  const double held_slope = drift + stress_change(linearised.slopes, held) +
                            pass_.total_weight_ * relaxed.slope + d_weight_ * relaxed.value + extra;
  d_stress_ = -held_slope / linearised.residual_by_stress;

  // And everything follows the stress.
  const kernels::StepChange& by = linearised.by_stress;
  pass_.kernel_.move(modes,
                     {held.log_scale + by.log_scale * d_stress_, held.forcing + by.forcing * d_stress_,
                      held.curvature + by.curvature * d_stress_},
                     view, linearised.rows.data());
  pass_.feedbacks_.release(d_stress_, feedback_);
  relaxed.slope += step.relaxed_stress.slope * d_stress_;
  fluidity.slope += step.fluidity.slope * d_stress_;
  previous_.scale.slope += step.forcing.scale.slope * d_stress_;
  previous_.forcing.slope += step.forcing.forcing.slope * d_stress_;
  if (m + 1 < pass_.history_.steps())
    inputs_.fluidity_begin[i + 1] =
        scaled(inputs_.fluidity_begin[i + 1], factor.fluidity.value,
               feedback_.log_factor.fluidity + factor.fluidity.slope / factor.fluidity.value * d_stress_);
  return d_stress_;
}

}  // namespace probation
