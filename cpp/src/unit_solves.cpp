#include "unit_solves.hpp"

#include <algorithm>

#include "kernel_runs.hpp"

namespace probation {

using Eigen::Index;

void UnitSolves::set_modes(const Spectrum& spectrum) {
  group_.set(spectrum.relaxation_ratio, spectrum.modal_weight);
  total_weight_ = spectrum.modal_weight.sum();
  kernel_scratch_.resize(9 * group_.padded());
}

void UnitSolves::keep(const RecordSteps<double>& steps, Forcing& forcing) {
  const auto count = static_cast<Index>(steps.forcing.size());
  forcing.forcing = Eigen::Map<const Eigen::ArrayXd>(steps.forcing.data(), count);
  forcing.curvature = Eigen::Map<const Eigen::ArrayXd>(steps.curvature.data(), count);
}

void UnitSolves::take(const Law& law, const History& history, Scheme scheme, Start start) {
  Law unit = law;
  unit.tau_max = unit.alpha = 1.0;
  unit.unrelaxed_modulus = 1.0;
  unit.hardening_modulus = 0.0;
  curved_ = scheme == Scheme::sa3;
  RecordRates rates;
  form_inputs(unit, {}, history, scheme, rates, inputs_);
  form_steps(scheme, start, history, inputs_, steps_);
  keep(steps_, stiff_);
  unit_scale_ = Eigen::Map<const Eigen::ArrayXd>(steps_.scale.data(), history.steps());
  runs_.clear();
  for_each_run(history, steps_.rule, inputs_.fluidity_end.size() == 1,
               [this](Index first, Index count, bool uniform) {
                 runs_.push_back({first, count, uniform});
                 if (uniform) unit_scale_.segment(first, count).setConstant(unit_scale_[first]);
               });
  // The same steps with the other forcing.
  inputs_.unrelaxed_modulus[0] = 0.0;
  inputs_.relaxed_stress.assign(history.haward_thackray_strain().data(),
                                history.haward_thackray_strain().data() + history.size());
  form_steps(scheme, start, history, inputs_, steps_);
  keep(steps_, relaxed_);
  rule_ = steps_.rule;
  ratio_ = steps_.ratio;
  strain_ = history.true_strain();
  hardening_ = history.haward_thackray_strain();
  instants_.resize(static_cast<std::size_t>(history.size()));
  for (std::size_t i = 0; i < instants_.size(); ++i) instants_[i] = static_cast<Index>(i);
}

void UnitSolves::take_thinned(const UnitSolves& full, Index stride) {
  instants_.clear();
  for (Index i = 0; i < full.size(); i += stride) instants_.push_back(i);
  if (instants_.back() != full.size() - 1) instants_.push_back(full.size() - 1);
  const Index n = size(), steps = n - 1;
  strain_.resize(n);
  hardening_.resize(n);
  for (Index i = 0; i < n; ++i) {
    strain_[i] = full.strain_[instants_[static_cast<std::size_t>(i)]];
    hardening_[i] = full.hardening_[instants_[static_cast<std::size_t>(i)]];
  }
  unit_scale_.resize(steps);
  for (Index m = 0; m < steps; ++m) {
    const Index first = instants_[static_cast<std::size_t>(m)];
    unit_scale_[m] =
        full.unit_scale_.segment(first, instants_[static_cast<std::size_t>(m) + 1] - first).sum();
  }
  stiff_.forcing = strain_.tail(steps) - strain_.head(steps);
  relaxed_.forcing = hardening_.head(steps) - hardening_.tail(steps);
  curved_ = false;
  rule_.assign(static_cast<std::size_t>(steps), StepRule::exponential);
  ratio_.assign(static_cast<std::size_t>(steps), 1.0);
  Index even = 1;
  while (even < steps && std::abs(unit_scale_[even] - unit_scale_[0]) <= 1e-9 * unit_scale_[0]) ++even;
  runs_.clear();
  if (even > 1) runs_.push_back({0, even, true});
  if (even == 1) even = 0;
  if (even < steps) runs_.push_back({even, steps - even, false});
}

void UnitSolves::sweep(const Forcing& forcing, double* stress) {
  group_.state.setZero();
  group_.before.setZero();
  for (const Run& run : runs_) {
    const kernels::Steps part = steps_of(run, forcing);
    kernels::best().sweep(modes_for(part, group_), part, stress + run.first + 1);
  }
}

kernels::Steps UnitSolves::steps_of(const Run& run, const Forcing& forcing) const {
  const auto m = static_cast<std::size_t>(run.first);
  return {rule_[m],
          static_cast<int>(run.count),
          run.uniform,
          &scale_[run.first],
          &ratio_[m],
          &forcing.forcing[run.first],
          curved_ ? &forcing.curvature[run.first] : nullptr};
}

/// In an even run only the scale of the first step is needed.
void UnitSolves::set_time(double time) {
  scale_.resize(unit_scale_.size());
  for (const Run& run : runs_) {
    const Index count = run.uniform ? 1 : run.count;
    scale_.segment(run.first, count) = unit_scale_.segment(run.first, count) * (1.0 / time);
  }
}

void UnitSolves::solve(double time) {
  set_time(time);
  u_.setZero(size());
  sweep(stiff_, u_.data());
  v_ = total_weight_ * hardening_;
  sweep(relaxed_, v_.data());
}

/// The forcing of E_u u + G v.
void UnitSolves::combine(double unrelaxed_modulus, double hardening_modulus) {
  both_.forcing = unrelaxed_modulus * stiff_.forcing + hardening_modulus * relaxed_.forcing;
  if (!curved_) return;
  both_.curvature.resize(both_.forcing.size());
  for (const Run& run : runs_) {
    const Index count = run.uniform ? 1 : run.count;
    both_.curvature.segment(run.first, count) =
        unrelaxed_modulus * stiff_.curvature.segment(run.first, count) +
        hardening_modulus * relaxed_.curvature.segment(run.first, count);
  }
}

void UnitSolves::stress(double unrelaxed_modulus, double time, double hardening_modulus,
                        Eigen::Ref<Eigen::ArrayXd> out) {
  set_time(time);
  combine(unrelaxed_modulus, hardening_modulus);
  out = (total_weight_ * hardening_modulus) * hardening_;
  sweep(both_, out.data());
}

const Eigen::ArrayXd& UnitSolves::slope(double unrelaxed_modulus, double hardening_modulus) {
  const Index steps = size() - 1;
  combine(unrelaxed_modulus, hardening_modulus);
  group_.state.setZero();
  group_.before.setZero();
  slope_state_.setZero(group_.padded());
  slope_before_.setZero(group_.padded());
  slope_.setZero(size());
  ignored_.setZero(size());
  minus_one_.setConstant(steps, -1.0);
  for (const Run& run : runs_) {
    const kernels::Steps part = steps_of(run, both_);
    const kernels::TangentDirection time{nullptr,
                                         nullptr,
                                         minus_one_.data(),
                                         nullptr,
                                         nullptr,
                                         slope_state_.data(),
                                         slope_before_.data(),
                                         slope_.data() + run.first + 1};
    kernels::best().tangent(modes_for(part, group_), part, ignored_.data() + run.first + 1, &time, 1,
                            kernel_scratch_.data());
  }
  return slope_;
}

}  // namespace probation
