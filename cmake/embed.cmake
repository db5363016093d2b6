# Text files that become part of a library.
#
# As a function: merge2d_embed(TARGET FUNCTION FOLDER FILES…) adds a source that defines
# `std::span<const EmbeddedFile> merge2d::FUNCTION()` over FILES, named from FOLDER.
# As a script (-P), it writes that source. Titles of TOML files are taken from them here, so that
# the program need not parse the files to list them.

# Sets `result` to the title that stands above the first table of the TOML text `toml`; to nothing
# where there is none, or where its key is quoted: the program parses such a text.
function(merge2d_title_of file toml result)
  set(${result} "" PARENT_SCOPE)
  string(REGEX REPLACE "\n[ \t]*\\[.*" "\n" head "\n${toml}\n")
  if(NOT head MATCHES "\n[ \t]*title[ \t]*=[ \t]*([^\n]*)")
    return()
  endif()
  set(value "${CMAKE_MATCH_1}")
  if(head MATCHES "\"\"\"|'''")  # a line in such a text only looks like a title
    message(FATAL_ERROR "${file}: a built-in file with a title has no text of several lines above "
                        "its first table")
  endif()
  if(NOT value MATCHES "^\"([^\"\\\\]*)\"[ \t\r]*(#.*)?$")  # escapes are not decoded here
    message(FATAL_ERROR "${file}: a built-in title is one line in double quotes, without a "
                        "backslash, not ${value}")
  endif()
  set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  string(REPLACE "|" ";" FILES "${FILES}")
  set(entries "")
  foreach(file IN LISTS FILES)
    file(READ ${FOLDER}/${file} text)
    if(text MATCHES "\\)embedded\"")
      message(FATAL_ERROR "${FOLDER}/${file}: the text may not contain )embedded\"")
    endif()
    set(title "")
    if(file MATCHES "\\.toml$")
      merge2d_title_of(${FOLDER}/${file} "${text}" title)
      string(LENGTH "${title}" title_length)
      set(title ", std::string_view(R\"embedded(${title})embedded\", ${title_length})")
    endif()
    # With its length: to count that of a large file is too much for a compiler.
    string(LENGTH "${text}" length)
    string(APPEND entries
           "    {\"${file}\", std::string_view(R\"embedded(${text})embedded\", ${length})${title}},\n")
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
