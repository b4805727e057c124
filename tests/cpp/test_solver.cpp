// The schemes along a whole record, against literal versions, closed forms and each other.

#include "probation/solver.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "probation/companion/weissenberg.hpp"
#include "probation/errors.hpp"
#include "probation/feedback/self_heating.hpp"
#include "probation/feedback/stress_activation.hpp"
#include "probation/schemes/ramp.hpp"

using namespace probation;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

Law experiment_1() {
  Law law;
  law.unrelaxed_modulus = 3224.0;
  law.tau_max = 5.207;
  law.hardening_modulus = 2.556;
  return law;
}

ArrayXd even(Index n, double duration) { return ArrayXd::LinSpaced(n, 0.0, duration); }

/// Ratios between 0.6 and 1.6.
ArrayXd uneven(Index n, double duration) {
  ArrayXd time(n);
  time[0] = 0.0;
  for (Index i = 1; i < n; ++i) time[i] = time[i - 1] + 1.0 + 0.25 * std::sin(1.7 * static_cast<double>(i));
  return time * (duration / time[n - 1]);
}

ArrayXd smooth(const ArrayXd& time) { return 0.006 * time + 0.016 * (0.25 * time).sin(); }

ArrayXd solve(const Law& law, const History& history, SolverOptions options, const LawChange& change = {}) {
  ArrayXd stress(history.size());
  Solver(history, options).stress(law, change, stress);
  return stress;
}

SolverOptions by(Scheme scheme, Start start = Start::exponential) {
  SolverOptions options;
  options.scheme = scheme;
  options.start = start;
  return options;
}

double largest(const ArrayXd& a) { return a.abs().maxCoeff(); }

/// Eq. (9) in the modal stresses themselves, with the three-point backward difference (the secant where
/// fresh).
ArrayXd literal_be2(const Law& law, const History& history) {
  const ArrayXd &t = history.time(), &e = history.true_strain();
  const ArrayXd tau = law.spectrum.relaxation_ratio * law.tau_max, p = law.spectrum.modal_weight;
  const auto e_ht = [&](Index i) { return std::exp(2 * e[i]) - std::exp(-e[i]); };
  ArrayXd sigma = p * law.hardening_modulus * e_ht(0), before = sigma, total(t.size());
  total[0] = sigma.sum();
  for (Index n = 0; n + 1 < t.size(); ++n) {
    const double h = t[n + 1] - t[n], secant = (e[n + 1] - e[n]) / h;
    ArrayXd next;
    if (history.fresh(n)) {
      next =
          (sigma + h * (p * law.unrelaxed_modulus * secant + p * law.hardening_modulus * e_ht(n + 1) / tau)) /
          (1 + h / tau);
    } else {
      const double h0 = t[n] - t[n - 1], w = h / h0, earlier = (e[n] - e[n - 1]) / h0;
      const double rate = secant + h * (secant - earlier) / (h + h0);
      const double a0 = (1 + 2 * w) / (1 + w), a1 = -(1 + w), a2 = w * w / (1 + w);
      next = (h * (p * law.unrelaxed_modulus * rate + p * law.hardening_modulus * e_ht(n + 1) / tau) -
              a1 * sigma - a2 * before) /
             (a0 + h / tau);
    }
    before = sigma;
    sigma = next;
    total[n + 1] = sigma.sum();
  }
  return total;
}

