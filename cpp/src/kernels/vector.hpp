#pragma once
// Four doubles in lockstep, for the files that are compiled once per instruction set.
//
// These files must not instantiate library templates that other files use too: the linker keeps one copy of
// each, and it could be the one that an older processor cannot run. Hence no Eigen and no std:: containers
// here.

#include "probation/inline.hpp"

namespace probation::kernels {
constexpr int lanes = 4;
}

#ifdef PROBATION_PLAIN_VECTOR
#include "plain_vector.hpp"
#else

#include <cstdint>

namespace probation {

using Vector = double __attribute__((vector_size(32)));
using IntegerVector = std::int64_t __attribute__((vector_size(32)));

namespace kernels {

PROBATION_INLINE Vector load(const double* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
PROBATION_INLINE void store(double* to, Vector v) { __builtin_memcpy(to, &v, sizeof v); }

/// The first two of both, and the last two.
PROBATION_INLINE Vector first_halves(Vector a, Vector b) { return __builtin_shufflevector(a, b, 0, 1, 4, 5); }
PROBATION_INLINE Vector last_halves(Vector a, Vector b) { return __builtin_shufflevector(a, b, 2, 3, 6, 7); }

/// The four sums a0+a1+a2+a3, b0+..., c0+..., d0+... as one vector.
PROBATION_INLINE Vector sums(Vector a, Vector b, Vector c, Vector d) {
  const Vector ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Vector cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return first_halves(ab, cd) + last_halves(ab, cd);
}
PROBATION_INLINE double sum(Vector a) { return (a[0] + a[1]) + (a[2] + a[3]); }
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
