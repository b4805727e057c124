#include "probation/batch.hpp"

#include <cmath>
#include <memory>
#include <string>

#include "probation/errors.hpp"
#include "require_finite.hpp"
#include "unit_solves.hpp"

namespace probation {
namespace {

using Eigen::Index;
using Parameters = Eigen::Ref<const RowMajorMatrix>;

/// Sets that one worker takes at a time: successive ones may share their tau_max.
constexpr Index chunk = 16;

bool changes_nothing(const LawChange& c) {
  return c.relaxation_time_factor.size() == 0 && c.unrelaxed_modulus_factor.size() == 0 &&
         c.hardening_factor.size() == 0 && c.added_relaxed_stress.size() == 0 &&
         c.load_bearing_area.size() == 0 && c.initial_modal_stress.size() == 0 &&
         c.extra_modes.modulus.size() == 0 && c.extra_modes.relaxation_time.size() == 0 &&
         c.feedbacks.empty();
}

bool by_steps(Scheme scheme) { return scheme != Scheme::exact && scheme != Scheme::cvode; }

/// The stress along one history at one parameter set after another.
class RepeatedSolve {
 public:
  RepeatedSolve(const Law& law, const History& history, const LawChange& change, const SolverOptions& options)
      : law_(law), time_(history.time()), change_(change) {
    if (by_steps(options.scheme) && changes_nothing(change)) {
      solves_.set_modes(law.spectrum);
      solves_.take(law, history, options.scheme, options.start);
    } else {
      solver_ = std::make_unique<Solver>(history, options);
    }
  }

  /// `again`: the next sets have the same tau_max (or alpha).
  void stress(const Eigen::Array3d& parameters, bool again, Eigen::Ref<Eigen::ArrayXd> out) {
    if (solver_) {
      solver_->stress(with_parameters(law_, parameters), change_, out);
      return;
    }
    if (parameters[1] == solved_) {
      out = parameters[0] * solves_.u() + parameters[2] * solves_.v();
    } else if (again) {
      solves_.solve(parameters[1]);
      solved_ = parameters[1];
      out = parameters[0] * solves_.u() + parameters[2] * solves_.v();
    } else {
      solves_.stress(parameters[0], parameters[1], parameters[2], out);
    }
    require_finite(out, time_, "the stress");
  }

 private:
  const Law& law_;
  const Eigen::ArrayXd& time_;
  const LawChange& change_;
  UnitSolves solves_;
  std::unique_ptr<Solver> solver_;
  double solved_ = 0.0;
};

/// Unit solves pay from the third set on that shares its tau_max.
bool shares_time(const Parameters& parameters, Index set) {
  return set + 2 < parameters.rows() && parameters(set + 1, 1) == parameters(set, 1) &&
         parameters(set + 2, 1) == parameters(set, 1);
}

void require_shape(const Eigen::Ref<RowMajorMatrix>& out, Index rows, Index columns) {
  if (out.rows() != rows || out.cols() != columns)
    throw InputError("out has the shape (" + std::to_string(out.rows()) + ", " + std::to_string(out.cols()) +
                     "); (" + std::to_string(rows) + ", " + std::to_string(columns) + ") is needed");
}

/// Checks all parameter sets before the first solve.
void require_parameters(const Law& law, const Parameters& parameters) {
  if (parameters.cols() != 3)
    throw InputError("parameters has " + std::to_string(parameters.cols()) + " columns; 3 are needed");
  Law tried = law;
  for (Index set = 0; set < parameters.rows(); ++set) {
    const Eigen::Array3d p = parameters.row(set).transpose().array();
    if (set > 0 && p[0] >= 0.0 && p[1] > 0.0 && p[2] >= 0.0 && p.allFinite()) continue;
    tried = with_parameters(std::move(tried), p);
    try {
      tried.validate();
    } catch (const InputError& error) {
      throw InputError("parameters[" + std::to_string(set) + "]: " + error.what());
    }
  }
}

void require_records(const std::vector<BatchRecord>& records, const Law& law) {
  for (const BatchRecord& record : records) {
    if (record.true_stress.size() != record.history.size())
      throw InputError("true_stress has " + std::to_string(record.true_stress.size()) + " samples; " +
                       std::to_string(record.history.size()) + " are needed to match time");
    record.change.validate(record.history.size(), law.spectrum.modes());
  }
}

/// Does the work; puts a name such as "parameters[3]" before the message of an InputError.
template <class Name, class Work>
void named(Name name, Work work) {
  try {
    work();
  } catch (const InputError& error) {
    throw InputError(name() + ": " + error.what());
  } catch (const ConvergenceError& error) {
    throw ConvergenceError(name() + ": " + error.what(), error.time(), error.residual_norm());
  }
}

std::string name_of(const char* what, Index index) { return what + ("[" + std::to_string(index) + "]"); }

/// Scratch of each worker, made when the worker takes its first task.
template <class Scratch>
class PerWorker {
 public:
  explicit PerWorker(int workers) : scratches_(static_cast<std::size_t>(workers)) {}

