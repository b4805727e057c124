# SUNDIALS' CVODE with its serial vectors, as static libraries -> target sundials_static, STATIC_SUNDIALS_VERSION.
#
# The headers and archives are looked up one by one: the package configuration that SUNDIALS installs asks for MPI,
# hypre and PETSc as well when the distribution built those parts, and none of them is needed here.
# PROBATION_SUNDIALS_ROOT names an installation outside the system directories.

set(only_there "")
if(PROBATION_SUNDIALS_ROOT)
  set(only_there NO_DEFAULT_PATH)
endif()

find_path(STATIC_SUNDIALS_INCLUDE cvode/cvode.h
  HINTS "${PROBATION_SUNDIALS_ROOT}" PATH_SUFFIXES include ${only_there})

set(STATIC_SUNDIALS_VERSION "")
set(with_mpi FALSE)
if(STATIC_SUNDIALS_INCLUDE)
  file(STRINGS "${STATIC_SUNDIALS_INCLUDE}/sundials/sundials_config.h" version_lines
    REGEX "^#define SUNDIALS_VERSION_(MAJOR|MINOR|PATCH) ")
  foreach(part MAJOR MINOR PATCH)
    string(REGEX MATCH "VERSION_${part} ([0-9]+)" found "${version_lines}")
    list(APPEND STATIC_SUNDIALS_VERSION "${CMAKE_MATCH_1}")
  endforeach()
  list(JOIN STATIC_SUNDIALS_VERSION "." STATIC_SUNDIALS_VERSION)
  file(STRINGS "${STATIC_SUNDIALS_INCLUDE}/sundials/sundials_config.h" with_mpi
    REGEX "^#define SUNDIALS_MPI_ENABLED 1")
endif()

# Order matters to the linker: users of a symbol before its owner. What 6.x calls generic is core since 7.0.
set(archives cvode nvecserial)
if(STATIC_SUNDIALS_VERSION VERSION_LESS 7)
  list(APPEND archives generic)
else()
  list(APPEND archives core)
endif()
set(STATIC_SUNDIALS_LIBRARIES "")
set(archive_variables "")
foreach(archive ${archives})
  find_library(STATIC_SUNDIALS_${archive} NAMES libsundials_${archive}.a sundials_${archive}_static  # the latter: Windows
    HINTS "${PROBATION_SUNDIALS_ROOT}" PATH_SUFFIXES lib lib64 "lib/${CMAKE_LIBRARY_ARCHITECTURE}" ${only_there})
  list(APPEND archive_variables STATIC_SUNDIALS_${archive})
  list(APPEND STATIC_SUNDIALS_LIBRARIES "${STATIC_SUNDIALS_${archive}}")
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(StaticSundials
  REQUIRED_VARS STATIC_SUNDIALS_INCLUDE ${archive_variables}
  VERSION_VAR STATIC_SUNDIALS_VERSION
  REASON_FAILURE_MESSAGE "install SUNDIALS 6.4 or newer with its static libraries (Debian: libsundials-dev)")

if(StaticSundials_FOUND AND NOT TARGET sundials_static)
  add_library(sundials_static INTERFACE IMPORTED GLOBAL)
  target_include_directories(sundials_static SYSTEM INTERFACE "${STATIC_SUNDIALS_INCLUDE}")
  target_link_libraries(sundials_static INTERFACE ${STATIC_SUNDIALS_LIBRARIES} $<$<NOT:$<PLATFORM_ID:Windows>>:m>)
  # Since 7.0 the core itself calls MPI if it was built with it, so that library cannot be left out.
  if(with_mpi AND STATIC_SUNDIALS_VERSION VERSION_GREATER_EQUAL 7)
    message(STATUS "SUNDIALS ${STATIC_SUNDIALS_VERSION} was built with MPI: the extension will need the MPI library")
    find_package(MPI REQUIRED COMPONENTS C)
    target_link_libraries(sundials_static INTERFACE MPI::MPI_C)
  endif()
endif()
mark_as_advanced(STATIC_SUNDIALS_INCLUDE ${archive_variables})
