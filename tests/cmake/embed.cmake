# Titles of embedded TOML files: taken without parsing where they are plain, else refused.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

# Embeds a file of this text; sets `source` to what was written, and `errors`.
function(embed text)
  file(WRITE ${WORK}/scene.toml "${text}")
  file(REMOVE ${WORK}/out.cpp)
  execute_process(COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/out.cpp -DFUNCTION=files -DFOLDER=${WORK}
                          -DFILES=scene.toml -P ${SCRIPT}
                  RESULT_VARIABLE result ERROR_VARIABLE errors)
  set(source "")
  if(EXISTS ${WORK}/out.cpp)
    file(READ ${WORK}/out.cpp source)
  endif()
  set(source "${source}" PARENT_SCOPE)
  set(errors "${errors}" PARENT_SCOPE)
endfunction()

function(expect_title text title)
  embed("${text}")
  string(LENGTH "${title}" length)
  string(FIND "${source}" "std::string_view(R\"embedded(${title})embedded\", ${length})}," at)
  if(at EQUAL -1)
    message(SEND_ERROR "the title of\n${text}\nshould be '${title}'\n${errors}${source}")
  endif()
endfunction()

function(expect_refusal text words)
  embed("${text}")
  string(REGEX REPLACE "[ \n]+" " " errors "${errors}")
  string(FIND "${errors}" "${words}" at)
  if(at EQUAL -1 OR NOT source STREQUAL "")
    message(SEND_ERROR "\n${text}\nshould be refused: ${words}\n${errors}")
  endif()
endfunction()

expect_title("title = \"A tower\"\n" "A tower")
expect_title("# title = \"no\"\nformat = 1\n  title=\"é; #1 \${x} [y] 'z'\"  # \"its\" comment\n"
             "é; #1 \${x} [y] 'z'")
# No title, or one of something else.
expect_title("format = 1\n" "")
expect_title("subtitle = \"no\"\n[camera]\ntitle = \"no\"\n" "")
expect_title("[[body]]\nbox = [1, 1]\ntitle = \"\\n\"\n" "")

set(plain "a built-in title is one line in double quotes, without a backslash, not")
expect_refusal("title = \"a\\u0041\"\n" "${plain} \"a\\u0041\"")
expect_refusal("title = \"a \\\"word\\\"\"\n" "${plain}")
expect_refusal("title = 'a'\n" "${plain} 'a'")
expect_refusal("title = 1\n" "${plain} 1")
set(one_line "has no text of several lines above its first table")
expect_refusal("title = \"\"\"\na\"\"\"\n" "${one_line}")
expect_refusal("note = '''\ntitle = \"no\"\n'''\n" "${one_line}")