  template <class Make>
  Scratch& get(int worker, Make make) {
    std::unique_ptr<Scratch>& scratch = scratches_[static_cast<std::size_t>(worker)];
    if (!scratch) scratch = make();
    return *scratch;
  }

 private:
  std::vector<std::unique_ptr<Scratch>> scratches_;
};

/// Calls work(scratch, set) for every set, by chunks of successive ones.
template <class Scratch, class Make, class Work>
void over_sets(Index sets, const BatchRun& run, Make make, Work work) {
  const Index chunks = (sets + chunk - 1) / chunk;
  PerWorker<Scratch> scratches(workers_for(chunks, run));
  in_parallel(chunks, run, [&](int worker, Index task) {
    Scratch& scratch = scratches.get(worker, make);
    const Index end = std::min(sets, (task + 1) * chunk);
    for (Index set = task * chunk; set < end; ++set) work(scratch, set);
  });
}

}  // namespace

Law with_parameters(Law law, const Eigen::Ref<const Eigen::Array3d>& parameters) {
  law.unrelaxed_modulus = parameters[0];
  (law.companion ? law.alpha : law.tau_max) = parameters[1];
  law.hardening_modulus = parameters[2];
  return law;
}

void batch_stress(const Law& law, const Parameters& parameters, const History& history,
                  const LawChange& change, const SolverOptions& options, const BatchRun& run,
                  Eigen::Ref<RowMajorMatrix> out) {
  require_parameters(law, parameters);
  require_shape(out, parameters.rows(), history.size());
  change.validate(history.size(), law.spectrum.modes());
  over_sets<RepeatedSolve>(
      parameters.rows(), run, [&] { return std::make_unique<RepeatedSolve>(law, history, change, options); },
      [&](RepeatedSolve& solve, Index set) {
        Eigen::Map<Eigen::ArrayXd> stress(out.row(set).data(), out.cols());
        named([&] { return name_of("parameters", set); },
              [&] {
                solve.stress(parameters.row(set).transpose().array(), shares_time(parameters, set), stress);
              });
      });
}

void field_stress(const Law& law, const Parameters& parameters, const Samples& time,
                  const SampleRows& true_strain, bool find_jumps, const SolverOptions& options,
                  const BatchRun& run, Eigen::Ref<RowMajorMatrix> out) {
  require_parameters(law, parameters);
  require_shape(out, out.rows(), time.size());
  if (parameters.rows() != 1 && parameters.rows() != out.rows())
    throw InputError("parameters has " + std::to_string(parameters.rows()) + " rows; 1 or " +
                     std::to_string(out.rows()) + " are needed, one per pixel");
  struct Scratch {
    UnitSolves solves;
    Eigen::ArrayXd true_strain;
  };
  const auto make = [&] {
    auto scratch = std::make_unique<Scratch>();
    scratch->solves.set_modes(law.spectrum);
    scratch->true_strain.resize(time.size());
    return scratch;
  };
  PerWorker<Scratch> scratches(workers_for(out.rows(), run));
  in_parallel(out.rows(), run, [&](int worker, Index pixel) {
    Scratch& s = scratches.get(worker, make);
    true_strain.read(pixel, s.true_strain);
    const Eigen::Array3d p = parameters.row(parameters.rows() == 1 ? 0 : pixel).transpose().array();
    Eigen::Map<Eigen::ArrayXd> stress(out.row(pixel).data(), out.cols());
    const auto solve = [&] {
      const History history =
          find_jumps ? History(FindJumps{}, time, s.true_strain) : History(time, s.true_strain);
      if (by_steps(options.scheme)) {
        s.solves.take(law, history, options.scheme, options.start);
        s.solves.stress(p[0], p[1], p[2], stress);
        require_finite(stress, history.time(), "the stress");
      } else {
        Solver(history, options).stress(with_parameters(law, p), {}, stress);
      }
    };
    named([&] { return "pixel " + std::to_string(pixel); }, solve);
  });
}

void batch_sum_of_squares(const Law& law, const Parameters& parameters,
                          const std::vector<BatchRecord>& records, const SolverOptions& options,
                          const BatchRun& run, Eigen::Ref<RowMajorMatrix> out) {
  const auto count = static_cast<Index>(records.size());
  require_parameters(law, parameters);
  require_shape(out, parameters.rows(), count);
  require_records(records, law);
  struct Scratch {
    std::vector<std::unique_ptr<RepeatedSolve>> solves;
    Eigen::ArrayXd stress;
  };
  const auto make = [&] {
    auto scratch = std::make_unique<Scratch>();
    for (const BatchRecord& record : records)
      scratch->solves.push_back(std::make_unique<RepeatedSolve>(law, record.history, record.change, options));
    return scratch;
  };
  over_sets<Scratch>(parameters.rows(), run, make, [&](Scratch& scratch, Index set) {
    for (Index k = 0; k < count; ++k) {
      const BatchRecord& record = records[static_cast<std::size_t>(k)];
      scratch.stress.resize(record.history.size());
      const auto solve = [&] {
        scratch.solves[static_cast<std::size_t>(k)]->stress(parameters.row(set).transpose().array(),
                                                            shares_time(parameters, set), scratch.stress);
        out(set, k) = (scratch.stress - record.true_stress).square().sum();
        if (!std::isfinite(out(set, k)))
          throw InputError("the stress is so far from true_stress that the sum of squares is not finite");
      };
      named([&] { return name_of("parameters", set) + ", " + name_of("records", k); }, solve);
    }
  });
}

void batch_normal_equations(const Law& law, const Parameters& parameters,
                            const std::vector<BatchRecord>& records, const SolverOptions& options,
                            const BatchRun& run, Eigen::Ref<RowMajorMatrix> out) {
  const auto count = static_cast<Index>(records.size());
  require_parameters(law, parameters);
  require_shape(out, parameters.rows() * count, 13);
  require_records(records, law);
  using Solvers = std::vector<Solver>;
  const auto make = [&] {
    auto solvers = std::make_unique<Solvers>();
    for (const BatchRecord& record : records) solvers->emplace_back(record.history, options);
    return solvers;
  };
  over_sets<Solvers>(parameters.rows(), run, make, [&](Solvers& solvers, Index set) {
    const Law one = with_parameters(law, parameters.row(set).transpose().array());
    for (Index k = 0; k < count; ++k) {
      const BatchRecord& record = records[static_cast<std::size_t>(k)];
      NormalEquations found;
      named([&] { return name_of("parameters", set) + ", " + name_of("records", k); },
            [&] {
              found = normal_equations(solvers[static_cast<std::size_t>(k)], one, record.change,
                                       record.true_stress);
            });
      auto row = out.row(set * count + k);
      for (Index i = 0; i < 3; ++i) row.segment(3 * i, 3) = found.matrix.row(i);
      row.segment(9, 3) = found.gradient.transpose();
      row[12] = found.sum_of_squares;
    }
  });
}

NormalEquations normal_equations(Solver& solver, const Law& law, const LawChange& change,
                                 const Samples& true_stress) {
  const Index n = solver.history().size();
  if (true_stress.size() != n)
    throw InputError("true_stress has " + std::to_string(true_stress.size()) + " samples; " +
                     std::to_string(n) + " are needed");
  const std::vector<Direction> directions = parameter_directions(law, change, solver.history());
  Eigen::ArrayXd stress(n);
  RowMajorMatrix sensitivity(n, static_cast<Index>(directions.size()));
  solver.tangent(law, change, directions, stress, sensitivity);
  const Eigen::VectorXd residual = (stress - true_stress).matrix();
  NormalEquations found{sensitivity.transpose() * sensitivity, sensitivity.transpose() * residual,
                        residual.squaredNorm()};
  if (!found.matrix.allFinite() || !found.gradient.allFinite() || !std::isfinite(found.sum_of_squares))
    throw InputError("the stress or its derivatives are so large that their squares are not finite");
  return found;
}

}  // namespace probation
