# What the program tells of itself, for shells and for `man`: completion, and with help2man a manual
# page of the program and of each command.
set(manual_dir ${PROJECT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual_dir})
set(manual_files "")

# `folder` is below the data folder.
function(merge2d_completion shell file folder)
  set(output ${manual_dir}/${shell}/${file})
  file(MAKE_DIRECTORY ${manual_dir}/${shell})
  add_custom_command(OUTPUT ${output} COMMAND merge2d completion ${shell} > ${output}
                     DEPENDS merge2d VERBATIM)
  install(FILES ${output} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder} COMPONENT program
          OPTIONAL)
  set(manual_files ${manual_files} ${output} PARENT_SCOPE)
endfunction()
merge2d_completion(bash merge2d bash-completion/completions)
merge2d_completion(zsh _merge2d zsh/vendor-completions)
merge2d_completion(fish merge2d.fish fish/vendor_completions.d)

find_program(HELP2MAN help2man)
find_program(GZIP gzip)
# `name` is that of the page, `summary` its first line; the rest are arguments of the program.
function(merge2d_man_page name summary)
  string(TOUPPER ${name} heading)
  set(output ${manual_dir}/${name}.1)
  add_custom_command(OUTPUT ${output}.gz
    COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C.UTF-8 SOURCE_DATE_EPOCH=${MERGE2D_MANUAL_DATE}
            ${HELP2MAN} --no-info "--version-string=merge2d ${PROJECT_VERSION}" "--name=${summary}"
            --output=${output} "$<TARGET_FILE:merge2d> ${ARGN}"
    COMMAND sed -i -e "/^.SH NAME/{n" -e "s/^merge2d/${name}/" -e "}"
            -e "s/^[.]TH MERGE2D /.TH ${heading} /" ${output}
    COMMAND sed -i -f ${PROJECT_SOURCE_DIR}/cmake/manual.sed ${output}
    COMMAND ${GZIP} -9nf ${output}
    DEPENDS merge2d ${PROJECT_SOURCE_DIR}/cmake/manual.sed VERBATIM)
  install(FILES ${output}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
  set(manual_files ${manual_files} ${output}.gz PARENT_SCOPE)
endfunction()
if(HELP2MAN AND GZIP)
  # The same bytes whenever it is built: the date is that of the changelog's version.
  set(MERGE2D_MANUAL_DATE 1795564800 CACHE STRING "Date of the manual pages, in seconds since 1970")
  mark_as_advanced(MERGE2D_MANUAL_DATE)
  merge2d_man_page(merge2d "simulate adaptive merging of rigid bodies")
  foreach(page "list|name the built-in scenes and lessons" "validate|check a scene or a lesson"
          "run|simulate a scene and print a summary" "render|draw a scene as pictures"
          "compare|simulate a scene in all four modes" "study|run a scene many times"
          "lesson|write a scene or a lesson as a page" "cycles|judge a contact graph"
          "step|walk through a scene" "explain|tell why bodies merged or not"
          "doctor|tell what works here" "completion|print what completes commands")
    string(REPLACE "|" ";" page "${page}")
    list(GET page 0 command)
    list(GET page 1 summary)
    merge2d_man_page(merge2d-${command} "${summary}" ${command})
  endforeach()
endif()
add_custom_target(merge2d_manual ALL DEPENDS ${manual_files})
