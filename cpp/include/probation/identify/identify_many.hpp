#pragma once
// Identification in bulk: one record per row, a field of pixels say.

#include <Eigen/Core>
#include <cstdint>

#include "probation/identify/identify.hpp"
#include "probation/sample_rows.hpp"
#include "probation/thread_pool.hpp"

namespace probation {

struct BulkRecords {
  Eigen::Index records, n_times;  ///< n_times: of every substep
  SampleRows time;                ///< at every substep [s]
  SampleRows true_strain;         ///< at every substep [-]
  SampleRows true_stress;         ///< at the samples [MPa]
  SampleRows noise;               ///< standard deviation of the stress at the samples [MPa]
  bool noise_given = false;
};

/// The arrays to be filled; see Identified.
struct BulkOutput {
  Eigen::Ref<RowMajorMatrix> parameters;                            ///< shape (records, 3)
  Eigen::Ref<RowMajorMatrix> standard_error;                        ///< shape (records, 3)
  Eigen::Ref<Eigen::ArrayXd> rms_residual;                          ///< [MPa]; shape (records)
  Eigen::Ref<Eigen::Array<std::int8_t, Eigen::Dynamic, 1>> status;  ///< IdentifyStatus; shape (records)
  Eigen::Ref<Eigen::ArrayXi> iterations;                            ///< shape (records)
};

/// Identifies every record by itself; results depend neither on the threads nor on the other records.
/// @throws InputError  for options or shapes that do not fit; never for the samples of a record
void identify_many(const Law& law, const BulkRecords& records, const IdentifyOptions& options,
                   const BatchRun& run, BulkOutput out);

}  // namespace probation
