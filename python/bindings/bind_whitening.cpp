#include "bindings.hpp"
#include "probation/whitening.hpp"

using probation::Whitening;

void bind_whitening(py::module_& m) {
  py::class_<Whitening>(m, "Whitening")
      .def(py::init<const probation::Samples&, double, double, Eigen::ArrayXd, const Whitening::Columns&,
                    const probation::Samples&>(),
           "scale"_a, "phi"_a, "theta"_a, "variance"_a, "directions"_a, "shrink"_a)
      .def("of", &Whitening::of, "values"_a);
}
