#include <limits>

#include "bindings.hpp"
#include "probation/slider.hpp"

void bind_slider(py::module_& m) {
  m.def("behind_backlash", &probation::behind_backlash, "value"_a, "width"_a,
        "begin"_a = std::numeric_limits<double>::quiet_NaN(), py::call_guard<py::gil_scoped_release>());
}
