#include "probation/identify/identify.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "identify/search.hpp"
#include "probation/errors.hpp"

namespace probation {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Identified bad(IdentifyStatus status) {
  return {Eigen::Array3d::Constant(not_a_number), Eigen::Array3d::Constant(not_a_number), not_a_number,
          status, 0};
}

}  // namespace

void IdentifyOptions::validate() const {
  if (scheme == Scheme::exact || scheme == Scheme::cvode)
    throw InputError("identification needs sensitivities: use the scheme be2, sa2 or sa3");
  if (held[0] && held[1] && held[2])
    throw InputError("every parameter is held; one is needed that is left to identify");
  for (Index i = 0; i < 3; ++i) {
    const bool possible = lower[i] >= 0.0 && lower[i] < upper[i];
    if (!possible)
      throw InputError("the bounds of parameter " + std::to_string(i) + " are " + std::to_string(lower[i]) +
                       " and " + std::to_string(upper[i]) + "; 0 <= lower < upper is needed");
  }
  if (substeps < 1) throw InputError("substeps is " + std::to_string(substeps) + "; at least 1 is needed");
}

struct Identifier::Workspace {
  Law law;
  IdentifyOptions options;
  RecordFit full, thinned;

  /// Range of tau_max (or alpha) that is searched: from far below a sampling interval to far beyond the
  /// record.
  Bounds log_time(const History& history) const {
    double low = 1e-3, high = 1e3;
    if (!law.companion) {
      low *= history.step().minCoeff();
      high *= history.time()[history.size() - 1] - history.time()[0];
    }
    low = std::max(low, options.lower[1]);
    return {std::log(low), std::log(std::max(low, std::min(high, options.upper[1])))};
  }

  /// The history, its jumps looked for among the samples: between them nothing was measured.
  History history_of(const ArrayXd& time, const ArrayXd& true_strain) const {
    if (!options.find_jumps) return {time, true_strain};
    const Index every = options.substeps, samples = (time.size() - 1) / every + 1;
    if (every == 1) return {FindJumps{}, time, true_strain};
    const ArrayXd sampled_time = time(Eigen::seqN(0, samples, every));
    const ArrayXd sampled_strain = true_strain(Eigen::seqN(0, samples, every));
    History::Indices jumps = History::find_rate_jumps(sampled_time, sampled_strain);
    for (Index& jump : jumps) jump *= every;
    return {time, true_strain, ArrayXd(), std::move(jumps)};
  }

  Search search(const SearchSpace& space, const ArrayXd& true_stress, const ArrayXd& noise) {
    constexpr Index coarse_steps = 100;
    const Index every = options.substeps;
    full.take_data(true_stress, noise, every);
    if (options.held[1]) return best_from({space.log_time.lower}, space);
    const Index stride = every * std::max<Index>((true_stress.size() - 1) / coarse_steps, 1);
    if (stride <= 1) return best_from(coarse_search(full, space), space);
    thinned.solves.take_thinned(full.solves, stride);
    thinned.take_data(true_stress, noise, every);
    Search best = best_from(coarse_search(thinned, space), space);
    // Times below the thinned steps may have been missed.
    const double at = best.point.log_time, near = 1e-6;
    if (best.iterations > 0 && at > space.log_time.lower + near && at < space.log_time.upper - near)
      return best;
    Search other = best_from(coarse_search(full, space), space);
    other.iterations += best.iterations;
    return other;
  }

  /// From every start to the least cost; no iteration where there is no start.
  Search best_from(const std::vector<double>& starts, const SearchSpace& space) {
    Search best;
    std::size_t best_start = 0;
    const auto from = [&](std::size_t k) {
      return options.method == IdentifyMethod::variable_projection
                 ? variable_projection(full, space, starts[k])
                 : levenberg_marquardt(full, space, starts[k]);
    };
    int iterations = 0;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const Search one = from(k);
      iterations += one.iterations;
      if (k > 0 && !(one.point.cost < best.point.cost)) continue;
      best = one;
      best_start = k;
    }
    if (best_start + 1 < starts.size()) best = from(best_start);  // whose residual is kept
    best.iterations = iterations;
    return best;
  }
};

