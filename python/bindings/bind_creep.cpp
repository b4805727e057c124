#include "bindings.hpp"
#include "probation/creep.hpp"

void bind_creep(py::module_& m) {
  m.def("creep_strain", &probation::creep_strain, "law"_a, "change"_a, "time"_a, "true_stress"_a, "jumps"_a,
        "start"_a, py::call_guard<py::gil_scoped_release>());
}
