# Text files that become part of a library.
#
# As a function: merge2d_embed(TARGET FUNCTION FOLDER FILES…) adds a source that defines
# `std::span<const EmbeddedFile> merge2d::FUNCTION()` over FILES, named from FOLDER.
# As a script (-P), it writes that source.

if(CMAKE_SCRIPT_MODE_FILE)
  string(REPLACE "|" ";" FILES "${FILES}")
  set(entries "")
  foreach(file IN LISTS FILES)
    file(READ ${FOLDER}/${file} text)
    if(text MATCHES "\\)embedded\"")
      message(FATAL_ERROR "${FOLDER}/${file}: the text may not contain )embedded\"")
    endif()
    # With its length: to count that of a large file is too much for a compiler.
    string(LENGTH "${text}" length)
    string(APPEND entries
           "    {\"${file}\", std::string_view(R\"embedded(${text})embedded\", ${length})},\n")
  endforeach()
  file(WRITE ${OUTPUT}
"// Written by cmake/embed.cmake.
#include <span>
#include <string_view>

#include \"src2d/scene/data_folder.h\"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored \"-Woverlength-strings\"

namespace merge2d {
namespace {
constexpr EmbeddedFile kFiles_${FUNCTION}[] = {
${entries}};
}  // namespace

std::span<const EmbeddedFile> ${FUNCTION}();  // declared where it is used
std::span<const EmbeddedFile> ${FUNCTION}() { return kFiles_${FUNCTION}; }

}  // namespace merge2d

#pragma GCC diagnostic pop
")
  return()
endif()

set(MERGE2D_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(merge2d_embed target function folder)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE paths)
  string(REPLACE ";" "|" files "${ARGN}")
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFUNCTION=${function} -DFOLDER=${folder}
            "-DFILES=${files}" -P ${MERGE2D_EMBED_SCRIPT}
    DEPENDS ${paths} ${MERGE2D_EMBED_SCRIPT}
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
