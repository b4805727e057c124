// MGIS generic behaviour "ProbationDNLR", finite strain, Tridimensional: for code_aster, MFEM/MGIS,
// OpenGeoSys, …, without MFront or TFEL. Structures as in MGIS 2 and later (TFEL 4).
//
// Material properties are the constants of probation/material/constants.hpp. Their number and that of the
// state variables are part of what the library declares: -DPROBATION_MGIS_MODES=N (50) is the largest number
// of modes, and -DPROBATION_MGIS_CONSTANTS=M (11) makes room for a spectrum of your own (11 + 2 N) and, where
// M is even, for the stress tolerance. Returns -1 (with a text in error_message where the host has one) with
// nothing written and rdt 0.25 where a smaller increment may help; 0 where the update is made, but its
// estimated error is above the stress tolerance, with rdt 0.25 to 0.9; 1 on success. K[0] asks for the
// operator, K[1] for the stress, K[2] for the tangent, as MGIS documents.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "probation/material/constants.hpp"
#include "probation/material/measures.hpp"

#ifndef PROBATION_MGIS_MODES
#define PROBATION_MGIS_MODES 50
#endif
#ifndef PROBATION_MGIS_CONSTANTS
#define PROBATION_MGIS_CONSTANTS 11
#endif

extern "C" {

struct ProbationMgisInitialState {
  const double *gradients, *thermodynamic_forces, *mass_density, *material_properties,
      *internal_state_variables, *stored_energy, *dissipated_energy, *external_state_variables;
};
struct ProbationMgisState {
  const double* gradients;
  double* thermodynamic_forces;
  const double *mass_density, *material_properties;
  double *internal_state_variables, *stored_energy, *dissipated_energy;
  const double* external_state_variables;
};
struct ProbationMgisData {
  char* error_message;  // 512 characters
  double dt;
  double* K;
  double* rdt;
  double* speed_of_sound;
  ProbationMgisInitialState s0;
  ProbationMgisState s1;
};
}

namespace {

using namespace probation::material;

constexpr int modes = PROBATION_MGIS_MODES;
constexpr int constants = PROBATION_MGIS_CONSTANTS;
/// Ratios and weights, rates and times come in pairs: an odd one is the stress tolerance.
constexpr bool with_tolerance = (constants - fixed_constants) % 2 == 1;
constexpr int state_size = point_state_size(modes);
static_assert(modes >= 1 && modes <= most_modes && constants >= fixed_constants &&
              constants <= most_constants);

constexpr double root = 1.4142135623730951;  // of 2: MGIS' shear components
constexpr Symmetric shear_factor{1.0, 1.0, 1.0, root, root, root};

/// MGIS' order of an unsymmetric tensor: 11, 22, 33, 12, 21, 13, 31, 23, 32.
constexpr std::array<Pair, 9> tensor_pairs{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 0}, {0, 2}, {2, 0}, {1, 2}, {2, 1}}};

Matrix3 matrix(const double* tensor) noexcept {
  Matrix3 f{};
  for (int c = 0; c < 9; ++c) f[tensor_pairs[c].i][tensor_pairs[c].j] = tensor[c];
  return f;
}

int row(int c) noexcept { return 3 * tensor_pairs[c].i + tensor_pairs[c].j; }

void store_stress(const PointStress& point, const FirstPiola& piola, const Matrix3& f, double measure,
                  double* out) noexcept {
  if (measure > 1.5) {
    for (int c = 0; c < 9; ++c) out[c] = piola.stress[tensor_pairs[c].i][tensor_pairs[c].j];
    return;
  }
  Symmetric stress = point.stress;
  if (measure < 0.5) {
    stress = transform(congruence(f), stress);
    for (double& component : stress) component /= determinant(f);
  }
  for (int c = 0; c < 6; ++c) out[c] = shear_factor[c] * stress[c];
}

void store_tangent(const PointStress& point, const FirstPiola& piola, const Matrix3& f, double measure,
                   double* out) noexcept {
  if (measure > 1.5) {
    for (int r = 0; r < 9; ++r)
      for (int c = 0; c < 9; ++c) out[9 * r + c] = piola.tangent[row(r)][row(c)];
  } else if (measure > 0.5) {
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) out[6 * r + c] = shear_factor[r] * shear_factor[c] * point.tangent[r][c];
  } else {
    const auto slope = cauchy_slope(piola, f);
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 9; ++c) out[9 * r + c] = shear_factor[r] * slope[r][row(c)];
  }
}

