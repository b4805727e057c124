// The Taylor terms of step coefficients in the relative distance of the scale. Compiled once per instruction
// set.
//
// The coefficient of bE2 and backward Euler is a multiple of 1 / (1 + x), whose terms are powers of
// -x / (1 + x). Those of the exponential rule are phi and psi of schemes/step.hpp, which satisfy
//
//   x phi' = e^-x - phi,     x psi' = -2 psi - x phi',
//
// so that each term follows from the one before without dividing by x.

#include "coefficient_rows.hpp"

#include <cstddef>

#include "vector.hpp"

namespace probation::kernels::PROBATION_ISA {
namespace {

constexpr int terms = CoefficientRows::terms;

void fill_rational(long count, const double* x, double* row, long stride) {
  for (long at = 0; at < count; at += lanes) {
    Vector term = BackwardEulerStep::coefficients<Vector>(load(x + at), 1.0).forcing;
    const Vector factor = term - 1.0;
    for (int k = 0; k < terms; ++k) {
      store(row + k * stride + at, term);
      term *= factor;
    }
  }
}

void fill_exponential(long count, const double* x, double* forcing, double* curvature, long stride) {
  for (long at = 0; at < count; at += lanes) {
    const Vector here = load(x + at);
    const StepCoefficients<Vector> c = ExponentialStep::coefficients<Vector>(here, 1.0);
    Vector decayed = c.previous, phi = c.forcing, psi = c.curvature;
    const Vector factor = choose(here < 700.0, -here, Vector{});  // beyond, nothing is left of e^-x
    for (int k = 0; k < terms; ++k) {
      store(forcing + k * stride + at, phi);
      if (curvature) store(curvature + k * stride + at, psi);
      const double next = 1.0 / (k + 1);
      const Vector phi_next = decayed * next - phi;
      psi = -(psi * (k + 2.0) + phi * static_cast<double>(k)) * next - phi_next;
      phi = phi_next;
      decayed *= factor * next;
    }
  }
}

}  // namespace

void fill_rows(bool exponential, long count, const double* x, double* forcing, double* curvature,
               long stride) {
  if (exponential) return fill_exponential(count, x, forcing, curvature, stride);
  fill_rational(count, x, forcing, stride);
}

void weigh_rows(const Modes& modes, const CoefficientRows& rows, double* by_forcing, double* by_curvature) {
  Vector forcing[terms] = {}, curvature[terms] = {};
  for (std::ptrdiff_t at = 0; at < modes.padded; at += lanes) {
    const Vector weight = load(modes.weight + at);
#pragma GCC unroll 8
    for (int k = 0; k < terms; ++k) {
      forcing[k] += weight * load(rows.forcing + k * rows.stride + at);
      if (rows.curvature) curvature[k] += weight * load(rows.curvature + k * rows.stride + at);
    }
  }
  for (int k = 0; k < terms; ++k) {
    by_forcing[k] = sum(forcing[k]);
    by_curvature[k] = sum(curvature[k]);
  }
}

}  // namespace probation::kernels::PROBATION_ISA
