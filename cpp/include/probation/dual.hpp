#pragma once
// A number and its derivative in one direction: forward differentiation of the O(n) part of every scheme.

#include <cmath>

namespace probation {

struct Dual {
  double value = 0.0;
  double slope = 0.0;

  constexpr Dual() = default;
  constexpr Dual(double v) : value(v) {}  // a constant; implicit on purpose
  constexpr Dual(double v, double s) : value(v), slope(s) {}
};

inline Dual operator-(Dual a) { return {-a.value, -a.slope}; }
inline Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.slope + b.slope}; }
inline Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.slope - b.slope}; }
inline Dual operator*(Dual a, Dual b) { return {a.value * b.value, a.slope * b.value + a.value * b.slope}; }
inline Dual operator/(Dual a, Dual b) {
  const double inverse = 1.0 / b.value, ratio = a.value * inverse;
  return {ratio, (a.slope - ratio * b.slope) * inverse};
}
// With a constant, whose derivative is zero.
inline Dual operator+(Dual a, double b) { return {a.value + b, a.slope}; }
inline Dual operator+(double a, Dual b) { return {a + b.value, b.slope}; }
inline Dual operator-(Dual a, double b) { return {a.value - b, a.slope}; }
inline Dual operator-(double a, Dual b) { return {a - b.value, -b.slope}; }
inline Dual operator*(Dual a, double b) { return {a.value * b, a.slope * b}; }
inline Dual operator*(double a, Dual b) { return {a * b.value, a * b.slope}; }
inline Dual operator/(Dual a, double b) { return {a.value / b, a.slope / b}; }
inline bool operator>(Dual a, Dual b) { return a.value > b.value; }
inline bool operator<(Dual a, Dual b) { return a.value < b.value; }

inline Dual exp(Dual a) {
  const double e = std::exp(a.value);
  return {e, e * a.slope};
}
inline Dual log(Dual a) { return {std::log(a.value), a.slope / a.value}; }
inline Dual sqrt(Dual a) {
  const double root = std::sqrt(a.value);
  return {root, 0.5 * a.slope / root};
}
inline Dual pow(Dual a, Dual b) { return exp(b * log(a)); }
inline Dual sinh(Dual a) { return {std::sinh(a.value), std::cosh(a.value) * a.slope}; }
inline Dual tanh(Dual a) {
  const double t = std::tanh(a.value);
  return {t, (1.0 - t * t) * a.slope};
}
inline Dual expm1(Dual a) { return {std::expm1(a.value), std::exp(a.value) * a.slope}; }

inline double value(double a) { return a; }
inline double value(Dual a) { return a.value; }
inline double slope(double) { return 0.0; }
inline double slope(Dual a) { return a.slope; }

}  // namespace probation
