#include <algorithm>

#include "identify/search.hpp"

namespace probation {
namespace {

constexpr int points = 41;               // evenly spaced in the logarithm
constexpr double much_higher = 2.0;      // times the lowest cost
constexpr double thinning_error = 1e-5;  // of the data's sum of squares
constexpr double coarse_accuracy = 3e-3;
constexpr std::size_t most_minima = 3;

}  // namespace

std::vector<double> coarse_search(RecordFit& fit, const SearchSpace& space) {
  const Bounds& range = space.log_time;
  if (!(range.upper > range.lower)) return {range.lower};
  std::array<double, points> cost{};
  const double spacing = (range.upper - range.lower) / (points - 1);
  const auto point = [&](int i) { return range.lower + spacing * i; };
  for (int i = 0; i < points; ++i)
    cost[static_cast<std::size_t>(i)] = fit.project(point(i), space.modulus, space.hardening).cost;
  const auto cost_at = [&](int i) {
    return i < 0 || i >= points ? std::numeric_limits<double>::infinity() : cost[static_cast<std::size_t>(i)];
  };
  const double low = *std::min_element(cost.begin(), cost.end());
  const double most = much_higher * low + thinning_error * fit.data_square();
  std::vector<int> minima;
  for (int i = 0; i < points; ++i)
    if (cost_at(i) <= most && cost_at(i) < cost_at(i - 1) && cost_at(i) <= cost_at(i + 1))
      minima.push_back(i);
  std::sort(minima.begin(), minima.end(), [&](int a, int b) { return cost_at(a) < cost_at(b); });
  if (minima.size() > most_minima) minima.resize(most_minima);
  std::vector<double> found;
  for (const int i : minima) {
    SearchSpace near = space;
    near.log_time = {std::max(point(i - 1), range.lower), std::min(point(i + 1), range.upper)};
    const Search better = variable_projection(fit, near, point(i), coarse_accuracy);
    found.push_back(better.point.log_time);
  }
  return found;
}

}  // namespace probation
