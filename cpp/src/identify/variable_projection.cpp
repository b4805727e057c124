#include <algorithm>
#include <cmath>

#include "identify/search.hpp"

namespace probation {

Search variable_projection(RecordFit& fit, const SearchSpace& space, double log_time, double accuracy) {
  constexpr int most_iterations = 60;
  constexpr double longest_step = 0.5;  // of ln time
  constexpr double least_secant = 0.1,
                   largest_secant = 10.0;  // limits of a secant slope, over the Gauss-Newton slope
  const bool time_free = !space.held[1];
  Search search;
  Bounds bracket = space.log_time;  // the derivative of the cost is negative at its lower end, else positive
  bool lower_known = false, upper_known = false;
  double theta = std::clamp(log_time, space.log_time.lower, space.log_time.upper);
  double last_theta = 0.0, last_gradient = 0.0, last_step = 0.0;
  for (;;) {
    FitPoint& p = search.point;
    p = fit.project(theta, space.modulus, space.hardening);
    fit.differentiate(p);
    ++search.iterations;
    search.inverse = invert(p.normal, {p.modulus_free, time_free, p.hardening_free});
    search.step = -search.inverse.matrix * p.gradient;
    if (!time_free) return search;
    const double reciprocal = search.inverse.matrix(1, 1);  // of the projected cost's second derivative
    if (!(reciprocal > 0.0)) {
      search.status = IdentifyStatus::not_determined;
      return search;
    }
    const double gradient = p.gradient[1], gauss_newton = 1.0 / reciprocal;
    (gradient < 0.0 ? bracket.lower : bracket.upper) = theta;
    (gradient < 0.0 ? lower_known : upper_known) = true;

    double slope = gauss_newton;
    bool smooth = false;  // no parameter met its bound between the last two points, say
    if (search.iterations > 1 && theta != last_theta) {
      const double secant = (gradient - last_gradient) / (theta - last_theta);
      if (secant > least_secant * gauss_newton && secant < largest_secant * gauss_newton) slope = secant;
      smooth = std::abs(secant - gauss_newton) < 0.1 * gauss_newton;
    }
    const double step = std::clamp(-gradient / slope, -longest_step, longest_step);
    // The error after a secant step is about the product of this step and the one before.
    const bool small = std::abs(step) <= accuracy || (smooth && std::abs(step * last_step) <= accuracy);
    double next = theta + step;
    const bool beyond = next <= bracket.lower || next >= bracket.upper;
    const double end = gradient < 0.0 ? space.log_time.upper : space.log_time.lower;
    if (small && !beyond) {
      search.step *= step / (search.step[1] != 0.0 ? search.step[1] : 1.0);
      search.step[1] = step;
      return search;
    }
    if (theta == end) {  // and the cost still falls beyond the end
      search.step.setZero();
      search.status = IdentifyStatus::at_a_bound;
      return search;
    }
    if (beyond) next = lower_known && upper_known ? 0.5 * (bracket.lower + bracket.upper) : end;
    if (search.iterations >= most_iterations ||
        (lower_known && upper_known &&
         bracket.upper - bracket.lower <= 1e-15 * std::max(1.0, std::abs(theta)))) {
      search.step.setZero();
      if (search.iterations >= most_iterations) search.status = IdentifyStatus::did_not_converge;
      return search;
    }
    last_theta = theta;
    last_gradient = gradient;
    last_step = next - theta;
    theta = next;
  }
}

}  // namespace probation
