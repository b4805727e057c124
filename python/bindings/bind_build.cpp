#include "bindings.hpp"
#include "probation/solver.hpp"

void bind_build(py::module_& m) {
  m.def("build_information", [] {
    py::dict found;
    found["compiler"] = PROBATION_COMPILER;
    found["flags"] = PROBATION_FLAGS;
    found["kernel_flags"] = PROBATION_KERNEL_FLAGS;
    found["kernels"] = probation::kernel_build();
    return found;
  });
}
