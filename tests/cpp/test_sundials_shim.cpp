#include "sundials_shim.hpp"

#include <cvode/cvode_diag.h>
#include <doctest/doctest.h>

#include <cmath>

using namespace probation::sundials;

namespace {

int decay(sunrealtype /*time*/, N_Vector state, N_Vector rate, void* /*user_data*/) noexcept {
  NV_Ith_S(rate, 0) = -NV_Ith_S(state, 0);
  return 0;
}

int refuse(sunrealtype /*time*/, N_Vector /*state*/, N_Vector /*rate*/, void* /*user_data*/) noexcept {
  return -1;
}

struct Solver {
  explicit Solver(CVRhsFn rate) {
    NV_Ith_S(state.get(), 0) = 1.0;
    REQUIRE(CVodeInit(memory.get(), rate, 0.0, state.get()) == CV_SUCCESS);
    REQUIRE(CVodeSStolerances(memory.get(), 1e-10, 1e-12) == CV_SUCCESS);
    REQUIRE(CVDiag(memory.get()) == CVDIAG_SUCCESS);
  }

  int advance_to(double time) {
    double reached = 0.0;
    return CVode(memory.get(), time, state.get(), &reached, CV_NORMAL);
  }

  Messages messages;
  Context context = make_context(messages);
  Vector state = make_vector(1, context);
  Memory memory = make_memory(CV_BDF, context, messages);
};

}  // namespace

TEST_CASE("a decay of one time constant ends at exp(-1)") {
  Solver solver(decay);
  REQUIRE(solver.advance_to(1.0) == CV_SUCCESS);
  CHECK(NV_Ith_S(solver.state.get(), 0) == doctest::Approx(std::exp(-1.0)).epsilon(1e-8));
  CHECK(solver.messages.last.empty());
}

TEST_CASE("a refused right-hand side is reported by flag, name and message") {
  Solver solver(refuse);
  const int flag = solver.advance_to(1.0);
  CHECK(flag == CV_RHSFUNC_FAIL);
  CHECK(flag_name(flag) == "CV_RHSFUNC_FAIL");
  CHECK(solver.messages.last.find("right-hand side") != std::string::npos);
}

TEST_CASE("too few steps are reported too") {
  Solver solver(decay);
  CVodeSetMaxNumSteps(solver.memory.get(), 3);
  CHECK(flag_name(solver.advance_to(1.0)) == "CV_TOO_MUCH_WORK");
  CHECK_FALSE(solver.messages.last.empty());
}
