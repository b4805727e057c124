// feedback.hpp and feedback/: one line per form.

#include "bindings.hpp"
#include "probation/feedback/self_heating.hpp"
#include "probation/feedback/stress_activation.hpp"

using namespace probation;

void bind_feedback(py::module_& m) {
  py::class_<Feedback, std::shared_ptr<Feedback>>(m, "Feedback").def_property_readonly("parameters", &Feedback::parameters);
  py::class_<StressActivation, Feedback, std::shared_ptr<StressActivation>>(m, "StressActivation")
      .def(py::init<double>(), "activation_stress"_a);
  py::class_<SelfHeating, Feedback, std::shared_ptr<SelfHeating>>(m, "SelfHeating")
      .def(py::init<double, double, double, double>(), "heating"_a, "cooling_rate"_a, "softening"_a, "hardening_loss"_a);
}
