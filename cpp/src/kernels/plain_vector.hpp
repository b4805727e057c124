#pragma once
// A vector of one double: plain C++, for compilers without vector extensions, and as the
// reference for the other builds.

namespace probation {

using Vector = double;

namespace kernels {

constexpr int lanes = 1;

PROBATION_INLINE Vector load(const double* from) { return *from; }
PROBATION_INLINE void store(double* to, Vector v) { *to = v; }
template <int vectors>
Vector fold(Vector a, Vector b);  // of one lane: nothing to fold
PROBATION_INLINE double sum(Vector a) { return a; }
PROBATION_INLINE bool all_above(Vector a, double least) { return a > least; }

}  // namespace kernels
}  // namespace probation
