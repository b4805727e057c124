#include "bindings.hpp"
#include "probation/schemes/ramp.hpp"

void bind_ramp(py::module_& m) {
  m.def("ramp_stress", &probation::ramp_stress, "law"_a, "strain_rate"_a, "time"_a,
        py::call_guard<py::gil_scoped_release>());
}
