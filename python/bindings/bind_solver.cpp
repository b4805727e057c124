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

  py::class_<SolverOptions>(m, "SolverOptions")
      .def(py::init([](Scheme scheme, Start start, double relative_tolerance, double absolute_tolerance,
                       long max_steps) {
             return SolverOptions{scheme, start, {relative_tolerance, absolute_tolerance, max_steps}};
           }),
           "scheme"_a = Scheme::be2, "start"_a = Start::exponential,
           "relative_tolerance"_a = CvodeOptions().relative_tolerance,
           "absolute_tolerance"_a = CvodeOptions().absolute_tolerance,
           "max_steps"_a = CvodeOptions().max_steps);

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
      .def(
          "stress",
          [](Solver& solver, const Law& law, const LawChange& change, Held<double> out) {
            const py::gil_scoped_release others_run;
            solver.stress(law, change, out.view());
          },
          "law"_a, "change"_a, "out"_a)
      .def("tangent", &Solver::tangent, "law"_a, "change"_a, "directions"_a, "stress"_a, "derivatives"_a,
           py::call_guard<py::gil_scoped_release>())
      .def("strain_sensitivity", &strain_sensitivity, "law"_a, "change"_a,
           py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("cvode_statistics", &Solver::cvode_statistics);
  m.def(
      "stress",
      [](const Law& law, const LawChange& change, const SolverOptions& options, Held<double> out,
         Held<const double> time, Held<const double> true_strain, Held<const double> strain_rate,
         History::Indices jumps, Held<const int> direction, bool find_jumps) {
        const py::gil_scoped_release others_run;
        const auto instants = time.view(), strain = true_strain.view(), rate = strain_rate.view();
        const Eigen::ArrayXi signs = direction.view();
        Solver(find_jumps ? History(FindJumps{}, instants, strain, rate, signs)
                          : History(instants, strain, rate, std::move(jumps), signs),
               options)
            .stress(law, change, out.view());
      },
      "law"_a, "change"_a, "options"_a, "out"_a, "time"_a, "true_strain"_a, "strain_rate"_a, "jumps"_a,
      "direction"_a, "find_jumps"_a);
  m.def("kernel_build", &kernel_build);
  m.def("parameter_directions", &parameter_directions, "law"_a, "change"_a, "history"_a);
}
