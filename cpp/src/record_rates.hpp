#pragma once
// The rates of a record and the relaxation times that follow from them: the same for all solves of a record.

#include <Eigen/Core>
#include <memory>

#include "probation/companion.hpp"
#include "probation/history.hpp"
#include "probation/solver.hpp"

namespace probation {

/// Formed when first asked for. Every call must be for the same history and scheme.
class RecordRates {
 public:
  const StepRates& rates(const History& history, Scheme scheme);

  /// alpha / tau_max [1/s] at the two ends of every step, by a relation; shape (n_times - 1).
  struct Fluidity {
    Eigen::ArrayXd begin, end;
  };
  const Fluidity& fluidity(const History& history, Scheme scheme,
                           const std::shared_ptr<const CompanionRelation>& relation);

 private:
  StepRates rates_;
  std::shared_ptr<const CompanionRelation>
      relation_;  // of which fluidity_ was formed; relations never change
  Fluidity fluidity_;
};

}  // namespace probation
