#pragma once

namespace probation {

/// Which rule of schemes/step.hpp a step uses.
enum class StepRule { backward_euler, bdf2, exponential };

}  // namespace probation
