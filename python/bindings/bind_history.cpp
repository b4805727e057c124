#include "bindings.hpp"
#include "probation/history.hpp"

using probation::Differentiator;
using probation::History;

namespace {

History make_history(const probation::Samples& time, const probation::Samples& true_strain,
                     const probation::Samples& strain_rate, History::Indices jumps,
                     const Eigen::ArrayXi& direction, bool find_jumps) {
  if (find_jumps) return {probation::FindJumps{}, time, true_strain, strain_rate, direction};
  return {time, true_strain, strain_rate, std::move(jumps), direction};
}

}  // namespace

void bind_history(py::module_& m) {
  py::native_enum<Differentiator>(m, "Differentiator", "enum.Enum")
      .value("secant", Differentiator::secant)
      .value("backward", Differentiator::backward)
      .value("three_point", Differentiator::three_point)
      .finalize();
  py::class_<History>(m, "History")
      .def(py::init(&make_history), "time"_a, "true_strain"_a, "strain_rate"_a = Eigen::ArrayXd(),
           "jumps"_a = History::Indices(), "direction"_a = Eigen::ArrayXi(), "find_jumps"_a = false)
      .def_static("find_rate_jumps", &History::find_rate_jumps, "time"_a, "true_strain"_a)
      .def_property_readonly("time", &History::time)
      .def_property_readonly("true_strain", &History::true_strain)
      .def_property_readonly("strain_rate", &History::strain_rate)
      .def_property_readonly("haward_thackray_strain", &History::haward_thackray_strain)
      .def_property_readonly("jumps", &History::jumps)
      .def(
          "rates",
          [](const History& history, Differentiator differentiator) {
            const probation::StepRates rates = history.rates(differentiator);
            return py::make_tuple(rates.begin, rates.end);
          },
          "differentiator"_a)
      .def("__len__", &History::size);
}
