// Solves one case as often as it is told: `probation_bench_solves CASE TIMES`. What two runs differ by is
// that of the solves alone. bench/instructions.py lists the cases.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "probation/companion/weissenberg.hpp"
#include "probation/feedback/self_heating.hpp"
#include "probation/feedback/stress_activation.hpp"
#include "probation/solver.hpp"

using namespace probation;
using Eigen::ArrayXd;

namespace {

constexpr Eigen::Index steps = 2000;

Law base_law() {
  Law law;
  law.unrelaxed_modulus = 3220.0;
  law.hardening_modulus = 2.5;
  law.tau_max = 5.2;
  return law;
}

ArrayXd even_time() { return ArrayXd::LinSpaced(steps + 1, 0.0, 400.0); }

/// Steps that differ by up to 30 %, without a random generator that a library could change.
ArrayXd uneven_time() {
  ArrayXd time(steps + 1);
  time[0] = 0.0;
  for (Eigen::Index m = 0; m < steps; ++m)
    time[m + 1] = time[m] + 0.2 * (1.0 + 0.3 * std::sin(1.7 * static_cast<double>(m * m % 1009)));
  return time;
}

Scheme scheme_of(const std::string& name) {
  return name == "be2" ? Scheme::be2 : name == "sa2" ? Scheme::sa2 : Scheme::sa3;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return std::fprintf(stderr, "usage: probation_bench_solves SCHEME-KIND TIMES\n"), 2;
  const std::string name = arguments[1], scheme = name.substr(0, 3), kind = name.substr(4);
  const long times = std::strtol(arguments[2], nullptr, 10);

  Law law = base_law();
  LawChange change;
  ArrayXd time = kind == "uneven" ? uneven_time() : even_time(), strain = 0.005 * time;
  if (kind == "rate") {  // the rate, and tau_max with it, varies fivefold
    law.companion = std::make_shared<Weissenberg>(0.00464, 0.0367);
    strain = 0.005 * (time + 200.0 / 3.0 * (1.0 - (0.01 * time).cos()));
  }
  if (kind == "stress") change.feedbacks = {std::make_shared<StressActivation>(20.0)};
  if (kind == "heat") change.feedbacks = {std::make_shared<SelfHeating>(1.0, 0.02, 0.03, 0.01)};

  const History history(time, strain);
  ArrayXd stress(history.size());
  Solver solver(history, {scheme_of(scheme)});
  const std::vector<Direction> directions = parameter_directions(law, change, history);
  RowMajorMatrix derivatives(history.size(), static_cast<Eigen::Index>(directions.size()));
  for (long i = 0; i < times; ++i) {
    if (kind == "history")
      static_cast<void>(History(FindJumps{}, time, strain));
    else if (kind == "tangent")
      solver.tangent(law, change, directions, stress, derivatives);
    else
      solver.stress(law, change, stress);
  }
  std::printf("%.17g\n", stress[steps]);
  return 0;
}