Outcome integrate(ProbationMgisData& data, Parameters& parameters) noexcept {
  // The host says what it asks for in K, where the tangent goes.
  const double operation = data.K[0], stress_measure = data.K[1], tangent_measure = data.K[2];
  const double* given = data.s1.material_properties;
  double shorter[fixed_constants + 1];
  int count = constants;
  if constexpr (constants > fixed_constants) {
    // Kernel properties of log-spaced modes are declared, but not part of the list.
    if (given[10] > 0.0 && given[3] != static_cast<double>(Form::table)) {
      std::copy(given, given + fixed_constants, shorter);
      shorter[fixed_constants] = given[constants - 1];
      count = with_tolerance ? fixed_constants + 1 : fixed_constants;
      given = shorter;
    }
  }
  Outcome outcome = read_constants(given, count, parameters);
  if (!outcome.ok()) return outcome;
  if (parameters.modes > modes) return {Status::short_state};

  const bool prediction = operation < -0.5, with_tangent = prediction || operation > 0.5;
  const Matrix3 f = matrix(prediction ? data.s0.gradients : data.s1.gradients);
  if (!possible_volume(f)) return {Status::cut_step};
  PointStress point;
  double* after = prediction ? nullptr : data.s1.internal_state_variables;
  outcome = point_update(parameters, right_cauchy_green(f), data.dt, data.s0.internal_state_variables, after,
                         point, with_tangent);
  if (!outcome.ok()) return outcome;
  const FirstPiola piola = first_piola(point, f, with_tangent);
  if (prediction) outcome.step_factor = 1.0;  // nothing was deformed
  if (!prediction) store_stress(point, piola, f, stress_measure, data.s1.thermodynamic_forces);
  if (with_tangent) store_tangent(point, piola, f, tangent_measure, data.K);
  return outcome;
}

/// "Name[0]", "Name[1]", … : names of entries as MGIS needs them, formed at compile time.
template <std::size_t Count>
struct Names {
  char text[Count][24] = {};
};
template <std::size_t Count>
constexpr Names<Count> numbered(const char* stem, int first) {
  Names<Count> names;
  for (std::size_t k = 0; k < Count; ++k) {
    int length = 0, number = first + static_cast<int>(k), divisor = 1;
    for (; stem[length] != '\0'; ++length) names.text[k][length] = stem[length];
    names.text[k][length++] = '[';
    while (number / divisor >= 10) divisor *= 10;
    for (; divisor > 0; divisor /= 10)
      names.text[k][length++] = static_cast<char>('0' + number / divisor % 10);
    names.text[k][length] = ']';
  }
  return names;
}

constexpr Names<state_size> state_names = numbered<state_size>("State", 0);
constexpr Names<most_constants - fixed_constants> kernel_names =
    numbered<most_constants - fixed_constants>("Kernel", 0);
constexpr const char* constant_names[] = {
    "UnrelaxedModulus",  "HardeningModulus", "BulkModulus", "Form",  "TauMaxOrAlpha", "FirstCoefficient",
    "SecondCoefficient", "RateFloor",        "RateFilter",  "Modes", "Decades"};

template <std::size_t Count>
struct Pointers {
  const char* name[Count];
};
template <std::size_t... Is>
constexpr Pointers<sizeof...(Is)> state_pointers(std::index_sequence<Is...> /*indices*/) {
  return {{state_names.text[Is]...}};
}
constexpr const char* constant_name(std::size_t k) {
  if (with_tolerance && k + 1 == constants) return "StressTolerance";
  return k < fixed_constants ? constant_names[k] : kernel_names.text[k - fixed_constants];
}
template <std::size_t... Is>
constexpr Pointers<sizeof...(Is)> constant_pointers(std::index_sequence<Is...> /*indices*/) {
  return {{constant_name(Is)...}};
}

}  // namespace

