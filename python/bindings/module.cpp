#include "bindings.hpp"
#include "probation/solver.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled engine of probation. Its public face is the probation package.";
  m.attr("__version__") = PROBATION_VERSION;
  probation::kernel_build();  // a wrong name in PROBATION_KERNELS stops the import
  bind_errors(m);
  bind_kinematics(m);
  bind_elastic_frame(m);
  bind_slider(m);
  bind_spectrum(m);
  bind_whitening(m);
  bind_companion(m);
  bind_feedback(m);
  bind_history(m);
  bind_law(m);
  bind_ramp(m);
  bind_solver(m);
  bind_creep(m);
  bind_batch(m);
  bind_identify(m);
  bind_build(m);
}
