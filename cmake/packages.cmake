# `cpack` in the build folder makes Debian packages: merge2d, libmerge2d0, libmerge2d-dev and
# python3-merge2d.
set(CPACK_GENERATOR DEB)
# As CPack calls it by default: any other would come before each package's own summary.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_NAME} built using CMake")
set(CPACK_PACKAGE_CONTACT "the merge2d authors <merge2d@example.org>")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL program library development)
if(TARGET merge2d_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# libmerge2d0 is made in the same run.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/api)

# OpenGL is loaded at run time, so that no tool finds it by itself.
set(gl "libosmesa6 | libegl-mesa0, libosmesa6 | libegl1")
set(packages program library development python)
set(names merge2d libmerge2d${PROJECT_VERSION_MAJOR} libmerge2d-dev python3-merge2d)
set(sections science libs libdevel python)
set(depends "fonts-dejavu-core, ${gl}" "fonts-dejavu-core" "libmerge2d${PROJECT_VERSION_MAJOR} (= ${PROJECT_VERSION})"
    "python3 (>= 3.9), python3-numpy, fonts-dejavu-core, ${gl}")
set(summaries "${PROJECT_DESCRIPTION}" "shared library for adaptive merging of rigid bodies in 2D"
    "development files for merge2d" "Python module for adaptive merging of rigid bodies in 2D")
set(details
"merge2d simulates rigid bodies in 2D. Bodies that touch and move as one are
simulated as one body until something tears them apart. It renders pictures,
writes traces and lesson pages, and needs no display and no network."
"This package contains the shared library, with a C interface."
"This package contains the header for C and C++, a static archive, and the
files by which CMake and pkg-config find them."
"This package contains the module merge2d, with NumPy views of a world's
bodies, pictures for notebooks, and explanations in words.")
foreach(package name section depend summary detail IN ZIP_LISTS packages names sections depends
        summaries details)
  string(TOUPPER ${package} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depend}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${detail}")
endforeach()

# Copyright and changelog, for the packages alone.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE license)
string(REGEX REPLACE "^.*(Permission is hereby)" "\\1" license "${license}")
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n" "\n " license "${license}")
string(STRIP "${license}" license)
configure_file(${PROJECT_SOURCE_DIR}/cmake/copyright.in ${PROJECT_BINARY_DIR}/packages/copyright @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_BINARY_DIR}/packages/NEWS COPYONLY)
string(TIMESTAMP date "%a, %d %b %Y 00:00:00 +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/packages/changelog
"merge2d (${PROJECT_VERSION}) unstable; urgency=medium

  * Version ${PROJECT_VERSION}; NEWS.gz beside this file tells what is new.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
execute_process(COMMAND gzip -9nf changelog NEWS WORKING_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
# CPack calls ldconfig beside the trigger, and cannot be told not to.
file(WRITE ${PROJECT_BINARY_DIR}/packages/libmerge2d${PROJECT_VERSION_MAJOR}
     "libmerge2d${PROJECT_VERSION_MAJOR}: maintscript-calls-ldconfig\n")
install(FILES ${PROJECT_BINARY_DIR}/packages/libmerge2d${PROJECT_VERSION_MAJOR}
        DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT library EXCLUDE_FROM_ALL)
file(WRITE ${PROJECT_BINARY_DIR}/packages/triggers "activate-noawait ldconfig\n")
foreach(package name IN ZIP_LISTS packages names)
  install(FILES ${PROJECT_BINARY_DIR}/packages/copyright ${PROJECT_BINARY_DIR}/packages/changelog.gz
                ${PROJECT_BINARY_DIR}/packages/NEWS.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${package} EXCLUDE_FROM_ALL)
endforeach()
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/packages/triggers)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS ffmpeg)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "libosmesa6 | libegl1")
# The program, and the documentation; the others are for those who link the archive.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
    "merge2d, libbox2d-dev, libcmark-dev, libdeflate-dev, libfmt-dev, libfreetype-dev, libpng-dev")
include(CPack)
