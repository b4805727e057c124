#pragma once
// One bind_<header>.cpp per topic; module.cpp lists them.

#include <pybind11/eigen.h>
#include <pybind11/native_enum.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <type_traits>

namespace py = pybind11;
using namespace pybind11::literals;

/// Samples where NumPy holds them: one-dimensional, contiguous, of this very type. Nothing else is taken, so
/// that nothing is copied; probation._arrays makes them so. `Scalar` is const where they are only read.
template <class Scalar>
struct Held {
  using Array = Eigen::Array<std::remove_const_t<Scalar>, Eigen::Dynamic, 1>;
  Scalar* data = nullptr;
  py::ssize_t size = 0;
  Eigen::Map<std::conditional_t<std::is_const_v<Scalar>, const Array, Array>> view() const {
    return {data, size};
  }
};

namespace pybind11::detail {

template <class Scalar>
struct type_caster<Held<Scalar>> {
  using Value = std::remove_const_t<Scalar>;
  PYBIND11_TYPE_CASTER(Held<Scalar>, const_name("numpy.typing.NDArray"));

  bool load(handle source, bool /*convert*/) {
    if (!array_t<Value, array::c_style>::check_(source)) return false;
    auto held = reinterpret_borrow<array_t<Value>>(source);
    if (held.ndim() != 1 || (!std::is_const_v<Scalar> && !held.writeable())) return false;
    value = {const_cast<Value*>(held.data()), held.size()};
    return true;
  }
};

}  // namespace pybind11::detail

void bind_batch(py::module_& m);
void bind_build(py::module_& m);
void bind_companion(py::module_& m);
void bind_creep(py::module_& m);
void bind_elastic_frame(py::module_& m);
void bind_errors(py::module_& m);
void bind_feedback(py::module_& m);
void bind_history(py::module_& m);
void bind_identify(py::module_& m);
void bind_kinematics(py::module_& m);
void bind_law(py::module_& m);
void bind_ramp(py::module_& m);
void bind_slider(py::module_& m);
void bind_solver(py::module_& m);
void bind_spectrum(py::module_& m);
void bind_whitening(py::module_& m);
