#pragma once
// The companion relation: the longest relaxation time from the strain rate. Forms live in companion/.

#include <cmath>
#include <cstddef>

#include "probation/errors.hpp"

namespace probation {

/// tau_max as a function of the strain rate r > 0, eqs. (10)-(12).
///
/// The law calls it with r = max(|rate|, rate_floor()): the relations are fitted between 5e-5 and 1e-2 1/s,
/// and eq. (11) gives no positive time below 1.2e-8 1/s.
class CompanionRelation {
 public:
  static constexpr double default_rate_floor = 1e-7;  // [1/s]

  virtual ~CompanionRelation() = default;

  /// Longest relaxation time [s] at rate [1/s].
  /// @throws InputError  where the relation gives no positive, finite time
  double relaxation_time(double rate) const {
    const double time = form(rate);
    if (!(time > 0.0) || !std::isfinite(time)) throw_no_time(rate, time);
    return time;
  }

  /// The same at many rates; both arrays have `count` entries.
  void relaxation_times(const double* rate, double* time, std::size_t count) const {
    forms(rate, time, count);
    for (std::size_t i = 0; i < count; ++i)
      if (!(time[i] > 0.0) || !std::isfinite(time[i])) throw_no_time(rate[i], time[i]);
  }

  /// d ln tau_max / d ln rate at rate [1/s].
  virtual double log_slope(double rate) const = 0;

  double rate_floor() const noexcept { return rate_floor_; }  ///< [1/s]

 protected:
  explicit CompanionRelation(double rate_floor) : rate_floor_(rate_floor) {
    if (!(rate_floor > 0.0) || !std::isfinite(rate_floor))
      throw InputError("rate_floor must be a positive number");
  }

 private:
  virtual double form(double rate) const = 0;
  virtual void forms(const double* rate, double* time, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) time[i] = form(rate[i]);
  }
  [[noreturn]] static void throw_no_time(double rate, double time);

  double rate_floor_;
};

}  // namespace probation