/// The q and s recursions of docs/law.md, in long double.
ArrayXd literal_sa(const Law& law, const History& history, bool third_order) {
  using Real = long double;
  const ArrayXd &t = history.time(), &e = history.true_strain();
  const Index modes = law.spectrum.modes();
  const auto H = [&](Index i) { return std::exp(Real(2) * e[i]) - std::exp(-Real(e[i])); };
  std::vector<Real> q(static_cast<std::size_t>(modes), 0), s(q.size(), H(0));
  ArrayXd total(t.size());
  for (Index n = -1; n + 1 < t.size(); ++n) {
    Real sum = 0;
    for (Index j = 0; j < modes; ++j) {
      auto &qj = q[static_cast<std::size_t>(j)], &sj = s[static_cast<std::size_t>(j)];
      if (n >= 0) {
        const Real h = Real(t[n + 1]) - t[n], z = h / (Real(law.spectrum.relaxation_ratio[j]) * law.tau_max);
        const Real de = Real(e[n + 1]) - e[n], dH = H(n + 1) - H(n);
        Real c = 0, cH = 0;
        if (third_order && !history.fresh(n)) {
          const Real h0 = Real(t[n]) - t[n - 1];
          c = h * h * (de / h - (Real(e[n]) - e[n - 1]) / h0) / (h + h0);
          cH = h * h * (dH / h - (H(n) - H(n - 1)) / h0) / (h + h0);
        }
        Real k0 = -std::expm1(-z), k1 = 1 - k0 / z, k2 = 1 - 2 * k1 / z;
        if (z < 0.02L) {  // series: k1 = z/2 - z^2/6 + ..., k2 = z/3 - z^2/12 + ...
          Real term = 1;
          k1 = k2 = 0;
          for (int k = 1; k < 12; ++k) {
            term *= -z / k;  // (-z)^k / k!
            k1 -= term / (k + 1);
            k2 -= 2 * term / ((k + 1) * (k + 2));
          }
        }
        qj = std::exp(-z) * qj + ((de - c) * k0 + 2 * c * k1) / z;
        sj = std::exp(-z) * sj + H(n) * k0 + (dH - cH) * k1 + cH * k2;
      }
      sum += Real(law.spectrum.modal_weight[j]) *
             (Real(law.unrelaxed_modulus) * qj + Real(law.hardening_modulus) * sj);
    }
    total[n + 1] = static_cast<double>(sum);
  }
  return total;
}

}  // namespace

TEST_CASE("be2 in z-form is eq. (9) in sigma-form") {
  const Law law = experiment_1();
  for (const ArrayXd& time : {ArrayXd(even(481, 60.0)), uneven(481, 60.0)}) {
    const History history(time, smooth(time));
    CHECK(largest(solve(law, history, by(Scheme::be2, Start::backward_euler)) - literal_be2(law, history)) <=
          1e-12);
  }
}

TEST_CASE("be2 restarts at jumps as the paper starts") {
  const Law law = experiment_1();
  const ArrayXd time = even(241, 60.0), strain = time.min(20.0) * 0.01 - (time - 20.0).max(0.0) * 0.004;
  const History history(time, strain, ArrayXd(), {80});
  CHECK(largest(solve(law, history, by(Scheme::be2, Start::backward_euler)) - literal_be2(law, history)) <=
        1e-12);
}

TEST_CASE("sa2 and sa3 are the recursions of docs/law.md") {
  const Law law = experiment_1();
  for (const ArrayXd& time : {ArrayXd(even(241, 60.0)), uneven(241, 60.0)}) {
    const History history(time, smooth(time), ArrayXd(), {100});
    CHECK(largest(solve(law, history, by(Scheme::sa2)) - literal_sa(law, history, false)) <= 1e-12);
    CHECK(largest(solve(law, history, by(Scheme::sa3)) - literal_sa(law, history, true)) <= 1e-12);
  }
}

TEST_CASE("on a ramp exact is eq. (7), sa3 within 2e-7 MPa, cvode within 1e-6") {
  Law law = experiment_1();
  law.unrelaxed_modulus = 3220.0;
  law.tau_max = 5.2;
  law.hardening_modulus = 2.5;
  const ArrayXd time = even(2001, 400.0), truth = ramp_stress(law, 0.005, time);
  const History history(time, 0.005 * time);
  CHECK(largest(solve(law, history, by(Scheme::exact)) - truth) <= 1e-12 * largest(truth));
  CHECK(largest(solve(law, history, by(Scheme::sa3)) - truth) <= 2e-7);
  CHECK(largest(solve(law, history, by(Scheme::cvode)) - truth) <= 1e-6);
}

TEST_CASE("eq. (7) has a value where its printed form has none") {
  // One mode, tau = 1, E_u = 0, G = 3: G [(e^2t - e^-t)/(2 + 1) - t e^-t] at rate 1; G t e^-t at its twin,
  // rate -1/2.
  Law law;
  law.hardening_modulus = 3.0;
  law.tau_max = 1.0;
  law.spectrum = Spectrum::log_spaced(1);
  const auto at = [&](double rate, double t) { return ramp_stress(law, rate, ArrayXd::Constant(1, t))[0]; };
  CHECK(at(1.0, 1.0) == doctest::Approx(std::exp(2.0) - std::exp(-1.0) - 3 * std::exp(-1.0)).epsilon(1e-14));
  // rate -1/2: int e^-s e^-(t-s) ds = t e^-t, int e^(s/2) e^-(t-s) ds = (e^(t/2) - e^-t) / 1.5
  CHECK(at(-0.5, 1.0) ==
        doctest::Approx(3 * std::exp(-1.0) - 2 * (std::exp(0.5) - std::exp(-1.0))).epsilon(1e-14));
  CHECK(at(0.0, 5.0) == 0.0);
  law.unrelaxed_modulus = 1000.0;
  CHECK(at(1e-3, 1e-12) == doctest::Approx(1e-12).epsilon(1e-11));
  CHECK(exponential_difference(2.0, 2.0) == std::exp(2.0));
  CHECK(exponential_difference(700.0, -700.0) == doctest::Approx(std::exp(700.0) / 1400.0));
  CHECK_THROWS_AS(at(NAN, 1.0), InputError);
  CHECK_THROWS_AS(at(1.0, -1.0), InputError);
}

