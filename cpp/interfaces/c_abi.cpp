// The functions of probation.h.

#include "probation/material/constants.hpp"
#include "probation/material/measures.hpp"
#include "probation/material/uniaxial.hpp"

#pragma GCC visibility push(default)
#include "probation.h"
#pragma GCC visibility pop

namespace {

using namespace probation::material;

int code(Outcome outcome) noexcept {
  return outcome.step_factor < 1.0 ? PROBATION_COARSE_STEP : static_cast<int>(outcome.status);
}

Matrix3 matrix(const double* row_by_row) noexcept {
  Matrix3 f;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) f[i][j] = row_by_row[3 * i + j];
  return f;
}

/// The update, unless F turns the material inside out.
Outcome update(const Parameters& parameters, const Matrix3& f, double dt, const double* before, double* after,
               PointStress& out, bool with_tangent) noexcept {
  if (!possible_volume(f)) return {Status::cut_step};
  return point_update(parameters, right_cauchy_green(f), dt, before, after, out, with_tangent);
}

void store(const PointStress& out, double* stress, double* tangent) noexcept {
  for (int r = 0; r < 6; ++r) {
    stress[r] = out.stress[r];
    if (tangent == nullptr) continue;
    for (int c = 0; c < 6; ++c) tangent[6 * r + c] = out.tangent[r][c];
  }
}

}  // namespace

extern "C" {

int probation_message(const double* constants, int count, char* message, int capacity) {
  Parameters parameters;
  const Outcome outcome = read_constants(constants, count, parameters);
  describe(outcome, parameters.form, message, capacity);
  return code(outcome);
}

int probation_state_size(const double* constants, int count) {
  Parameters parameters;
  return read_constants(constants, count, parameters).ok() ? point_state_size(parameters.modes) : 0;
}

int probation_uniaxial_state_size(const double* constants, int count) {
  Parameters parameters;
  return read_constants(constants, count, parameters).ok() ? uniaxial_state_size(parameters.modes) : 0;
}

int probation_uniaxial(const double* constants, int count, double strain_increment, double dt,
                       const double* before, double* after, double* true_stress, double* tangent) {
  Parameters parameters;
  Outcome outcome = read_constants(constants, count, parameters);
  UniaxialStress out;
  if (outcome.ok()) outcome = uniaxial_update(parameters, strain_increment, dt, before, after, out);
  if (!outcome.ok()) return code(outcome);
  *true_stress = out.true_stress;
  *tangent = out.tangent;
  return code(outcome);
}

int probation_second_piola(const double* constants, int count, const double* deformation_gradient, double dt,
                           const double* before, double* after, double* stress, double* tangent) {
  Parameters parameters;
  Outcome outcome = read_constants(constants, count, parameters);
  if (!outcome.ok()) return code(outcome);
  PointStress out;
  outcome = update(parameters, matrix(deformation_gradient), dt, before, after, out, tangent != nullptr);
  if (outcome.ok()) store(out, stress, tangent);
  return code(outcome);
}

int probation_cauchy(const double* constants, int count, const double* deformation_gradient, double dt,
                     const double* before, double* after, double* stress, double* tangent) {
  Parameters parameters;
  Outcome outcome = read_constants(constants, count, parameters);
  if (!outcome.ok()) return code(outcome);
  PointStress out;
  const Matrix3 f = matrix(deformation_gradient);
  outcome = update(parameters, f, dt, before, after, out, true);
  if (outcome.ok()) store(cauchy_jaumann(out, f), stress, tangent);
  return code(outcome);
}

int probation_first_piola(const double* constants, int count, int points, const double* deformation_gradients,
                          double dt, const double* before, double* after, double* stress, double* tangent,
                          int* failed) {
  if (failed != nullptr) *failed = -1;
  Parameters parameters;
  const Outcome constants_read = read_constants(constants, count, parameters);
  if (!constants_read.ok()) return code(constants_read);
  const long size = point_state_size(parameters.modes);
  const auto step = [&](int point, double* state_after, const Matrix3& f, PointStress& out) {
    return update(parameters, f, dt, before + size * point, state_after, out, tangent != nullptr);
  };
  const auto stopped = [&](Outcome outcome, int point) {
    if (failed != nullptr) *failed = point;
    return code(outcome);
  };
  PointStress out;
  // In place, the states of the first points would be gone once a later one fails: all are tried before.
  for (int point = 0; before == after && point < points; ++point) {
    const Outcome outcome = step(point, nullptr, matrix(deformation_gradients + 9L * point), out);
    if (!outcome.ok()) return stopped(outcome, point);
  }
  int coarse = -1;
  for (int point = 0; point < points; ++point) {
    const Matrix3 f = matrix(deformation_gradients + 9L * point);
    const Outcome outcome = step(point, after + size * point, f, out);
    if (!outcome.ok()) return stopped(outcome, point);
    if (coarse < 0 && outcome.step_factor < 1.0) coarse = point;
    const FirstPiola piola = first_piola(out, f, tangent != nullptr);
    for (int r = 0; r < 9; ++r) {
      stress[9L * point + r] = piola.stress[r / 3][r % 3];
      if (tangent == nullptr) continue;
      for (int c = 0; c < 9; ++c) tangent[81L * point + 9L * r + c] = piola.tangent[r][c];
    }
  }
  if (coarse < 0) return PROBATION_OK;
  if (failed != nullptr) *failed = coarse;
  return PROBATION_COARSE_STEP;
}

}  // extern "C"
