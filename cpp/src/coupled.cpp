#include "coupled.hpp"

#include <cmath>
#include <string>

#include "probation/errors.hpp"

namespace probation {
namespace {

using Eigen::Index;
constexpr int most_iterations = 50;
constexpr double newton_tolerance = 1e-9;  // of the last correction, relative; Newton's error is its square

Dual slope_at(double value) { return {value, 1.0}; }

/// e^-a and (1 - e^-a) / a with slopes.
Dual decay_of(Dual a) { return exp(-a); }
Dual mean_decay_of(Dual a) {
  const double decayed = std::exp(-a.value), mean = mean_decay(a.value, decayed);
  return {mean, 0.5 * (curvature_decay(a.value, mean) - mean) * a.slope};
}

kernels::Steps one_step(const StepForcing<double>& s, const double& ratio) {
  return {s.rule,
          1,
          false,
          &s.scale,
          &ratio,
          &s.forcing,
          s.rule == StepRule::exponential ? &s.curvature : nullptr};
}

StepForcing<double> values(const StepForcing<Dual>& s) {
  return {s.rule, s.scale.value, s.forcing.value, s.curvature.value};
}

/// What a step's stress does when its inputs move: the trial's sums by the slopes of the inputs.
double moved(const kernels::Trial& trial, const StepForcing<Dual>& s) {
  return trial.by_log_scale * s.scale.slope / s.scale.value + trial.by_forcing * s.forcing.slope +
         trial.by_curvature * s.curvature.slope;
}

}  // namespace

/// The moving parts of one direction: everything that is kept from step to step, with its slope.
struct CoupledSolver::Tangent {
  const Direction* direction = nullptr;
  RecordInputs<Dual> inputs;  // actual ones (shifts included) up to the current instant
  std::vector<Dual> memory;
  Dual stress;
  Dual previous_scale, previous_forcing;
  Eigen::ArrayXd state, before, log_inverse, weight;  // main modes, unit weight
  Eigen::ArrayXd extra_state, extra_before, extra_log_inverse, extra_weight;
  RecordSteps<Dual> extra_steps;
};

CoupledSolver::CoupledSolver(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                             Start start, ModalGroup& main, ModalGroup& extra)
    : law_(law),
      change_(change),
      history_(history),
      scheme_(scheme),
      start_(start),
      main_(main),
      extra_(extra) {}

FeedbackShift<Dual> CoupledSolver::start_shift(Dual stress, const Direction* direction) const {
  FeedbackShift<Dual> total;
  for (std::size_t k = 0; k < change_.feedbacks.size(); ++k) {
    const bool moves = direction && direction->feedback == static_cast<Index>(k);
    const auto shift = change_.feedbacks[k]->shift(
        stress, Dual(0.0), moves ? direction->feedback_parameter : Feedback::no_parameter);
    total.log_relaxation_time = total.log_relaxation_time + shift.log_relaxation_time;
    total.log_hardening = total.log_hardening + shift.log_hardening;
  }
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
    const bool moves = direction && direction->feedback == static_cast<Index>(k);
    const std::size_t parameter = moves ? direction->feedback_parameter : Feedback::no_parameter;
    const Dual loss = feedback.loss_rate(parameter) * h;
    memory_next[k] = decay_of(loss) * memory[k] + mean_decay_of(loss) * work;
    const auto shift = feedback.shift(stress_next, memory_next[k], parameter);
    total.log_relaxation_time = total.log_relaxation_time + shift.log_relaxation_time;
    total.log_hardening = total.log_hardening + shift.log_hardening;
  }
  return total;
}

