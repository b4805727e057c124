#pragma once
// Identification in bulk: one record per row, a field of pixels say.

#include <Eigen/Core>
#include <cstdint>
#include <variant>

#include "probation/identify/identify.hpp"
#include "probation/thread_pool.hpp"

namespace probation {

/// Rows of samples in the caller's memory, in either precision. A stride of zero gives all records the same
/// row.
struct SampleRows {
  std::variant<const float*, const double*> first = static_cast<const double*>(nullptr);
  Eigen::Index stride = 0;  ///< samples from row to row

  /// Copies row `record` into `samples`, which has its length.
  void read(Eigen::Index record, Eigen::ArrayXd& samples) const;
};

struct BulkRecords {
  Eigen::Index records, n_times;
  SampleRows time;         ///< [s]
  SampleRows true_strain;  ///< [-]
  SampleRows true_stress;  ///< [MPa]
  SampleRows noise;        ///< standard deviation of the stress [MPa]
  bool noise_given = false;
};

/// Where the answers go; see Identified.
struct BulkOutput {
  Eigen::Ref<RowMajorMatrix> parameters;                            ///< shape (records, 3)
  Eigen::Ref<RowMajorMatrix> standard_error;                        ///< shape (records, 3)
  Eigen::Ref<Eigen::ArrayXd> rms_residual;                          ///< [MPa]; shape (records)
  Eigen::Ref<Eigen::Array<std::int8_t, Eigen::Dynamic, 1>> status;  ///< IdentifyStatus; shape (records)
  Eigen::Ref<Eigen::ArrayXi> iterations;                            ///< shape (records)
};

/// Identifies every record by itself; the answers depend on neither the threads nor the other records.
/// @throws InputError  for options or shapes that do not fit; never for what a record holds
void identify_many(const Law& law, const BulkRecords& records, const IdentifyOptions& options,
                   const BatchRun& run, BulkOutput out);

}  // namespace probation
