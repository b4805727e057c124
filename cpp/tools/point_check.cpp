// probation_point_check: checks the material point with given constants.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "checks.hpp"
#include "probation/material/constants.hpp"
#include "probation/material/point.hpp"
#include "probation/material/uniaxial.hpp"

namespace {

using namespace probation;

constexpr const char* usage =
    "usage: probation_point_check [CONSTANT ... | --file FILE]\n"
    "\n"
    "Checks the material point on a list of constants, in the order of probation/material/constants.hpp; "
    "numbers may\n"
    "be separated by commas. Without any: E_u 3220, G 1.8, K 20000 MPa, eq. (11) of the paper, 50 modes over "
    "6\n"
    "decades. Exit status: 0 all within limits, 1 not, 2 invalid constants.\n";

/// Numbers separated by white space or commas; false where something else stands.
bool numbers(std::string text, std::vector<double>& out) {
  for (char& c : text)
    if (c == ',' || c == '\n' || c == '\t' || c == '\r') c = ' ';
  const char* at = text.c_str();
  for (;;) {
    while (*at == ' ') ++at;
    if (*at == '\0') return true;
    char* end = nullptr;
    out.push_back(std::strtod(at, &end));
    if (end == at) return false;
    at = end;
  }
}

bool all_within = true;

void line(const char* what, double found, double least, double most) {
  const bool within = found >= least && found <= most;
  all_within = all_within && within;
  if (least > 0.0)
    std::printf("%-58s %10.3f  %.1f to %.1f  %s\n", what, found, least, most, within ? "ok" : "FAILED");
  else
    std::printf("%-58s %10.1e  <= %.0e     %s\n", what, found, most, within ? "ok" : "FAILED");
}

int check(const std::vector<double>& constants) {
  material::Parameters parameters;
  const material::Outcome outcome =
      material::read_constants(constants.data(), static_cast<int>(constants.size()), parameters);
  if (!outcome.ok()) {
    char message[400];
    material::describe(outcome, parameters.form, message, sizeof message);
    std::fprintf(stderr, "%s\n", message);
    return 2;
  }
  std::printf("%d modes, %d state variables in 3D, %d in 1D\n", parameters.modes,
              material::point_state_size(parameters.modes), material::uniaxial_state_size(parameters.modes));
  line("3D against 1D, incompressible tension", tools::three_against_one_dimension(parameters), 0.0, 1e-12);
  if (parameters.rate_filter == 0.0)
    line("1D against the engine's SA2", tools::one_dimension_against_engine(parameters), 0.0, 1e-12);
  else
    std::printf("1D against the engine's SA2: not compared, the engine has no rate filter\n");
  line("1D tangent against differences", tools::uniaxial_tangent_error(parameters), 0.0, 1e-7);
  line("3D tangent dS/dE against differences", tools::tangent_error(parameters), 0.0, 1e-7);
  line("Jaumann tangent (DDSDDE) against differences", tools::jaumann_tangent_error(parameters), 0.0, 1e-7);
  line("dP/dF against differences", tools::first_piola_tangent_error(parameters), 0.0, 1e-7);
  line("objectivity, Cauchy stress under rotation", tools::objectivity_error(parameters), 0.0, 1e-10);
  if (parameters.rate_filter == 0.0) {
    line("order in time, 1D", tools::uniaxial_time_order(parameters), 1.9, 2.1);
    line("order in time, 3D", tools::time_order(parameters), 1.9, 2.1);
  } else {
    std::printf("order in time: 1D %.3f, 3D %.3f (no limit: the filter is of order 1)\n",
                tools::uniaxial_time_order(parameters), tools::time_order(parameters));
  }
  std::printf("cost: %.2f us stress alone, %.2f us with tangent\n", tools::update_cost(parameters, false),
              tools::update_cost(parameters, true));
  return all_within ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    std::string text;
    if (count == 2 && (std::strcmp(arguments[1], "--help") == 0 || std::strcmp(arguments[1], "-h") == 0)) {
      std::fputs(usage, stdout);
      return 0;
    }
    if (count > 1 && std::strcmp(arguments[1], "--file") == 0) {
      std::ifstream file(count == 3 ? arguments[2] : "");
      if (!file) {
        std::fprintf(stderr, "probation_point_check: cannot read %s\n", count == 3 ? arguments[2] : "FILE");
        return 2;
      }
      text.assign(std::istreambuf_iterator<char>(file), {});
    } else {
      for (int i = 1; i < count; ++i) text += std::string(arguments[i]) + " ";
    }
    if (text.empty()) text = "3220 1.8 20000 1 1 0.00464 0.0367 1e-7 0 50 6";
    std::vector<double> constants;
    if (!numbers(text, constants)) {
      std::fprintf(stderr, "probation_point_check: entry %zu is not a number\n%s", constants.size(), usage);
      return 2;
    }
    return check(constants);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "probation_point_check: %s\n", problem.what());
    return 1;
  }
}
