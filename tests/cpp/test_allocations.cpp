// The time loop allocates nothing: the number of allocations of a call does not depend on the number of
// instants. Counted in malloc, which both operator new and Eigen use; not where the sanitizers have taken its
// place.

#include <doctest/doctest.h>

#include <cstdlib>
#include <memory>
#include <vector>

#include "probation/companion/weissenberg.hpp"
#include "probation/feedback/self_heating.hpp"
#include "probation/feedback/stress_activation.hpp"
#include "probation/solver.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define PROBATION_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PROBATION_SANITIZED
#endif
#endif

#if defined(__GLIBC__) && !defined(PROBATION_SANITIZED)

namespace {
thread_local long allocations = 0;
}

// glibc's own name. NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

using namespace probation;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

constexpr Index few = 50, many = 800;

Law law(bool companion) {
  Law made;
  made.unrelaxed_modulus = 3220.0;
  made.tau_max = 5.2;
  made.hardening_modulus = 2.5;
  made.spectrum = Spectrum::log_spaced(12, 4.0);
  if (companion) made.companion = std::make_shared<Weissenberg>(0.00464, 0.0367);
  return made;
}

LawChange change(bool feedback, bool extra) {
  LawChange made;
  if (feedback)
    made.feedbacks = {std::make_shared<StressActivation>(20.0),
                      std::make_shared<SelfHeating>(1.0, 0.02, 0.03, 0.01)};
  if (extra) made.extra_modes = {Eigen::Array2d(100.0, 20.0), Eigen::Array2d(0.5, 9.0)};
  return made;
}

/// Every third step is longer, so that no run is uniform.
History history(Index n, bool uniform) {
  ArrayXd time(n);
  time[0] = 0.0;
  for (Index i = 1; i < n; ++i) time[i] = time[i - 1] + (uniform || i % 3 > 0 ? 0.125 : 0.1875);
  return History(time, 0.004 * time + 0.001 * (0.5 * time).sin());
}

/// Allocations of the second call.
template <class Call>
long counted(Call call) {
  call();
  const long before = allocations;
  call();
  return allocations - before;
}

}  // namespace

TEST_CASE("a counted allocation is seen") {
  CHECK(counted([] { ArrayXd(100).setZero(); }) == 1);
  CHECK(counted([] {
          void* volatile block = ::operator new(1);  // volatile: or the compiler leaves both out
          ::operator delete(block);
        }) == 1);
}

TEST_CASE("stress allocates no more for a long record than for a short one") {
  for (const Scheme scheme : {Scheme::be2, Scheme::sa2, Scheme::sa3, Scheme::exact, Scheme::cvode})
    for (const bool companion : {false, true})
      for (const bool uniform : {true, false})
        for (const bool extra : {false, true})
          for (const bool feedback : {false, true}) {
            if (feedback && scheme == Scheme::exact) continue;
            SolverOptions options;
            options.scheme = scheme;
            options.cvode.relative_tolerance = options.cvode.absolute_tolerance = 1e-6;
            const Law tried = law(companion);
            const LawChange changed = change(feedback, extra);
            const auto allocations_at = [&](Index n) {
              Solver solver(history(n, uniform), options);
              ArrayXd stress(n);
              return counted([&] { solver.stress(tried, changed, stress); });
            };
            CAPTURE(static_cast<int>(scheme));
            CAPTURE(companion);
            CAPTURE(uniform);
            CAPTURE(extra);
            CAPTURE(feedback);
            CHECK(allocations_at(many) == allocations_at(few));
          }
}

TEST_CASE("so do tangents") {
  for (const Scheme scheme : {Scheme::be2, Scheme::sa2, Scheme::sa3})
    for (const bool companion : {false, true})
      for (const bool extra : {false, true})
        for (const bool feedback : {false, true}) {
          SolverOptions options;
          options.scheme = scheme;
          const Law tried = law(companion);
          const LawChange changed = change(feedback, extra);
          const auto allocations_at = [&](Index n) {
            Solver solver(history(n, false), options);
            const auto directions = parameter_directions(tried, changed, solver.history());
            ArrayXd stress(n);
            RowMajorMatrix columns(n, 3);
            return counted([&] { solver.tangent(tried, changed, directions, stress, columns); });
          };
          CAPTURE(static_cast<int>(scheme));
          CAPTURE(companion);
          CAPTURE(extra);
          CAPTURE(feedback);
          CHECK(allocations_at(many) == allocations_at(few));
        }
}

#else

TEST_CASE("allocations are counted with glibc and without sanitizers only") {}

#endif
