#pragma once
// Rows of samples where NumPy holds them, and the interpreter during a long batch.

#include <functional>

#include "bindings.hpp"
#include "probation/sample_rows.hpp"

/// float32 or float64, contiguous; a single row serves all records.
inline probation::SampleRows rows(const py::array& samples) {
  const py::ssize_t stride = samples.ndim() == 2 ? samples.shape(1) : 0;
  if (samples.itemsize() == sizeof(float)) return {static_cast<const float*>(samples.data()), stride};
  return {static_cast<const double*>(samples.data()), stride};
}

/// An interrupt from the keyboard ends a batch: called now and then without the interpreter's lock.
inline void raise_signals() {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// The `pause` of a batch. Signals reach the main thread only, and no other thread may ask for the
/// interpreter's lock while it shuts down. To be called with the lock held.
inline std::function<void()> signals_of_this_thread() {
  const auto main =
      py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  return PyThread_get_thread_ident() == main ? std::function<void()>(raise_signals) : std::function<void()>();
}
