#include "probation/batch.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "probation/errors.hpp"

namespace probation {
namespace {

using Eigen::Index;

/// Calls work(make_scratch(), task) for every task, on several threads; the first failure is thrown to the
/// caller.
template <class MakeScratch, class Work>
void in_parallel(Index tasks, int threads, MakeScratch make_scratch, Work work) {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  if (threads <= 0) threads = std::max(cores, 1);
  threads = static_cast<int>(std::min<Index>(threads, std::max<Index>(tasks, 1)));
  std::atomic<Index> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto run = [&] {
    try {
      auto scratch = make_scratch();
      for (Index task = next++; task < tasks; task = next++) work(scratch, task);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failing);
      if (!failure) failure = std::current_exception();
      next = tasks;
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(run);
  run();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

void require_parameters(const Eigen::Ref<const RowMajorMatrix>& parameters,
                        const Eigen::Ref<RowMajorMatrix>& out, Index columns) {
  if (parameters.cols() != 3)
    throw InputError("parameters has " + std::to_string(parameters.cols()) + " columns; 3 are needed");
  if (out.rows() != parameters.rows() || out.cols() != columns)
    throw InputError("out has the shape (" + std::to_string(out.rows()) + ", " + std::to_string(out.cols()) +
                     "); (" + std::to_string(parameters.rows()) + ", " + std::to_string(columns) +
                     ") is needed");
}

}  // namespace

Law with_parameters(Law law, const Eigen::Ref<const Eigen::Array3d>& parameters) {
  law.unrelaxed_modulus = parameters[0];
  (law.companion ? law.alpha : law.tau_max) = parameters[1];
  law.hardening_modulus = parameters[2];
  return law;
}

void batch_stress(const Law& law, const Eigen::Ref<const RowMajorMatrix>& parameters, const History& history,
                  const LawChange& change, const SolverOptions& options, int threads,
                  Eigen::Ref<RowMajorMatrix> out) {
  require_parameters(parameters, out, history.size());
  in_parallel(
      parameters.rows(), threads, [&] { return Solver(history, options); },
      [&](Solver& solver, Index set) {
        Eigen::Map<Eigen::ArrayXd> stress(out.row(set).data(), out.cols());
        solver.stress(with_parameters(law, parameters.row(set).transpose().array()), change, stress);
      });
}

void batch_sum_of_squares(const Law& law, const Eigen::Ref<const RowMajorMatrix>& parameters,
                          const std::vector<BatchRecord>& records, const SolverOptions& options, int threads,
                          Eigen::Ref<RowMajorMatrix> out) {
  const auto count = static_cast<Index>(records.size());
  require_parameters(parameters, out, count);
  for (const BatchRecord& record : records)
    if (record.true_stress.size() != record.history.size())
      throw InputError("true_stress has " + std::to_string(record.true_stress.size()) + " samples; " +
                       std::to_string(record.history.size()) + " are needed to match time");
  struct Scratch {
    std::vector<Solver> solvers;
    Eigen::ArrayXd stress;
  };
  const auto make_scratch = [&] {
    Scratch scratch;
    for (const BatchRecord& record : records) scratch.solvers.emplace_back(record.history, options);
    return scratch;
  };
  in_parallel(parameters.rows(), threads, make_scratch, [&](Scratch& scratch, Index set) {
    const Law one = with_parameters(law, parameters.row(set).transpose().array());
    for (Index k = 0; k < count; ++k) {
      const BatchRecord& record = records[static_cast<std::size_t>(k)];
      scratch.stress.resize(record.history.size());
      scratch.solvers[static_cast<std::size_t>(k)].stress(one, record.change, scratch.stress);
      out(set, k) = (scratch.stress - record.true_stress).square().sum();
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
  return {sensitivity.transpose() * sensitivity, sensitivity.transpose() * residual, residual.squaredNorm()};
}

}  // namespace probation
