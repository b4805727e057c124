// Chooses the build of the kernels for this processor, once.

#include <cstdlib>
#include <cstring>

#include "kernels/kernels.hpp"

namespace probation::kernels {
namespace {

/// A forced build that this processor cannot run is not taken.
const Kernels& choose() {
#ifdef PROBATION_HAVE_V3
  const char* forced = std::getenv("PROBATION_KERNELS");
  if (forced && std::strcmp(forced, "baseline") == 0) return baseline::table;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return v3::table;
#endif
  return baseline::table;
}

}  // namespace

const Kernels& best() {
  static const Kernels& chosen = choose();
  return chosen;
}

}  // namespace probation::kernels
