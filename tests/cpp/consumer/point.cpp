// The material point in somebody else's program: eq. (6) with one mode is a Maxwell element, sigma = E t0 r
// (1 - e^(-t/t0)).
#include <cmath>
#include <cstdio>
#include <probation/material/uniaxial.hpp>

int main() {
  using namespace probation::material;
  Parameters parameters;
  parameters.unrelaxed_modulus = 1000.0;
  parameters.tau_max = 2.0;
  parameters.set_log_spaced(1, 6.0);
  double state[most_uniaxial_state] = {};
  UniaxialStress out;
  for (int i = 0; i < 10; ++i)
    if (!uniaxial_update(parameters, 0.001, 0.5, state, state, out).ok()) return 1;
  const double expected = 1000.0 * 2.0 * 0.002 * (1.0 - std::exp(-5.0 / 2.0));
  std::printf("true stress %.15g MPa, expected %.15g MPa\n", out.true_stress, expected);
  return std::abs(out.true_stress - expected) < 1e-12 ? 0 : 1;
}
