#include "bindings.hpp"
#include "probation/elastic_frame.hpp"

void bind_elastic_frame(py::module_& m) {
  m.def("stress_behind_frame", &probation::stress_behind_frame, "time"_a, "modulus"_a, "relaxation_time"_a,
        "give"_a, "change"_a, py::call_guard<py::gil_scoped_release>());
}
