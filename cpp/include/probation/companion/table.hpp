#pragma once
// Companion relation: a table, straight lines between its points in log-log axes.

#include <string>
#include <utility>
#include <vector>

#include "probation/companion.hpp"
#include "probation/companion/forms.hpp"

namespace probation {

/// tau_max interpolated linearly in (ln r, ln tau_max); the end segments go on beyond the table.
class Table final : public CompanionRelation {
 public:
  /// @param rates    r [1/s], increasing, at least two
  /// @param tau_max  [s], positive, one per rate
  Table(std::vector<double> rates, std::vector<double> tau_max, double rate_floor = default_rate_floor)
      : CompanionRelation(rate_floor), rates_(std::move(rates)), tau_max_(std::move(tau_max)) {
    if (rates_.size() < 2 || rates_.size() != tau_max_.size())
      throw InputError("the companion table has " + std::to_string(rates_.size()) + " rates and " +
                       std::to_string(tau_max_.size()) +
                       " times; at least two of each are needed, one time per rate");
    for (std::size_t i = 0; i < rates_.size(); ++i) {
      const bool positive = rates_[i] > 0.0 && tau_max_[i] > 0.0 && std::isfinite(rates_[i] + tau_max_[i]);
      const bool increasing = i == 0 || rates_[i] > rates_[i - 1];
      if (!positive || !increasing)
        throw InputError("the companion table's row " + std::to_string(i + 1) +
                         " is out of order: rates must be positive and increasing, times positive");
    }
  }

  const std::vector<double>& rates() const noexcept { return rates_; }
  const std::vector<double>& tau_max() const noexcept { return tau_max_; }

  double log_slope(double rate) const override { return table().log_slope(rate); }

 private:
  TableForm table() const noexcept {
    return {rates_.data(), tau_max_.data(), static_cast<int>(rates_.size())};
  }
  double form(double rate) const override { return table().relaxation_time(rate); }

  std::vector<double> rates_;
  std::vector<double> tau_max_;
};

}  // namespace probation
