#include "probation/schemes/cvode.hpp"

#include <cvode/cvode_diag.h>

#include <cmath>
#include <exception>
#include <sstream>
#include <string>

#include "probation/errors.hpp"
#include "sampled.hpp"
#include "sundials_shim.hpp"

namespace probation {
namespace {

using Eigen::Index;
using State = Eigen::Map<Eigen::ArrayXd>;
using ConstState = Eigen::Map<const Eigen::ArrayXd>;

/// Eq. (6) as an initial value problem within one step of the history. State: modal stresses, extra modes,
/// memories.
class StepProblem {
 public:
  StepProblem(const Law& law, const LawChange& change, const History& history)
      : law_(law),
        change_(change),
        history_(history),
        rates_(history.rates(history.rate_given() ? Differentiator::backward : Differentiator::secant)),
        largest_rate_(rates_.end.abs().maxCoeff()),
        time_factor_(change.relaxation_time_factor, 1.0),
        modulus_factor_(change.unrelaxed_modulus_factor, 1.0),
        hardening_factor_(change.hardening_factor, 1.0),
        added_(change.added_relaxed_stress, 0.0),
        modes_(law.spectrum.modes()),
        extra_(change.extra_modes.modulus.size()),
        memories_(static_cast<Index>(change.feedbacks.size())) {}

  Index size() const { return modes_ + extra_ + memories_; }
  void enter(Index step) { step_ = step; }
  /// Whether the rate changes where this step begins: a piecewise-linear history kinks at every sample, and
  /// past steps are a bad prediction across a kink (0.1 MPa on rough strain at a tolerance of 1e-10).
  bool kinks() const { return std::abs(rates_.begin[step_] - rates_.end[step_ - 1]) > 1e-9 * largest_rate_; }
  double stress(const ConstState& state) const { return state.head(modes_ + extra_).sum(); }

  void start(State state) const {
    state.setZero();
    if (change_.initial_modal_stress.size() > 0) {
      state.head(modes_) = change_.initial_modal_stress;
      return;
    }
    // Relaxed: sigma_j = p_j sigma^r(0), which may itself depend on the stress.
    const double relaxed =
        law_.hardening_modulus * hardening_factor_[0] * history_.haward_thackray_strain()[0] + added_[0];
    const double total_weight = law_.spectrum.modal_weight.sum();
    double stress = total_weight * relaxed, factor = 1.0;
    for (int i = 0; i < 200 && memories_ > 0; ++i) {
      factor = feedback(stress, nullptr).hardening;
      stress = total_weight * relaxed * factor;
    }
    state.head(modes_) = law_.spectrum.modal_weight * (relaxed * factor);
  }

  void rate(double t, const ConstState& state, State rate) const {
    const Index m = step_;
    const double h = history_.step()[m], u = (t - history_.time()[m]) / h;
    const Eigen::ArrayXd& strain = history_.true_strain();
    // Cubic through the strains and rates at both ends; a straight line where the rates are the secant.
    const double rise = strain[m + 1] - strain[m], begin = rates_.begin[m], end = rates_.end[m];
    const double bend_begin = h * begin - rise, bend_end = rise - h * end;
    const double now = strain[m] + u * rise + u * (1.0 - u) * ((1.0 - u) * bend_begin + u * bend_end);
    const double speed = (rise + (1.0 - 2.0 * u) * ((1.0 - u) * bend_begin + u * bend_end) +
                          u * (1.0 - u) * (bend_end - bend_begin)) /
                         h;
    const auto sample = [&](const Sampled& s) { return (1.0 - u) * s[m] + u * s[m + 1]; };

    const double total = stress(state);
    const FeedbackFactor<double> moved = feedback(total, state.data() + modes_ + extra_);
    double tau_max = law_.tau_max;
    if (law_.companion)
      tau_max = law_.alpha * law_.companion->relaxation_time(
                                 history_.companion_rate(m, speed, law_.companion->rate_floor()));
    tau_max *= sample(time_factor_) / moved.fluidity;
    const double modulus = law_.unrelaxed_modulus * sample(modulus_factor_);
    const double relaxed =
        (law_.hardening_modulus * sample(hardening_factor_) * haward_thackray_strain(now) + sample(added_)) *
        moved.hardening;  // eq. (3)

    rate.head(modes_) = law_.spectrum.modal_weight * (modulus * speed) -
                        (state.head(modes_) - law_.spectrum.modal_weight * relaxed) /
                            (law_.spectrum.relaxation_ratio * tau_max);  // eq. (6)
    rate.segment(modes_, extra_) = change_.extra_modes.modulus * speed -
                                   state.segment(modes_, extra_) / change_.extra_modes.relaxation_time;
    const double plastic_rate = modulus > 0.0 ? speed - rate.head(modes_ + extra_).sum() / modulus : speed;
    for (Index k = 0; k < memories_; ++k) {
      const double loss =
          change_.feedbacks[static_cast<std::size_t>(k)]->loss_rate(Feedback::no_parameter).value;
      rate[modes_ + extra_ + k] = total * plastic_rate - loss * state[modes_ + extra_ + k];
    }
  }

  std::exception_ptr failure;

