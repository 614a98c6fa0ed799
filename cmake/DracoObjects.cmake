# jalousie_draco_objects(RESULT): object files of Debian's libdraco.a, without those that hold a copy of tinygltf and stb.
# The copy is another version, whose structs have other members. A linker takes it wherever libtinygltf or libstb come
# later, or are left out because only libraries need them. The objects become a part of the library that uses Draco, so
# that no order matters, in programs that link the installed package neither.
function(jalousie_draco_objects result)
  get_target_property(archive draco::draco_static LOCATION)
  set(folder "${PROJECT_BINARY_DIR}/draco")
  execute_process(COMMAND "${CMAKE_AR}" t "${archive}" OUTPUT_VARIABLE members COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" members "${members}")
  list(FILTER members EXCLUDE REGEX "gltf|_io\\.cc")
  file(REMOVE_RECURSE "${folder}")
  file(MAKE_DIRECTORY "${folder}")
  execute_process(COMMAND "${CMAKE_AR}" xo "${archive}" ${members} WORKING_DIRECTORY "${folder}"
    COMMAND_ERROR_IS_FATAL ANY)
  list(TRANSFORM members PREPEND "${folder}/")
  set(${result} ${members} PARENT_SCOPE)
endfunction()
