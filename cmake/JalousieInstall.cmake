# Programs, libraries, headers, and a CMake package that other projects find: find_package(jalousie).

include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY JALOUSIE_LIBRARIES)
get_property(programs GLOBAL PROPERTY JALOUSIE_PROGRAMS)
set_target_properties(jalousie_options PROPERTIES EXPORT_NAME options)
install(TARGETS jalousie_options ${libraries} EXPORT jalousieTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(programs)
  install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/jalousie
  FILES_MATCHING PATTERN "*.h" PATTERN "app" EXCLUDE)
install(DIRECTORY shaders/shared DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/jalousie/shaders FILES_MATCHING PATTERN "*.h")
install(FILES README.md LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(packageFolder ${CMAKE_INSTALL_LIBDIR}/cmake/jalousie)
install(EXPORT jalousieTargets NAMESPACE jalousie:: DESTINATION ${packageFolder})
configure_package_config_file(cmake/jalousieConfig.cmake.in "${PROJECT_BINARY_DIR}/jalousieConfig.cmake"
  INSTALL_DESTINATION ${packageFolder})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/jalousieConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/jalousieConfig.cmake" "${PROJECT_BINARY_DIR}/jalousieConfigVersion.cmake"
  DESTINATION ${packageFolder})
