#include "checks.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "paths.hpp"
#include "probation/companion/exponential.hpp"
#include "probation/companion/power_law.hpp"
#include "probation/companion/table.hpp"
#include "probation/companion/weissenberg.hpp"
#include "probation/material/measures.hpp"
#include "probation/material/uniaxial.hpp"
#include "probation/solver.hpp"

namespace probation::tools {
namespace {

using namespace material;

constexpr double failed = std::numeric_limits<double>::infinity();

/// A point with its state, stepped from deformation gradient to deformation gradient.
class Point {
 public:
  explicit Point(const Parameters& parameters) : parameters_(parameters) {}

  bool step(const Matrix3& f, double dt) { return step(right_cauchy_green(f), dt); }
  bool step(const Symmetric& c, double dt) {
    return point_update(parameters_, c, dt, state_.data(), state_.data(), now_).ok();
  }
  /// The answer to an increment that is not taken.
  PointStress trial(const Matrix3& f, double dt) const { return trial(right_cauchy_green(f), dt); }
  PointStress trial(const Symmetric& c, double dt) const {
    std::vector<double> after(state_.size());
    PointStress out;
    const bool done = point_update(parameters_, c, dt, state_.data(), after.data(), out).ok();
    if (!done) out.stress.fill(failed);
    return out;
  }
  const PointStress& now() const { return now_; }

