#pragma once
// Steps of any length from the samples of a record. Plain pointers, as in kernels.hpp.

namespace probation::kernels {

/// Steps that start nothing afresh. All arrays begin with the first of them and have, at -1, the step before.
struct StepSamples {
  long count;
  const double* h;         ///< [s]
  const double* integral;  ///< F at the beginning of a step [MPa]; one more than there are steps
  const double* begin;     ///< 1 / tau_max at the beginning of a step [1/s]; null: it never changes
  const double* end;       ///< and at its end; if it never changes, one number
  const double* rate;      ///< of the strain at the end of a step [1/s]; null: F holds the strain as well
  double modulus;          ///< by which the rate acts [MPa]
};

/// As in Steps; the step before has been formed.
struct FormedSteps {
  double *ratio, *scale, *forcing, *curvature;
};

/// Whether every scale is positive. Ratios are formed where a rule asks for them, curvatures by the parabolic
/// one.
struct StepPasses {
  bool (*two_step)(const StepSamples&, const FormedSteps&);   ///< bE2
  bool (*straight)(const StepSamples&, const FormedSteps&);   ///< SA2
  bool (*parabolic)(const StepSamples&, const FormedSteps&);  ///< SA3
};

}  // namespace probation::kernels
