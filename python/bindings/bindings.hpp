#pragma once
// One bind_<header>.cpp per topic; module.cpp lists them.

#include <pybind11/eigen.h>
#include <pybind11/native_enum.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace pybind11::literals;

/// Samples where NumPy holds them: float64, one-dimensional, contiguous. Nothing else is taken, so that
/// nothing is copied; probation._arrays makes them so.
struct HeldSamples {
  const double* data = nullptr;
  py::ssize_t size = 0;
  Eigen::Map<const Eigen::ArrayXd> view() const { return {data, size}; }
};

/// The same, to be written to.
struct HeldOutput {
  double* data = nullptr;
  py::ssize_t size = 0;
  Eigen::Map<Eigen::ArrayXd> view() const { return {data, size}; }
};

namespace pybind11::detail {

inline bool holds_samples(handle source) {
  return array_t<double, array::c_style>::check_(source) && reinterpret_borrow<array>(source).ndim() == 1;
}

template <>
struct type_caster<HeldSamples> {
  PYBIND11_TYPE_CASTER(HeldSamples, const_name("numpy.typing.NDArray[numpy.float64]"));
  bool load(handle source, bool /*convert*/) {
    if (!holds_samples(source)) return false;
    const auto array = reinterpret_borrow<pybind11::array>(source);
    value = {static_cast<const double*>(array.data()), array.size()};
    return true;
  }
};

template <>
struct type_caster<HeldOutput> {
  PYBIND11_TYPE_CASTER(HeldOutput, const_name("numpy.typing.NDArray[numpy.float64]"));
  bool load(handle source, bool /*convert*/) {
    if (!holds_samples(source)) return false;
    auto array = reinterpret_borrow<pybind11::array>(source);
    if (!array.writeable()) return false;
    value = {static_cast<double*>(array.mutable_data()), array.size()};
    return true;
  }
};

}  // namespace pybind11::detail

void bind_batch(py::module_& m);
void bind_companion(py::module_& m);
void bind_creep(py::module_& m);
void bind_errors(py::module_& m);
void bind_feedback(py::module_& m);
void bind_history(py::module_& m);
void bind_kinematics(py::module_& m);
void bind_law(py::module_& m);
void bind_ramp(py::module_& m);
void bind_solver(py::module_& m);
void bind_spectrum(py::module_& m);
