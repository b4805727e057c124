#pragma once
// What can go wrong: the caller's input, or the numerics. Broken invariants of our own are std::logic_error.

#include <stdexcept>
#include <string>

namespace probation {

/// The caller's mistake. The message names the argument, what was found and what was expected.
class InputError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The numerics gave up: where on the time axis, and how far from converged.
class ConvergenceError : public std::runtime_error {
 public:
  ConvergenceError(const std::string& cause, double time, double residual_norm)
      : std::runtime_error(cause), time_(time), residual_norm_(residual_norm) {}

  double time() const noexcept { return time_; }                    ///< [s]
  double residual_norm() const noexcept { return residual_norm_; }  ///< [MPa]

 private:
  double time_;
  double residual_norm_;
};

}  // namespace probation
