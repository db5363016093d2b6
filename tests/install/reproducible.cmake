# Two builds from the same sources in different folders have the same bytes: no path, no date and no
# order of a file system gets into the program or the library.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
set(ENV{CCACHE_DISABLE} 1)
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Copies of the checkout without the files that git ignores, both before the first build.
execute_process(COMMAND git -C ${SOURCE} ls-files --cached --others --exclude-standard
                OUTPUT_VARIABLE files RESULT_VARIABLE no_git ERROR_QUIET)
if(NOT no_git EQUAL 0)
  message(STATUS "skipped: no checkout of git")
  return()
endif()
string(REPLACE "\n" ";" files "${files}")
foreach(copy one another/deeper/one)
  foreach(file IN LISTS files)
    if(file AND EXISTS ${SOURCE}/${file})
      get_filename_component(folder ${WORK}/${copy}/${file} DIRECTORY)
      file(COPY ${SOURCE}/${file} DESTINATION ${folder})
    endif()
  endforeach()
endforeach()
foreach(copy one another/deeper/one)
  # Without optimisation, which has no part in this and takes most of the time.
  run(${CMAKE_COMMAND} -S ${WORK}/${copy} -B ${WORK}/${copy}/build -G ${GENERATOR}
      -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCMAKE_UNITY_BUILD=ON
      -DCMAKE_UNITY_BUILD_BATCH_SIZE=20 -DMERGE2D_TESTS=OFF)
  run(${CMAKE_COMMAND} --build ${WORK}/${copy}/build --target merge2d merge2d_shared -j 2)
endforeach()
file(GLOB_RECURSE products RELATIVE ${WORK}/one/build
     ${WORK}/one/build/merge2d ${WORK}/one/build/api/libmerge2d.so.*.*.*)
list(LENGTH products count)
if(count LESS 2)
  message(FATAL_ERROR "there is no program or no library to compare: ${products}")
endif()
foreach(product IN LISTS products)
  run(cmp ${WORK}/one/build/${product} ${WORK}/another/deeper/one/build/${product})
endforeach()
