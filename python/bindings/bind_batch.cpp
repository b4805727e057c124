#include "bindings.hpp"
#include "probation/batch.hpp"

using namespace probation;

void bind_batch(py::module_& m) {
  py::class_<BatchRecord>(m, "BatchRecord")
      .def(py::init([](const History& history, const Eigen::ArrayXd& true_stress, const LawChange& change) {
             return BatchRecord{history, true_stress, change};
           }),
           "history"_a, "true_stress"_a, "change"_a);
  m.def("batch_stress", &batch_stress, "law"_a, "parameters"_a, "history"_a, "change"_a, "options"_a,
        "threads"_a, "out"_a, py::call_guard<py::gil_scoped_release>());
  m.def("batch_sum_of_squares", &batch_sum_of_squares, "law"_a, "parameters"_a, "records"_a, "options"_a,
        "threads"_a, "out"_a, py::call_guard<py::gil_scoped_release>());
  m.def(
      "normal_equations",
      [](Solver& solver, const Law& law, const LawChange& change, const Samples& true_stress) {
        NormalEquations found;
        {
          const py::gil_scoped_release release;
          found = normal_equations(solver, law, change, true_stress);
        }
        return py::make_tuple(found.matrix, found.gradient, found.sum_of_squares);
      },
      "solver"_a, "law"_a, "change"_a, "true_stress"_a);
}
