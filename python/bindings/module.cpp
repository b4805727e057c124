#include "bindings.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled engine of probation. Its public face is the probation package.";
  m.attr("__version__") = PROBATION_VERSION;
  bind_errors(m);
  bind_kinematics(m);
  bind_spectrum(m);
  bind_companion(m);
  bind_feedback(m);
  bind_history(m);
  bind_law(m);
  bind_ramp(m);
  bind_solver(m);
  bind_creep(m);
  bind_batch(m);
  bind_identify(m);
}
