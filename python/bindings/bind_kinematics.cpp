#include "bindings.hpp"
#include "probation/kinematics.hpp"

void bind_kinematics(py::module_& m) {
  m.def("haward_thackray_strain",
        py::overload_cast<const probation::Samples&>(&probation::haward_thackray_strain), "true_strain"_a,
        py::call_guard<py::gil_scoped_release>());
}
