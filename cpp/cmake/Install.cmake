# What others build against: find_package(probation) -> probation::material (headers alone) and, with Eigen and SUNDIALS
# there, probation::engine. Component "development" goes below a prefix; "python" puts the headers beside the module.

include(CMakePackageConfigHelpers)

set(package "${CMAKE_CURRENT_BINARY_DIR}/package")
configure_file("${CMAKE_CURRENT_LIST_DIR}/probationConfig.cmake.in" "${package}/probationConfig.cmake" @ONLY)
write_basic_package_version_file("${package}/probationConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
set(package_files "${package}/probationConfig.cmake" "${package}/probationConfigVersion.cmake")

install(TARGETS probation_engine EXPORT probationEngine
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)

function(probation_install_for component prefix)
  install(DIRECTORY include/ DESTINATION ${prefix}include COMPONENT ${component} FILES_MATCHING PATTERN "*.hpp")
  install(FILES interfaces/probation.h DESTINATION ${prefix}include COMPONENT ${component})
  install(DIRECTORY interfaces/ DESTINATION ${prefix}share/probation/interfaces COMPONENT ${component}
    FILES_MATCHING PATTERN "*.cpp" PATTERN "*.h")
  install(FILES ${package_files} DESTINATION ${prefix}lib/cmake/probation COMPONENT ${component})
endfunction()

probation_install_for(development "")
install(EXPORT probationEngine NAMESPACE probation:: DESTINATION lib/cmake/probation COMPONENT development)
install(FILES cmake/FindStaticSundials.cmake DESTINATION lib/cmake/probation COMPONENT development)
if(PROBATION_PYTHON)
  probation_install_for(python probation/cpp/)
endif()
