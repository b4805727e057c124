// A forward solve with the engine: the ramp of experiment 1 by bE2, against the closed form, eq. (7).
#include <cstdio>
#include <probation/schemes/ramp.hpp>
#include <probation/solver.hpp>

int main() {
  probation::Law law;
  law.unrelaxed_modulus = 3224.0;
  law.tau_max = 5.207;
  law.hardening_modulus = 2.556;
  const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(2001, 0.0, 400.0), strain = 0.005 * time;
  Eigen::ArrayXd stress(time.size());
  probation::Solver solver(probation::History(time, strain), {});
  solver.stress(law, {}, stress);
  const double error = (stress - probation::ramp_stress(law, 0.005, time)).abs().maxCoeff();
  std::printf("true stress %.4f MPa at strain 2, largest error %.1e MPa\n", stress[2000], error);
  return error < 0.05 ? 0 : 1;
}
