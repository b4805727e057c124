#pragma once
// How an update of the material point ended. Nothing here throws, allocates, prints or keeps a state.

namespace probation::material {

enum class Status {
  ok = 0,
  cut_step = 1,      ///< no update at this increment: try a smaller one; nothing was written
  bad_constant = 2,  ///< entry `constant` of the outcome is invalid; no increment helps
  short_state = 3,   ///< the caller keeps fewer state variables than the modes need
  no_element = 4,    ///< this kind of element (plane stress, say) is not offered
};

/// The smallest factor by which an increment is multiplied; the one used where there is no update.
constexpr double smallest_cut = 0.25;

struct Outcome {
  Status status = Status::ok;
  int constant = 0;  ///< which constant is bad: 1 for the first; 0 if none is
  /// Below 1 where the update was made, but its estimated error is above the stress tolerance: the factor
  /// that makes the increment small enough.
  double step_factor = 1.0;

  bool ok() const noexcept { return status == Status::ok; }
};

}  // namespace probation::material
