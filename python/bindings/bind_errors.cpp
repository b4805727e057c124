// errors.hpp -> InputError (also a ValueError), ConvergenceError (also a RuntimeError) with .time,
// .residual_norm.

#include "bindings.hpp"
#include "probation/errors.hpp"

void bind_errors(py::module_& m) {
  py::register_exception<probation::InputError>(m, "InputError", PyExc_ValueError);

  // A released handle: an owning static could be destroyed after the interpreter.
  static py::handle convergence_error =
      py::exception<probation::ConvergenceError>(m, "ConvergenceError", PyExc_RuntimeError).release();
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const probation::ConvergenceError& error) {
      py::object instance = py::reinterpret_borrow<py::object>(convergence_error)(error.what());
      instance.attr("time") = error.time();
      instance.attr("residual_norm") = error.residual_norm();
      PyErr_SetObject(convergence_error.ptr(), instance.ptr());
    }
  });
}
