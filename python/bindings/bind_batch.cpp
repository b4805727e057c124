#include "bindings.hpp"
#include "probation/batch.hpp"
#include "rows.hpp"

using namespace probation;

void bind_batch(py::module_& m) {
  py::class_<BatchRecord>(m, "BatchRecord")
      .def(py::init([](const History& history, const Eigen::ArrayXd& true_stress, const LawChange& change) {
             return BatchRecord{history, true_stress, change};
           }),
           "history"_a, "true_stress"_a, "change"_a);
  using Matrix = Eigen::Ref<RowMajorMatrix>;  // what it refers to is written
  using ConstMatrix = Eigen::Ref<const RowMajorMatrix>;
  using Records = std::vector<BatchRecord>;
  m.def(
      "batch_stress",
      [](const Law& law, const ConstMatrix& parameters, const History& history, const LawChange& change,
         const SolverOptions& options, int threads, const Matrix& out) {
        const std::function<void()> signals = signals_of_this_thread();
        const py::gil_scoped_release release;
        batch_stress(law, parameters, history, change, options, {threads, signals}, out);
      },
      "law"_a, "parameters"_a, "history"_a, "change"_a, "options"_a, "threads"_a, "out"_a);
  m.def(
      "field_stress",
      [](const Law& law, const ConstMatrix& parameters, const Samples& time, const py::array& true_strain,
         bool find_jumps, const SolverOptions& options, int threads, const Matrix& out) {
        const SampleRows strains = rows(true_strain);
        const std::function<void()> signals = signals_of_this_thread();
        const py::gil_scoped_release release;
        field_stress(law, parameters, time, strains, find_jumps, options, {threads, signals}, out);
      },
      "law"_a, "parameters"_a, "time"_a, "true_strain"_a, "find_jumps"_a, "options"_a, "threads"_a, "out"_a);
  m.def(
      "batch_sum_of_squares",
      [](const Law& law, const ConstMatrix& parameters, const Records& records, const SolverOptions& options,
         int threads, const Matrix& out) {
        const std::function<void()> signals = signals_of_this_thread();
        const py::gil_scoped_release release;
        batch_sum_of_squares(law, parameters, records, options, {threads, signals}, out);
      },
      "law"_a, "parameters"_a, "records"_a, "options"_a, "threads"_a, "out"_a);
  m.def(
      "batch_normal_equations",
      [](const Law& law, const ConstMatrix& parameters, const Records& records, const SolverOptions& options,
         int threads, const Matrix& out) {
        const std::function<void()> signals = signals_of_this_thread();
        const py::gil_scoped_release release;
        batch_normal_equations(law, parameters, records, options, {threads, signals}, out);
      },
      "law"_a, "parameters"_a, "records"_a, "options"_a, "threads"_a, "out"_a);
  m.def(
      "normal_equations",
      [](Solver& solver, const Law& law, const LawChange& change, const Samples& true_stress) {
        NormalEquations found;
        {
          const std::function<void()> signals = signals_of_this_thread();
          const py::gil_scoped_release release;
          found = normal_equations(solver, law, change, true_stress);
        }
        return py::make_tuple(found.matrix, found.gradient, found.sum_of_squares);
      },
      "solver"_a, "law"_a, "change"_a, "true_stress"_a);
}
