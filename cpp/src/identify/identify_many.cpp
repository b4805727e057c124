#include "probation/identify/identify_many.hpp"

#include <string>
#include <vector>

#include "probation/errors.hpp"

namespace probation {
namespace {

using Eigen::Index;

struct Scratch {
  Identifier identifier;
  Eigen::ArrayXd time, true_strain, true_stress, noise;
};

void require_records(Index found, Index expected, const char* name) {
  if (found != expected)
    throw InputError(std::string("out.") + name + " has " + std::to_string(found) + " records; " +
                     std::to_string(expected) + " are needed");
}

}  // namespace

void identify_many(const Law& law, const BulkRecords& records, const IdentifyOptions& options,
                   const BatchRun& run, BulkOutput out) {
  require_records(out.parameters.rows(), records.records, "parameters");
  require_records(out.standard_error.rows(), records.records, "standard_error");
  require_records(out.rms_residual.size(), records.records, "rms_residual");
  require_records(out.status.size(), records.records, "status");
  require_records(out.iterations.size(), records.records, "iterations");
  options.validate();
  const Index n = records.n_times, samples = (n - 1) / options.substeps + 1;
  if ((n - 1) % options.substeps != 0)
    throw InputError("time has " + std::to_string(n) + " instants; a multiple of the " +
                     std::to_string(options.substeps) + " substeps and one more are needed");
  std::vector<Scratch> scratches;
  for (int worker = workers_for(records.records, run); worker > 0; --worker) {
    scratches.push_back({Identifier(law, options), Eigen::ArrayXd(n), Eigen::ArrayXd(n),
                         Eigen::ArrayXd(samples), Eigen::ArrayXd(records.noise_given ? samples : 0)});
  }
  in_parallel(records.records, run, [&](int worker, Index record) {
    Scratch& s = scratches[static_cast<std::size_t>(worker)];
    records.time.read(record, s.time);
    records.true_strain.read(record, s.true_strain);
    records.true_stress.read(record, s.true_stress);
    if (records.noise_given) records.noise.read(record, s.noise);
    const Identified found = s.identifier(s.time, s.true_strain, s.true_stress, s.noise);
    out.parameters.row(record) = found.parameters.matrix().transpose();
    out.standard_error.row(record) = found.standard_error.matrix().transpose();
    out.rms_residual[record] = found.rms_residual;
    out.status[record] = static_cast<std::int8_t>(found.status);
    out.iterations[record] = found.iterations;
  });
}

}  // namespace probation
