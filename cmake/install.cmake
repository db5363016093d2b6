# Installing, and being found by other projects: find_package(merge2d) works from the build tree
# and from the installed one, pkg-config and CPack (a Debian package) from the installed one.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(MERGE2D_INCLUDE_DIR ${CMAKE_INSTALL_INCLUDEDIR}/merge2d)
set(MERGE2D_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/merge2d)

# Exports a library of ours as merge2d::<name>. What it was made from is inside the archive, so its
# users see only what ARGN says: the packages in our headers, and those to link with.
function(merge2d_export name)
  set(target merge2d_${name})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} INTERFACE_LINK_LIBRARIES "${ARGN}")
  target_compile_features(${target} INTERFACE cxx_std_20)
  target_include_directories(${target} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${MERGE2D_INCLUDE_DIR}>)
  install(TARGETS ${target} EXPORT merge2d ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

function(merge2d_install_headers folder)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/ DESTINATION ${MERGE2D_INCLUDE_DIR}/${folder}
          FILES_MATCHING PATTERN "*.h")
endfunction()

merge2d_export(engine Eigen3::Eigen box2d::box2d fmt::fmt $<LINK_ONLY:PNG::PNG>)
merge2d_install_headers(src2d)
if(MERGE2D_APP)
  merge2d_export(render merge2d_engine $<LINK_ONLY:PNG::PNG> $<LINK_ONLY:Freetype::Freetype>
                 $<LINK_ONLY:Threads::Threads> $<LINK_ONLY:PkgConfig::DEFLATE>
                 $<LINK_ONLY:${CMAKE_DL_LIBS}>)
  merge2d_install_headers(render)
  install(TARGETS merge2d RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes/
          DESTINATION ${CMAKE_INSTALL_DATADIR}/merge2d/scenes)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/lessons/
          DESTINATION ${CMAKE_INSTALL_DATADIR}/merge2d/lessons
          FILES_MATCHING PATTERN "*.toml" PATTERN "*.md" PATTERN web EXCLUDE)
endif()

# The package: from the build tree, where it lies at the top, and installed.
configure_package_config_file(cmake/merge2dConfig.cmake.in ${PROJECT_BINARY_DIR}/merge2dConfig.cmake
                              INSTALL_DESTINATION ${MERGE2D_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/merge2dConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
export(EXPORT merge2d NAMESPACE merge2d:: FILE ${PROJECT_BINARY_DIR}/merge2dTargets.cmake)
install(EXPORT merge2d NAMESPACE merge2d:: FILE merge2dTargets.cmake
        DESTINATION ${MERGE2D_CMAKE_DIR})
install(FILES ${PROJECT_BINARY_DIR}/merge2dConfig.cmake
              ${PROJECT_BINARY_DIR}/merge2dConfigVersion.cmake
        DESTINATION ${MERGE2D_CMAKE_DIR})

# Relative paths, so that the installed tree may be moved.
file(RELATIVE_PATH MERGE2D_LIB_TO_INCLUDE /${CMAKE_INSTALL_LIBDIR} /${MERGE2D_INCLUDE_DIR})
configure_file(cmake/merge2d.pc.in ${PROJECT_BINARY_DIR}/merge2d.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/merge2d.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# `cpack` in the build folder makes a Debian package.
if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_CONTACT "the merge2d authors")
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  # OpenGL is loaded at run time, so that no tool finds it by itself.
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core, libosmesa6 | libegl-mesa0, libosmesa6 | libegl1")
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS
      "ffmpeg, libbox2d-dev, libeigen3-dev, libfmt-dev, libpng-dev, libfreetype-dev, libdeflate-dev")
  include(CPack)
endif()
