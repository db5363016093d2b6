# Builds and runs the consumer as a user would, against the tree TREE: "build" or "install".
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
run(${work}/build/consumer)

# The same without CMake: only an installed tree has its pkg-config file.
if(TREE STREQUAL "install")
  file(GLOB_RECURSE pc ${prefix}/merge2d.pc)
  get_filename_component(pc_folder ${pc} DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} ${pc_folder})
  run(sh -c "c++ -std=c++20 -o by-pkg-config ${CONSUMER}/main.cpp \
             $(pkg-config --cflags --libs merge2d)" WORKING_DIRECTORY ${work})
  run(${work}/by-pkg-config)
endif()
