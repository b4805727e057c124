#pragma once
// The hot loops, built once per instruction set. Everything here is plain pointers: no allocation, no
// exceptions.

#include "probation/schemes/step_rule.hpp"

namespace probation::kernels {

/// Modes that share a time scale and a forcing. Arrays are padded to a multiple of four with weights of zero.
struct Modes {
  int padded;                   ///< length of the arrays
  const double* inverse_ratio;  ///< tau_max / tau_j
  const double* weight;         ///< p_j
  double* state;                ///< z_j at the last instant; advanced
  double* before;               ///< z_j one instant earlier; advanced
};

/// Consecutive steps by one rule; x_j = scale * inverse_ratio_j.
struct Steps {
  StepRule rule;
  int count;
  bool uniform;             ///< scale[0] and ratio[0] hold for all steps
  const double* scale;      ///< h / tau_max, or the step of reduced time
  const double* ratio;      ///< h / h0
  const double* forcing;    ///< U
  const double* curvature;  ///< V; null: zero
};

/// One direction of a tangent, in step with Steps; null pointers are zero.
struct TangentDirection {
  const double* forcing;      ///< dU
  const double* curvature;    ///< dV
  const double* log_scale;    ///< d ln scale, per step
  const double* log_inverse;  ///< d ln inverse_ratio, per mode
  const double* weight;       ///< d p_j, per mode
  double* state;              ///< d y_j; advanced
  double* before;             ///< advanced
  double* stress;             ///< d stress, per step; added to
};

/// What a trial step gives without being taken: sums over the modes, weights included.
struct Trial {
  double stress;        ///< sum p y+
  double by_log_scale;  ///< d stress / d ln scale
  double by_forcing;    ///< d stress / d U
  double by_curvature;  ///< d stress / d V
};

struct Kernels {
  const char* name;
  /// Advance the modes by steps.count steps, adding sum_j z_j after each to stress[0..count).
  void (*sweep)(const Modes&, const Steps&, double* stress);
  /// The same in unit-weight states y_j, with tangents; scratch has 9 * padded entries.
  void (*tangent)(const Modes&, const Steps&, double* stress, const TangentDirection*, int directions,
                  double* scratch);
  /// One step (the first of steps) tried, in states z_j; nothing is advanced.
  Trial (*trial)(const Modes&, const Steps&);
};

/// The best build for this processor; PROBATION_KERNELS=baseline in the environment overrides the choice.
const Kernels& best();

namespace baseline {
extern const Kernels table;
}
namespace v3 {
extern const Kernels table;
}

}  // namespace probation::kernels
