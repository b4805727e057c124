#include "bindings.hpp"
#include "probation/solver.hpp"

using namespace probation;

void bind_solver(py::module_& m) {
  py::native_enum<Scheme>(m, "Scheme", "enum.Enum")
      .value("be2", Scheme::be2)
      .value("sa2", Scheme::sa2)
      .value("sa3", Scheme::sa3)
      .value("exact", Scheme::exact)
      .value("cvode", Scheme::cvode)
      .finalize();
  py::native_enum<Start>(m, "Start", "enum.Enum")
      .value("exponential", Start::exponential)
      .value("backward_euler", Start::backward_euler)
      .finalize();

  py::class_<CvodeStatistics>(m, "CvodeStatistics")
      .def_readonly("steps", &CvodeStatistics::steps)
      .def_readonly("rate_evaluations", &CvodeStatistics::rate_evaluations)
      .def_readonly("error_test_failures", &CvodeStatistics::error_test_failures)
      .def_readonly("nonlinear_iterations", &CvodeStatistics::nonlinear_iterations)
      .def_readonly("nonlinear_failures", &CvodeStatistics::nonlinear_failures)
      .def_readonly("restarts", &CvodeStatistics::restarts)
      .def_readonly("last_order", &CvodeStatistics::last_order);

  py::class_<Solver>(m, "Solver")
      .def(py::init([](const History& history, Scheme scheme, Start start, double relative_tolerance,
                       double absolute_tolerance, long max_steps) {
             return Solver(history, {scheme, start, {relative_tolerance, absolute_tolerance, max_steps}});
           }),
           "history"_a, "scheme"_a = Scheme::be2, "start"_a = Start::exponential,
           "relative_tolerance"_a = CvodeOptions().relative_tolerance,
           "absolute_tolerance"_a = CvodeOptions().absolute_tolerance,
           "max_steps"_a = CvodeOptions().max_steps)
      .def_property_readonly("history", &Solver::history)
      .def("stress", &Solver::stress, "law"_a, "change"_a, "out"_a, py::call_guard<py::gil_scoped_release>())
      .def("tangent", &Solver::tangent, "law"_a, "change"_a, "directions"_a, "stress"_a, "derivatives"_a,
           py::call_guard<py::gil_scoped_release>())
      .def("strain_sensitivity", &strain_sensitivity, "law"_a, "change"_a,
           py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("cvode_statistics", &Solver::cvode_statistics);
  m.def("kernel_build", &kernel_build);
  m.def("parameter_directions", &parameter_directions, "law"_a, "change"_a, "history"_a);
}
