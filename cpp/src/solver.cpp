#include "probation/solver.hpp"

#include <algorithm>
#include <mutex>
#include <string>

#include "coupled.hpp"
#include "flush_subnormals.hpp"
#include "kernel_runs.hpp"
#include "kernels/kernels.hpp"
#include "modal_group.hpp"
#include "probation/errors.hpp"
#include "probation/schemes/exact.hpp"
#include "record_steps.hpp"
#include "require_finite.hpp"

namespace probation {

using Eigen::Index;

/// One direction's states and outputs while a tangent is swept.
struct TangentState {
  Eigen::ArrayXd state, before, log_inverse, weight, stress;
  std::vector<double> forcing, curvature, log_scale;

  void take(const RecordSteps<Dual>& steps) {
    const std::size_t n = steps.scale.size();
    forcing.resize(n);
    curvature.resize(n);
    log_scale.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      forcing[i] = steps.forcing[i].slope;
      curvature[i] = steps.curvature[i].slope;
      // A step too short to change any mode changes no derivative either.
      log_scale[i] = steps.scale[i].value > 0.0 ? steps.scale[i].slope / steps.scale[i].value : 0.0;
    }
  }
  /// A direction in which the steps are linear: their forcing is that of the inputs' derivatives, which it
  /// replaces.
  void take_linear(RecordSteps<double>& steps) {
    std::swap(forcing, steps.forcing);
    std::swap(curvature, steps.curvature);
    log_scale.clear();
  }
  /// Whether the direction is a solve of its own: nothing of it multiplies the state of the base solve.
  bool linear() const { return log_scale.empty() && log_inverse.size() == 0 && weight.size() == 0; }
  /// All times change by one factor: no forcing does, for any scheme.
  void take_time_shift(std::size_t steps, double log_time) {
    forcing.clear();
    curvature.clear();
    log_scale.assign(steps, -log_time);
  }
  kernels::TangentDirection view(Index first) {
    const auto i = static_cast<std::size_t>(first);
    const auto from = [i](const std::vector<double>& samples) {
      return samples.empty() ? nullptr : &samples[i];
    };
    return {from(forcing),
            from(curvature),
            from(log_scale),
            log_inverse.size() ? log_inverse.data() : nullptr,
            weight.size() ? weight.data() : nullptr,
            state.data(),
            before.data(),
            stress.data() + first + 1};
  }
};

struct Solver::Workspace {
  RecordRates rates;
  RecordInputs<double> inputs, extra_in, slope_inputs;
  RecordSteps<double> steps, extra_steps, slope_steps;
  RecordInputs<Dual> dual_inputs, dual_extra;
  RecordSteps<Dual> dual_steps;
  ModalGroup main, extra;
  std::vector<TangentState> tangents;
  CoupledTables tables;
  bool coupled = false;  // whether the tables are in use
  CvodeStatistics cvode;
  std::mutex busy;

  void prepare(const Law& law, const LawChange& change, const History& history,
               const SolverOptions& options) {
    law.validate_parameters();
    if (!main.holds(law.spectrum)) law.spectrum.validate();
    change.validate(history.size(), law.spectrum.modes());
    form_inputs(law, change, history, options.scheme, rates, inputs);
    main.set(law.spectrum.relaxation_ratio, law.spectrum.modal_weight);
    if (change.initial_modal_stress.size() > 0)
      main.state.head(law.spectrum.modes()) =
          change.initial_modal_stress - law.spectrum.modal_weight * inputs.relaxed_stress[0];
    extra.set(change.extra_modes.relaxation_time, change.extra_modes.modulus);
  }
  Eigen::Map<const Eigen::ArrayXd> relaxed_stress() const {
    return {inputs.relaxed_stress.data(), static_cast<Index>(inputs.relaxed_stress.size())};
  }
};

Solver::Solver() : work_(std::make_unique<Workspace>()) {}
Solver::Solver(History history, SolverOptions options)
    : history_(std::move(history)), options_(options), work_(std::make_unique<Workspace>()) {}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::forget() {
  work_->rates = {};
  if (!work_->coupled) return;
  work_->tables = {};
  work_->coupled = false;
}

Solver& kept_solver() {
  constexpr Index most_kept = 100'000;  // samples: about ten megabytes in all
  thread_local Solver solver;
  if (solver.history().size() > most_kept) solver = Solver();
  return solver;
}

