# The hot loops, src/kernels/*.cpp, compiled once per build: each file sees PROBATION_ISA, the name of the namespace its
# code goes into (portable, baseline, v3), and the dispatcher in src/ sees PROBATION_HAVE_BASELINE and PROBATION_HAVE_V3
# where these were built. `portable` is plain C++ that any compiler takes; the others need vector extensions.
#
# A kernel file takes and returns plain pointers and numbers, and includes neither Eigen nor containers: an inline
# function compiled for v3 could otherwise be the copy that the linker keeps for everyone. ctest checks that.

include(CheckCXXSourceCompiles)
check_cxx_source_compiles("
  using Vector = double __attribute__((vector_size(32)));
  int main() {
    const Vector a{}, b = a * 2.0 + a, c = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    return static_cast<int>((a < c ? b : c)[0]);
  }" PROBATION_VECTOR_EXTENSIONS)

set(PROBATION_KERNEL_FLAGS -O3)
if(PROBATION_VECTOR_EXTENSIONS)
  # psabi: a 32-byte vector is passed differently with and without AVX. None leaves its file, so that may be.
  set(PROBATION_KERNEL_FLAGS -O3 -ffp-contract=fast -fno-math-errno -fno-trapping-math -fopenmp-simd -Wno-psabi)
elseif(MSVC)
  set(PROBATION_KERNEL_FLAGS "")
endif()
if(PROBATION_SANITIZE)
  # Checks in unrolled loops keep the optimizer busy for minutes, and where their variables are the debugger's notes.
  list(APPEND PROBATION_KERNEL_FLAGS -O1 -fno-var-tracking)
endif()

function(probation_add_kernels engine)
  file(GLOB kernel_sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/src/kernels/*.cpp")
  probation_add_kernels_for(${engine} portable "" "${kernel_sources}")
  target_compile_definitions(probation_kernels_portable PRIVATE PROBATION_PLAIN_VECTOR=1)
  if(NOT PROBATION_VECTOR_EXTENSIONS)
    return()
  endif()
  probation_add_kernels_for(${engine} baseline "" "${kernel_sources}")
  target_compile_definitions(${engine} PRIVATE PROBATION_HAVE_BASELINE=1)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    probation_add_kernels_for(${engine} v3 -march=x86-64-v3 "${kernel_sources}")
    target_compile_definitions(${engine} PRIVATE PROBATION_HAVE_V3=1)
  endif()
endfunction()

function(probation_add_kernels_for engine isa isa_flags sources)
  set(kernels probation_kernels_${isa})
  add_library(${kernels} OBJECT ${sources})
  target_include_directories(${kernels} PRIVATE include src)
  target_compile_features(${kernels} PRIVATE cxx_std_17)
  target_compile_definitions(${kernels} PRIVATE PROBATION_ISA=${isa})
  target_compile_options(${kernels} PRIVATE ${PROBATION_KERNEL_FLAGS} ${isa_flags})
  set_target_properties(${kernels} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
  target_link_libraries(${kernels} PRIVATE probation_sanitizers probation_warnings)
  target_sources(${engine} PRIVATE $<TARGET_OBJECTS:${kernels}>)
endfunction()
