// The exponential rule on uneven steps from the table: see kernels/scale_table.hpp.

#include <doctest/doctest.h>

#include <string>

#include "plain_sweep.hpp"

using namespace probation;
using namespace probation::kernels;

namespace {

/// Steps that differ from one to the next (jitter) and drift by `decades` over the record.
Drive varied(int count, double decades, double jitter) {
  Drive drive(count, false);
  for (int n = 0; n < count; ++n) {
    const double drift = decades * (static_cast<double>(n) / count - 0.5);
    drive.scale[n] = 0.05 * std::pow(10.0, drift) * (1.0 + jitter * std::sin(7.0 * n));
    drive.ratio[n] = n == 0 ? 1.0 : drive.scale[n] / drive.scale[n - 1];
  }
  return drive;
}

/// Modes that no law spaces.
ModalGroup scattered() {
  ArrayXd ratio(23), weight(23);
  for (Index j = 0; j < 23; ++j) {
    ratio[j] = std::pow(10.0, -2.5 + 2.5 * std::sin(1.7 * static_cast<double>(j)));
    weight[j] = 1.0 + std::cos(3.0 * static_cast<double>(j));
  }
  ModalGroup made;
  made.set(ratio, weight);
  made.state = made.weight * 3.0;
  return made;
}

}  // namespace

TEST_CASE("a tabled sweep gives what the formulas give in every step") {
  for (const Kernels* kernel : all_builds())
    for (const bool curved : {true, false})
      for (const double decades : {0.0, 1.0, 6.0})
        for (const ModalGroup& start : {group(50), group(6), scattered()}) {
          CAPTURE(std::string(kernel->name));
          CAPTURE(decades);
          const Drive drive = varied(1003, decades, 0.3);
          Steps steps = drive.steps(StepRule::exponential, false);
          if (!curved) steps.curvature = nullptr;
          ModalGroup plain = start, swept = start;
          const ArrayXd expected = plain_sweep(plain, steps);
          ArrayXd stress = ArrayXd::Zero(1003);
          kernel->sweep(swept.view_with_table(), steps, stress.data());
          check_close(stress, expected, 1e-13);
          check_close(swept.state, plain.state, 1e-13);
          check_close(swept.before, plain.before, 1e-13);
        }
}

TEST_CASE("steps that a table cannot serve are formed") {
  for (const Kernels* kernel : all_builds()) {
    Drive drive = varied(600, 0.0, 0.2);
    for (int n = 0; n < 600; n += 2) drive.scale[n] *= n % 4 == 0 ? 1e-3 : 1e4;
    drive.scale[7] = 1e-300;
    drive.scale[300] = 1e300;
    const Steps steps = drive.steps(StepRule::exponential, false);
    ModalGroup plain = group(50), swept = plain;
    const ArrayXd expected = plain_sweep(plain, steps);
    ArrayXd stress = ArrayXd::Zero(600);
    kernel->sweep(swept.view_with_table(), steps, stress.data());
    check_close(stress, expected, 1e-13);
  }
}

TEST_CASE("a table is kept from sweep to sweep, and forgotten with its spectrum") {
  const Drive drive = varied(500, 0.5, 0.3);
  const Steps steps = drive.steps(StepRule::exponential, false);
  const auto solve = [&](ModalGroup& modes) {
    modes.state.setZero();
    ArrayXd stress = ArrayXd::Zero(500);
    best().sweep(modes.view_with_table(), steps, stress.data());
    return stress;
  };
  ModalGroup modes = group(50);
  const ArrayXd first = solve(modes);
  CHECK((solve(modes) == first).all());
  const Spectrum other = Spectrum::log_spaced(50, 3.0);
  modes.set(other.relaxation_ratio, other.modal_weight);
  ModalGroup fresh;
  fresh.set(other.relaxation_ratio, other.modal_weight);
  CHECK((solve(modes) == solve(fresh)).all());
  CHECK((solve(modes) != first).any());
}

TEST_CASE("where the time scale alone moves, the tangent is the difference of two sweeps") {
  for (const Kernels* kernel : all_builds())
    for (const StepRule rule : all_rules)
      for (const bool uniform : {true, false}) {
        CAPTURE(std::string(kernel->name));
        CAPTURE(uniform);
        constexpr int count = 600;
        const Drive drive = uniform ? Drive(count, true) : varied(count, 0.7, 0.3);
        const Steps steps = drive.steps(rule, uniform);
        ArrayXd log_scale(count);
        for (int n = 0; n < count; ++n) log_scale[n] = uniform ? 0.7 : std::cos(0.1 * n);
        const auto moved = [&](double by) {
          Drive shifted = drive;
          shifted.scale *= (by * log_scale).exp();
          ModalGroup modes = group(50);
          modes.state.setZero();
          modes.before.setZero();
          ArrayXd stress = ArrayXd::Zero(count);
          kernel->sweep(modes.view(), shifted.steps(rule, uniform), stress.data());
          return stress;
        };
        ModalGroup modes = group(50);
        modes.state.setZero();
        modes.before.setZero();
        ArrayXd stress = ArrayXd::Zero(count), slope = stress, scratch(9 * modes.padded());
        ArrayXd d_state = ArrayXd::Zero(modes.padded()), d_before = d_state;
        const TangentDirection along{nullptr, nullptr,        log_scale.data(), nullptr,
                                     nullptr, d_state.data(), d_before.data(),  slope.data()};
        kernel->tangent(modes.view_with_table(), steps, stress.data(), &along, 1, scratch.data());
        check_close(stress, moved(0.0), 1e-13);
        const double step = 1e-4;
        const ArrayXd differences =
            (8.0 * (moved(step) - moved(-step)) - (moved(2.0 * step) - moved(-2.0 * step))) / (12.0 * step);
        check_close(slope, differences, 1e-10);
      }
}
