# The hot loops, src/kernels/*.cpp, compiled once per instruction set: each file sees PROBATION_ISA, the name of the
# namespace its code goes into (baseline, v3), and the dispatcher in src/ sees PROBATION_HAVE_V3 where v3 was built.
#
# A kernel file takes and returns plain pointers and numbers, and includes neither Eigen nor containers: an inline
# function compiled for v3 could otherwise be the copy that the linker keeps for everyone. ctest checks that.

# psabi: a 32-byte vector is passed differently with and without AVX. None leaves its file, so that may be.
set(PROBATION_KERNEL_FLAGS -O3 -ffp-contract=fast -fno-math-errno -fno-trapping-math -fopenmp-simd -Wno-psabi)

function(probation_add_kernels engine)
  file(GLOB kernel_sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/src/kernels/*.cpp")
  if(NOT kernel_sources)
    return()
  endif()
  probation_add_kernels_for(${engine} baseline "" "${kernel_sources}")
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
