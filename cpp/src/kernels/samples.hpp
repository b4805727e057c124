#pragma once
// What one pass over the samples of a record computes. Plain pointers, as in kernels.hpp.

#include <cstdint>

namespace probation::kernels {

/// Properties of the steps of a record that usually hold; a pass only says whether they do.
struct StepTraits {
  bool increasing;  ///< every step is a normal positive number: the kernels take subnormal ones for zero
  bool even;        ///< every step differs from the first by no more than was allowed
};

struct SamplePasses {
  /// e_HT of every sample; -inf, inf or nan where it is out of range. False if there is such a sample.
  bool (*haward_thackray)(const double* true_strain, std::int64_t count, double* result);
  /// Of `count` instants, at least 2.
  StepTraits (*inspect_steps)(const double* time, std::int64_t count, double allowed_difference);
  /// Whether the secant changes anywhere by more than `least`, relative to the larger of the two.
  bool (*secant_changes)(const double* time, const double* values, std::int64_t count, double least);
  bool (*all_finite)(const double* values, std::int64_t count);
};

}  // namespace probation::kernels
