#include "coupled.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "coupled_tangent.hpp"
#include "probation/errors.hpp"

namespace probation {
namespace {

using Eigen::Index;
constexpr int most_corrections = 50;
// Of Newton's last correction, relative. The stress errs by its square, slopes at the solution by itself.
constexpr double tolerance_of_stress = 1e-7, tolerance_of_slopes = 1e-12;

bool small(double correction, double stress, double tolerance) {
  return std::abs(correction) <= tolerance * (1e-3 + std::abs(stress));
}

Dual moved(Dual a, double by) { return {a.value + a.slope * by, a.slope}; }

/// How the forcing of an even step depends on the last sample of the strain, over E_u.
double end_weight(StepRule rule) { return rule == StepRule::bdf2 ? Bdf2Difference(1.0).next : 1.0; }

/// On to the next step.
template <class Real>
void shift(Three<Real>& three, double here, double next) {
  three.before = three.here;
  three.here = here;
  three.next = next;
}

}  // namespace

CoupledSolver::CoupledSolver(const Law& law, const LawChange& change, const History& history, Scheme scheme,
                             Start start, ModalGroup& main, CoupledTables& tables)
    : law_(law),
      change_(change),
      history_(history),
      scheme_(scheme),
      start_(start),
      main_(main),
      tables_(tables),
      kernel_(kernels::best()),
      total_weight_(law.spectrum.modal_weight.sum()),
      feedbacks_(change.feedbacks) {
  const bool curved = scheme == Scheme::sa3;
  tables_.exponential.set(main, curved);
  tables_.rational.set(main, false);
}

void CoupledSolver::solve(const RecordInputs<double>& base, const std::vector<Direction>& directions,
                          Eigen::Ref<Eigen::ArrayXd> stress, Eigen::Ref<RowMajorMatrix>* derivatives) {
  const Sampled area(change_.load_bearing_area, 1.0);
  tolerance_ = directions.empty() ? tolerance_of_stress : tolerance_of_slopes;
  begin(base);
  stress[0] = area[0] * stress_here_;
  std::vector<CoupledTangent> tangents;
  tangents.reserve(directions.size());
  const auto put = [&](std::size_t k, Index instant, double slope) {
    const Sampled log_area(directions[k].log_load_bearing_area, 0.0);
    (*derivatives)(instant, static_cast<Index>(k)) =
        area[instant] * slope + stress[instant] * log_area[instant];
  };
  for (std::size_t k = 0; k < directions.size(); ++k) {
    tangents.emplace_back(*this, directions[k]);
    put(k, 0, tangents[k].start_slope());
  }
  LinearisedStep linearised(main_.padded());
  StepEnd guess = enter(0);
  for (Index m = 0; m < history_.steps(); ++m) {
    solve_step(guess, stress[m + 1]);
    stress[m + 1] = area[m + 1] * step_.stress;
    if (!tangents.empty()) linearised.at(*this);
    for (std::size_t k = 0; k < tangents.size(); ++k)
      put(k, m + 1, tangents[k].take(linearised, (*derivatives)(m + 1, static_cast<Index>(k))));
    const kernels::NearStep taken = expanded_.taken(step_.forcing);
    leave();
    if (m + 1 == history_.steps()) return;
    guess = enter(m + 1);
    expanded_.set(table().near(expanded_.unit * guess.forcing.scale.value));
    kernel_.advance(main_.view(), taken, expanded_.cell ? &expanded_.near : nullptr, expanded_.modes);
  }
}

void CoupledSolver::begin(const RecordInputs<double>& base) {
  const Index modes = law_.spectrum.modes();
  base_ = &base;
  // s = sum of the modal stresses; for a relaxed start it depends on s through the hardening's factor.
  const double base_relaxed = at(base.relaxed_stress, 0);
  double s = given_start() ? change_.initial_modal_stress.sum() : total_weight_ * base_relaxed;
  begun_ = feedbacks_.at_start({s, 1.0});
  for (int i = 0; i < most_corrections && !given_start(); ++i) {
    const Dual relaxed = total_weight_ * base_relaxed * begun_.hardening;
    const double correction = (relaxed.value - s) / (1.0 - relaxed.slope);
    s += correction;
    begun_ = feedbacks_.at_start({s, 1.0});
    if (small(correction, s, tolerance_of_slopes)) break;
  }
  relaxed_start_ = base_relaxed * begun_.hardening.value;
  if (given_start())
    main_.state.head(modes) = change_.initial_modal_stress - law_.spectrum.modal_weight * relaxed_start_;
  stress_here_ = s;
  step_.factor = begun_;
  step_.relaxed_stress = relaxed_start_;
  strained_.true_strain.next = base.true_strain[0];
  strained_.unrelaxed_modulus.next = base.unrelaxed_modulus[0];
  strained_.constant_modulus = base.unrelaxed_modulus.size() == 1;
}

inline StepEnd CoupledSolver::evaluate(double stress) {
  StepEnd end;
  end.factor = feedbacks_.at(stress);
  end.relaxed_stress = law_relaxed_ * end.factor.hardening;
  end.fluidity = law_fluidity_ * end.factor.fluidity;
  data_.relaxed_stress.next = end.relaxed_stress;
  data_.fluidity.next = end.fluidity;
  end.forcing = step_forcing(scheme_, start_, data_, stiff_);
  return end;
}

StepEnd CoupledSolver::enter(Index m) {
  const auto i = static_cast<std::size_t>(m);
  StepData<double>& s = strained_;
  s.fresh = data_.fresh = history_.fresh(m);
  s.h = data_.h = history_.step()[m];
  s.ratio = data_.ratio = history_.ratio(m);
  shift(s.true_strain, s.true_strain.next, base_->true_strain[i + 1]);
  shift(s.unrelaxed_modulus, s.unrelaxed_modulus.next, at(base_->unrelaxed_modulus, m + 1));
  if (scheme_ == Scheme::be2) s.end_rate = base_->end_rate.empty() ? difference_rate(s) : base_->end_rate[i];
  stiff_ = stiff_part(scheme_, start_, s);
  law_relaxed_ = base_->relaxed_stress[i + 1];
  law_fluidity_ = at(base_->fluidity_end, m);
  shift(data_.relaxed_stress, step_.relaxed_stress.value, law_relaxed_);
  shift(data_.fluidity, at(base_->fluidity_begin, m) * step_.factor.fluidity.value, law_fluidity_);
  data_.previous_scale = step_.forcing.scale.value;
  data_.previous_forcing = step_.forcing.forcing.value;
  rise_ = s.true_strain.next - s.true_strain.here;
  modulus_ = 0.5 * (s.unrelaxed_modulus.here + s.unrelaxed_modulus.next);
  feedbacks_.enter(s.h, stress_here_, rise_, modulus_);
  step_.m = m;
  step_.ratio = s.ratio;
  expanded_.set(scheme_ == Scheme::be2 ? be2_rule(s.fresh, s.ratio, start_) : StepRule::exponential, s.ratio);
  guess_ = stress_here_ + continuation_.change(s.fresh, s.h, rise_);
  return evaluate(guess_);
}

bool CoupledSolver::look(double scale) {
  expanded_.set(table().near(expanded_.unit * scale));
  if (expanded_.cell) kernel_.look(main_.view(), expanded_.near, expanded_.modes);
  return expanded_.cell != nullptr;
}

/// So near the solution that a linear correction reaches it.
inline void CoupledSolver::finish(const StepEnd& end, double stress, double correction, double by_forcing) {
  continuation_.add(stress - stress_here_, rise_, by_forcing * modulus_ * end_weight(end.forcing.rule));
  feedbacks_.settle(correction);
  step_.stress = stress;
  step_.relaxed_stress = moved(end.relaxed_stress, correction);
  step_.fluidity = moved(end.fluidity, correction);
  step_.factor.fluidity = moved(end.factor.fluidity, correction);
  step_.factor.hardening = moved(end.factor.hardening, correction);
  step_.forcing.rule = end.forcing.rule;
  step_.forcing.scale = moved(end.forcing.scale, correction);
  step_.forcing.forcing = moved(end.forcing.forcing, correction);
  step_.forcing.curvature = moved(end.forcing.curvature, correction);
}

/// Newton on the stress at the end of the step.
bool CoupledSolver::iterate(double stress, StepEnd end, double extra_stress) {
  for (int iteration = 0; iteration < most_corrections; ++iteration) {
    const double scale = end.forcing.scale.value;
    if (!expanded_.reaches(scale) && !look(scale)) return false;
    const StressAtEnd found = expanded_.stress(end.forcing);
    const Dual excess{found.stress.value + total_weight_ * end.relaxed_stress.value + extra_stress - stress,
                      found.stress.slope + total_weight_ * end.relaxed_stress.slope - 1.0};
    residual_ = excess.value;
    const double compliance = -1.0 / excess.slope, correction = excess.value * compliance;
    if (!std::isfinite(correction)) return false;
    stress += correction;
    if (small(correction, stress, tolerance_)) {
      finish(end, stress, correction, compliance * found.by_forcing);
      return true;
    }
    end = evaluate(stress);
  }
  return false;
}

void CoupledSolver::solve_step(const StepEnd& guess, double extra_stress) {
  if (iterate(guess_, guess, extra_stress)) return;
  // Where this does not converge, the iteration starts again from a straight continuation.
  guess_ = stress_here_ + continuation_.straight(data_.fresh);
  if (!iterate(guess_, evaluate(guess_), extra_stress)) fail();
}

void CoupledSolver::leave() {
  feedbacks_.leave();
  stress_here_ = step_.stress;
}

void CoupledSolver::fail() const {
  const double t = history_.time()[step_.m + 1];
  std::ostringstream message;
  message << "the feedback's stress did not converge at t = " << t << " s; a finer time grid may help";
  throw ConvergenceError(message.str(), t, std::abs(residual_));
}

}  // namespace probation
