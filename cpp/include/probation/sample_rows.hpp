#pragma once
// Rows of samples in the caller's memory, in either precision.

#include <Eigen/Core>
#include <type_traits>
#include <variant>

namespace probation {

/// With a stride of zero all records have the same row.
struct SampleRows {
  std::variant<const float*, const double*> first = static_cast<const double*>(nullptr);
  Eigen::Index stride = 0;  ///< samples from row to row

  /// Copies row `record` into `samples`, which has its length.
  void read(Eigen::Index record, Eigen::ArrayXd& samples) const {
    std::visit(
        [&](const auto* from) {
          using Sample = std::remove_const_t<std::remove_pointer_t<decltype(from)>>;
          using Row = Eigen::Map<const Eigen::Array<Sample, Eigen::Dynamic, 1>>;
          samples = Row(from + record * stride, samples.size()).template cast<double>();
        },
        first);
  }
};

}  // namespace probation
