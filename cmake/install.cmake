# SPDX-License-Identifier: Apache-2.0
# Installs the files that find_package(lexican), pkg-config and a compiler without CMake need.
include(CMakePackageConfigHelpers)

# Writes the configuration of this build to the installed co_cfg.h, so that an application that is compiled without
# CMake has the configuration of the library.
file(READ ${PROJECT_SOURCE_DIR}/config/co_cfg.h co_cfg)
file(WRITE ${PROJECT_BINARY_DIR}/installed/co_cfg.h
  "#ifndef CO_CFG_PRESET\n#define CO_CFG_PRESET \"presets/${LEXICAN_PRESET}.h\"\n#endif\n${co_cfg}")

configure_file(${CMAKE_CURRENT_LIST_DIR}/lexican.pc.in ${PROJECT_BINARY_DIR}/installed/lexican.pc @ONLY)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/lexican-config.cmake.in
  ${PROJECT_BINARY_DIR}/installed/lexican-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lexican PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/installed/lexican-config-version.cmake
  COMPATIBILITY SameMinorVersion)

# The headers would be copied onto themselves.
if(CMAKE_INSTALL_PREFIX STREQUAL PROJECT_SOURCE_DIR)
  message(FATAL_ERROR "the installation prefix ${CMAKE_INSTALL_PREFIX} is the source directory; give another one with --install-prefix")
endif()
install(TARGETS lexican EXPORT lexican-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT lexican-targets NAMESPACE lexican:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lexican)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ ${PROJECT_SOURCE_DIR}/config/
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lexican
  FILES_MATCHING PATTERN *.h PATTERN *.hpp PATTERN co_cfg.h EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/installed/co_cfg.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lexican)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/lexican_generate.cmake ${PROJECT_BINARY_DIR}/installed/lexican-config.cmake
  ${PROJECT_BINARY_DIR}/installed/lexican-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lexican)
install(FILES ${PROJECT_BINARY_DIR}/installed/lexican.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
