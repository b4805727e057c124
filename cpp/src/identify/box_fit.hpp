#pragma once
// The best E_u and G at a given tau_max, each within its bounds.

namespace probation {

/// Sums over the samples: u.u, u.v, v.v, u.d, v.d for the columns u, v and the data d.
struct PairSums {
  double uu, uv, vv, ud, vd;
};

struct Bounds {
  double lower, upper;
};

/// Coefficients of u and v, and which of them no bound holds.
struct PairFit {
  double u, v;
  bool u_free, v_free;
};

/// The least squares fit d ~ a u + b v with a and b in their bounds (equal ones hold it). A column of zeros
/// gets its lower bound.
PairFit fit_pair(const PairSums& sums, const Bounds& u, const Bounds& v);

}  // namespace probation
