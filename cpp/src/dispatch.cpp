// Chooses the build of the kernels for this processor, once per process.

#include <cstdlib>
#include <string>

#include "kernels/kernels.hpp"
#include "probation/errors.hpp"

namespace probation::kernels {
namespace {

/// The builds that this processor can run, best first.
struct Runnable {
  const Kernels* builds[4] = {};

  Runnable() {
    int count = 0;
#ifdef PROBATION_HAVE_V3
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) builds[count++] = &v3::table;
#endif
#ifdef PROBATION_HAVE_BASELINE
    builds[count++] = &baseline::table;
#endif
#ifdef PROBATION_HAVE_PORTABLE
    builds[count] = &portable::table;
#endif
  }
};

const Kernels& choose() {
  const char* named = std::getenv("PROBATION_KERNELS");
  if (!named || !*named) return **runnable();
  std::string names;
  for (const Kernels* const* build = runnable(); *build; ++build) {
    if (std::string((*build)->name) == named) return **build;
    names += (names.empty() ? "" : ", ") + std::string((*build)->name);
  }
  throw InputError("PROBATION_KERNELS is '" + std::string(named) +
                   "'; this processor and this build can run " + names + ": name one of them or unset it");
}

}  // namespace

const Kernels* const* runnable() {
  static const Runnable found;
  return found.builds;
}

const Kernels& best() {
  static const Kernels& chosen = choose();
  return chosen;
}

}  // namespace probation::kernels