const History& Solver::history() const noexcept { return history_; }
const CvodeStatistics& Solver::cvode_statistics() const noexcept { return work_->cvode; }

namespace {

/// `samples` (n, 1 or none) as inputs of a record; none is zero.
void assign(const Eigen::ArrayXd& samples, std::vector<double>& to) {
  if (samples.size() == 0)
    to.assign(1, 0.0);
  else
    to.assign(samples.data(), samples.data() + samples.size());
}

/// Times `samples` (n, 1 or none).
void multiply(Eigen::Ref<Eigen::ArrayXd> stress, const Eigen::ArrayXd& samples) {
  if (samples.size() == 1) stress *= samples[0];
  if (samples.size() > 1) stress *= samples;
}

}  // namespace

void Solver::stress(const Law& law, const LawChange& change, Eigen::Ref<Eigen::ArrayXd> stress) {
  if (stress.size() != history_.size())
    throw InputError("out has " + std::to_string(stress.size()) + " entries; " +
                     std::to_string(history_.size()) + " are needed");
  const std::lock_guard<std::mutex> lock(work_->busy);
  solve(law, change, stress);
  require_finite(stress, history_.time(), "the stress");
}

void Solver::solve(const Law& law, const LawChange& change, Eigen::Ref<Eigen::ArrayXd>& stress) {
  if (options_.scheme == Scheme::exact) return exact_stress(law, change, history_, stress);
  if (options_.scheme == Scheme::cvode) {
    work_->cvode = cvode_stress(law, change, history_, options_.cvode, stress);
    return;
  }
  const FlushSubnormals flushing;
  Workspace& w = *work_;
  w.prepare(law, change, history_, options_);
  const kernels::Kernels& kernel = kernels::best();
  const bool coupled = !change.feedbacks.empty();
  if (coupled)
    stress.setZero();
  else
    stress = law.spectrum.modal_weight.sum() * w.relaxed_stress();
  const auto sweep = [&](ModalGroup& group, const RecordInputs<double>& inputs, RecordSteps<double>& steps) {
    form_steps(options_.scheme, options_.start, history_, inputs, steps);
    for_each_run(history_, steps.rule, inputs.fluidity_end.size() == 1,
                 [&](Index first, Index count, bool uniform) {
                   const kernels::Steps run = kernel_steps(options_.scheme, steps, first, count, uniform);
                   kernel.sweep(modes_for(run, group), run, stress.data() + first + 1);
                 });
  };
  if (!w.extra.empty()) {
    extra_inputs(w.inputs, w.extra_in);
    sweep(w.extra, w.extra_in, w.extra_steps);
  }
  if (coupled) {
    w.coupled = true;
    CoupledSolver(law, change, history_, options_.scheme, options_.start, w.main, w.tables)
        .solve(w.inputs, {}, stress, nullptr);
    return;
  }
  stress[0] += w.main.state.sum();
  sweep(w.main, w.inputs, w.steps);
  multiply(stress, change.load_bearing_area);
}

void Solver::tangent(const Law& law, const LawChange& change, const std::vector<Direction>& directions,
                     Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix> derivatives) {
  const Index n = history_.size(), count = static_cast<Index>(directions.size());
  if (stress.size() != n || derivatives.rows() != n || derivatives.cols() != count)
    throw InputError("out does not have the shape (n_times) and (n_times, directions)");
  if (options_.scheme == Scheme::exact || options_.scheme == Scheme::cvode)
    throw InputError("sensitivities are made by the schemes be2, sa2 and sa3 only");
  const std::lock_guard<std::mutex> lock(work_->busy);
  solve_tangent(law, change, directions, stress, derivatives);
  require_finite(stress, history_.time(), "the stress");
  // The columns are searched only where a value is not finite, to name it.
  const bool packed = derivatives.outerStride() == count;
  if (packed && kernels::best().samples.all_finite(derivatives.data(), derivatives.size())) return;
  for (Index k = 0; k < count; ++k) {
    const std::string name = "the derivative of the stress along direction " + std::to_string(k);
    require_finite(derivatives.col(k).array().eval(), history_.time(), name.c_str());
  }
}

