// The passes over samples go with the build of the kernels that runs.

#include <cstring>

#include "kernels/kernels.hpp"
#include "kernels/samples.hpp"

namespace probation::kernels {

namespace {

const SamplePasses& choose() {
#ifdef PROBATION_HAVE_V3
  if (std::strcmp(best().name, "v3") == 0) return v3::sample_passes;
#endif
#ifdef PROBATION_HAVE_BASELINE
  if (std::strcmp(best().name, "baseline") == 0) return baseline::sample_passes;
#endif
  return portable::sample_passes;
}

}  // namespace

const SamplePasses& sample_passes() {
  static const SamplePasses& chosen = choose();
  return chosen;
}

}  // namespace probation::kernels
