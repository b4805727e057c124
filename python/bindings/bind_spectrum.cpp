#include "bindings.hpp"
#include "probation/spectrum.hpp"

using probation::Spectrum;

void bind_spectrum(py::module_& m) {
  py::class_<Spectrum>(m, "Spectrum")
      .def(py::init([](const Eigen::ArrayXd& relaxation_ratio, const Eigen::ArrayXd& modal_weight) {
             Spectrum spectrum{relaxation_ratio, modal_weight};
             spectrum.validate();
             return spectrum;
           }),
           "relaxation_ratio"_a, "modal_weight"_a)
      .def_static("log_spaced", &Spectrum::log_spaced, "modes"_a = 50, "decades"_a = 6.0)
      .def_readonly("relaxation_ratio", &Spectrum::relaxation_ratio)
      .def_readonly("modal_weight", &Spectrum::modal_weight)
      .def_property_readonly("modes", &Spectrum::modes);
}
