# Programs, the runtime libraries with their headers, and a CMake package that other projects find:
# find_package(jalousie).

include(CMakePackageConfigHelpers)

# Libraries in these folders serve this project's own programs. They are neither installed nor exported.
set(programFolders "${PROJECT_SOURCE_DIR}/preprocess" "${PROJECT_SOURCE_DIR}/src/app" "${PROJECT_SOURCE_DIR}/src/cli"
  "${PROJECT_SOURCE_DIR}/src/compare")

# jalousie_is_below(RESULT FOLDER PARENT...): true if FOLDER is one of the parents or lies inside one
function(jalousie_is_below result folder)
  set(${result} FALSE PARENT_SCOPE)
  foreach(parent IN LISTS ARGN)
    cmake_path(IS_PREFIX parent "${folder}" NORMALIZE inside)
    if(inside)
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

get_property(libraries GLOBAL PROPERTY JALOUSIE_LIBRARIES)
set(installed jalousie_options)
set(headerFolders "")
foreach(library IN LISTS libraries)
  get_target_property(folder ${library} SOURCE_DIR)
  jalousie_is_below(isProgramPart "${folder}" ${programFolders})
  if(NOT isProgramPart)
    list(APPEND installed ${library})
    list(APPEND headerFolders "${folder}")
  endif()
endforeach()
set_target_properties(jalousie_options PROPERTIES EXPORT_NAME options)
install(TARGETS ${installed} EXPORT jalousieTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

# A library's folder brings every header below it, under its path from src/.
list(REMOVE_DUPLICATES headerFolders)
foreach(folder IN LISTS headerFolders)
  jalousie_is_below(inSrc "${folder}" "${PROJECT_SOURCE_DIR}/src")
  if(inSrc)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/src" OUTPUT_VARIABLE name)
    install(DIRECTORY "${folder}/" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/jalousie/${name}
      FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()
install(DIRECTORY shaders/shared DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/jalousie/shaders FILES_MATCHING PATTERN "*.h")

get_property(programs GLOBAL PROPERTY JALOUSIE_PROGRAMS)
if(programs)
  install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(FILES README.md LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(packageFolder ${CMAKE_INSTALL_LIBDIR}/cmake/jalousie)
set(jalousieIncludeFolder ${CMAKE_INSTALL_INCLUDEDIR}/jalousie)
install(EXPORT jalousieTargets NAMESPACE jalousie:: DESTINATION ${packageFolder})
configure_package_config_file(cmake/jalousieConfig.cmake.in "${PROJECT_BINARY_DIR}/jalousieConfig.cmake"
  INSTALL_DESTINATION ${packageFolder} PATH_VARS jalousieIncludeFolder)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/jalousieConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/jalousieConfig.cmake" "${PROJECT_BINARY_DIR}/jalousieConfigVersion.cmake"
  DESTINATION ${packageFolder})
