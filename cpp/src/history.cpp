#include "probation/history.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "kernels/kernels.hpp"
#include "probation/errors.hpp"

namespace probation {
namespace {

using Eigen::Index;

void require(bool good, const char* argument, Index sample, double found, const char* expected) {
  if (good) return;
  std::ostringstream message;
  message << argument << "[" << sample << "] is " << found << "; " << expected;
  throw InputError(message.str());
}

void require_finite(const Eigen::ArrayXd& values, const char* argument) {
  if (values.allFinite()) return;
  for (Index i = 0; i < values.size(); ++i)
    require(std::isfinite(values[i]), argument, i, values[i], "a finite number is needed");
}

void require_length(Index found, Index expected, const char* argument) {
  if (found == expected) return;
  throw InputError(std::string(argument) + " has " + std::to_string(found) + " entries; " +
                   std::to_string(expected) + " are needed to match time");
}

/// By how much a step may differ from the first of an even segment. Times read from a file or made by
/// linspace are even to rounding only: the limit is relative to the times around it, since later times must
/// not change it.
double evenness(double step, double time, double other_time) {
  return 1e-10 * step + 4e-16 * std::max(std::abs(time), std::abs(other_time));
}

}  // namespace

History::History(const Samples& time, const Samples& true_strain, const Samples& strain_rate, Indices jumps,
                 const Eigen::ArrayXi& direction) {
  assign(time, true_strain, strain_rate, std::move(jumps), direction);
}

History::History(FindJumps find, const Samples& time, const Samples& true_strain, const Samples& strain_rate,
                 const Eigen::ArrayXi& direction) {
  assign(find, time, true_strain, strain_rate, direction);
}

void History::assign(const Samples& time, const Samples& true_strain, const Samples& strain_rate,
                     Indices jumps, const Eigen::ArrayXi& direction) {
  take(time, true_strain, strain_rate, direction);
  const bool even = check();
  jumps_ = std::move(jumps);
  mark_fresh();
  find_segments(even);
}

void History::assign(FindJumps, const Samples& time, const Samples& true_strain, const Samples& strain_rate,
                     const Eigen::ArrayXi& direction) {
  take(time, true_strain, strain_rate, direction);
  const bool even = check();
  jumps_ = find_rate_jumps(time_, true_strain_);
  mark_fresh();
  find_segments(even);
}

void History::take(const Samples& time, const Samples& true_strain, const Samples& strain_rate,
                   const Eigen::ArrayXi& direction) {
  time_ = time;
  true_strain_ = true_strain;
  strain_rate_ = strain_rate;
  direction_ = direction;
}

bool History::check() {
  const Index n = time_.size();
  if (n < 2) throw InputError("time has " + std::to_string(n) + " samples; at least 2 are needed");
  require_length(true_strain_.size(), n, "true_strain");
  if (strain_rate_.size() > 0) require_length(strain_rate_.size(), n, "strain_rate");
  if (direction_.size() > 0) require_length(direction_.size() + 1, n, "direction (plus one)");
  const kernels::SamplePasses& passes = kernels::best().samples;
  const kernels::StepTraits steps =
      passes.inspect_steps(time_.data(), n, evenness(time_[1] - time_[0], time_[0], time_[n - 1]));
  if (!steps.increasing) require_finite(time_, "time");
  for (Index i = 1; i < n && !steps.increasing; ++i) {
    const double step = time_[i] - time_[i - 1];
    require(step > 0.0, "time", i, time_[i], "time must increase from sample to sample");
    require(std::isnormal(step), "time", i, time_[i],
            "the step to it is too long or too short for double precision");
  }
  probation::haward_thackray_strain(true_strain_, haward_thackray_strain_);
  require_finite(strain_rate_, "strain_rate");
  return steps.even;
}

void History::mark_fresh() {
  fresh_.assign(static_cast<std::size_t>(steps()), 0);
  fresh_[0] = 1;
  std::sort(jumps_.begin(), jumps_.end());
  for (const Index jump : jumps_) {
    if (jump < 0 || jump >= size())
      throw InputError("jumps holds " + std::to_string(jump) + "; an index of time is needed");
    if (jump < steps()) fresh_[static_cast<std::size_t>(jump)] = 1;
  }
}

void History::find_segments(bool even) {
  step_.resize(steps());
  uniform_until_.resize(static_cast<std::size_t>(steps()));
  const auto end_of = [&](Index m) {
    if (even) {
      const auto jump = std::upper_bound(jumps_.begin(), jumps_.end(), m);
      return jump == jumps_.end() ? steps() : std::min(*jump, steps());
    }
    const double step = time_[m + 1] - time_[m];
    const auto goes_on = [&](Index end) {
      return std::abs((time_[end + 1] - time_[end]) - step) <= evenness(step, time_[m], time_[end + 1]);
    };
    Index end = m + 1;
    while (end < steps() && !fresh(end) && goes_on(end)) ++end;
    return end;
  };
  for (Index m = 0; m < steps();) {
    const Index end = end_of(m);
    // A clock since 1970 ticks in 2e-7 s: the mean of the segment knows its step better than any one
    // difference.
    step_.segment(m, end - m).setConstant((time_[end] - time_[m]) / static_cast<double>(end - m));
    std::fill(uniform_until_.begin() + m, uniform_until_.begin() + end, end);
    m = end;
  }
}

History::Indices History::find_rate_jumps(const Samples& time, const Samples& true_strain) {
  constexpr double least_change = 0.1, outstanding = 30.0, rare = 0.05;
  constexpr Index nearest = 2, farthest = 5, fewest_for_rarity = 60;
  const Index n = time.size();
  Indices jumps;
  require_length(true_strain.size(), n, "true_strain");
  if (n < 3) return jumps;
  // Usually there is none. Products round differently from quotients: a change near the limit is examined.
  const double surely_less = least_change * (1.0 - 1e-9);
  if (!kernels::best().samples.secant_changes(time.data(), true_strain.data(), n, surely_less)) return jumps;
  const Eigen::ArrayXd secant =
      (true_strain.tail(n - 1) - true_strain.head(n - 1)) / (time.tail(n - 1) - time.head(n - 1));
  if (!secant.allFinite()) return jumps;
  const auto change = [&](Index i) { return std::abs(secant[i] - secant[i - 1]); };
  const auto large = [&](Index i) {
    return change(i) > least_change * std::max(std::abs(secant[i]), std::abs(secant[i - 1]));
  };
  Index first = 1;
  while (first + 1 < n && !large(first)) ++first;
  if (first + 1 >= n) return jumps;
  // The secant of rounded strains often changes by one quantum: a jump must also exceed these frequent
  // changes.
  double common = 0.0;
  if (n >= fewest_for_rarity) {
    std::vector<double> changes;
    changes.reserve(static_cast<std::size_t>(n - 2));
    for (Index i = 1; i + 1 < n; ++i) changes.push_back(change(i));
    const auto tail =
        changes.begin() + static_cast<std::ptrdiff_t>((1.0 - rare) * static_cast<double>(changes.size()));
    std::nth_element(changes.begin(), tail, changes.end());
    common = *tail;
  }
  for (Index i = first; i + 1 < n; ++i) {
    if (change(i) < 3.0 * common || !large(i)) continue;
    // The third largest change around: one neighbouring jump (which may take two samples) must not hide this
    // one.
    std::vector<double> around;
    for (Index distance = nearest; distance <= farthest; ++distance) {
      if (i - distance >= 1) around.push_back(change(i - distance));
      if (i + distance + 1 < n) around.push_back(change(i + distance));
    }
    std::sort(around.begin(), around.end(), std::greater<>());
    const double usual = around.size() > 2 ? around[2] : 0.0;
    if (change(i) > outstanding * usual) jumps.push_back(i);
  }
  return jumps;
}

StepRates History::differentiate(const Samples& values, Differentiator differentiator) const {
  const Index steps = this->steps();
  const Eigen::ArrayXd secant = (values.tail(steps) - values.head(steps)) / step_;
  StepRates rates{secant, secant};
  const auto starts = [&](Index m) {
    return m >= steps || fresh(m);
  };  // a segment ends where the next starts
  // Slope of the parabola over steps m - 1 and m, at their common instant; and beyond it by half the bend.
  const auto middle = [&](Index m) {
    return (secant[m - 1] * step_[m] + secant[m] * step_[m - 1]) / (step_[m - 1] + step_[m]);
  };
  const auto at_end = [&](Index m) {
    return secant[m] + (secant[m] - secant[m - 1]) * step_[m] / (step_[m - 1] + step_[m]);
  };
  const auto at_start = [&](Index m) {
    return secant[m] - (secant[m + 1] - secant[m]) * step_[m] / (step_[m] + step_[m + 1]);
  };

  switch (differentiator) {
    case Differentiator::secant:
      break;
    case Differentiator::backward:
      for (Index m = 1; m < steps; ++m)
        if (!fresh(m)) {
          rates.end[m] = at_end(m);
          rates.begin[m] = rates.end[m - 1];
        }
      break;
    case Differentiator::three_point:
      for (Index m = 0; m < steps; ++m) {
        if (!fresh(m))
          rates.begin[m] = middle(m);
        else if (!starts(m + 1))
          rates.begin[m] = at_start(m);
        if (!starts(m + 1))
          rates.end[m] = middle(m + 1);
        else if (!fresh(m))
          rates.end[m] = at_end(m);
      }
      break;
  }
  return rates;
}

StepRates History::rates(Differentiator differentiator) const {
  return move_rates(true_strain_, strain_rate_, differentiator);
}

StepRates History::move_rates(const Samples& true_strain, const Samples& strain_rate,
                              Differentiator differentiator) const {
  return rate_given() ? take_given(true_strain, strain_rate) : differentiate(true_strain, differentiator);
}

/// Linear in its arguments; which side of a jump a given rate belongs to is a matter of the history itself.
StepRates History::take_given(const Samples& true_strain, const Samples& strain_rate) const {
  const Index steps = this->steps();
  StepRates rates{strain_rate.head(steps), strain_rate.tail(steps)};
  const auto secant = [&](const auto& strain, Index m) { return (strain[m + 1] - strain[m]) / step_[m]; };
  for (const Index jump : jumps_) {
    if (jump == 0 || jump >= steps) continue;
    // One given rate cannot serve both sides of a jump: it is used on the side whose secant is nearer, the
    // other side uses its secant.
    const double given = strain_rate_[jump];
    const double to_before = std::abs(given - secant(true_strain_, jump - 1));
    const double to_after = std::abs(given - secant(true_strain_, jump));
    if (to_before <= to_after)
      rates.begin[jump] = secant(true_strain, jump);
    else
      rates.end[jump - 1] = secant(true_strain, jump - 1);
  }
  return rates;
}

double History::companion_rate(Index m, double rate, double floor) const {
  const int commanded = direction(m);
  return std::max(commanded == 0 ? std::abs(rate) : commanded * rate, floor);
}

void History::see_companion_rates(Eigen::ArrayXd& rate, double floor) const {
  if (direction_.size() == 0) {
    rate = rate.abs().max(floor);
    return;
  }
  for (Index m = 0; m < steps(); ++m) rate[m] = companion_rate(m, rate[m], floor);
}

double History::companion_rate_slope(Index m, double rate, double floor) const {
  if (companion_rate(m, rate, floor) <= floor) return 0.0;
  return rate < 0.0 ? -1.0 : 1.0;
}

}  // namespace probation
