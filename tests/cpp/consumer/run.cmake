# Install into a folder of its own, then configure, build and run the project beside this file against that.
# -D BUILD= the build tree, WORK= where to do it, GENERATOR=, MAKE_PROGRAM=
file(REMOVE_RECURSE "${WORK}")
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install "${BUILD}" --component development --prefix "${WORK}/install")
run(${CMAKE_COMMAND} -G "${GENERATOR}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" -S "${CMAKE_CURRENT_LIST_DIR}"
  -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${WORK}/install" "-DCMAKE_CXX_FLAGS=-O0 -Wall -Wextra -Werror")
run(${CMAKE_COMMAND} --build "${WORK}/build")
foreach(program point forward)
  run("${WORK}/build/${program}")
  message(STATUS "${program}: ${output}")
endforeach()
