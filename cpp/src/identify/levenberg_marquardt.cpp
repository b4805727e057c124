#include <algorithm>
#include <cmath>

#include "identify/search.hpp"

namespace probation {
namespace {

constexpr double longest_time_step = 1.0;  // of ln time
constexpr double least_damping = 1e-8;     // of the diagonal of J^T J
constexpr double slowest = 0.99;           // shrinking of the steps that is still taken for convergence

Eigen::Vector3d values(const FitPoint& p) { return {p.unrelaxed_modulus, p.log_time, p.hardening_modulus}; }

}  // namespace

Search levenberg_marquardt(RecordFit& fit, const SearchSpace& space, double log_time) {
  constexpr int most_iterations = 100;
  const Bounds bounds[3] = {space.modulus, space.log_time, space.hardening};
  Search search;
  FitPoint& p = search.point;
  p = fit.project(std::clamp(log_time, space.log_time.lower, space.log_time.upper), space.modulus,
                  space.hardening);
  double damping = 0.0, last_size = 0.0;
  std::array<bool, 3> last_free{};
  for (;;) {
    fit.differentiate(p);
    ++search.iterations;
    const Eigen::Vector3d here = values(p);
    // A parameter at a bound is held if its step leads beyond.
    std::array<bool, 3> free{};
    for (int i = 0; i < 3; ++i) {
      const bool stopped = (here[i] <= bounds[i].lower && p.gradient[i] > 0.0) ||
                           (here[i] >= bounds[i].upper && p.gradient[i] < 0.0);
      free[static_cast<std::size_t>(i)] = !space.held[static_cast<std::size_t>(i)] && !stopped;
    }
    if (free != last_free) last_size = 0.0;
    last_free = free;
    p.modulus_free = free[0];
    p.hardening_free = free[2];
    search.inverse = invert(p.normal, free);
    if (!search.inverse.determined) {
      search.status = IdentifyStatus::not_determined;
      return search;
    }

    for (bool rejected = false;; rejected = true) {
      Eigen::Matrix3d damped = p.normal;
      damped.diagonal() *= 1.0 + damping;
      Eigen::Vector3d step = -invert(damped, free).matrix * p.gradient;
      if (std::abs(step[1]) > longest_time_step) step *= longest_time_step / std::abs(step[1]);
      Eigen::Vector3d next = here + step;
      for (int i = 0; i < 3; ++i) next[i] = std::clamp(next[i], bounds[i].lower, bounds[i].upper);
      step = next - here;
      // Lengths of steps in units of the parameters; the remaining error shrinks by their ratio from step to
      // step.
      const auto relative = [&](int i) {
        return i == 1 ? std::abs(step[1]) : std::abs(step[i]) / std::max(std::abs(here[i]), 1e-300);
      };
      const double size = std::max({relative(0), relative(1), relative(2)});
      const double ratio = last_size > 0.0 ? std::min(size / last_size, slowest) : slowest;
      const bool last =
          size <= finest_accuracy * 1e-2 || (!rejected && size * ratio / (1.0 - ratio) <= finest_accuracy);
      if (last) {
        if (rejected) {  // the residual is the rejected point's
          p = fit.evaluate(here[0], here[1], here[2]);
          fit.differentiate(p);
        }
        search.step = step;
        return search;
      }
      if (search.iterations >= most_iterations) {
        search.status = IdentifyStatus::did_not_converge;
        return search;
      }
      const FitPoint tried = fit.evaluate(next[0], next[1], next[2]);
      if (tried.cost <= p.cost * (1.0 + 1e-12)) {
        p = tried;
        damping = damping > least_damping ? 0.3 * damping : 0.0;
        last_size = size;
        break;
      }
      ++search.iterations;
      damping = damping > 0.0 ? 10.0 * damping : least_damping;
      last_size = 0.0;
    }
  }
}

}  // namespace probation
