#include <optional>

#include "bindings.hpp"
#include "probation/solver.hpp"

using namespace probation;

namespace {

/// The samples of an array where NumPy holds them; none if it is of a subclass, or Held does not take it.
template <class Scalar>
std::optional<Held<Scalar>> held(py::handle source) {
  if (Py_TYPE(source.ptr()) != py::detail::npy_api::get().PyArray_Type_) return {};
  py::detail::make_caster<Held<Scalar>> caster;
  if (!caster.load(source, false)) return {};
  return py::detail::cast_op<Held<Scalar>&>(caster);
}

}  // namespace

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
        Solver& solver = kept_solver();
        if (find_jumps)
          solver.take(options, FindJumps{}, instants, strain, rate, signs);
        else
          solver.take(options, instants, strain, rate, std::move(jumps), signs);
        solver.stress(law, change, out.view());
      },
      "law"_a, "change"_a, "options"_a, "out"_a, "time"_a, "true_strain"_a, "strain_rate"_a, "jumps"_a,
      "direction"_a, "find_jumps"_a);
  m.def(
      "stress_where_held",
      [](const Law& law, const LawChange& change, const SolverOptions& options, py::object out,
         py::handle time, py::handle true_strain) -> py::object {
        const auto instants = held<const double>(time), strain = held<const double>(true_strain);
        if (!instants || !strain || instants->size != strain->size) return py::none();
        if (out.is_none()) out = py::array_t<double>(instants->size);
        const auto stress = held<double>(out);
        if (!stress || stress->size != instants->size) return py::none();
        {
          const py::gil_scoped_release others_run;
          Solver& solver = kept_solver();
          solver.take(options, FindJumps{}, instants->view(), strain->view(), Eigen::ArrayXd(),
                      Eigen::ArrayXi());
          solver.stress(law, change, stress->view());
        }
        return out;
      },
      "law"_a, "change"_a, "options"_a, "out"_a, "time"_a, "true_strain"_a);
  m.def("kernel_build", &kernel_build);
  m.def("parameter_directions", &parameter_directions, "law"_a, "change"_a, "history"_a);
}