#pragma GCC visibility push(default)
// The names below are MGIS'. NOLINTBEGIN(readability-identifier-naming)
extern "C" {

int ProbationDNLR_Tridimensional(ProbationMgisData* data) noexcept {
  Parameters parameters;
  const Outcome outcome = integrate(*data, parameters);
  if (outcome.ok() && !(outcome.step_factor < 1.0)) return 1;
  if (data->rdt != nullptr) *data->rdt = outcome.ok() ? outcome.step_factor : smallest_cut;
  if (outcome.ok()) return 0;
  describe(outcome, parameters.form, data->error_message, 512);
  return -1;
}

#define PROBATION_MGIS_NUMBER(name, value) extern const unsigned short ProbationDNLR_##name = value
#define PROBATION_MGIS_TEXT(name, value) extern const char* const ProbationDNLR_##name = value

extern const char* const ProbationDNLR_mfront_ept = "ProbationDNLR";
PROBATION_MGIS_NUMBER(mfront_mkt, 1);
PROBATION_MGIS_NUMBER(api_version, 1);
PROBATION_MGIS_TEXT(mfront_interface, "Generic");
PROBATION_MGIS_TEXT(tfel_version, "4.0.0");
PROBATION_MGIS_TEXT(src, "probation");
PROBATION_MGIS_TEXT(unit_system, "");
PROBATION_MGIS_NUMBER(nModellingHypotheses, 1);
extern const char* const ProbationDNLR_ModellingHypotheses[1] = {"Tridimensional"};
PROBATION_MGIS_NUMBER(BehaviourType, 2);
PROBATION_MGIS_NUMBER(BehaviourKinematic, 3);
PROBATION_MGIS_NUMBER(SymmetryType, 0);
PROBATION_MGIS_NUMBER(ElasticSymmetryType, 0);
PROBATION_MGIS_NUMBER(savesTangentOperator, 0);
PROBATION_MGIS_NUMBER(UsableInPurelyImplicitResolution, 1);
PROBATION_MGIS_NUMBER(nMainVariables, 1);
PROBATION_MGIS_NUMBER(nGradients, 1);
extern const int ProbationDNLR_GradientsTypes[1] = {3};
extern const char* const ProbationDNLR_Gradients[1] = {"DeformationGradient"};
PROBATION_MGIS_NUMBER(nThermodynamicForces, 1);
extern const int ProbationDNLR_ThermodynamicForcesTypes[1] = {1};
extern const char* const ProbationDNLR_ThermodynamicForces[1] = {"Stress"};
PROBATION_MGIS_NUMBER(nTangentOperatorBlocks, 2);
extern const char* const ProbationDNLR_TangentOperatorBlocks[2] = {"Stress", "DeformationGradient"};
PROBATION_MGIS_NUMBER(nMaterialProperties, constants);
extern const Pointers<constants> ProbationDNLR_MaterialProperties =
    constant_pointers(std::make_index_sequence<constants>());
PROBATION_MGIS_NUMBER(nInternalStateVariables, state_size);
extern const Pointers<state_size> ProbationDNLR_InternalStateVariables =
    state_pointers(std::make_index_sequence<state_size>());
extern const int ProbationDNLR_InternalStateVariablesTypes[state_size] = {};  // scalars, all of them
PROBATION_MGIS_NUMBER(TemperatureRemovedFromExternalStateVariables, 1);
PROBATION_MGIS_NUMBER(nExternalStateVariables, 0);
PROBATION_MGIS_NUMBER(nParameters, 0);
extern const int ProbationDNLR_ParametersTypes[1] = {};
PROBATION_MGIS_NUMBER(nInitializeFunctions, 0);
PROBATION_MGIS_NUMBER(nPostProcessings, 0);
PROBATION_MGIS_NUMBER(requiresStiffnessTensor, 0);
PROBATION_MGIS_NUMBER(requiresThermalExpansionCoefficientTensor, 0);
PROBATION_MGIS_NUMBER(ComputesInternalEnergy, 0);
PROBATION_MGIS_NUMBER(ComputesDissipatedEnergy, 0);

}  // extern "C"
// NOLINTEND(readability-identifier-naming)
#pragma GCC visibility pop