 private:
  FeedbackFactor<double> feedback(double stress, const double* memory) const {
    FeedbackFactor<double> total;
    for (Index k = 0; k < memories_; ++k) {
      const auto one = change_.feedbacks[static_cast<std::size_t>(k)]->factor(
          stress, memory ? memory[k] : 0.0, Feedback::no_parameter);
      total.fluidity *= one.fluidity.value;
      total.hardening *= one.hardening.value;
    }
    return total;
  }

  const Law& law_;
  const LawChange& change_;
  const History& history_;
  StepRates rates_;
  double largest_rate_;
  Sampled time_factor_, modulus_factor_, hardening_factor_, added_;
  Index modes_, extra_, memories_;
  Index step_ = 0;
};

// No exception may leave this function: CVODE is C.
int right_hand_side(sunrealtype t, N_Vector state, N_Vector rate, void* user_data) noexcept {
  auto& problem = *static_cast<StepProblem*>(user_data);
  try {
    const Index size = problem.size();
    problem.rate(t, ConstState(N_VGetArrayPointer(state), size), State(N_VGetArrayPointer(rate), size));
    return ConstState(N_VGetArrayPointer(rate), size).allFinite() ? 0
                                                                  : 1;  // CVODE may retry with a smaller step
  } catch (...) {
    problem.failure = std::current_exception();
    return -1;
  }
}

}  // namespace

CvodeStatistics cvode_stress(const Law& law, const LawChange& change, const History& history,
                             const CvodeOptions& options, Eigen::Ref<Eigen::ArrayXd> stress) {
  law.validate();
  change.validate(history.size(), law.spectrum.modes());
  for (const double tolerance : {options.relative_tolerance, options.absolute_tolerance})
    if (!(tolerance > 0.0) || !std::isfinite(tolerance))
      throw InputError("relative_tolerance and absolute_tolerance must be positive numbers");
  if (options.max_steps < 1) throw InputError("max_steps must be at least 1");

  const double begin = history.time()[0];
  StepProblem problem(law, change, history);
  sundials::Messages messages;
  const sundials::Context context = sundials::make_context(messages);
  const sundials::Vector state = sundials::make_vector(static_cast<sunindextype>(problem.size()), context);
  problem.start(State(N_VGetArrayPointer(state.get()), problem.size()));
  const sundials::Memory memory = sundials::make_memory(CV_BDF, context, messages);

  CvodeStatistics statistics;
  const auto require = [&](int flag, double time) {
    if (flag >= 0) return;
    if (problem.failure) std::rethrow_exception(problem.failure);
    double norm = 0.0;
    const sundials::Vector errors = sundials::make_vector(static_cast<sunindextype>(problem.size()), context);
    if (CVodeGetEstLocalErrors(memory.get(), errors.get()) == CV_SUCCESS)
      norm = ConstState(N_VGetArrayPointer(errors.get()), problem.size()).matrix().norm();
    std::ostringstream message;
    message << "CVODE stopped at t = " << time << " s: " << sundials::flag_name(flag);
    if (!messages.last.empty()) message << " (" << messages.last << ")";
    message << "; looser tolerances or more max_steps may help";
    throw ConvergenceError(message.str(), time, norm);
  };
  require(CVodeInit(memory.get(), right_hand_side, begin, state.get()), begin);
  require(CVodeSetUserData(memory.get(), &problem), begin);
  require(CVodeSStolerances(memory.get(), options.relative_tolerance, options.absolute_tolerance), begin);
  require(CVodeSetNonlinConvCoef(memory.get(), 0.01),
          begin);  // the diagonal Jacobian converges slowly under feedbacks
  require(CVodeSetMaxNumSteps(memory.get(), options.max_steps), begin);
  require(CVDiag(memory.get()), begin);

  const auto collect = [&] {  // counters restart with every CVodeReInit
    long steps = 0, evaluations = 0, failures = 0, iterations = 0, nonlinear = 0;
    int order = 0;
    CVodeGetNumSteps(memory.get(), &steps);
    CVodeGetNumRhsEvals(memory.get(), &evaluations);
    CVodeGetNumErrTestFails(memory.get(), &failures);
    CVodeGetNumNonlinSolvIters(memory.get(), &iterations);
    CVodeGetNumNonlinSolvConvFails(memory.get(), &nonlinear);
    CVodeGetLastOrder(memory.get(), &order);
    statistics.steps += steps;
    statistics.rate_evaluations += evaluations;
    statistics.error_test_failures += failures;
    statistics.nonlinear_iterations += iterations;
    statistics.nonlinear_failures += nonlinear;
    statistics.last_order = order;
  };

  const Sampled area(change.load_bearing_area, 1.0);
  const auto total = [&] {
    return problem.stress(ConstState(N_VGetArrayPointer(state.get()), problem.size()));
  };
  stress[0] = area[0] * total();
  for (Index m = 0; m < history.steps(); ++m) {
    problem.enter(m);
    if (m > 0 && (history.fresh(m) || problem.kinks())) {
      collect();
      ++statistics.restarts;
      require(CVodeReInit(memory.get(), history.time()[m], state.get()), history.time()[m]);
    }
    const double end = history.time()[m + 1];
    require(CVodeSetStopTime(memory.get(), end), end);
    double reached = history.time()[m];
    const int flag = CVode(memory.get(), end, state.get(), &reached, CV_NORMAL);
    require(flag, reached);
    stress[m + 1] = area[m + 1] * total();
  }
  collect();
  return statistics;
}

}  // namespace probation
