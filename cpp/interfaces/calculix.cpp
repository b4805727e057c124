// CalculiX native external behaviour: *MATERIAL, NAME=@PROBATION_DNLR with libPROBATION.so on the library
// path.
//
// *USER MATERIAL, CONSTANTS=11 (12 with a stress tolerance) holds the constants of
// probation/material/constants.hpp, *DEPVAR 10 + 6 N. CalculiX passes at most 21 constants; longer lists (a
// spectrum of your own) are compiled in: -DPROBATION_CONSTANTS='"FILE"' names a file of numbers separated by
// commas, and those of the deck are then not looked at. Native means: Green-Lagrange strain in, second
// Piola-Kirchhoff stress and the 21 terms of dS/dE (symmetrised) out. CalculiX offers no way to say more than
// pnewdt < 1: on invalid constants it cuts its increment until it stops. probation_point_check
// reports what is wrong with them. Where the increment is cut because there is no update, state, stress and
// stiffness are left as they were; where the estimated error is above the stress tolerance, the update is
// made and pnewdt is 0.25 to 0.9.

#include "probation/material/constants.hpp"
#include "probation/material/point.hpp"

namespace {

using namespace probation::material;

#ifdef PROBATION_CONSTANTS
constexpr double compiled_in[] = {
#include PROBATION_CONSTANTS
};
#endif

Outcome constants(const double* props, int nprops, Parameters& parameters) noexcept {
#ifdef PROBATION_CONSTANTS
  (void)props, (void)nprops;
  return read_constants(compiled_in, static_cast<int>(sizeof compiled_in / sizeof compiled_in[0]),
                        parameters);
#else
  // CalculiX passes its material type, -100 - number of constants.
  return read_constants(props, nprops < 0 ? -nprops - 100 : nprops, parameters);
#endif
}

}  // namespace

// CalculiX looks for names in capitals. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" [[gnu::visibility("default")]] void DNLR(
    const char* /*amat*/, const int* iel, const int* iint, const int* nprops, const double* props,
    const double* green_lagrange, const double* /*at the start*/, const double* /*beta*/,
    const double* /*f0*/, const double* /*voj*/, const double* /*f1*/, const double* /*vj*/,
    const int* /*ithermal*/, const double* /*temp*/, const double* dtime, const double* /*time*/,
    const double* /*ttime*/, const int* icmd, const int* /*ielas*/, const int* mi, const int* nstatv,
    const double* statev0, double* statev1, double* stress, double* stiffness, const int* /*iorien*/,
    const double* /*pgauss*/, const double* /*orab*/, double* pnewdt, const int* /*ipkon*/,
    int /*amat_length*/) noexcept {
  Parameters parameters;
  const Outcome read = constants(props, *nprops, parameters);
  // Points share pnewdt, which is negative as long as none has cut: the smallest factor counts.
  const auto cut = [&](double factor) {
    const bool smaller = *pnewdt > 0.0 && *pnewdt < factor;
    if (!smaller) *pnewdt = factor;
  };
  if (!read.ok() || *nstatv < point_state_size(parameters.modes)) return cut(smallest_cut);
  Symmetric c{};
  for (int k = 0; k < 6; ++k) c[k] = (k < 3 ? 1.0 : 0.0) + 2.0 * green_lagrange[k];
  // The arrays of states are those of the whole model: state variables, integration points, elements.
  const long first = static_cast<long>(*nstatv) * ((*iint - 1) + static_cast<long>(mi[0]) * (*iel - 1));
  PointStress out;
  const bool with_tangent = *icmd != 3;
  const Outcome outcome =
      point_update(parameters, c, *dtime, statev0 + first, statev1 + first, out, with_tangent);
  if (!outcome.ok()) return cut(smallest_cut);
  if (outcome.step_factor < 1.0) cut(outcome.step_factor);
  for (int k = 0; k < 6; ++k) stress[k] = out.stress[k];
  if (!with_tangent) return;
  for (int column = 0, term = 0; column < 6; ++column)
    for (int row = 0; row <= column; ++row, ++term)
      stiffness[term] = 0.5 * (out.tangent[row][column] + out.tangent[column][row]);
}
