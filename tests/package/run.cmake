# cmake -DBUILD=... -DSOURCE=... -DWORK=... -DCOMPILER=... -P run.cmake
# Installs the build into a fresh prefix, then configures, builds and runs the outside project against it.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/prefix")
run(${CMAKE_COMMAND} -G Ninja -S "${SOURCE}" -B "${WORK}/build" -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix")
run(${CMAKE_COMMAND} --build "${WORK}/build")
run("${WORK}/build/outside")
run("${WORK}/prefix/bin/jalousie-bake" --help)
foreach(file applications/jalousie.desktop icons/hicolor/scalable/apps/jalousie.svg icons/hicolor/48x48/apps/jalousie.png
    man/man1/jalousie.1 man/man1/jalousie-view.1 man/man1/jalousie-bake.1 man/man1/jalousie-scatter.1)
  if(NOT EXISTS "${WORK}/prefix/share/${file}")
    message(FATAL_ERROR "not installed: share/${file}")
  endif()
endforeach()
