#pragma once
// One bind_<header>.cpp per topic; module.cpp lists them.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace pybind11::literals;

void bind_errors(py::module_& m);
