#pragma once
// One bind_<header>.cpp per topic; module.cpp lists them.

#include <pybind11/eigen.h>
#include <pybind11/native_enum.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace pybind11::literals;

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
