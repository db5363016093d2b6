# `pip wheel .` makes a wheel, from the parts that the build tree BUILD has compiled already or, without
# one, from the sources alone, and the tests pass with it in an environment of its own.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${WORK} COMMAND_ECHO STDOUT
                  COMMAND_ERROR_IS_FATAL ANY)
endfunction()

execute_process(COMMAND ${PYTHON} -c "import setuptools, wheel, venv, pip" RESULT_VARIABLE status
                ERROR_QUIET)
if(NOT status EQUAL 0)
  message(STATUS "skipped: pip, setuptools, venv or wheel is missing (scripts/install-packages package)")
  return()
endif()
if(BUILD)
  set(ENV{MERGE2D_BUILD} ${BUILD})
endif()
run(${PYTHON} -m pip wheel ${SOURCE} --no-deps --no-build-isolation --no-index -w ${WORK})
file(GLOB wheel ${WORK}/merge2d-*.whl)
run(${PYTHON} -m venv --system-site-packages ${WORK}/venv)
run(${WORK}/venv/bin/python -m pip install --no-index --no-deps ${wheel})
run(${WORK}/venv/bin/python -m pytest -q -p no:cacheprovider ${SOURCE}/tests/python)
