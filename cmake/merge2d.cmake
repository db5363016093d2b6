# Options that every target of ours is built with.
add_library(merge2d_options INTERFACE)
target_include_directories(merge2d_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_features(merge2d_options INTERFACE cxx_std_20)
# The same input gives the same bytes: no contraction, no fast-math.
target_compile_options(merge2d_options INTERFACE -ffp-contract=off)

# Our own warnings; dependencies are included as system headers.
add_library(merge2d_warnings INTERFACE)
target_compile_options(merge2d_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(MERGE2D_WERROR)
  target_compile_options(merge2d_warnings INTERFACE -Werror)
endif()
if(CMAKE_UNITY_BUILD)
  # A source that another one includes looks like a header, where such types would be a mistake.
  target_compile_options(merge2d_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

option(MERGE2D_SANITIZE "Build with the address and undefined behaviour sanitizers" OFF)
if(MERGE2D_SANITIZE)
  # What we ship is watched. The tests' own sources only drive it: they are compiled as for a
  # release, so that ccache has them already. Of the undefined behaviour, null, alignment and object
  # size are left to the address sanitizer; checking them twice doubles the time of the compiler.
  # Of code that runs for a moment only, the compiler's time counts.
  set(watched "$<NOT:$<BOOL:$<TARGET_PROPERTY:MERGE2D_TESTS_ONLY>>>")
  set(optimisation "$<IF:$<BOOL:$<TARGET_PROPERTY:MERGE2D_RUNS_BRIEFLY>>,-O0,-O1>")
  target_compile_options(merge2d_options INTERFACE
    "$<${watched}:${optimisation};-g1;-fsanitize=address,undefined;-fno-sanitize=null,alignment,object-size,vptr>"
    "$<${watched}:-fno-sanitize-recover=all;-fno-omit-frame-pointer>")
  target_link_options(merge2d_options INTERFACE -fsanitize=address,undefined)
endif()

# Everything of ours is watched, and tells libFuzzer where it has been.
if(MERGE2D_FUZZ)
  target_compile_options(merge2d_options INTERFACE
    -O1 -g1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
    -fno-sanitize=vptr -fno-omit-frame-pointer)
  target_link_options(merge2d_options INTERFACE -fsanitize=address,undefined)
endif()

find_program(CCACHE ccache)
if(CCACHE AND PROJECT_IS_TOP_LEVEL)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
find_program(MOLD mold)
if(MOLD AND PROJECT_IS_TOP_LEVEL)
  add_link_options(-fuse-ld=mold)
endif()

# An object library from all sources of one folder.
function(merge2d_objects name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  add_library(merge2d_${name} OBJECT ${sources})
  target_link_libraries(merge2d_${name} PRIVATE merge2d_options merge2d_warnings ${ARGN})
  set_target_properties(merge2d_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()
