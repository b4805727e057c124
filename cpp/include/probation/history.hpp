#pragma once
// A strain history on any time grid, its jumps of strain rate, and the rates that each scheme sees.

#include <Eigen/Core>
#include <vector>

#include "probation/kinematics.hpp"

namespace probation {

/// How a strain rate is computed from samples.
enum class Differentiator {
  secant,       ///< the piecewise-linear history itself: one rate per step
  backward,     ///< three-point backward difference at the end of the step; the secant after a jump (bE2)
  three_point,  ///< slope of the parabola through three neighbours, one-sided at jumps (SA2, SA3)
};

/// Tag of the constructor that searches the rate for jumps; see History::find_rate_jumps.
struct FindJumps {};

/// The rate at the two ends of every step; shape (n_times - 1). At a jump the two sides differ.
struct StepRates {
  Eigen::ArrayXd begin;  ///< [1/s]
  Eigen::ArrayXd end;    ///< [1/s]
};

/// A strain history: instants, true strain, optionally the true strain rate.
///
/// Step m leads from instant m to instant m + 1. Without rates the samples stand for the piecewise-linear
/// history between them; with rates, for the cubic (Hermite) through both.
class History {
 public:
  using Indices = std::vector<Eigen::Index>;

  /// Without samples: to be assigned to later.
  History() = default;
  /// @param time         [s], finite, increasing; shape (n_times), at least 2
  /// @param true_strain  [-], finite; shape (n_times)
  /// @param strain_rate  [1/s], finite; shape (n_times), or empty
  /// @param jumps        instants (indices) at which the rate jumps: schemes start afresh there
  /// @param direction    commanded direction of each step, +1, -1 or 0 (unknown); shape (n_times - 1), or
  ///                     empty. A rate against it is noise: the companion relation then takes the rate floor
  /// @throws InputError  naming the argument and the sample
  History(const Samples& time, const Samples& true_strain, const Samples& strain_rate = Eigen::ArrayXd(),
          Indices jumps = {}, const Eigen::ArrayXi& direction = Eigen::ArrayXi());
  History(FindJumps, const Samples& time, const Samples& true_strain,
          const Samples& strain_rate = Eigen::ArrayXd(), const Eigen::ArrayXi& direction = Eigen::ArrayXi());

  /// Replaces this history by another one in the same memory; arguments as above. After an exception it must
  /// be assigned to again before it is used.
  void assign(const Samples& time, const Samples& true_strain, const Samples& strain_rate, Indices jumps,
              const Eigen::ArrayXi& direction);
  void assign(FindJumps, const Samples& time, const Samples& true_strain, const Samples& strain_rate,
              const Eigen::ArrayXi& direction);

  /// Instants at which the rate of a sampled history jumps: the secant changes there by over 10 %, thirty
  /// times more than it does around, and three times more than 95 % of the changes of the whole record (of 60
  /// samples or more).
  static Indices find_rate_jumps(const Samples& time, const Samples& true_strain);

  Eigen::Index size() const noexcept { return time_.size(); }
  Eigen::Index steps() const noexcept { return time_.size() - 1; }

  const Eigen::ArrayXd& time() const noexcept { return time_; }
  const Eigen::ArrayXd& true_strain() const noexcept { return true_strain_; }
  const Eigen::ArrayXd& strain_rate() const noexcept { return strain_rate_; }  ///< empty if not given
  const Eigen::ArrayXd& haward_thackray_strain() const noexcept { return haward_thackray_strain_; }
  const Eigen::ArrayXd& step() const noexcept { return step_; }  ///< h [s]; shape (n_times - 1)
  const Indices& jumps() const noexcept { return jumps_; }

  bool rate_given() const noexcept { return strain_rate_.size() > 0; }
  bool fresh(Eigen::Index m) const {
    return fresh_[static_cast<std::size_t>(m)] != 0;
  }  ///< first step after the start or a jump
  double ratio(Eigen::Index m) const { return m == 0 ? 1.0 : step_[m] / step_[m - 1]; }  ///< h / h0
  /// Number of steps from m on that have the length of step m and are not fresh (m itself may be fresh).
  Eigen::Index uniform_run(Eigen::Index m) const { return uniform_until_[static_cast<std::size_t>(m)] - m; }

  /// Rates of this history; given ones are used as they are, but for the secant on the other side of a jump.
  StepRates rates(Differentiator differentiator) const;
  /// The same linear operator on any samples (a change of strain, say), as if no rate had been given.
  StepRates differentiate(const Samples& values, Differentiator differentiator) const;
  /// How rates() moves when strain samples and given rates do; `strain_rate` has n_times entries only where
  /// rates are given.
  StepRates move_rates(const Samples& true_strain, const Samples& strain_rate,
                       Differentiator differentiator) const;

  /// The rate used in the companion relation in step m: its modulus, or the floor where the rate is against
  /// the commanded direction.
  double companion_rate(Eigen::Index m, double rate, double floor) const;
  /// The same for the rates of all steps, in place; shape (n_times - 1).
  void see_companion_rates(Eigen::ArrayXd& rate, double floor) const;
  /// Commanded direction of step m; 0 if unknown.
  int direction(Eigen::Index m) const { return direction_.size() > 0 ? direction_[m] : 0; }
  /// Its derivative with respect to the rate: +1, -1, or 0 on the floor.
  double companion_rate_slope(Eigen::Index m, double rate, double floor) const;

 private:
  StepRates take_given(const Samples& true_strain, const Samples& strain_rate) const;
  /// Copies the samples.
  void take(const Samples& time, const Samples& true_strain, const Samples& strain_rate,
            const Eigen::ArrayXi& direction);
  /// Computes e_HT, throws for invalid samples, and returns whether all steps are even.
  bool check();
  void mark_fresh();
  void find_segments(bool even);

  Eigen::ArrayXd time_, true_strain_, strain_rate_, haward_thackray_strain_, step_;
  Indices jumps_;
  std::vector<char> fresh_;
  std::vector<Eigen::Index> uniform_until_;
  Eigen::ArrayXi direction_;
};

}  // namespace probation
