# Runs the program as it is found on another machine, in a fresh folder: from the tree that
# `cmake --install` makes, from the Debian package, and as a lone file.
cmake_minimum_required(VERSION 3.25)
set(work ${MERGE2D_BINARY_DIR}/tests/elsewhere)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work}/packages ${work}/lone ${work}/home)

function(run)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env HOME=${work}/home XDG_DATA_HOME= XDG_DATA_DIRS=/nowhere
                          ${ARGV}
                  WORKING_DIRECTORY ${work}/home
                  COMMAND_ECHO STDOUT OUTPUT_VARIABLE output ECHO_OUTPUT_VARIABLE
                  COMMAND_ERROR_IS_FATAL ANY)
  set(output "${output}" PARENT_SCOPE)
endfunction()

# The main job, a lesson, and what the program says of itself.
function(use program)
  run(${program} list)
  if(NOT output MATCHES "books" OR NOT output MATCHES "one-step")
    message(FATAL_ERROR "${program} does not list its scenes and lessons")
  endif()
  run(${program} render books --seconds 0.1 -r 160x120 --force)
  run(${program} lesson one-step --force)
  run(${program} doctor)
endfunction()

run(${CMAKE_COMMAND} --install ${MERGE2D_BINARY_DIR} --prefix ${work}/prefix)
use(${work}/prefix/bin/merge2d)

file(COPY ${work}/prefix/bin/merge2d DESTINATION ${work}/lone)
use(${work}/lone/merge2d)

find_program(DPKG_DEB dpkg-deb)
if(DPKG_DEB)
  run(${CMAKE_CPACK_COMMAND} -G DEB -B ${work}/packages --config ${MERGE2D_BINARY_DIR}/CPackConfig.cmake)
  file(GLOB packages ${work}/packages/*.deb)
  foreach(package IN LISTS packages)
    run(${DPKG_DEB} -x ${package} ${work}/unpacked)
  endforeach()
  use(${work}/unpacked/usr/bin/merge2d)
endif()