Identifier::Identifier(const Law& law, const IdentifyOptions& options)
    : work_(std::make_unique<Workspace>()) {
  options.validate();
  Law tried = law;  // parameters that are not held may have any value
  for (int i = 0; i < 3; ++i)
    if (!options.held[static_cast<std::size_t>(i)])
      (i == 0          ? tried.unrelaxed_modulus
       : i == 2        ? tried.hardening_modulus
       : law.companion ? tried.alpha
                       : tried.tau_max) = 1.0;
  tried.validate();
  work_->law = std::move(tried);
  work_->options = options;
  work_->full.solves.set_modes(law.spectrum);
  work_->thinned.solves.set_modes(law.spectrum);
}
Identifier::~Identifier() = default;
Identifier::Identifier(Identifier&&) noexcept = default;
Identifier& Identifier::operator=(Identifier&&) noexcept = default;

Identified Identifier::operator()(const ArrayXd& time, const ArrayXd& true_strain, const ArrayXd& true_stress,
                                  const ArrayXd& noise) {
  // Beyond these, fourth powers overflow; no specimen has a strain of 50.
  constexpr double largest_strain = 50.0, largest_stress = 1e70, least_stress = 1e-70;
  Workspace& w = *work_;
  const IdentifyOptions& options = w.options;
  const Law& law = w.law;
  const Index n = true_stress.size();
  const auto free = static_cast<Index>(std::count(options.held.begin(), options.held.end(), false));
  if (n < 2 || n <= free) return bad(IdentifyStatus::too_few_samples);
  const bool finite = time.allFinite() && true_strain.allFinite() && true_stress.allFinite() &&
                      true_strain.abs().maxCoeff() < largest_strain && noise.allFinite() &&
                      (noise > 0.0).all();
  const double stress = finite ? true_stress.abs().maxCoeff() : not_a_number;
  if (!finite || stress > largest_stress || (stress > 0.0 && stress < least_stress))
    return bad(IdentifyStatus::not_finite);
  if (!(time.tail(time.size() - 1) > time.head(time.size() - 1)).all())
    return bad(IdentifyStatus::times_do_not_increase);

  SearchSpace space{options.held, {}, {}, {}};
  try {
    const History history = w.history_of(time, true_strain);
    w.full.solves.take(law, history, options.scheme, options.start);
    space.log_time = w.log_time(history);
  } catch (const InputError&) {
    return bad(IdentifyStatus::impossible_rate);
  }
  const double fixed[3] = {law.unrelaxed_modulus, law.companion ? law.alpha : law.tau_max,
                           law.hardening_modulus};
  space.modulus = options.held[0] ? Bounds{fixed[0], fixed[0]} : Bounds{options.lower[0], options.upper[0]};
  space.hardening = options.held[2] ? Bounds{fixed[2], fixed[2]} : Bounds{options.lower[2], options.upper[2]};
  if (options.held[1]) space.log_time = {std::log(fixed[1]), std::log(fixed[1])};

  const Search search = w.search(space, true_stress, noise);
  if (search.iterations == 0) return bad(IdentifyStatus::not_determined);
  w.full.move(search.step);
  const Eigen::Array3d ends[2] = {
      {space.modulus.lower, std::exp(space.log_time.lower), space.hardening.lower},
      {space.modulus.upper, std::exp(space.log_time.upper), space.hardening.upper}};
  Identified found;
  found.status = search.status;
  found.iterations = search.iterations;
  found.rms_residual = w.full.rms();
  found.parameters = {search.point.unrelaxed_modulus + search.step[0],
                      options.held[1] ? fixed[1] : std::exp(search.point.log_time + search.step[1]),
                      search.point.hardening_modulus + search.step[2]};
  found.parameters = found.parameters.max(ends[0]).min(ends[1]);

  // At a bound, too, the others' errors count it as free.
  const FreeInverse all = invert(search.point.normal, {!options.held[0], !options.held[1], !options.held[2]});
  const double scatter = w.full.cost() / static_cast<double>(n - free);
  for (int i = 0; i < 3; ++i) {
    const bool held = options.held[static_cast<std::size_t>(i)];
    const double variance = scatter * all.matrix(i, i);
    found.standard_error[i] = held             ? 0.0
                              : all.determined ? std::sqrt(variance)
                                               : std::numeric_limits<double>::infinity();
    if (i == 1) found.standard_error[i] *= found.parameters[1];
    if (!held && found.status == IdentifyStatus::converged &&
        (found.parameters[i] <= ends[0][i] || found.parameters[i] >= ends[1][i]))
      found.status = IdentifyStatus::at_a_bound;
  }
  if (!all.determined && found.status == IdentifyStatus::converged)
    found.status = IdentifyStatus::not_determined;
  return found;
}

}  // namespace probation
