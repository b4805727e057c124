#pragma once
// Many solves at once: over parameter sets, over records, with outputs as small as the caller needs.

#include <Eigen/Core>
#include <vector>

#include "probation/solver.hpp"

namespace probation {

/// A record that laws are held against.
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
/// @param threads     how many to use; 0: all cores
/// @param out         shape (sets, n_times)
void batch_stress(const Law& law, const Eigen::Ref<const RowMajorMatrix>& parameters, const History& history,
                  const LawChange& change, const SolverOptions& options, int threads,
                  Eigen::Ref<RowMajorMatrix> out);

/// Sum of squared fit residuals [MPa^2] of many parameter sets over many records; the stresses are not kept.
/// @param out  shape (sets, records)
void batch_sum_of_squares(const Law& law, const Eigen::Ref<const RowMajorMatrix>& parameters,
                          const std::vector<BatchRecord>& records, const SolverOptions& options, int threads,
                          Eigen::Ref<RowMajorMatrix> out);

/// Normal equations of one record along its parameter directions (E_u, tau_max or alpha, G).
NormalEquations normal_equations(Solver& solver, const Law& law, const LawChange& change,
                                 const Samples& true_stress);

}  // namespace probation
