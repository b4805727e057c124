#pragma once
// Doubles in lockstep, as many as a register holds, for the files that are compiled once per instruction set.
//
// These files must not instantiate library templates that other files use too: the linker keeps one copy of
// each, and it could be the one that an older processor cannot run. Hence no Eigen and no std:: containers
// here.

#include "probation/inline.hpp"

#ifdef PROBATION_PLAIN_VECTOR
#include "plain_vector.hpp"
#else

#include <cstdint>

namespace probation {

namespace kernels {
#ifdef __AVX__
constexpr int lanes = 4;
#else
constexpr int lanes = 2;  // SSE2, NEON
#endif
}  // namespace kernels

using Vector = double __attribute__((vector_size(kernels::lanes * sizeof(double))));
using IntegerVector = std::int64_t __attribute__((vector_size(kernels::lanes * sizeof(double))));

namespace kernels {

PROBATION_INLINE Vector load(const double* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
PROBATION_INLINE void store(double* to, Vector v) { __builtin_memcpy(to, &v, sizeof v); }

/// One of log2(lanes) foldings. After all of them the lanes of the result are the sums over the lanes of
/// `lanes` vectors; neighbours are added first, then pairs.
template <int vectors>
PROBATION_INLINE Vector fold(Vector a, Vector b) {
#ifdef __AVX__
  if constexpr (vectors == 4)
    return __builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7);
  else
    return __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
#else
  return __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3);
#endif
}
PROBATION_INLINE double sum(Vector a) {
#ifdef __AVX__
  return (a[0] + a[1]) + (a[2] + a[3]);
#else
  return a[0] + a[1];
#endif
}
PROBATION_INLINE bool all_above(Vector a, double least) {
  for (int i = 0; i < lanes; ++i)
    if (!(a[i] > least)) return false;
  return true;
}
}  // namespace kernels

/// a where a comparison holds, b elsewhere.
PROBATION_INLINE Vector choose(IntegerVector where, Vector a, Vector b) { return where ? a : b; }

/// e^-x for x >= 0 to 1 unit in the last place or so; 0 beyond x = 700.
PROBATION_INLINE Vector decay(Vector x) {
  const Vector limited = x < 700.0 ? x : Vector{} + 700.0;
  // -x = n ln 2 + r, |r| <= ln 2 / 2; the magic number rounds to the nearest integer and leaves it in the low
  // bits.
  const double magic = 6755399441055744.0;  // 1.5 * 2^52
  const Vector rounded = limited * -1.4426950408889634074 + magic;
  const Vector n = rounded - magic;
  const Vector r = (-limited - n * 0.693147180369123816490) - n * 1.90821492927058770002e-10;
  // Taylor to r^13: the remainder is below 5e-17 on |r| <= 0.3466.
  Vector e = r * (1.0 / 6227020800.0) + 1.0 / 479001600.0;
  e = e * r + 1.0 / 39916800.0;
  e = e * r + 1.0 / 3628800.0;
  e = e * r + 1.0 / 362880.0;
  e = e * r + 1.0 / 40320.0;
  e = e * r + 1.0 / 5040.0;
  e = e * r + 1.0 / 720.0;
  e = e * r + 1.0 / 120.0;
  e = e * r + 1.0 / 24.0;
  e = e * r + 1.0 / 6.0;
  e = e * r + 0.5;
  e = e * r + 1.0;
  e = e * r + 1.0;
  const IntegerVector exponent = ((IntegerVector)rounded << 52) + ((IntegerVector)(Vector{} + 1.0));
  const Vector power = (Vector)exponent;
  return x < 700.0 ? e * power : Vector{};
}

}  // namespace probation

#endif

// After decay(Vector) and choose(): a template finds an overload for a built-in vector type only where it is
// declared first.
#include "probation/schemes/step.hpp"