void CoupledSolver::solve(const RecordInputs<double>& base, const std::vector<Direction>& directions,
                          Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix>* derivatives) {
  const kernels::Kernels& kernel = kernels::best();
  const Index n = history_.size(), modes = law_.spectrum.modes();
  const double total_weight = law_.spectrum.modal_weight.sum();
  const std::size_t feedbacks = change_.feedbacks.size();
  const Sampled area(change_.load_bearing_area, 1.0);
  const bool given_start = change_.initial_modal_stress.size() > 0;

  // Actual inputs: those of the law times what the feedbacks make of them, filled in as the pass goes on.
  RecordInputs<Dual> in;
  const auto spread = [](const std::vector<double>& from, Index length, std::vector<Dual>& to) {
    to.resize(static_cast<std::size_t>(length));
    for (Index i = 0; i < length; ++i) to[static_cast<std::size_t>(i)] = at(from, i);
  };
  spread(base.true_strain, n, in.true_strain);
  spread(base.relaxed_stress, n, in.relaxed_stress);
  spread(base.unrelaxed_modulus, static_cast<Index>(base.unrelaxed_modulus.size()), in.unrelaxed_modulus);
  spread(base.fluidity_begin, n - 1, in.fluidity_begin);
  spread(base.fluidity_end, n - 1, in.fluidity_end);
  if (!base.end_rate.empty()) spread(base.end_rate, n - 1, in.end_rate);

  // The start: s = sum of modal stresses, which for a relaxed start depends on s through the shift of the
  // hardening.
  const double base_relaxed = at(base.relaxed_stress, 0);
  double s = given_start ? change_.initial_modal_stress.sum() : total_weight * base_relaxed;
  FeedbackShift<Dual> begun = start_shift(slope_at(s), nullptr);
  if (!given_start) {
    for (int i = 0; i < most_iterations; ++i) {
      const Dual relaxed = total_weight * base_relaxed * exp(begun.log_hardening);
      const double correction = (relaxed.value - s) / (1.0 - relaxed.slope);
      s += correction;
      begun = start_shift(slope_at(s), nullptr);
      if (std::abs(correction) <= newton_tolerance * (1e-3 + std::abs(s))) break;
    }
  }
  const double start_relaxed = base_relaxed * std::exp(begun.log_hardening.value);
  in.relaxed_stress[0] = start_relaxed;
  in.fluidity_begin[0] = in.fluidity_begin[0] * std::exp(-begun.log_relaxation_time.value);
  if (given_start)
    main_.state.head(modes) = change_.initial_modal_stress - law_.spectrum.modal_weight * start_relaxed;
  stress[0] = area[0] * s;

  // Tangents run beside, in unit-weight states.
  ModalGroup unit = main_, unit_extra = extra_;
  Eigen::ArrayXd scratch(9 * std::max(main_.padded(), extra_.padded()));
  std::vector<Tangent> tangents(directions.size());
  RecordInputs<Dual> extra_in, extra_dual;
  RecordSteps<Dual> extra_steps;
  RecordInputs<Dual> plain_extra;
  extra_inputs(in, plain_extra);
  if (!extra_.empty()) form_steps(scheme_, start_, history_, plain_extra, extra_steps);
  if (!directions.empty()) unit.to_unit_weight(given_start ? -start_relaxed : 0.0);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    Tangent& t = tangents[k];
    const Direction& direction = directions[k];
    t.direction = &direction;
    form_inputs(law_, change_, history_, scheme_, base, direction, t.inputs);
    for (auto* samples : {&t.inputs.fluidity_begin, &t.inputs.fluidity_end})
      if (samples->size() == 1) samples->assign(static_cast<std::size_t>(n - 1), (*samples)[0]);
    t.memory.assign(feedbacks, Dual(0.0));
    t.before.setZero(unit.padded());
    t.weight = unit.pad(direction.modal_weight);
    t.log_inverse = -unit.pad(direction.log_relaxation_ratio);
    t.extra_state.setZero(unit_extra.padded());
    t.extra_before.setZero(unit_extra.padded());
    t.extra_weight = unit_extra.pad(direction.extra_modulus);
    t.extra_log_inverse = -unit_extra.pad(direction.log_extra_time);
    if (!extra_.empty()) {
      extra_inputs(t.inputs, extra_dual);
      form_steps(scheme_, start_, history_, extra_dual, t.extra_steps);
    }

    // The start moves too: s and sigma^r(0) together.
    const double d_weight = direction.modal_weight.sum();
    const Dual fixed = start_shift(Dual(s), &direction).log_hardening;
    const Dual explicit_relaxed = t.inputs.relaxed_stress[0] * exp(fixed);
    double ds = direction.initial_modal_stress.sum();
    if (!given_start)
      ds = (ds + total_weight * explicit_relaxed.slope + d_weight * start_relaxed) /
           (1.0 - total_weight * start_relaxed * begun.log_hardening.slope);
    const FeedbackShift<Dual> started = start_shift({s, ds}, &direction);
    t.stress = {s, ds};
    t.inputs.relaxed_stress[0] = t.inputs.relaxed_stress[0] * exp(started.log_hardening);
    t.inputs.fluidity_begin[0] = t.inputs.fluidity_begin[0] * exp(-started.log_relaxation_time);
    unit.start_slope(change_, direction, start_relaxed, t.inputs.relaxed_stress[0].slope, t.state);
    (*derivatives)(0, static_cast<Index>(k)) =
        area[0] * ds + stress[0] * Sampled(direction.log_load_bearing_area, 0.0)[0];
  }

  std::vector<Dual> memory(feedbacks, Dual(0.0)), memory_next(feedbacks), tangent_memory(feedbacks);
  Dual previous_scale, previous_forcing;
  ModalGroup unit_before = unit, unit_extra_before = unit_extra;
  Eigen::ArrayXd next_state(unit.padded()), next_before(unit.padded());
  double s_here = s, s_change = 0.0;
  for (Index m = 0; m < history_.steps(); ++m) {
    const auto i = static_cast<std::size_t>(m);
    const double h = history_.step()[m], ratio = history_.ratio(m);
    const double base_fluidity = at(base.fluidity_end, m), base_next = at(base.relaxed_stress, m + 1);
    const Dual rise = in.true_strain[i + 1] - in.true_strain[i];
    const Dual modulus = 0.5 * (at(in.unrelaxed_modulus, m) + at(in.unrelaxed_modulus, m + 1));

    double extra_stress = 0.0;
    StepForcing<double> extra_forcing{};
    if (!extra_.empty()) {
      extra_forcing = {extra_steps.rule[i], extra_steps.scale[i].value, extra_steps.forcing[i].value,
                       extra_steps.curvature[i].value};
      kernel.sweep(extra_.view(), one_step(extra_forcing, ratio), &extra_stress);
    }

    // Newton on the stress at the end of the step, from a straight continuation.
    double next = s_here + (history_.fresh(m) ? 0.0 : s_change * ratio);
    StepForcing<Dual> forcing;
    kernels::Trial trial{};
    Dual relaxed, residual;
    bool converged = false;
    for (int iteration = 0; iteration < most_iterations && !converged; ++iteration) {
      const FeedbackShift<Dual> now =
          shift(slope_at(next), Dual(s_here), rise, modulus, h, memory, nullptr, memory_next);
      relaxed = base_next * exp(now.log_hardening);
      in.relaxed_stress[i + 1] = relaxed;
      in.fluidity_end[i] = base_fluidity * exp(-now.log_relaxation_time);
      forcing = step_forcing(scheme_, start_, step_data(history_, in, m, previous_scale, previous_forcing));
      const StepForcing<double> plain = values(forcing);
      trial = kernel.trial(main_.view(), one_step(plain, ratio));
      residual = {trial.stress + total_weight * relaxed.value + extra_stress - next,
                  moved(trial, forcing) + total_weight * relaxed.slope - 1.0};
      const double correction = -residual.value / residual.slope;
      if (!std::isfinite(correction)) break;
      converged = std::abs(correction) <= newton_tolerance * (1e-3 + std::abs(next));
      next += correction;
    }
    if (!converged)
      throw ConvergenceError("the feedback's stress did not converge at t = " +
                                 std::to_string(history_.time()[m + 1]) + " s; a finer time grid may help",
                             history_.time()[m + 1], std::abs(residual.value));

    // Taken: everything once more at the converged stress (the last correction was below the tolerance), for
    // good.
    const FeedbackShift<Dual> now =
        shift(slope_at(next), Dual(s_here), rise, modulus, h, memory, nullptr, memory_next);
    relaxed = base_next * exp(now.log_hardening);
    in.relaxed_stress[i + 1] = relaxed;
    in.fluidity_end[i] = base_fluidity * exp(-now.log_relaxation_time);
    forcing = step_forcing(scheme_, start_, step_data(history_, in, m, previous_scale, previous_forcing));
    const StepForcing<double> plain = values(forcing);
    if (!directions.empty()) trial = kernel.trial(main_.view(), one_step(plain, ratio));
    const double by_stress = moved(trial, forcing) + total_weight * relaxed.slope - 1.0;
    double modal = 0.0;
    kernel.sweep(main_.view(), one_step(plain, ratio), &modal);
    stress[m + 1] = area[m + 1] * (modal + total_weight * relaxed.value + extra_stress);

    if (!directions.empty()) {
      unit_before = unit;
      unit_extra_before = unit_extra;
    }
    for (std::size_t k = 0; k < directions.size(); ++k) {
      Tangent& t = tangents[k];
      const Dual d_rise = t.inputs.true_strain[i + 1] - t.inputs.true_strain[i];
      const Dual d_modulus =
          0.5 * (at(t.inputs.unrelaxed_modulus, m) + at(t.inputs.unrelaxed_modulus, m + 1));
      const Dual law_relaxed = t.inputs.relaxed_stress[i + 1], law_fluidity = t.inputs.fluidity_end[i];
      double extra_slope = 0.0;
      if (!extra_.empty()) {
        unit_extra = unit_extra_before;
        double unused = 0.0;
        const double du = t.extra_steps.forcing[i].slope, dv = t.extra_steps.curvature[i].slope;
        const kernels::TangentDirection view{
            &du,
            &dv,
            nullptr,
            t.extra_log_inverse.size() ? t.extra_log_inverse.data() : nullptr,
            t.extra_weight.size() ? t.extra_weight.data() : nullptr,
            t.extra_state.data(),
            t.extra_before.data(),
            &extra_slope};
        kernel.tangent(unit_extra.view(), one_step(extra_forcing, ratio), &unused, &view, 1, scratch.data());
      }

      // One pass with the stress held gives its slope (implicit function theorem); the second takes the step.
      const auto pass = [&](double ds, bool take) {
        const FeedbackShift<Dual> moving =
            shift({next, ds}, t.stress, d_rise, d_modulus, h, t.memory, t.direction, tangent_memory);
        t.inputs.relaxed_stress[i + 1] = law_relaxed * exp(moving.log_hardening);
        t.inputs.fluidity_end[i] = law_fluidity * exp(-moving.log_relaxation_time);
        const StepForcing<Dual> f = step_forcing(
            scheme_, start_, step_data(history_, t.inputs, m, t.previous_scale, t.previous_forcing));
        unit = unit_before;
        next_state = t.state;
        next_before = t.before;
        const double du = f.forcing.slope, dv = f.curvature.slope, dx = f.scale.slope / f.scale.value;
        double unused = 0.0, slope = 0.0;
        const kernels::TangentDirection view{&du,
                                             &dv,
                                             &dx,
                                             t.log_inverse.size() ? t.log_inverse.data() : nullptr,
                                             t.weight.size() ? t.weight.data() : nullptr,
                                             next_state.data(),
                                             next_before.data(),
                                             &slope};
        kernel.tangent(unit.view(), one_step(plain, ratio), &unused, &view, 1, scratch.data());
        if (take) {
          t.state = next_state;
          t.before = next_before;
          t.previous_scale = f.scale;
          t.previous_forcing = f.forcing;
          t.memory = tangent_memory;
          if (m + 1 < history_.steps())
            t.inputs.fluidity_begin[i + 1] =
                t.inputs.fluidity_begin[i + 1] * exp(-moving.log_relaxation_time);
        }
        return slope + total_weight * t.inputs.relaxed_stress[i + 1].slope +
               t.direction->modal_weight.sum() * t.inputs.relaxed_stress[i + 1].value + extra_slope;
      };
      const double ds = -pass(0.0, false) / by_stress;
      pass(ds, true);
      t.stress = {next, ds};
      (*derivatives)(m + 1, static_cast<Index>(k)) =
          area[m + 1] * ds + stress[m + 1] * Sampled(t.direction->log_load_bearing_area, 0.0)[m + 1];
    }
    if (!directions.empty() && !extra_.empty()) {
      double unused = 0.0;
      unit_extra = unit_extra_before;
      kernel.tangent(unit_extra.view(), one_step(extra_forcing, ratio), &unused, nullptr, 0, scratch.data());
    }

    for (std::size_t k = 0; k < feedbacks; ++k) memory[k] = memory_next[k].value;
    in.relaxed_stress[i + 1] = relaxed.value;
    in.fluidity_end[i] = in.fluidity_end[i].value;
    if (m + 1 < history_.steps())
      in.fluidity_begin[i + 1] = in.fluidity_begin[i + 1] * std::exp(-now.log_relaxation_time.value);
    previous_scale = forcing.scale.value;
    previous_forcing = forcing.forcing.value;
    s_change = next - s_here;
    s_here = next;
  }
}

}  // namespace probation
