#include "bindings.hpp"
#include "probation/identify/identify_many.hpp"
#include "rows.hpp"

using namespace probation;

void bind_identify(py::module_& m) {
  py::native_enum<IdentifyMethod>(m, "IdentifyMethod", "enum.Enum")
      .value("variable_projection", IdentifyMethod::variable_projection)
      .value("levenberg_marquardt", IdentifyMethod::levenberg_marquardt)
      .finalize();
  py::native_enum<IdentifyStatus>(m, "IdentifyStatus", "enum.Enum")
      .value("converged", IdentifyStatus::converged)
      .value("at_a_bound", IdentifyStatus::at_a_bound)
      .value("did_not_converge", IdentifyStatus::did_not_converge)
      .value("not_determined", IdentifyStatus::not_determined)
      .value("not_finite", IdentifyStatus::not_finite)
      .value("times_do_not_increase", IdentifyStatus::times_do_not_increase)
      .value("too_few_samples", IdentifyStatus::too_few_samples)
      .value("impossible_rate", IdentifyStatus::impossible_rate)
      .finalize();
  py::class_<IdentifyOptions>(m, "IdentifyOptions")
      .def(py::init([](Scheme scheme, Start start, IdentifyMethod method, const std::array<bool, 3>& held,
                       const Eigen::Array3d& lower, const Eigen::Array3d& upper, bool find_jumps,
                       int substeps) {
             return IdentifyOptions{scheme, start, method, held, lower, upper, find_jumps, substeps};
           }),
           "scheme"_a, "start"_a, "method"_a, "held"_a, "lower"_a, "upper"_a, "find_jumps"_a, "substeps"_a);
  m.def(
      "identify_many",
      [](const Law& law, const py::array& time, const py::array& true_strain, const py::array& true_stress,
         const std::optional<py::array>& noise, const IdentifyOptions& options, int threads,
         const Eigen::Ref<RowMajorMatrix>& parameters, const Eigen::Ref<RowMajorMatrix>& standard_error,
         const Eigen::Ref<Eigen::ArrayXd>& rms_residual,
         const Eigen::Ref<Eigen::Array<std::int8_t, Eigen::Dynamic, 1>>& status,
         const Eigen::Ref<Eigen::ArrayXi>& iterations) {
        BulkRecords records{parameters.rows(), time.shape(time.ndim() - 1), rows(time),
                            rows(true_strain), rows(true_stress),           {},
                            noise.has_value()};
        if (noise) records.noise = rows(*noise);
        const std::function<void()> signals = signals_of_this_thread();
        const py::gil_scoped_release release;
        identify_many(law, records, options, {threads, signals},
                      {parameters, standard_error, rms_residual, status, iterations});
      },
      "law"_a, "time"_a, "true_strain"_a, "true_stress"_a, "noise"_a, "options"_a, "threads"_a,
      "parameters"_a, "standard_error"_a, "rms_residual"_a, "status"_a, "iterations"_a);
}
