// feedback.hpp and feedback/: one line per form.

#include "bindings.hpp"
#include "probation/feedback/power_activation.hpp"
#include "probation/feedback/self_heating.hpp"
#include "probation/feedback/stress_activation.hpp"

using namespace probation;

namespace {

/// In Python a feedback is its values: equal if they are equal, and pickled as them (for processes and deep
/// copies).
template <class Form, class... Parameters>
auto as_values(py::class_<Form, Parameters...> form) {
  return form.def_property_readonly("values", [](const Form& feedback) { return feedback.values(); })
      .def(
          "__eq__", [](const Form& one, const Form& other) { return one.values() == other.values(); },
          py::is_operator())
      .def("__hash__",
           [](const Form& feedback) {
             return py::hash(py::cast(feedback.values()).template cast<py::tuple>());
           })
      .def("__repr__",
           [](const py::object& self) {
             py::list values;
             for (const py::handle value : self.attr("values")) values.append(py::repr(value));
             return py::str("{}({})").format(py::type::of(self).attr("__name__"),
                                             py::str(", ").attr("join")(values));
           })
      .def("__reduce__", [](const py::object& self) {
        return py::make_tuple(py::type::of(self), py::tuple(self.attr("values")));
      });
}

}  // namespace

void bind_feedback(py::module_& m) {
  py::class_<Feedback, std::shared_ptr<Feedback>>(m, "Feedback")
      .def_property_readonly("parameters", &Feedback::parameters);
  as_values(py::class_<StressActivation, Feedback, std::shared_ptr<StressActivation>>(m, "StressActivation")
                .def(py::init<double>(), "activation_stress"_a));
  as_values(py::class_<PowerActivation, Feedback, std::shared_ptr<PowerActivation>>(m, "PowerActivation")
                .def(py::init<double, double>(), "activation_stress"_a, "exponent"_a));
  as_values(py::class_<SelfHeating, Feedback, std::shared_ptr<SelfHeating>>(m, "SelfHeating")
                .def(py::init<double, double, double, double>(), "heating"_a, "cooling_rate"_a, "softening"_a,
                     "hardening_loss"_a));
}