void Solver::solve_tangent(const Law& law, const LawChange& change, const std::vector<Direction>& directions,
                           Eigen::Ref<Eigen::ArrayXd>& stress, Eigen::Ref<RowMajorMatrix>& derivatives) {
  const Index n = history_.size();
  Workspace& w = *work_;
  const FlushSubnormals flushing;
  w.prepare(law, change, history_, options_);
  for (const Direction& direction : directions)
    direction.validate(change, n, law.spectrum.modes(), history_.rate_given());
  const kernels::Kernels& kernel = kernels::best();
  const double total_weight = law.spectrum.modal_weight.sum();
  const bool feeds_back = !change.feedbacks.empty();
  if (feeds_back)
    stress.setZero();
  else
    stress = total_weight * w.relaxed_stress();

  std::vector<TangentState>& tangents = w.tangents;
  tangents.resize(directions.size());
  const auto sweep = [&](ModalGroup& group, const RecordInputs<double>& inputs, RecordSteps<double>& steps) {
    form_steps(options_.scheme, options_.start, history_, inputs, steps);
    const bool constant = inputs.fluidity_end.size() == 1;
    Eigen::ArrayXd scratch(9 * group.padded());
    std::vector<kernels::TangentDirection> views;
    const bool coupled =
        std::any_of(tangents.begin(), tangents.end(), [](const TangentState& t) { return !t.linear(); });
    if (!coupled) group.state *= group.weight;
    for_each_run(history_, steps.rule, constant, [&](Index first, Index length, bool uniform) {
      const kernels::Steps run = kernel_steps(options_.scheme, steps, first, length, uniform);
      if (!coupled) {
        kernel.sweep(modes_for(run, group), run, stress.data() + first + 1);
        return;
      }
      views.clear();
      for (TangentState& t : tangents)
        if (!t.linear()) views.push_back(t.view(first));
      kernel.tangent(modes_for(run, group), run, stress.data() + first + 1, views.data(),
                     static_cast<int>(views.size()), scratch.data());
    });
    for (TangentState& t : tangents) {
      if (!t.linear()) continue;
      Eigen::ArrayXd state = t.state * group.weight, before = Eigen::ArrayXd::Zero(group.padded());
      for_each_run(history_, steps.rule, constant, [&](Index first, Index length, bool uniform) {
        kernels::Steps linear = kernel_steps(options_.scheme, steps, first, length, uniform);
        linear.forcing = &t.forcing[static_cast<std::size_t>(first)];
        if (linear.curvature) linear.curvature = &t.curvature[static_cast<std::size_t>(first)];
        kernels::Modes alone = modes_for(linear, group);
        alone.state = state.data();
        alone.before = before.data();
        kernel.sweep(alone, linear, t.stress.data() + first + 1);
      });
    }
  };

  for (TangentState& t : tangents) t.stress.setZero(n);
  if (!w.extra.empty()) {
    extra_inputs(w.inputs, w.extra_in);
    for (std::size_t k = 0; k < directions.size(); ++k) {
      TangentState& t = tangents[k];
      form_inputs(law, change, history_, options_.scheme, w.inputs, directions[k], w.dual_inputs);
      extra_inputs(w.dual_inputs, w.dual_extra);
      form_steps(options_.scheme, options_.start, history_, w.dual_extra, w.dual_steps);
      t.take(w.dual_steps);
      t.state.setZero(w.extra.padded());
      t.before.setZero(w.extra.padded());
      t.weight = w.extra.pad(directions[k].extra_modulus);
      t.log_inverse = -w.extra.pad(directions[k].log_extra_time);
    }
    sweep(w.extra, w.extra_in, w.extra_steps);
  }
  if (feeds_back) {
    for (std::size_t k = 0; k < directions.size(); ++k)
      derivatives.col(static_cast<Index>(k)) = tangents[k].stress.matrix();
    CoupledSolver(law, change, history_, options_.scheme, options_.start, w.main, w.tables)
        .solve(w.inputs, directions, stress, &derivatives);
    return;
  }

  const double relaxed_start = w.inputs.relaxed_stress[0];
  stress[0] += w.main.state.sum();
  w.main.to_unit_weight(change.initial_modal_stress.size() > 0 ? -relaxed_start : 0.0);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Direction& direction = directions[k];
    TangentState& t = tangents[k];
    double relaxed_slope_start = 0.0;
    const bool strained = direction.true_strain.size() > 0 || direction.strain_rate.size() > 0;
    if (!strained && direction.log_relaxation_time.size() == 0) {
      w.slope_inputs = w.inputs;
      assign(direction.unrelaxed_modulus, w.slope_inputs.unrelaxed_modulus);
      assign(direction.relaxed_stress, w.slope_inputs.relaxed_stress);
      form_steps(options_.scheme, options_.start, history_, w.slope_inputs, w.slope_steps);
      t.take_linear(w.slope_steps);
      if (direction.relaxed_stress.size() > 1) t.stress += total_weight * direction.relaxed_stress;
      if (direction.relaxed_stress.size() == 1) t.stress += total_weight * direction.relaxed_stress[0];
      relaxed_slope_start = w.slope_inputs.relaxed_stress[0];
    } else if (!strained && direction.log_relaxation_time.size() == 1 &&
               direction.unrelaxed_modulus.size() == 0 && direction.relaxed_stress.size() == 0) {
      t.take_time_shift(static_cast<std::size_t>(history_.steps()), direction.log_relaxation_time[0]);
    } else {
      form_inputs(law, change, history_, options_.scheme, w.inputs, direction, w.dual_inputs);
      form_steps(options_.scheme, options_.start, history_, w.dual_inputs, w.dual_steps);
      t.take(w.dual_steps);
      for (Index i = 0; i < n; ++i)
        t.stress[i] += total_weight * w.dual_inputs.relaxed_stress[static_cast<std::size_t>(i)].slope;
      relaxed_slope_start = w.dual_inputs.relaxed_stress[0].slope;
    }
    if (direction.modal_weight.size() > 0) t.stress += direction.modal_weight.sum() * w.relaxed_stress();
    t.before.setZero(w.main.padded());
    t.weight = w.main.pad(direction.modal_weight);
    t.log_inverse = -w.main.pad(direction.log_relaxation_ratio);
    w.main.start_slope(change, direction, relaxed_start, relaxed_slope_start, t.state);
    t.stress[0] +=
        (w.main.weight * t.state).sum() + (t.weight.size() ? (t.weight * w.main.state).sum() : 0.0);
  }
  sweep(w.main, w.inputs, w.steps);

  multiply(stress, change.load_bearing_area);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    TangentState& t = tangents[k];
    multiply(t.stress, change.load_bearing_area);
    const Eigen::ArrayXd& log_area = directions[k].log_load_bearing_area;
    if (log_area.size() > 1) t.stress += stress * log_area;
    if (log_area.size() == 1) t.stress += stress * log_area[0];
    derivatives.col(static_cast<Index>(k)) = t.stress.matrix();
  }
}

