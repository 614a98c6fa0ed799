# Manual pages, made from --help by help2man when a program changes, so that the two never disagree.

# Month and year in the pages: the same bytes whenever they are built. Moved on with a release.
set(JALOUSIE_RELEASE_SECONDS 1795564800)  # 2026-11-25

set(JALOUSIE_MAN_FOLDER "${PROJECT_BINARY_DIR}/man")

# jalousie_man_page(TARGET "what it is" [COMMAND]): PROGRAM.1, or PROGRAM-COMMAND.1 for one of its commands
function(jalousie_man_page program summary)
  set(command "${ARGN}")
  string(JOIN "-" page ${program} ${command})
  set(file "${JALOUSIE_MAN_FOLDER}/${page}.1")
  # What the help does not say: of the program, then of the command.
  set(includes "${PROJECT_SOURCE_DIR}/docs/man/${program}.h2m")
  set(own "${PROJECT_SOURCE_DIR}/docs/man/${page}.h2m")
  if(command AND EXISTS "${own}")
    list(APPEND includes "${own}")
  endif()
  add_custom_command(
    OUTPUT "${file}"
    COMMAND ${CMAKE_COMMAND} "-DHELP2MAN=${JALOUSIE_HELP2MAN}" "-DHELP=${PROJECT_SOURCE_DIR}/cmake/help-for-man"
            "-DPROGRAM=$<TARGET_FILE:${program}>" "-DCOMMAND=${command}" "-DPAGE=${page}" "-DSUMMARY=${summary}"
            "-DINCLUDES=${includes}" "-DSECONDS=${JALOUSIE_RELEASE_SECONDS}"
            "-DVERSION=${PROJECT_VERSION}" "-DOUTPUT=${file}" -P "${PROJECT_SOURCE_DIR}/cmake/MakeManPage.cmake"
    DEPENDS ${program} "${PROJECT_SOURCE_DIR}/cmake/help-for-man" "${PROJECT_SOURCE_DIR}/cmake/MakeManPage.cmake"
            ${includes}
    COMMENT "Manual page ${page}.1"
    VERBATIM)
  set_property(GLOBAL APPEND PROPERTY JALOUSIE_MAN_PAGES "${file}")
endfunction()

if(JALOUSIE_BUILD_RUNTIME)
  jalousie_man_page(jalousie "level of detail that follows how visible each object is")
  jalousie_man_page(jalousie "render one frame of a scene, headless" render)
  jalousie_man_page(jalousie "show scenes in a window and explain what is occluded, and why" view)
  jalousie_man_page(jalousie "measure configurations along a camera path and write a report" compare)
  jalousie_man_page(jalousie "how far one picture is from another" diff)
  jalousie_man_page(jalousie "write a camera path as a glTF camera animation" record)
endif()
if(JALOUSIE_BUILD_TOOLS)
  jalousie_man_page(jalousie-bake "bake meshes into glTF with discrete LOD chains")
  jalousie_man_page(jalousie-bake "show the LOD chains of a glTF file" inspect)
  jalousie_man_page(jalousie-bake "choose a level for each cell of a chain" cut)
  jalousie_man_page(jalousie-scatter "scatter copies of a baked object in a cube")
  jalousie_man_page(jalousie-wad "convert a level of a WAD file to glTF with rooms and portals")
endif()

get_property(pages GLOBAL PROPERTY JALOUSIE_MAN_PAGES)
add_custom_target(jalousie_man_pages ALL DEPENDS ${pages})
# Absent pages do not stop an installation: a build of single targets has none.
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
