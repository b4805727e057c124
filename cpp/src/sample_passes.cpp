// The passes over samples go with the build of the kernels that runs.

#include <cstring>

#include "kernels/kernels.hpp"
#include "kernels/samples.hpp"

namespace probation::kernels {

const SamplePasses& sample_passes() {
#ifdef PROBATION_HAVE_V3
  static const bool v3_runs = std::strcmp(best().name, "v3") == 0;
  if (v3_runs) return v3::sample_passes;
#endif
  return baseline::sample_passes;
}

}  // namespace probation::kernels
