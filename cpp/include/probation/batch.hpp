#pragma once
// Many solves at once: over parameter sets, over records, over pixels, with outputs as small as the caller
// needs.

#include <Eigen/Core>
#include <vector>

#include "probation/sample_rows.hpp"
#include "probation/solver.hpp"
#include "probation/thread_pool.hpp"

namespace probation {

/// A record with which stresses of the law are compared.
struct BatchRecord {
  History history;
  Eigen::ArrayXd true_stress;  ///< [MPa]; shape (n_times)
  LawChange change;
};

/// J^T J, J^T r and r^T r of the fit residual r = model - data along some directions.
struct NormalEquations {
  Eigen::MatrixXd matrix;    ///< J^T J; shape (directions, directions)
  Eigen::VectorXd gradient;  ///< J^T r; shape (directions)
  double sum_of_squares;     ///< r^T r [MPa^2]
};

/// The law with the parameters E_u [MPa], tau_max [s] or alpha [-], G [MPa]; shape (3).
Law with_parameters(Law law, const Eigen::Ref<const Eigen::Array3d>& parameters);

/// True stress [MPa] of many parameter sets along one history.
/// @param parameters  shape (sets, 3)
/// @param out         shape (sets, n_times)
void batch_stress(const Law& law, const Eigen::Ref<const RowMajorMatrix>& parameters, const History& history,
                  const LawChange& change, const SolverOptions& options, const BatchRun& run,
                  Eigen::Ref<RowMajorMatrix> out);

/// True stress [MPa] along many strain histories on one time grid: the pixels of a field.
/// @param parameters   shape (pixels, 3), or (1, 3): the same for all
/// @param time         [s]; shape (n_times)
/// @param true_strain  [-]; rows of n_times, one per pixel
/// @param find_jumps   whether each pixel's strain rate is searched for jumps
/// @param out          shape (pixels, n_times)
/// @throws InputError  naming the pixel
void field_stress(const Law& law, const Eigen::Ref<const RowMajorMatrix>& parameters, const Samples& time,
                  const SampleRows& true_strain, bool find_jumps, const SolverOptions& options,
                  const BatchRun& run, Eigen::Ref<RowMajorMatrix> out);

/// Sum of squared fit residuals [MPa^2] of many parameter sets over many records; the stresses are not kept.
/// @param out  shape (sets, records)
void batch_sum_of_squares(const Law& law, const Eigen::Ref<const RowMajorMatrix>& parameters,
                          const std::vector<BatchRecord>& records, const SolverOptions& options,
                          const BatchRun& run, Eigen::Ref<RowMajorMatrix> out);

/// Normal equations of many parameter sets, each along its parameter directions (E_u, tau_max or alpha, G),
/// over many records; neither stresses nor sensitivities are kept.
/// @param out  shape (sets * records, 13): J^T J by rows, J^T r, r^T r of set 0 on each record, then of set 1
void batch_normal_equations(const Law& law, const Eigen::Ref<const RowMajorMatrix>& parameters,
                            const std::vector<BatchRecord>& records, const SolverOptions& options,
                            const BatchRun& run, Eigen::Ref<RowMajorMatrix> out);

/// Normal equations of one record along its parameter directions (E_u, tau_max or alpha, G).
NormalEquations normal_equations(Solver& solver, const Law& law, const LawChange& change,
                                 const Samples& true_stress);

}  // namespace probation
