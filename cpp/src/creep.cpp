#include "probation/creep.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "kernels/kernels.hpp"
#include "modal_group.hpp"
#include "probation/errors.hpp"
#include "record_steps.hpp"
#include "require_finite.hpp"

namespace probation {
namespace {

using Eigen::Index;

Dual haward_thackray(Dual strain) {
  return {haward_thackray_strain(strain.value), haward_thackray_slope(strain.value) * strain.slope};
}

/// Newton's iteration from `strain`, kept inside a bracket by bisection: where the flow stress falls with the
/// rate, Newton alone runs away. The bracket opens from the start, so that the nearest root is found. False
/// if there is none.
template <class Function>
bool solve_from(double& strain, Function function) {
  constexpr int most_openings = 60, most_iterations = 200;
  constexpr double first_opening = 1e-9, tolerance = 1e-14;
  const double side = function(strain).value;
  if (side == 0.0) return true;
  double outer = strain, inner = strain, opening = first_opening;
  const double away = side > 0.0 ? -1.0 : 1.0;  // stress grows with strain at large
  for (int i = 0; (function(outer).value > 0.0) == (side > 0.0); ++i) {
    if (i == most_openings || std::abs(outer) > 50.0) return false;
    inner = outer;
    outer = strain + away * opening;
    opening *= 2.0;
  }
  double low = side > 0.0 ? outer : inner, high = side > 0.0 ? inner : outer;
  strain = 0.5 * (low + high);
  for (int i = 0; i < most_iterations; ++i) {
    const Dual found = function(strain);
    (found.value < 0.0 ? low : high) = strain;
    double next = strain - found.value / found.slope;
    const bool inside = next > std::min(low, high) && next < std::max(low, high);
    if (!inside) next = 0.5 * (low + high);
    const bool done = std::abs(next - strain) <= tolerance * (1.0 + std::abs(next));
    strain = next;
    if (done) {
      function(strain);
      return true;
    }
  }
  return false;
}

}  // namespace

Eigen::ArrayXd creep_strain(const Law& law, const LawChange& change, const Samples& time,
                            const Samples& true_stress, const History::Indices& jumps, Start start) {
  const Index n = time.size();
  const History grid(time, Eigen::ArrayXd::Zero(n), Eigen::ArrayXd(), jumps);
  if (true_stress.size() != n)
    throw InputError("true_stress has " + std::to_string(true_stress.size()) + " samples; " +
                     std::to_string(n) + " are needed");
  if (!true_stress.allFinite()) throw InputError("true_stress has a sample that is not finite");
  law.validate();
  change.validate(n, law.spectrum.modes());
  if (!(law.unrelaxed_modulus > 0.0))
    throw InputError("unrelaxed_modulus must be positive for a stress to be imposed");
  if (!change.feedbacks.empty() || change.extra_modes.modulus.size() > 0)
    throw InputError("creep does not take feedbacks or extra modes");

  const Sampled time_factor(change.relaxation_time_factor, 1.0),
      modulus_factor(change.unrelaxed_modulus_factor, 1.0);
  const Sampled hardening_factor(change.hardening_factor, 1.0), added(change.added_relaxed_stress, 0.0);
  const Sampled area(change.load_bearing_area, 1.0);
  const double total_weight = law.spectrum.modal_weight.sum();
  const auto relaxed_stress = [&](Index i, Dual strain) {
    return law.hardening_modulus * hardening_factor[i] * haward_thackray(strain) + added[i];
  };
  const auto fluidity = [&](Index m, Index instant, Dual rate) {
    if (!law.companion) return Dual(1.0 / (law.tau_max * time_factor[instant]));
    const double floor = law.companion->rate_floor(), seen = grid.companion_rate(m, rate.value, floor);
    const double value = 1.0 / (law.alpha * law.companion->relaxation_time(seen) * time_factor[instant]);
    const double log_slope =
        law.companion->log_slope(seen) * grid.companion_rate_slope(m, rate.value, floor) / seen;
    return Dual(value, -value * log_slope * rate.slope);
  };

  RecordInputs<Dual> in;
  in.true_strain.resize(static_cast<std::size_t>(n));
  in.relaxed_stress.resize(static_cast<std::size_t>(n));
  in.unrelaxed_modulus.resize(static_cast<std::size_t>(n));
  in.fluidity_begin.resize(static_cast<std::size_t>(n - 1));
  in.fluidity_end.resize(static_cast<std::size_t>(n - 1));
  for (Index i = 0; i < n; ++i)
    in.unrelaxed_modulus[static_cast<std::size_t>(i)] = law.unrelaxed_modulus * modulus_factor[i];

  // Loaded at once: no mode has had time to relax, sigma_j = p_j E_u e.
  const double loaded = true_stress[0] / area[0] / in.unrelaxed_modulus[0].value / total_weight;
  in.true_strain[0] = loaded;
  in.relaxed_stress[0] = relaxed_stress(0, loaded).value;
  if (!std::isfinite(in.relaxed_stress[0].value)) {
    std::ostringstream message;
    message << "true_stress[0] is " << true_stress[0] << " MPa; put on at once it strains by " << loaded
            << ", which is no strain";
    throw InputError(message.str());
  }
  ModalGroup modes;
  modes.set(law.spectrum.relaxation_ratio, law.spectrum.modal_weight);
  modes.state = modes.weight * (in.unrelaxed_modulus[0].value * loaded - in.relaxed_stress[0].value);

  const kernels::Kernels& kernel = kernels::best();
  Eigen::ArrayXd strain(n);
  strain[0] = loaded;
  for (Index m = 0; m < n - 1; ++m) {
    const auto i = static_cast<std::size_t>(m);
    const double h = grid.step()[m], ratio = grid.ratio(m), target = true_stress[m + 1] / area[m + 1];
    double next = strain[m] + (m > 0 && !grid.fresh(m) ? (strain[m] - strain[m - 1]) * ratio : 0.0);
    StepForcing<double> taken{};
    const auto excess = [&](double end_strain) {  // of the stress over the imposed one, with its slope
      in.true_strain[i + 1] = {end_strain, 1.0};
      in.relaxed_stress[i + 1] = relaxed_stress(m + 1, in.true_strain[i + 1]);
      Dual rate = (in.true_strain[i + 1] - in.true_strain[i]) / h;
      if (!grid.fresh(m)) {
        const Bdf2Difference difference(ratio);
        rate = (difference.next * in.true_strain[i + 1] + difference.here * in.true_strain[i] +
                difference.before * in.true_strain[i - 1]) /
               h;
      }
      in.fluidity_end[i] = fluidity(m, m + 1, rate);
      if (grid.fresh(m)) in.fluidity_begin[i] = fluidity(m, m, rate);
      const StepForcing<Dual> f = step_forcing(Scheme::be2, start, step_data(grid, in, m, Dual(), Dual()));
      taken = {f.rule, f.scale.value, f.forcing.value, 0.0};
      const kernels::Steps step{taken.rule, 1, false, &taken.scale, &ratio, &taken.forcing, nullptr};
      const kernels::Trial trial = kernel.trial(modes.view(), step);
      return Dual(trial.stress + total_weight * in.relaxed_stress[i + 1].value - target,
                  trial.by_log_scale * f.scale.slope / f.scale.value + trial.by_forcing * f.forcing.slope +
                      total_weight * in.relaxed_stress[i + 1].slope);
    };
    const bool converged = solve_from(next, excess);
    if (!converged)
      throw ConvergenceError("no strain was found that carries the stress at t = " +
                                 std::to_string(time[m + 1]) + " s; a finer time grid may help",
                             time[m + 1], std::abs(excess(next).value));
    double stress = 0.0;
    kernel.sweep(modes.view(), {taken.rule, 1, false, &taken.scale, &ratio, &taken.forcing, nullptr},
                 &stress);
    strain[m + 1] = next;
    in.true_strain[i + 1] = next;
    in.relaxed_stress[i + 1] = in.relaxed_stress[i + 1].value;
    in.fluidity_end[i] = in.fluidity_end[i].value;
    if (grid.fresh(m)) in.fluidity_begin[i] = in.fluidity_begin[i].value;
    if (m + 1 < n - 1 && !grid.fresh(m + 1)) in.fluidity_begin[i + 1] = in.fluidity_end[i];
  }
  require_finite(strain, grid.time(), "the strain");
  return strain;
}

}  // namespace probation
