# The icon in pixels, rendered from assets/desktop/jalousie.svg: files for the desktop, and bytes for the window.
# Included where the program is built: rules for generated sources are local to a folder.

set(JALOUSIE_ICON_SIDES 16 32 48 64 128 256)
set(JALOUSIE_ICON_FOLDER "${PROJECT_BINARY_DIR}/icons")
set(JALOUSIE_EMBEDDED_ICON "${JALOUSIE_ICON_FOLDER}/embedded_icon.cpp")
file(MAKE_DIRECTORY "${JALOUSIE_ICON_FOLDER}")
set(icon "${PROJECT_SOURCE_DIR}/assets/desktop/jalousie.svg")
foreach(side ${JALOUSIE_ICON_SIDES})
  set(file "${JALOUSIE_ICON_FOLDER}/${side}.png")
  add_custom_command(OUTPUT "${file}"
    COMMAND "${JALOUSIE_RSVG_CONVERT}" -w ${side} -h ${side} -o "${file}" "${icon}"
    DEPENDS "${icon}"
    COMMENT "Icon, ${side} pixels"
    VERBATIM)
  list(APPEND iconFiles "${file}")
endforeach()
add_custom_command(OUTPUT "${JALOUSIE_EMBEDDED_ICON}"
  COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${JALOUSIE_EMBEDDED_ICON}" "-DINPUT=${JALOUSIE_ICON_FOLDER}/64.png"
          -DHEADER=app/view/icon.h -DNAMESPACE=jalousie::app -DFUNCTION=embeddedIcon
          -P "${PROJECT_SOURCE_DIR}/cmake/EmbedBytes.cmake"
  DEPENDS "${JALOUSIE_ICON_FOLDER}/64.png" "${PROJECT_SOURCE_DIR}/cmake/EmbedBytes.cmake"
  COMMENT "Embedding the icon"
  VERBATIM)
add_custom_target(jalousie_icons ALL DEPENDS ${iconFiles})

foreach(side ${JALOUSIE_ICON_SIDES})
  install(FILES "${JALOUSIE_ICON_FOLDER}/${side}.png" RENAME jalousie.png
    DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/${side}x${side}/apps)
endforeach()
install(FILES "${icon}" DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES "${PROJECT_SOURCE_DIR}/assets/desktop/jalousie.desktop" DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
