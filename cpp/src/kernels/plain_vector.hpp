#pragma once
// Four doubles in plain C++, for compilers without vector extensions, and to hold the other builds against.

#include <cmath>

namespace probation {

struct Vector {
  double lane[4];

  double operator[](int i) const { return lane[i]; }
};

/// What a comparison of two vectors finds.
struct LaneMask {
  bool lane[4];
};

namespace kernels {

inline Vector load(const double* from) { return {{from[0], from[1], from[2], from[3]}}; }
inline void store(double* to, Vector v) {
  for (int i = 0; i < 4; ++i) to[i] = v.lane[i];
}
inline Vector first_halves(Vector a, Vector b) { return {{a.lane[0], a.lane[1], b.lane[0], b.lane[1]}}; }
inline Vector last_halves(Vector a, Vector b) { return {{a.lane[2], a.lane[3], b.lane[2], b.lane[3]}}; }
inline double sum(Vector a) { return (a.lane[0] + a.lane[1]) + (a.lane[2] + a.lane[3]); }
inline Vector sums(Vector a, Vector b, Vector c, Vector d) { return {{sum(a), sum(b), sum(c), sum(d)}}; }

}  // namespace kernels

/// operation(a_i, b_i), lane by lane.
template <class Operation>
Vector by_lane(Vector a, Vector b, Operation operation) {
  Vector found{};
  for (int i = 0; i < 4; ++i) found.lane[i] = operation(a.lane[i], b.lane[i]);
  return found;
}
inline Vector broadcast(double a) { return {{a, a, a, a}}; }

inline Vector operator+(Vector a, Vector b) {
  return by_lane(a, b, [](double p, double q) { return p + q; });
}
inline Vector operator-(Vector a, Vector b) {
  return by_lane(a, b, [](double p, double q) { return p - q; });
}
inline Vector operator*(Vector a, Vector b) {
  return by_lane(a, b, [](double p, double q) { return p * q; });
}
inline Vector operator/(Vector a, Vector b) {
  return by_lane(a, b, [](double p, double q) { return p / q; });
}
inline Vector operator-(Vector a) { return Vector{} - a; }

inline Vector operator+(Vector a, double b) { return a + broadcast(b); }
inline Vector operator-(Vector a, double b) { return a - broadcast(b); }
inline Vector operator*(Vector a, double b) { return a * broadcast(b); }
inline Vector operator/(Vector a, double b) { return a / broadcast(b); }
inline Vector operator+(double a, Vector b) { return broadcast(a) + b; }
inline Vector operator-(double a, Vector b) { return broadcast(a) - b; }
inline Vector operator*(double a, Vector b) { return broadcast(a) * b; }
inline Vector operator/(double a, Vector b) { return broadcast(a) / b; }

template <class Other>
Vector& operator+=(Vector& a, Other b) {
  return a = a + b;
}
template <class Other>
Vector& operator-=(Vector& a, Other b) {
  return a = a - b;
}
template <class Other>
Vector& operator*=(Vector& a, Other b) {
  return a = a * b;
}

inline LaneMask operator<(Vector a, double b) {
  return {{a.lane[0] < b, a.lane[1] < b, a.lane[2] < b, a.lane[3] < b}};
}
inline LaneMask operator==(Vector a, double b) {
  return {{a.lane[0] == b, a.lane[1] == b, a.lane[2] == b, a.lane[3] == b}};
}
inline Vector choose(LaneMask where, Vector a, Vector b) {
  for (int i = 0; i < 4; ++i)
    if (!where.lane[i]) a.lane[i] = b.lane[i];
  return a;
}

inline Vector decay(Vector x) {
  return {{std::exp(-x.lane[0]), std::exp(-x.lane[1]), std::exp(-x.lane[2]), std::exp(-x.lane[3])}};
}

}  // namespace probation
