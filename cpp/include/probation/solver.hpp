#pragma once
// The stress along a record, and its sensitivities, by any scheme.

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "probation/history.hpp"
#include "probation/law.hpp"
#include "probation/schemes/cvode.hpp"
#include "probation/schemes/forcing.hpp"

namespace probation {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

enum class Scheme { be2, sa2, sa3, exact, cvode };

struct SolverOptions {
  Scheme scheme = Scheme::be2;
  Start start = Start::exponential;  ///< bE2's first step, and the one after a jump
  CvodeOptions cvode;
};

/// Solves the law along one history, again and again: its arrays are kept between calls. Two threads may
/// share a solver (one waits), but each does better with its own.
class Solver {
 public:
  Solver();  ///< Without history: take() one.
  Solver(History history, SolverOptions options);
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Replaces the history by one of `samples` (arguments of History), in the same memory.
  template <class... Samples>
  void take(SolverOptions options, Samples&&... samples) {
    forget();
    options_ = options;
    history_.assign(std::forward<Samples>(samples)...);
  }

  const History& history() const noexcept;

  /// True stress [MPa] at the instants of the history; `stress` has shape (n_times).
  /// @throws InputError        for an invalid law or change
  /// @throws ConvergenceError  with the time at which CVODE or a feedback's iteration fails, or the stress is
  ///                           not finite
  void stress(const Law& law, const LawChange& change, Eigen::Ref<Eigen::ArrayXd> stress);

  /// Stress and its derivatives [MPa per unit of the direction] along each direction; `derivatives` has shape
  /// (n_times, directions). Only for be2, sa2 and sa3. Throws as stress() does.
  void tangent(const Law& law, const LawChange& change, const std::vector<Direction>& directions,
               Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix> derivatives);

  /// Counters of CVODE in the last call.
  const CvodeStatistics& cvode_statistics() const noexcept;

 private:
  struct Workspace;
  /// What is known of the history, and tables that would change the last bits of the next answer.
  void forget();
  void solve(const Law& law, const LawChange& change, Eigen::Ref<Eigen::ArrayXd>& stress);
  void solve_tangent(const Law& law, const LawChange& change, const std::vector<Direction>& directions,
                     Eigen::Ref<Eigen::ArrayXd>& stress, Eigen::Ref<RowMajorMatrix>& derivatives);

  History history_;
  SolverOptions options_;
  std::unique_ptr<Workspace> work_;
};

/// The solver that this thread keeps for histories that are solved once: take() one.
Solver& kept_solver();

/// The build of the kernels in use: "v3" (AVX2, FMA), "baseline" (SSE2 or NEON) or "portable" (plain C++).
/// The best that this processor can run, unless PROBATION_KERNELS in the environment names one; it is read
/// once.
/// @throws InputError  if PROBATION_KERNELS names a build that this processor cannot run
const char* kernel_build();

/// The directions of the law's parameters: E_u [MPa], tau_max [s] (or alpha), G [MPa].
std::vector<Direction> parameter_directions(const Law& law, const LawChange& change, const History& history);

/// d stress / d true_strain, lower triangular, [MPa]; shape (n_times, n_times). Rates that follow the strain
/// (and tau_max with them) are included.
RowMajorMatrix strain_sensitivity(Solver& solver, const Law& law, const LawChange& change);

}  // namespace probation
