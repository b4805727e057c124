// companion.hpp and companion/: one line per form.

#include "bindings.hpp"
#include "probation/companion/exponential.hpp"
#include "probation/companion/power_law.hpp"
#include "probation/companion/rate_shift.hpp"
#include "probation/companion/table.hpp"
#include "probation/companion/weissenberg.hpp"

using namespace probation;

void bind_companion(py::module_& m) {
  constexpr double floor = CompanionRelation::default_rate_floor;
  py::class_<CompanionRelation, std::shared_ptr<CompanionRelation>>(m, "CompanionRelation")
      .def("relaxation_time", py::vectorize(&CompanionRelation::relaxation_time), "rate"_a)
      .def("log_slope", py::vectorize(&CompanionRelation::log_slope), "rate"_a)
      .def_property_readonly("rate_floor", &CompanionRelation::rate_floor);
  py::class_<Weissenberg, CompanionRelation, std::shared_ptr<Weissenberg>>(m, "Weissenberg")
      .def(py::init<double, double, double>(), "slope"_a, "intercept"_a, "rate_floor"_a = floor)
      .def_property_readonly("slope", &Weissenberg::slope)
      .def_property_readonly("intercept", &Weissenberg::intercept);
  py::class_<Exponential, CompanionRelation, std::shared_ptr<Exponential>>(m, "Exponential")
      .def(py::init<double, double, double>(), "coefficient"_a, "exponent"_a, "rate_floor"_a = floor)
      .def_property_readonly("coefficient", &Exponential::coefficient)
      .def_property_readonly("exponent", &Exponential::exponent);
  py::class_<PowerLaw, CompanionRelation, std::shared_ptr<PowerLaw>>(m, "PowerLaw")
      .def(py::init<double, double, double>(), "coefficient"_a, "exponent"_a, "rate_floor"_a = floor)
      .def_property_readonly("coefficient", &PowerLaw::coefficient)
      .def_property_readonly("exponent", &PowerLaw::exponent);
  py::class_<Table, CompanionRelation, std::shared_ptr<Table>>(m, "Table")
      .def(py::init<std::vector<double>, std::vector<double>, double>(), "rates"_a, "tau_max"_a,
           "rate_floor"_a = floor)
      .def_property_readonly("rates", &Table::rates)
      .def_property_readonly("tau_max", &Table::tau_max);
  py::class_<RateShift, CompanionRelation, std::shared_ptr<RateShift>>(m, "RateShift")
      .def(py::init<std::shared_ptr<CompanionRelation>, double, double, double, double>(),
           "base"_a.none(true), "reference_rate"_a, "exponent"_a, "curvature"_a, "rate_floor"_a = floor);
}
