#include "identify/box_fit.hpp"

#include <algorithm>
#include <array>

namespace probation {
namespace {

bool inside(double value, const Bounds& bounds) { return value > bounds.lower && value < bounds.upper; }

/// Least squares of one coefficient, `with` being its part of the gradient at zero.
double alone(double square, double with, const Bounds& bounds) {
  return square > 0.0 ? std::clamp(with / square, bounds.lower, bounds.upper) : bounds.lower;
}

}  // namespace

PairFit fit_pair(const PairSums& s, const Bounds& u, const Bounds& v) {
  constexpr double collinear = 1e-14;
  const double determinant = s.uu * s.vv - s.uv * s.uv;
  if (determinant > collinear * s.uu * s.vv) {
    const double a = (s.ud * s.vv - s.vd * s.uv) / determinant;
    const double b = (s.vd * s.uu - s.ud * s.uv) / determinant;
    if (inside(a, u) && inside(b, v)) return {a, b, true, true};
  }
  // The minimum of a convex function is on an edge of the box then.
  const auto with_u = [&](double a) { return PairFit{a, alone(s.vv, s.vd - a * s.uv, v), false, false}; };
  const auto with_v = [&](double b) { return PairFit{alone(s.uu, s.ud - b * s.uv, u), b, false, false}; };
  const auto cost = [&](const PairFit& f) {
    return f.u * (f.u * s.uu + 2.0 * (f.v * s.uv - s.ud)) + f.v * (f.v * s.vv - 2.0 * s.vd);
  };
  PairFit best = with_u(u.lower);
  const auto consider = [&](const PairFit& other) {
    if (cost(other) < cost(best)) best = other;
  };
  consider(with_v(v.lower));
  if (u.upper < 1e300) consider(with_u(u.upper));
  if (v.upper < 1e300) consider(with_v(v.upper));
  best.u_free = inside(best.u, u);
  best.v_free = inside(best.v, v);
  return best;
}

}  // namespace probation
