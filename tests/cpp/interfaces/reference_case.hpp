#pragma once
// One loading case for every interface, and what is known of its answer without any of them.

#include <array>
#include <string>
#include <vector>

struct Instant {
  std::array<double, 9> f;  ///< deformation gradient, row by row
  double dt;                ///< [s]
  double difference;  ///< stress along the bar minus across it [MPa] by the literal law; NaN where there is
                      ///< shear
  std::array<double, 3> bar;  ///< where the bar points
};

/// Tension at 1e-3 1/s, a jump to 1e-2 1/s, unloading, a turn by 90 degrees during a ramp, shear on top.
const std::vector<Instant>& reference_case();

/// E_u 3220, G 1.8, K 2000 MPa, eq. (11), 50 modes over 6 decades.
inline constexpr std::array<double, 11> reference_constants{3220.0, 1.8,  2000.0, 1.0,  1.0, 0.00464,
                                                            0.0367, 1e-7, 0.0,    50.0, 6.0};
/// The same as a list to be changed.
inline std::vector<double> constant_list() {
  return {reference_constants.begin(), reference_constants.end()};
}
constexpr std::size_t reference_modes = 50;
constexpr std::size_t reference_state = 10 + 6 * reference_modes;

using Stress = std::array<double, 6>;    // Cauchy, 11, 22, 33, 12, 13, 23 [MPa]
using Tangent = std::array<double, 36>;  // row by row
struct Answer {
  Stress stress;
  Tangent tangent;  ///< whatever the interface gives; see its test
};
using Answers = std::vector<Answer>;

/// The reference case through the C interface: Cauchy stress, with the Jaumann tangent or with dS/dE.
Answers by_c(bool jaumann);

/// Cauchy stress F S F^T / J.
Stress push_forward(const std::array<double, 9>& f, const double* second_piola);

/// Function `symbol` of the shared object whose path stands in the environment under `interface`.
void* symbol_of(const char* interface, const char* symbol);
template <class Function>
Function* function_of(const char* interface, const char* symbol) {
  return reinterpret_cast<Function*>(symbol_of(interface, symbol));
}

/// These print what they find.
void check_same_stress(const char* interface, const Answers& found, const Answers& expected);
void check_same_tangent(const char* interface, const Answers& found, const Answers& expected);
/// Against the literal law in one dimension, at every instant without shear.
void check_literal_law(const char* interface, const Answers& found);
