#include "probation/slider.hpp"

#include <algorithm>
#include <cmath>

#include "probation/errors.hpp"

namespace probation {

Eigen::ArrayXd behind_backlash(const Samples& value, double width, double begin) {
  if (!(width >= 0.0)) throw InputError("width is below 0; a width of the backlash is needed");
  Eigen::ArrayXd path(value.size());
  double place = std::isnan(begin) && value.size() > 0 ? value[0] : begin;
  for (Eigen::Index n = 0; n < value.size(); ++n) {
    place = std::min(std::max(place, value[n] - width), value[n] + width);
    path[n] = place;
  }
  return path;
}

}  // namespace probation
