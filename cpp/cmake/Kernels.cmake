# The hot loops, src/kernels/*.cpp, compiled once per build: each file sees PROBATION_ISA, the name of the namespace its
# code goes into, and the dispatcher in src/ sees PROBATION_HAVE_<NAME> of those that were built:
#
#   v3        AVX2 and FMA, on x86-64
#   baseline  vectors as every processor of the machine's kind has them
#   portable  plain C++: where the compiler has no vector extensions, and beside the others for the C++ tests
#
# A kernel file takes and returns plain pointers and numbers, and includes neither Eigen nor containers: an inline
# function compiled for v3 could otherwise be the copy that the linker keeps for everyone. ctest checks that.

include(CheckCXXSourceCompiles)
check_cxx_source_compiles("
  using Vector = double __attribute__((vector_size(16)));
  int main() {
    const Vector a{}, b = a * 2.0 + a, c = __builtin_shufflevector(a, b, 0, 2);
    return static_cast<int>((a < c ? b : c)[0]);
  }" PROBATION_VECTOR_EXTENSIONS)

set(PROBATION_KERNEL_FLAGS -O3)
if(PROBATION_VECTOR_EXTENSIONS)
  # psabi: a vector is passed differently with and without AVX. None leaves its file, so that may be.
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
  if(PROBATION_VECTOR_EXTENSIONS)
    probation_add_kernels_for(${engine} baseline "" "${kernel_sources}")
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
      probation_add_kernels_for(${engine} v3 -march=x86-64-v3 "${kernel_sources}")
    endif()
  endif()
  if(PROBATION_CPP_TESTS OR NOT PROBATION_VECTOR_EXTENSIONS)
    probation_add_kernels_for(${engine} portable "" "${kernel_sources}")
    target_compile_definitions(probation_kernels_portable PRIVATE PROBATION_PLAIN_VECTOR=1)
  endif()
endfunction()

function(probation_add_kernels_for engine isa isa_flags sources)
  set(kernels probation_kernels_${isa})
  add_library(${kernels} OBJECT ${sources})
  target_include_directories(${kernels} PRIVATE include src)
  target_compile_features(${kernels} PRIVATE cxx_std_17)
  target_compile_definitions(${kernels} PRIVATE PROBATION_ISA=${isa})
  target_compile_options(${kernels} PRIVATE ${PROBATION_KERNEL_FLAGS} ${isa_flags})
  set_target_properties(${kernels} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden UNITY_BUILD OFF)
  target_link_libraries(${kernels} PRIVATE probation_sanitizers probation_warnings)
  target_sources(${engine} PRIVATE $<TARGET_OBJECTS:${kernels}>)
  string(TOUPPER "PROBATION_HAVE_${isa}" have)
  target_compile_definitions(${engine} PRIVATE ${have}=1)
endfunction()