 private:
  const Parameters& parameters_;
  std::vector<double> state_ = std::vector<double>(most_point_state);
  PointStress now_;
};

/// Stress of a run of the one-dimensional update; empty if an increment failed.
template <class Increments>
std::vector<double> uniaxial_run(const Parameters& parameters, int count, Increments increments) {
  std::vector<double> state(most_uniaxial_state), stress;
  for (int i = 0; i < count; ++i) {
    const Increment increment = increments(i);
    UniaxialStress out;
    if (!uniaxial_update(parameters, increment.strain, increment.time, state.data(), state.data(), out).ok())
      return {};
    stress.push_back(out.true_stress);
  }
  return stress;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

double tangent_scale(const Parameters& p) {
  return std::max({p.unrelaxed_modulus, p.hardening_modulus, 0.01 * p.bulk_modulus});
}

/// Fourth-order central difference of a function of one number.
template <class Function>
auto difference(Function function, double h) {
  auto out = function(h);
  const auto back = function(-h), far = function(2.0 * h), far_back = function(-2.0 * h);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = (8.0 * (out[i] - back[i]) - (far[i] - far_back[i])) / (12.0 * h);
  return out;
}

constexpr double difference_step = 5e-5;
constexpr double path_time = 40.0;  // [s]
constexpr int tangent_points = 8;

/// Calls `at(point before the increment, F at its end, dt)` along the smooth path; false if an increment
/// failed.
template <class At>
bool along_smooth_path(const Parameters& parameters, At at) {
  Point point(parameters);
  const double dt = path_time / tangent_points;
  for (int i = 1; i <= tangent_points; ++i) {
    const Matrix3 f = smooth_deformation(static_cast<double>(i) / tangent_points);
    at(point, f, dt);
    if (!point.step(f, dt)) return false;
  }
  return true;
}

std::shared_ptr<const CompanionRelation> companion_of(const Parameters& p) {
  const double a = p.coefficients[0], b = p.coefficients[1];
  switch (p.form) {
    case Form::weissenberg:
      return std::make_shared<Weissenberg>(a, b, p.rate_floor);
    case Form::exponential:
      return std::make_shared<Exponential>(a, b, p.rate_floor);
    case Form::power:
      return std::make_shared<PowerLaw>(a, b, p.rate_floor);
    case Form::table:
      return std::make_shared<Table>(std::vector<double>(p.table_rate, p.table_rate + p.table_points),
                                     std::vector<double>(p.table_tau_max, p.table_tau_max + p.table_points),
                                     p.rate_floor);
    default:
      return nullptr;
  }
}

/// Steps of the coarsest of three runs: fine enough for the fastest modes, too, to be past their order
/// reduction.
constexpr int coarsest = 500;
constexpr int steps_of(int level) { return level == 0 ? coarsest : 2 * steps_of(level - 1); }

/// Order in the increment's length from runs of 1, 2 and 4 times as many steps: their largest differences at
/// ten common instants. `run(steps)` answers with as many stresses as steps, none if an increment failed.
template <class Run>
double order(Run run) {
  std::vector<double> stress[3];
  for (int level = 0; level < 3; ++level) {
    stress[level] = run(steps_of(level));
    if (stress[level].empty()) return failed;
  }
  double coarse = 0.0, fine = 0.0;
  for (int instant = 1; instant <= 10; ++instant) {
    const auto at = [&](int level) {
      return stress[level][static_cast<std::size_t>(steps_of(level) / 10 * instant - 1)];
    };
    coarse = std::max(coarse, std::abs(at(0) - at(1)));
    fine = std::max(fine, std::abs(at(1) - at(2)));
  }
  return std::log2(coarse / fine);
}

}  // namespace

double three_against_one_dimension(const Parameters& parameters) {
  const std::vector<double> expected = uniaxial_run(parameters, jumpy_increments, jumpy_increment);
  if (expected.empty()) return failed;
  Point point(parameters);
  double strain = 0.0, worst = 0.0;
  for (int i = 0; i < jumpy_increments; ++i) {
    const Increment increment = jumpy_increment(i);
    strain += increment.strain;
    const Symmetric c = uniaxial_right_cauchy_green(strain);
    if (!point.step(c, increment.time)) return failed;
    const Symmetric& s = point.now().stress;
    worst = std::max(worst, std::abs(c[0] * s[0] - c[1] * s[1] - expected[static_cast<std::size_t>(i)]));
  }
  return worst / largest(expected);
}

double one_dimension_against_engine(const Parameters& parameters) {
  const std::vector<double> found = uniaxial_run(parameters, jumpy_increments, jumpy_increment);
  if (found.empty()) return failed;
  Law law;
  law.unrelaxed_modulus = parameters.unrelaxed_modulus;
  law.hardening_modulus = parameters.hardening_modulus;
  law.tau_max = parameters.tau_max;
  law.alpha = parameters.alpha;
  law.companion = companion_of(parameters);
  law.spectrum.relaxation_ratio =
      Eigen::Map<const Eigen::ArrayXd>(parameters.relaxation_ratio, parameters.modes);
  law.spectrum.modal_weight = Eigen::Map<const Eigen::ArrayXd>(parameters.modal_weight, parameters.modes);

  // Every instant is a jump, so that the engine, too, takes the rate of the increment.
  Eigen::ArrayXd time(jumpy_increments + 1), strain(jumpy_increments + 1), stress(jumpy_increments + 1);
  History::Indices jumps;
  time[0] = strain[0] = 0.0;
  for (int i = 0; i < jumpy_increments; ++i) {
    const Increment increment = jumpy_increment(i);
    time[i + 1] = time[i] + increment.time;
    strain[i + 1] = strain[i] + increment.strain;
    if (i > 0) jumps.push_back(i);
  }
  SolverOptions options;
  options.scheme = Scheme::sa2;
  Solver solver(History(time, strain, Eigen::ArrayXd(), jumps), options);
  solver.stress(law, LawChange(), stress);
  double worst = 0.0;
  for (int i = 0; i < jumpy_increments; ++i)
    worst = std::max(worst, std::abs(stress[i + 1] - found[static_cast<std::size_t>(i)]));
  return worst / largest(found);
}

double uniaxial_tangent_error(const Parameters& parameters) {
  std::vector<double> state(most_uniaxial_state), after(most_uniaxial_state);
  double worst = 0.0;
  for (int i = 0; i < jumpy_increments; i += 7) {
    const Increment increment = jumpy_increment(i);
    UniaxialStress out, moved;
    const double strain = 7.0 * increment.strain, dt = 7.0 * increment.time;
    // The tangent is not continuous where the rate falls to the floor: stay on one side.
    const double h = std::abs(strain) / dt > 10.0 * parameters.rate_floor ? 1e-3 * std::abs(strain) : 1e-9;
    const auto stress = [&](double d) {
      if (!uniaxial_update(parameters, strain + d, dt, state.data(), after.data(), moved).ok())
        moved.true_stress = failed;
      return std::vector<double>{moved.true_stress};
    };
    const double expected = difference(stress, h)[0];
    if (!uniaxial_update(parameters, strain, dt, state.data(), state.data(), out).ok()) return failed;
    if (h > 1e-8) worst = std::max(worst, std::abs(out.tangent - expected));
  }
  return worst / tangent_scale(parameters);
}

double tangent_error(const Parameters& parameters) {
  double worst = 0.0;
  const bool done = along_smooth_path(parameters, [&](const Point& point, const Matrix3& f, double dt) {
    const Symmetric here = right_cauchy_green(f);
    const PointStress out = point.trial(here, dt);
    for (std::size_t c = 0; c < 6; ++c) {
      const auto stress = [&](double d) {
        Symmetric moved = here;
        moved[c] += 2.0 * d;  // C = I + 2 E
        return point.trial(moved, dt).stress;
      };
      const Symmetric expected = difference(stress, difference_step);
      for (std::size_t r = 0; r < 6; ++r)
        worst = std::max(worst, std::abs(out.tangent[r][c] - expected[r] / multiplicity[c]));
    }
  });
  return done ? worst / tangent_scale(parameters) : failed;
}

double jaumann_tangent_error(const Parameters& parameters) {
  double worst = 0.0;
  const bool done = along_smooth_path(parameters, [&](const Point& point, const Matrix3& f, double dt) {
    const PointStress out = cauchy_jaumann(point.trial(f, dt), f);
    for (std::size_t c = 0; c < 6; ++c) {
      // No spin: the Jaumann rate is the plain rate of the Kirchhoff stress.
      const auto kirchhoff = [&](double d) {
        Matrix3 stretch{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
        const double half = c < 3 ? d : 0.5 * d;
        if (c < 3)
          stretch[pairs[c].i][pairs[c].j] += half;
        else
          stretch[pairs[c].i][pairs[c].j] = stretch[pairs[c].j][pairs[c].i] = half;
        const Matrix3 moved = product(stretch, f);
        Symmetric tau = cauchy_jaumann(point.trial(moved, dt), moved).stress;
        for (double& component : tau) component *= determinant(moved) / determinant(f);
        return tau;
      };
      const Symmetric expected = difference(kirchhoff, difference_step);
      for (std::size_t r = 0; r < 6; ++r) worst = std::max(worst, std::abs(out.tangent[r][c] - expected[r]));
    }
  });
  return done ? worst / tangent_scale(parameters) : failed;
}

double first_piola_tangent_error(const Parameters& parameters) {
  double worst = 0.0;
  const bool done = along_smooth_path(parameters, [&](const Point& point, const Matrix3& f, double dt) {
    const FirstPiola out = first_piola(point.trial(f, dt), f);
    for (std::size_t c = 0; c < 9; ++c) {
      const auto stress = [&](double d) {
        Matrix3 moved = f;
        moved[c / 3][c % 3] += d;
        const Matrix3 p = first_piola(point.trial(moved, dt), moved).stress;
        return std::vector<double>{p[0][0], p[0][1], p[0][2], p[1][0], p[1][1],
                                   p[1][2], p[2][0], p[2][1], p[2][2]};
      };
      const std::vector<double> expected = difference(stress, difference_step);
      for (std::size_t r = 0; r < 9; ++r) worst = std::max(worst, std::abs(out.tangent[r][c] - expected[r]));
    }
  });
  return done ? worst / tangent_scale(parameters) : failed;
}

double objectivity_error(const Parameters& parameters) {
  Point still(parameters), turning(parameters);
  double worst = 0.0, most = 0.0;
  for (int i = 1; i <= 40; ++i) {
    const Matrix3 f = smooth_deformation(i / 40.0), q = rotation(0.2 * i), turned = product(q, f);
    if (!still.step(f, 1.0) || !turning.step(turned, 1.0)) return failed;
    const Symmetric expected = transform(congruence(q), cauchy_jaumann(still.now(), f).stress);
    const Symmetric found = cauchy_jaumann(turning.now(), turned).stress;
    for (std::size_t c = 0; c < 6; ++c) {
      worst = std::max(worst, std::abs(found[c] - expected[c]));
      most = std::max(most, std::abs(expected[c]));
    }
  }
  return worst / most;
}

double uniaxial_time_order(const Parameters& parameters) {
  return order([&](int steps) {
    return uniaxial_run(parameters, steps, [&](int i) {
      const double from = static_cast<double>(i) / steps, to = static_cast<double>(i + 1) / steps;
      return Increment{smooth_strain(to) - smooth_strain(from), path_time / steps};
    });
  });
}

double time_order(const Parameters& parameters) {
  return order([&](int steps) {
    Point point(parameters);
    std::vector<double> stress;
    for (int i = 1; i <= steps; ++i) {
      if (!point.step(smooth_deformation(static_cast<double>(i) / steps), path_time / steps))
        return std::vector<double>{};
      stress.push_back(point.now().stress[0] - point.now().stress[1]);
    }
    return stress;
  });
}

double update_cost(const Parameters& parameters, bool with_tangent) {
  std::vector<double> state(most_point_state), after(most_point_state);
  const Symmetric c = right_cauchy_green(smooth_deformation(0.5));
  PointStress out;
  constexpr int repeats = 2000;
  double best = failed, kept = 0.0;
  for (int round = 0; round < 5; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < repeats; ++i) {
      point_update(parameters, c, 1.0, state.data(), after.data(), out, with_tangent);
      kept += out.stress[0];
    }
    const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count() / repeats);
  }
  return std::isfinite(kept) ? best : failed;
}

}  // namespace probation::tools
