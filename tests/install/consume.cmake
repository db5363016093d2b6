# Builds and runs the consumer as a user would, against the tree TREE: "build" or "install".
cmake_minimum_required(VERSION 3.25)
set(work ${MERGE2D_BINARY_DIR}/tests/consumer-${TREE})
set(prefix ${work}/prefix)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

if(TREE STREQUAL "install")
  run(${CMAKE_COMMAND} --install ${MERGE2D_BINARY_DIR} --prefix ${prefix})
  set(location -DCMAKE_PREFIX_PATH=${prefix})
else()
  set(location -Dmerge2d_DIR=${MERGE2D_BINARY_DIR})
endif()

run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${work}/build -G ${GENERATOR} ${location}
    -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
run(${CMAKE_COMMAND} --build ${work}/build)
foreach(program consumer consumer_static consumer_c)
  run(${work}/build/${program})
endforeach()

# The same without CMake: only an installed tree has its pkg-config file. The examples stand alone.
# A machine of its users need not have the packages that the library was built of.
if(TREE STREQUAL "install")
  file(GLOB_RECURSE pc ${prefix}/merge2d.pc)
  get_filename_component(pc_folder ${pc} DIRECTORY)
  get_filename_component(libraries ${pc_folder} DIRECTORY)
  set(ENV{PKG_CONFIG_LIBDIR} ${pc_folder})
  set(ENV{LD_LIBRARY_PATH} ${libraries})
  file(MAKE_DIRECTORY ${work}/examples)
  file(GLOB examples ${EXAMPLES}/*.cpp ${EXAMPLES}/*.c)
  foreach(example IN LISTS examples)
    set(compiler "c++ -std=c++20")
    if(example MATCHES "\\.c$")
      set(compiler "cc -std=c99")
    endif()
    run(sh -c "${compiler} -Wall -Wextra -Wpedantic -Werror -o example ${example} \
               $(pkg-config --cflags --libs merge2d) -lm" WORKING_DIRECTORY ${work}/examples)
    run(./example WORKING_DIRECTORY ${work}/examples)
  endforeach()

  # C++ before C++20 has the functions for C.
  file(WRITE ${work}/examples/old.cpp
       "#include <merge2d/merge2d.h>\nint main() { return m2_version()[0] == 0; }\n")
  run(sh -c "c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -o old old.cpp \
             $(pkg-config --cflags --libs merge2d)" WORKING_DIRECTORY ${work}/examples)
  run(./old WORKING_DIRECTORY ${work}/examples)
  file(WRITE ${work}/examples/classes.cpp
       "#include <merge2d/merge2d.h>\nint main() { merge2d::World world; }\n")
  execute_process(COMMAND sh -c "c++ -std=c++17 -c classes.cpp $(pkg-config --cflags merge2d)"
                  WORKING_DIRECTORY ${work}/examples ERROR_VARIABLE said RESULT_VARIABLE result)
  if(result EQUAL 0 OR NOT said MATCHES "the classes of merge2d need C[+][+]20")
    message(FATAL_ERROR "the classes in C++17: ${said}")
  endif()

  # With the archive.
  set(ENV{LD_LIBRARY_PATH})
  list(GET examples 0 example)
  run(sh -c "c++ -std=c++20 -o example ${example} $(pkg-config --cflags merge2d) \
             $(pkg-config --static --libs merge2d | sed s/-lmerge2d/-l:libmerge2d.a/)"
      WORKING_DIRECTORY ${work}/examples)
  run(./example WORKING_DIRECTORY ${work}/examples)
endif()
