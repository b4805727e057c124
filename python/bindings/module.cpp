#include "bindings.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled engine of probation. Its public face is the probation package.";
  m.attr("__version__") = PROBATION_VERSION;
  bind_errors(m);
}
