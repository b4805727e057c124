#pragma once
// One bind_<header>.cpp per topic; module.cpp lists them.

#include <pybind11/eigen.h>
#include <pybind11/native_enum.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace pybind11::literals;

/// An interrupt from the keyboard ends a long batch: to be called now and then without the interpreter's
/// lock.
inline void raise_signals() {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void bind_batch(py::module_& m);
void bind_companion(py::module_& m);
void bind_creep(py::module_& m);
void bind_errors(py::module_& m);
void bind_feedback(py::module_& m);
void bind_history(py::module_& m);
void bind_identify(py::module_& m);
void bind_kinematics(py::module_& m);
void bind_law(py::module_& m);
void bind_ramp(py::module_& m);
void bind_solver(py::module_& m);
void bind_spectrum(py::module_& m);
