#pragma once
// One interface to SUNDIALS 6.4 to 7.x: their differences, owners of handles, and no output to the terminal.
//
// The same in both and therefore not here: sunrealtype, sunindextype, int as the type of every return flag
// (7.x calls it SUNErrCode), CVode..., CVDiag..., N_V..., SUNLinSol... and SUNMat... functions.

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>
#include <sundials/sundials_types.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <type_traits>

#if SUNDIALS_VERSION_MAJOR < 6 || (SUNDIALS_VERSION_MAJOR == 6 && SUNDIALS_VERSION_MINOR < 4)
#error "probation needs SUNDIALS 6.4 or newer"
#endif
static_assert(std::is_same_v<sunrealtype, double>, "probation needs SUNDIALS in double precision");

namespace probation::sundials {

// Owners. A context outlives everything made with it, so declare it first.

template <class Handle, auto destroy>
struct Destroy {
  void operator()(std::remove_pointer_t<Handle>* handle) const noexcept { destroy(handle); }
};
inline void destroy_context(SUNContext context) noexcept { SUNContext_Free(&context); }
inline void destroy_memory(void* memory) noexcept { CVodeFree(&memory); }
inline void destroy_vector(N_Vector vector) noexcept { N_VDestroy(vector); }
inline void destroy_matrix(SUNMatrix matrix) noexcept { SUNMatDestroy(matrix); }
inline void destroy_linear_solver(SUNLinearSolver solver) noexcept { SUNLinSolFree(solver); }

template <class Handle, auto destroy>
using Owner = std::unique_ptr<std::remove_pointer_t<Handle>, Destroy<Handle, destroy>>;

using Context = Owner<SUNContext, destroy_context>;
using Memory = Owner<void*, destroy_memory>;  ///< of CVODE
using Vector = Owner<N_Vector, destroy_vector>;
using Matrix = Owner<SUNMatrix, destroy_matrix>;
using LinearSolver = Owner<SUNLinearSolver, destroy_linear_solver>;

/// What SUNDIALS said last. It goes here instead of to standard error, and must outlive the context.
struct Messages {
  std::string last;

  void keep(const char* message) noexcept {
    try {
      last = message != nullptr ? message : "";
    } catch (...) {  // a lost message must not end the solve
      last.clear();
    }
  }
};

#if SUNDIALS_VERSION_MAJOR >= 7
inline void keep_error(int /*line*/, const char* /*function*/, const char* /*file*/, const char* message,
                       SUNErrCode /*code*/, void* messages, SUNContext /*context*/) noexcept {
  static_cast<Messages*>(messages)->keep(message);
}
#else
inline void keep_error(int /*code*/, const char* /*module*/, const char* /*function*/, char* message,
                       void* messages) noexcept {
  static_cast<Messages*>(messages)->keep(message);
}
#endif

/// A context that reports to `messages` and to nothing else.
/// @throws std::bad_alloc
inline Context make_context([[maybe_unused]] Messages& messages) {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
  const int flag = SUNContext_Create(SUN_COMM_NULL, &context);
#else
  const int flag = SUNContext_Create(nullptr, &context);
#endif
  if (flag != 0 || context == nullptr) throw std::bad_alloc();
  Context owner(context);
#if SUNDIALS_VERSION_MAJOR >= 7
  // Warnings go past the error handlers to a logger, which would write to standard output.
  SUNContext_SetLogger(context, nullptr);
  SUNContext_ClearErrHandlers(context);
  if (SUNContext_PushErrHandler(context, keep_error, &messages) != SUN_SUCCESS) throw std::bad_alloc();
#endif
  return owner;
}

/// CVODE's memory, reporting to `messages` too. `method` is CV_BDF or CV_ADAMS.
/// @throws std::bad_alloc
inline Memory make_memory(int method, const Context& context, [[maybe_unused]] Messages& messages) {
  Memory owner(CVodeCreate(method, context.get()));
  if (!owner) throw std::bad_alloc();
#if SUNDIALS_VERSION_MAJOR < 7
  CVodeSetErrHandlerFn(owner.get(), keep_error, &messages);
#endif
  return owner;
}

/// A vector of `size` doubles that it owns.
/// @throws std::bad_alloc
inline Vector make_vector(sunindextype size, const Context& context) {
  Vector owner(N_VNew_Serial(size, context.get()));
  if (!owner) throw std::bad_alloc();
  return owner;
}

/// The name of one of CVODE's return flags, as in "CV_TOO_MUCH_WORK".
inline std::string flag_name(long int flag) {
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
  return name ? name.get() : "unknown";
}

}  // namespace probation::sundials
