# Writes the source that knows the state of the repository: run at every build, it touches the file
# only where that state has changed.
#   cmake -DOUTPUT=FILE -DSOURCE_DIR=DIR -P version.cmake
# Without a repository of its own (a source package), or without git, the state is empty.
cmake_minimum_required(VERSION 3.25)
set(describe "")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} describe --always --dirty --tags --abbrev=12
                  OUTPUT_VARIABLE describe ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"// Written by cmake/version.cmake.
#include \"app/version.h\"

namespace merge2d {

const char* const kGitDescribe = \"@describe@\";

}  // namespace merge2d
")