const char* kernel_build() { return kernels::best().name; }

std::vector<Direction> parameter_directions(const Law& law, const LawChange& change, const History& history) {
  std::vector<Direction> directions(3);
  directions[0].unrelaxed_modulus =
      change.unrelaxed_modulus_factor.size() > 0 ? change.unrelaxed_modulus_factor : Eigen::ArrayXd::Ones(1);
  directions[1].log_relaxation_time =
      Eigen::ArrayXd::Constant(1, 1.0 / (law.companion ? law.alpha : law.tau_max));
  const Sampled factor(change.hardening_factor, 1.0);
  directions[2].relaxed_stress = history.haward_thackray_strain();
  for (Index i = 0; i < history.size(); ++i) directions[2].relaxed_stress[i] *= factor[i];
  return directions;
}

RowMajorMatrix strain_sensitivity(Solver& solver, const Law& law, const LawChange& change) {
  constexpr Index block = 16;
  const Index n = solver.history().size();
  RowMajorMatrix matrix = RowMajorMatrix::Zero(n, n);
  Eigen::ArrayXd stress(n);
  for (Index first = 0; first < n; first += block) {
    const Index count = std::min(block, n - first);
    std::vector<Direction> directions(static_cast<std::size_t>(count));
    for (Index k = 0; k < count; ++k) {
      directions[static_cast<std::size_t>(k)].true_strain = Eigen::ArrayXd::Zero(n);
      directions[static_cast<std::size_t>(k)].true_strain[first + k] = 1.0;
    }
    RowMajorMatrix columns(n, count);
    solver.tangent(law, change, directions, stress, columns);
    matrix.middleCols(first, count) = columns;
  }
  return matrix;
}

}  // namespace probation