TEST_CASE("a start at a strain is relaxed: G e_HT") {
  const Law law = experiment_1();
  const ArrayXd time = uneven(30, 50.0);
  const History history(time, ArrayXd::Constant(30, 0.4));
  const double relaxed = law.hardening_modulus * (std::exp(0.8) - std::exp(-0.4));
  for (const Scheme scheme : {Scheme::be2, Scheme::sa2, Scheme::sa3, Scheme::exact, Scheme::cvode})
    CHECK(largest(solve(law, history, by(scheme)) - relaxed) <= 1e-12);
}

TEST_CASE("cvode that may not take enough steps says when it stopped") {
  const ArrayXd time = even(11, 10.0);
  SolverOptions options = by(Scheme::cvode);
  options.cvode.max_steps = 1;
  Solver solver(History(time, 0.01 * time), options);
  ArrayXd stress(11);
  try {
    solver.stress(experiment_1(), {}, stress);
    FAIL("it should have stopped");
  } catch (const ConvergenceError& error) {
    CHECK(error.time() > 0.0);
    CHECK(error.time() < 1.0);
    CHECK(std::isfinite(error.residual_norm()));
    CHECK(std::string(error.what()).find("CV_TOO_MUCH_WORK") != std::string::npos);
  }
}

TEST_CASE("cvode starts afresh at jumps and where a kink stops it, and counts that") {
  const ArrayXd time = (ArrayXd(5) << 0.0, 10.0, 20.0, 20.5, 40.0).finished();
  const ArrayXd strain = (ArrayXd(5) << 0.0, 0.1, 0.1, 0.6, 0.5).finished();
  const Law law = experiment_1();
  const ArrayXd truth = solve(law, History(time, strain), by(Scheme::exact));
  for (const auto& jumps : {History::Indices{}, History::Indices{1, 2, 3}}) {
    Solver solver(History(time, strain, ArrayXd(), jumps), by(Scheme::cvode));
    ArrayXd stress(5);
    solver.stress(law, {}, stress);
    CHECK(largest(stress - truth) <= 2e-6);
    if (!jumps.empty()) CHECK(solver.cvode_statistics().restarts == 3);
    CHECK(solver.cvode_statistics().steps > 100);
  }
}

TEST_CASE("feedbacks are solved within the step: be2 meets cvode as h^2") {
  Law law = experiment_1();
  law.spectrum = Spectrum::log_spaced(12, 4.0);
  LawChange change;
  change.feedbacks = {std::make_shared<StressActivation>(20.0),
                      std::make_shared<SelfHeating>(1.0, 0.02, 0.03, 0.01)};
  const auto at_end = [&](Scheme scheme, Index steps) {
    SolverOptions options = by(scheme);
    options.cvode.relative_tolerance = options.cvode.absolute_tolerance = 1e-12;
    const ArrayXd time = even(steps + 1, 20.0);
    return solve(law, History(time, 0.01 * time), options, change)[steps];
  };
  const double truth = at_end(Scheme::cvode, 100);
  for (const Scheme scheme : {Scheme::be2, Scheme::sa2, Scheme::sa3}) {
    const double coarse = std::abs(at_end(scheme, 800) - truth),
                 fine = std::abs(at_end(scheme, 3200) - truth);
    CHECK(fine < 1e-6);
    CHECK(std::log2(coarse / fine) / 2 > 1.8);
  }
}

