#pragma once
// Which steps of a record one kernel call can do.

#include <cmath>

#include "kernels/kernels.hpp"
#include "modal_group.hpp"
#include "probation/history.hpp"
#include "record_steps.hpp"

namespace probation {

/// Calls take(first, count, uniform) for runs of steps that one kernel call can do.
template <class Take>
void for_each_run(const History& history, const std::vector<StepRule>& rule, bool constant_scale, Take take) {
  constexpr Eigen::Index shortest_uniform = 8;
  const Eigen::Index steps = history.steps();
  const auto rule_of = [&](Eigen::Index m) { return rule[static_cast<std::size_t>(m)]; };
  const auto uniform_from = [&](Eigen::Index m) {
    if (!constant_scale || (rule_of(m) == StepRule::bdf2 && std::abs(history.ratio(m) - 1.0) > 1e-9))
      return Eigen::Index{0};
    // The first of even steps may restart or follow another length; those after it go by one rule.
    const Eigen::Index run = history.uniform_run(m);
    return run == 1 || rule_of(m + 1) == rule_of(m) ? run : 1;
  };
  for (Eigen::Index m = 0; m < steps;) {
    const Eigen::Index uniform = uniform_from(m);
    if (uniform >= shortest_uniform) {
      take(m, uniform, true);
      m += uniform;
      continue;
    }
    Eigen::Index end = m + 1;
    while (end < steps && rule_of(end) == rule_of(m) && uniform_from(end) < shortest_uniform) ++end;
    take(m, end - m, false);
    m = end;
  }
}

inline kernels::Steps kernel_steps(Scheme scheme, const RecordSteps<double>& steps, Eigen::Index first,
                                   Eigen::Index count, bool uniform) {
  const auto i = static_cast<std::size_t>(first);
  return {steps.rule[i],
          static_cast<int>(count),
          uniform,
          &steps.scale[i],
          &steps.ratio[i],
          &steps.forcing[i],
          scheme == Scheme::sa3 ? &steps.curvature[i] : nullptr};
}

inline kernels::Modes modes_for(const kernels::Steps& steps, ModalGroup& group) {
  return steps.rule == StepRule::exponential && !steps.uniform && steps.count > 1 ? group.view_with_table()
                                                                                  : group.view();
}

}  // namespace probation
