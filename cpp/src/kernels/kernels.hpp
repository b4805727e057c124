#pragma once
// The hot loops, built once per instruction set. Everything here is plain pointers: no allocation, no
// exceptions.

#include <cstdint>

#include "kernels/form_steps.hpp"
#include "kernels/samples.hpp"
#include "kernels/whitening.hpp"
#include "probation/schemes/step_rule.hpp"

namespace probation::kernels {

/// Coefficients of uneven steps of the exponential rule, kept from step to step and from sweep to sweep; see
/// scale_table.hpp. The memory is the caller's.
struct ScaleTable {
  static constexpr int slots = 128, terms = 7;
  std::int64_t cell[slots];  ///< which scales a slot serves; negative: none
  double* rows;              ///< slots * terms * padded entries
};

/// Modes that share a time scale and a forcing. Arrays are padded to a multiple of four with weights of zero.
struct Modes {
  int padded;                   ///< length of the arrays
  const double* inverse_ratio;  ///< tau_max / tau_j
  const double* weight;         ///< p_j
  double* state;                ///< z_j at the last instant; advanced
  double* before;               ///< z_j one instant earlier; advanced
  ScaleTable* table = nullptr;  ///< of these inverse ratios; null: coefficients are formed in every step
};

/// Consecutive steps by one rule; x_j = scale * inverse_ratio_j.
struct Steps {
  StepRule rule;
  int count;
  bool uniform;             ///< scale[0] and ratio[0] hold for all steps
  const double* scale;      ///< h / tau_max, or the step of reduced time
  const double* ratio;      ///< h / h0
  const double* forcing;    ///< U
  const double* curvature;  ///< V; null: zero. In uniform steps half the change of U, but for the first step
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

/// Result of a trial step, which advances no state: sums over the modes, weights included.
struct Trial {
  double stress;        ///< sum p y+
  double by_log_scale;  ///< d stress / d ln scale
  double by_forcing;    ///< d stress / d U
  double by_curvature;  ///< d stress / d V
};

/// Coefficients of all modes near one scale, as polynomials in the scale's relative distance from it: the
/// term of distance^k of mode j stands in [k * stride + j]. Of bE2 on uneven steps the scale is x / a, a the
/// coefficient of Bdf2Difference at the end of the step, and the coefficients are a times as large.
struct CoefficientRows {
  static constexpr int terms = 6;
  static constexpr double reach = 3.5e-3;  ///< distance up to which the omitted terms are below rounding
  const double* forcing;                   ///< of U
  const double* curvature;                 ///< of V; null: zero
  long stride;
};

/// A step near the scale of some rows. With c and d the coefficients of U and V there,
///
///   exponential: z+ = z + c (p U - scale z / r) + d p V,     otherwise: z+ = c (here z + before z- + p U).
struct NearStep {
  bool exponential;
  CoefficientRows rows;
  double distance;
  double scale;         ///< where exponential
  double here, before;  ///< where not
  double forcing, curvature;
  int quasi_steady;  ///< how many modes (the first ones, a multiple of four) are quasi-steady:
                     ///< quasi_steady.hpp
};

/// Contribution of the modes' states before a step to the stress after it: sum_j z_j+ for U = V = 0 is the
/// sum over k < CoefficientRows::terms of sums[k] distance^k, or where exponential, sums[kept] less scale
/// times that.
struct StressNearby {
  static constexpr int kept = CoefficientRows::terms;
  double sums[kept + 2];  ///< the last one only fills a vector
};

/// Derivatives of the stress at the end of a step with respect to the step's inputs.
struct StepSlopes {
  double by_log_scale, by_forcing, by_curvature;
};

/// Derivatives of a step's inputs along a direction.
struct StepChange {
  double log_scale, forcing, curvature;
};

/// One direction along which a step is differentiated, in states z_j; null pointers are zero.
struct StepDirection {
  const double* log_inverse;  ///< d ln inverse_ratio, per mode
  const double* weight;       ///< d p_j, per mode
  double* state;              ///< d z_j; advanced
  double* before;             ///< advanced
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
  /// Rows of `count` modes (a multiple of four) whose x at the rows' scale are given.
  void (*fill_rows)(bool exponential, long count, const double* x, double* forcing, double* curvature,
                    long stride);
  /// sum_j p_j times each row.
  void (*weigh_rows)(const Modes&, const CoefficientRows&, double* by_forcing, double* by_curvature);
  /// Expands a step that is still to be taken.
  void (*look)(const Modes&, const NearStep&, StressNearby& found);
  /// Takes a step and, if there is a next one, expands it in the same pass. States of modes that are
  /// quasi-steady in both steps are not advanced: they have no influence afterwards.
  void (*advance)(const Modes&, const NearStep& taken, const NearStep* next, StressNearby& found);
  /// One step's coefficients and slopes, for drift() and move(), to rows (5 * padded entries); not taken.
  StepSlopes (*linearise)(const Modes&, const Steps&, double* rows);
  /// Advances a direction by the step at fixed scale, U and V; returns the derivative of the stress.
  double (*drift)(const Modes&, const Steps&, const StepDirection&, const double* rows);
  /// Adds what d ln scale, dU and dV do.
  void (*move)(const Modes&, const StepChange&, const StepDirection&, const double* rows);
  StepPasses form;
  SamplePasses samples;
  Whiten whiten;
};

/// The best build for this processor, or the one that PROBATION_KERNELS in the environment names.
/// @throws InputError  if PROBATION_KERNELS names a build that is missing or that this processor cannot run
const Kernels& best();

/// Every build that this processor can run, best first; ends with null.
const Kernels* const* runnable();

namespace portable {
extern const Kernels table;
}
namespace baseline {
extern const Kernels table;
}
namespace v3 {
extern const Kernels table;
}

}  // namespace probation::kernels
