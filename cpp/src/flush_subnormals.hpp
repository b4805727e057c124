#pragma once
// Decaying modes must not end at subnormal numbers: the smallest one times a factor above one half rounds to
// itself, again and again, and on many processors each such product takes a hundred cycles.

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#define PROBATION_FLUSHES_SUBNORMALS
#endif

namespace probation {

/// While it lives, this thread takes subnormal results and operands for zero (x86-64 alone; elsewhere it does
/// nothing). Its end restores the setting of the caller.
class FlushSubnormals {
 public:
#ifdef PROBATION_FLUSHES_SUBNORMALS
  FlushSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | both); }
  ~FlushSubnormals() { _mm_setcsr((_mm_getcsr() & ~both) | (before_ & both)); }
#else
  FlushSubnormals() = default;
#endif
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

#ifdef PROBATION_FLUSHES_SUBNORMALS
 private:
  static constexpr unsigned both = 0x8040;  // MXCSR: flush to zero, denormals are zero
  unsigned before_;
#endif
};

}  // namespace probation
