#include "record_rates.hpp"

namespace probation {

using Eigen::Index;

const StepRates& RecordRates::rates(const History& history, Scheme scheme) {
  if (rates_.end.size() == 0)
    rates_ = history.rates(scheme == Scheme::be2 ? Differentiator::backward : Differentiator::three_point);
  return rates_;
}

const RecordRates::Fluidity& RecordRates::fluidity(const History& history, Scheme scheme,
                                                   const std::shared_ptr<const CompanionRelation>& relation) {
  if (relation == relation_) return fluidity_;
  const StepRates& found = rates(history, scheme);
  const Index steps = history.steps();
  const double floor = relation->rate_floor();
  relation_ = nullptr;
  Eigen::ArrayXd& begin = fluidity_.begin;
  Eigen::ArrayXd& end = fluidity_.end;
  begin = found.end;  // rates, until there are times: a refused time is named with its rate
  history.see_companion_rates(begin, floor);
  end.resize(steps);
  relation->relaxation_times(begin.data(), end.data(), static_cast<std::size_t>(steps));
  end = end.inverse();
  // A step mostly begins at the rate at which the one before ended.
  begin.tail(steps - 1) = end.head(steps - 1);
  const auto goes_on = [&](Index m) {
    return m > 0 && found.begin[m] == found.end[m - 1] && history.direction(m) == history.direction(m - 1);
  };
  for (Index m = 0; m < steps; ++m)
    if (!goes_on(m))
      begin[m] = 1.0 / relation->relaxation_time(history.companion_rate(m, found.begin[m], floor));
  relation_ = relation;
  return fluidity_;
}

}  // namespace probation