TEST_CASE("tangents beside feedbacks are central differences of the stress") {
  Law law = experiment_1();
  law.spectrum = Spectrum::log_spaced(7, 3.0);
  law.companion = std::make_shared<Weissenberg>(0.00464, 0.0367);
  const ArrayXd time = uneven(41, 20.0);
  const History history(time, 0.05 + smooth(time));
  const auto change = [](double activation) {
    LawChange made;
    made.feedbacks = {std::make_shared<StressActivation>(activation),
                      std::make_shared<SelfHeating>(1.0, 0.0, 0.02, 0.03)};
    made.extra_modes = {Eigen::Array2d(100.0, 20.0), Eigen::Array2d(0.5, 9.0)};
    return made;
  };
  for (const Scheme scheme : {Scheme::be2, Scheme::sa2, Scheme::sa3}) {
    Solver solver(history, by(scheme));
    std::vector<Direction> directions = parameter_directions(law, change(15.0), history);
    directions.emplace_back();
    directions.back().feedback = 0;
    ArrayXd stress(41), up(41), down(41);
    RowMajorMatrix found(41, 4);
    solver.tangent(law, change(15.0), directions, stress, found);
    solver.stress(law, change(15.0), up);
    CHECK(largest(stress - up) <= 1e-10);
    for (Index k = 0; k < 4; ++k) {
      const double at[4] = {law.unrelaxed_modulus, law.alpha, law.hardening_modulus, 15.0},
                   step = 1e-5 * at[k];
      const auto moved = [&](double d, ArrayXd& out) {
        Law other = law;
        double activation = 15.0;
        double* const values[4] = {&other.unrelaxed_modulus, &other.alpha, &other.hardening_modulus,
                                   &activation};
        *values[k] += d;
        solver.stress(other, change(activation), out);
      };
      moved(step, up);
      moved(-step, down);
      const ArrayXd difference = (up - down) / (2 * step);
      CHECK(largest(found.col(k).array() - difference) <= 2e-6 * largest(difference));
    }
  }
}

TEST_CASE("a direction that does not fit is refused before anything is written past its end") {
  Law law = experiment_1();
  const ArrayXd time = even(5, 4.0);
  for (const bool coupled : {false, true}) {
    LawChange change;
    if (coupled) change.feedbacks = {std::make_shared<StressActivation>(15.0)};
    Solver solver(History(time, 0.01 * time), by(Scheme::be2));
    ArrayXd stress(5);
    RowMajorMatrix columns(5, 1);
    const auto refuse = [&](auto set) {
      std::vector<Direction> directions(1);
      set(directions[0]);
      CHECK_THROWS_AS(solver.tangent(law, change, directions, stress, columns), InputError);
    };
    refuse([](Direction& d) { d.modal_weight = ArrayXd::Ones(4000); });
    refuse([](Direction& d) { d.log_relaxation_ratio = ArrayXd::Ones(49); });
    refuse([](Direction& d) { d.initial_modal_stress = ArrayXd::Ones(51); });
    refuse([](Direction& d) { d.extra_modulus = ArrayXd::Ones(400); });
    refuse([](Direction& d) { d.log_extra_time = ArrayXd::Ones(400); });
    refuse([](Direction& d) { d.true_strain = ArrayXd::Ones(1); });
    refuse([](Direction& d) { d.strain_rate = ArrayXd::Ones(5); });
    refuse([](Direction& d) { d.relaxed_stress = ArrayXd::Ones(2); });
    refuse([](Direction& d) { d.feedback = 1; });
  }
}

TEST_CASE("a negative modulus is refused, a relaxed stress of the other sign is not") {
  LawChange change;
  change.unrelaxed_modulus_factor = Eigen::Array3d(1.0, 0.0, 2.0);
  change.hardening_factor = Eigen::Array3d(1.0, -0.5, 1.0);
  change.extra_modes = {Eigen::Array2d(0.0, 3.0), Eigen::Array2d(1.0, 2.0)};
  CHECK_NOTHROW(change.validate(3, 50));
  change.unrelaxed_modulus_factor[2] = -0.5;
  CHECK_THROWS_WITH_AS(change.validate(3, 50),
                       "unrelaxed_modulus_factor[2] is -0.5; a finite number, not negative, is needed",
                       InputError);
  change.unrelaxed_modulus_factor[2] = 1.0;
  change.extra_modes.modulus[1] = -3.0;
  CHECK_THROWS_WITH_AS(change.validate(3, 50),
                       "extra_modes.modulus[1] is -3; a finite number, not negative, is needed", InputError);
}

TEST_CASE("outputs of the wrong size are refused") {
  const ArrayXd time = even(5, 4.0);
  ArrayXd stress(4);
  RowMajorMatrix columns(5, 2);
  for (const Scheme scheme : {Scheme::be2, Scheme::exact, Scheme::cvode}) {
    Solver solver(History(time, 0.01 * time), by(scheme));
    CHECK_THROWS_AS(solver.stress(experiment_1(), {}, stress), InputError);
    ArrayXd fitting(5);
    CHECK_THROWS_AS(solver.tangent(experiment_1(), {}, std::vector<Direction>(1), fitting, columns),
                    InputError);
  }
}
