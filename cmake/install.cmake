# Installing, and being found by other projects: find_package(merge2d) works from the build tree
# and from the installed one, pkg-config from the installed one. Of headers only the public one is
# installed. Components are the packages that cmake/packages.cmake makes of them.
include(CMakePackageConfigHelpers)

set(MERGE2D_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/merge2d)
set(MERGE2D_PC_REQUIRES "box2d fmt freetype2 libdeflate libpng")
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)

if(MERGE2D_APP)
  install(TARGETS merge2d RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes/
          DESTINATION ${CMAKE_INSTALL_DATADIR}/merge2d/scenes COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/lessons/
          DESTINATION ${CMAKE_INSTALL_DATADIR}/merge2d/lessons COMPONENT program
          FILES_MATCHING PATTERN "*.toml" PATTERN "*.md" PATTERN web EXCLUDE)
  include(cmake/manual.cmake)
  # The pages that messages and the manual name.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
          FILES_MATCHING PATTERN "*.md" PATTERN "*.json" PATTERN "*.txt" PATTERN "*.png" PATTERN "*.svg")
endif()
if(TARGET merge2d_shared)
  # merge2d::merge2d is the shared library.
  target_include_directories(merge2d_shared INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(merge2d_shared PROPERTIES EXPORT_NAME merge2d)
  install(TARGETS merge2d_shared EXPORT merge2d
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
                  NAMELINK_COMPONENT development)
  install(FILES ${PROJECT_BINARY_DIR}/api/libmerge2d.a DESTINATION ${CMAKE_INSTALL_LIBDIR}
          COMPONENT development)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          COMPONENT development)

  file(GLOB examples CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/*.c*)
  install(FILES ${examples} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libmerge2d-dev/examples
          COMPONENT development)

  configure_package_config_file(cmake/merge2dConfig.cmake.in ${PROJECT_BINARY_DIR}/merge2dConfig.cmake
                                INSTALL_DESTINATION ${MERGE2D_CMAKE_DIR})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/merge2dConfigVersion.cmake
                                   COMPATIBILITY SameMinorVersion)
  export(EXPORT merge2d NAMESPACE merge2d:: FILE ${PROJECT_BINARY_DIR}/merge2dTargets.cmake)
  install(EXPORT merge2d NAMESPACE merge2d:: FILE merge2dTargets.cmake
          DESTINATION ${MERGE2D_CMAKE_DIR} COMPONENT development)
  install(FILES ${PROJECT_BINARY_DIR}/merge2dConfig.cmake
                ${PROJECT_BINARY_DIR}/merge2dConfigVersion.cmake
          DESTINATION ${MERGE2D_CMAKE_DIR} COMPONENT development)

  # Relative paths, so that the installed tree may be moved.
  file(RELATIVE_PATH MERGE2D_LIB_TO_INCLUDE /${CMAKE_INSTALL_LIBDIR} /${CMAKE_INSTALL_INCLUDEDIR})
  configure_file(cmake/merge2d.pc.in ${PROJECT_BINARY_DIR}/merge2d.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/merge2d.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT development)
endif()

if(PROJECT_IS_TOP_LEVEL AND TARGET merge2d_shared)
  include(cmake/packages.cmake)
endif()
