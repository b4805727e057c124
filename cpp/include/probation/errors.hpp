#pragma once
// Errors: of the input, or of the numerics. A broken invariant of the engine is a std::logic_error.

#include <stdexcept>
#include <string>

namespace probation {

/// Invalid input. The message names the argument, what was found and what was expected.
class InputError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// No convergence: at which time, and with which residual.
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
