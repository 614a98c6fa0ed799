# cmake -DBUILD=... -DROOT=... -DWORK=... -DCOMPILER=... -DLAUNCHER=... -DNINJA=... -P run.cmake
# Installs the build into a fresh prefix; configures, builds and runs the outside project against it; checks that the
# targets which scripts/demo builds suffice for `cmake --install`.

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif()
endfunction()

# Sets RESULT to the files of the build tree that `cmake --install` must find: those of install rules without OPTIONAL.
function(required_build_files result)
  file(GLOB_RECURSE scripts "${BUILD}/cmake_install.cmake")
  set(found "")
  foreach(script IN LISTS scripts)
    file(READ "${script}" text)
    string(REGEX MATCHALL "file\\(INSTALL [^)]*\\)" rules "${text}")
    foreach(rule IN LISTS rules)
      if(NOT rule MATCHES " OPTIONAL ")
        string(REGEX MATCHALL "\"${BUILD}/[^\"]+\"" files "${rule}")
        list(APPEND found ${files})
      endif()
    endforeach()
  endforeach()
  list(TRANSFORM found REPLACE "^\"(.*)\"$" "\\1")
  list(FILTER found EXCLUDE REGEX "/CMakeFiles/Export/|/jalousieConfig[A-Za-z]*\\.cmake$")  # made by configuring
  list(REMOVE_DUPLICATES found)
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# Sets RESULT to those of FILES that building TARGETS does not make.
function(files_not_made result files targets)
  # The commands name what they make. `-t inputs` would leave out what targets only wait for, such as the icons.
  execute_process(COMMAND "${NINJA}" -C "${BUILD}" -t commands ${targets}
    OUTPUT_VARIABLE commands RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "ninja does not know the targets: ${targets}")
  endif()
  set(missing "")
  foreach(file IN LISTS files)
    cmake_path(RELATIVE_PATH file BASE_DIRECTORY "${BUILD}" OUTPUT_VARIABLE name)
    string(FIND "${commands}" "${name}" position)
    if(position EQUAL -1)
      list(APPEND missing "${name}")
    endif()
  endforeach()
  set(${result} "${missing}" PARENT_SCOPE)
endfunction()

# README: `cmake --install build/release` works after scripts/demo, which builds some targets only.
required_build_files(required)
file(STRINGS "${ROOT}/scripts/demo" buildLine REGEX "cmake --build --preset release --target")
string(REGEX REPLACE ".*--target +" "" targets "${buildLine}")
separate_arguments(targets UNIX_COMMAND "${targets}")
files_not_made(missing "${required}" "${targets}")
if(missing OR NOT required)
  message(FATAL_ERROR "cmake --install needs files that scripts/demo does not build: ${missing}")
endif()
# The check can fail: one program alone does not suffice.
files_not_made(missing "${required}" "jalousie-scatter")
if(NOT missing)
  message(FATAL_ERROR "the check of what scripts/demo builds finds nothing missing for a single program")
endif()

file(REMOVE_RECURSE "${WORK}")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/prefix")
run(${CMAKE_COMMAND} -G Ninja -S "${ROOT}/tests/package" -B "${WORK}/build" -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
    "-DCMAKE_PREFIX_PATH=${WORK}/prefix")
run(${CMAKE_COMMAND} --build "${WORK}/build" -j2)
run("${WORK}/build/outside")
run("${WORK}/prefix/bin/jalousie" --version)
run("${WORK}/prefix/bin/jalousie-bake" --help)
run("${WORK}/prefix/bin/jalousie-scatter" --help)
run("${WORK}/prefix/bin/jalousie-wad" --help)
foreach(file applications/jalousie.desktop icons/hicolor/scalable/apps/jalousie.svg icons/hicolor/48x48/apps/jalousie.png
    man/man1/jalousie.1 man/man1/jalousie-view.1 man/man1/jalousie-bake.1 man/man1/jalousie-scatter.1)
  if(NOT EXISTS "${WORK}/prefix/share/${file}")
    message(FATAL_ERROR "not installed: share/${file}")
  endif()
endforeach()
# Parts of our own programs stay at home.
foreach(folder app compare bake scatter)
  if(EXISTS "${WORK}/prefix/include/jalousie/${folder}")
    message(FATAL_ERROR "installed by mistake: include/jalousie/${folder}")
  endif()
endforeach()
