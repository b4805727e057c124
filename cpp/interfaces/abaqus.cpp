// Abaqus/Standard user subroutine UMAT: solid, plane-strain, axisymmetric (NDI 3) and truss (NTENS 1)
// elements.
//
// PROPS are the constants of probation/material/constants.hpp, STATEV has 10 + 6 N entries (3 + N for
// trusses), all zero at the start. No *ORIENTATION: the state lives in the reference configuration, DROT is
// not used. PNEWDT becomes 0.25 where a smaller increment may help, and on invalid constants: STRESS, STATEV
// and DDSDDE then stay as they were. Invalid constants are also reported in the message file by Abaqus'
// STDB_ABQERR, which ends the analysis. Hosts without STDB_ABQERR call probation_umat_message for the text.
// Where the estimated error is above the stress tolerance, the update is made and PNEWDT becomes 0.25 to 0.9:
// Abaqus discards it and tries again.

#include <cstddef>

#include "probation/material/constants.hpp"
#include "probation/material/measures.hpp"
#include "probation/material/uniaxial.hpp"

namespace {

using namespace probation::material;

Outcome truss(const Parameters& parameters, double strain_increment, double dt, double* state, double* stress,
              double* tangent) noexcept {
  UniaxialStress out;
  const Outcome outcome = uniaxial_update(parameters, strain_increment, dt, state, state, out);
  if (!outcome.ok()) return outcome;
  *stress = out.true_stress;
  *tangent = out.tangent;
  return outcome;
}

Outcome solid(const Parameters& parameters, const double* deformation_gradient, double dt, int components,
              double* state, double* stress, double* tangent) noexcept {
  Matrix3 f;  // Fortran's order: column by column
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) f[i][j] = deformation_gradient[i + 3 * j];
  PointStress point;
  if (!possible_volume(f)) return {Status::cut_step};
  const Outcome outcome = point_update(parameters, right_cauchy_green(f), dt, state, state, point);
  if (!outcome.ok()) return outcome;
  const PointStress out = cauchy_jaumann(point, f);
  for (int r = 0; r < components; ++r) {
    stress[r] = out.stress[r];
    for (int c = 0; c < components; ++c) tangent[r + components * c] = out.tangent[r][c];
  }
  return outcome;
}

Outcome update(const double* props, int nprops, int ndi, int nshr, int nstatv, const double* dstran,
               const double* dfgrd1, double dtime, double* statev, double* stress, double* ddsdde,
               Parameters& parameters) noexcept {
  const Outcome constants = read_constants(props, nprops, parameters);
  if (!constants.ok()) return constants;
  const bool uniaxial = ndi == 1 && nshr == 0;
  const bool three_dimensional = ndi == 3 && (nshr == 1 || nshr == 3);
  if (!uniaxial && !three_dimensional) return {Status::no_element};
  if (nstatv < (uniaxial ? uniaxial_state_size(parameters.modes) : point_state_size(parameters.modes)))
    return {Status::short_state};
  return uniaxial ? truss(parameters, dstran[0], dtime, statev, stress, ddsdde)
                  : solid(parameters, dfgrd1, dtime, ndi + nshr, statev, stress, ddsdde);
}

}  // namespace

// Fortran's names end in an underscore. NOLINTBEGIN(readability-identifier-naming)
extern "C" {

/// Abaqus' message routine; -3 prints the text and ends the analysis. Weak: other hosts do not have it.
[[gnu::weak]] void stdb_abqerr_(const int* level, const char* text, const int* whole_numbers,
                                const double* numbers, const char* words, std::size_t text_length,
                                std::size_t words_length);

/// The error message of the constants, closed by a zero; "" for valid ones. For hosts without STDB_ABQERR.
[[gnu::visibility("default")]] void probation_umat_message(const double* props, const int* nprops, char* text,
                                                           const int* capacity) noexcept {
  Parameters parameters;
  const Outcome outcome = read_constants(props, *nprops, parameters);
  describe(outcome, parameters.form, text, *capacity);
}

[[gnu::visibility("default")]] void umat_(
    double* stress, double* statev, double* ddsdde, double* /*sse*/, double* /*spd*/, double* /*scd*/,
    double* /*rpl*/, double* /*ddsddt*/, double* /*drplde*/, double* /*drpldt*/, const double* /*stran*/,
    const double* dstran, const double* /*time*/, const double* dtime, const double* /*temp*/,
    const double* /*dtemp*/, const double* /*predef*/, const double* /*dpred*/, const char* /*cmname*/,
    const int* ndi, const int* nshr, const int* /*ntens*/, const int* nstatv, const double* props,
    const int* nprops, const double* /*coords*/, const double* /*drot*/, double* pnewdt,
    const double* /*celent*/, const double* /*dfgrd0*/, const double* dfgrd1, const int* /*noel*/,
    const int* /*npt*/, const int* /*layer*/, const int* /*kspt*/, const int* /*kstep*/, const int* /*kinc*/,
    std::size_t /*cmname_length*/) noexcept {
  Parameters parameters;
  const Outcome outcome = update(props, *nprops, *ndi, *nshr, *nstatv, dstran, dfgrd1, *dtime, statev, stress,
                                 ddsdde, parameters);
  if (outcome.step_factor < 1.0) *pnewdt = outcome.step_factor;
  if (outcome.ok()) return;
  *pnewdt = smallest_cut;
  if (outcome.status == Status::cut_step || stdb_abqerr_ == nullptr) return;
  char text[400];
  describe(outcome, parameters.form, text, sizeof text);
  std::size_t length = 0;
  while (text[length] != '\0') ++length;
  const int level = -3, whole_number = 0;
  const double number = 0.0;
  stdb_abqerr_(&level, text, &whole_number, &number, "        ", length, 8);
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming)
