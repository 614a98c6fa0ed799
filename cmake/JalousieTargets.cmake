# Compile options and the functions every folder uses to declare its library, program and tests.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(JALOUSIE_CCACHE ccache)
if(JALOUSIE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${JALOUSIE_CCACHE}")
endif()

add_library(jalousie_options INTERFACE)
add_library(jalousie::options ALIAS jalousie_options)
target_compile_features(jalousie_options INTERFACE cxx_std_20)
# A fused multiply-add rounds once where two operations round twice: results would depend on the machine.
target_compile_options(jalousie_options INTERFACE -ffp-contract=off)
if(JALOUSIE_SANITIZE)
  target_compile_options(jalousie_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
    -Wno-maybe-uninitialized)  # GCC finds false ones in code that is instrumented
  target_link_options(jalousie_options INTERFACE -fsanitize=address,undefined)
endif()
if(JALOUSIE_BUILD_FUZZERS)
  # vptr needs type information of libraries that are not ours.
  set(fuzzSanitizers address,undefined,float-cast-overflow)
  target_compile_options(jalousie_options INTERFACE
    -fsanitize=fuzzer-no-link,${fuzzSanitizers} -fno-sanitize=vptr -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(jalousie_options INTERFACE -fsanitize=${fuzzSanitizers} -fno-sanitize=vptr)
endif()
if(JALOUSIE_COVERAGE)
  target_compile_options(jalousie_options INTERFACE --coverage)
  target_link_options(jalousie_options INTERFACE --coverage)
endif()

add_library(jalousie_warnings INTERFACE)
target_compile_options(jalousie_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast
  $<$<CXX_COMPILER_ID:Clang>:-Wno-overloaded-shift-op-parentheses>  # how JAL_CHECK takes an expression apart
  $<$<BOOL:${JALOUSIE_WERROR}>:-Werror>)

# jalousie_add_library(NAME SOURCES ... [PUBLIC libs...] [PRIVATE libs...])
# Static library jalousie_NAME with alias jalousie::NAME; headers are included as "NAME/header.h".
function(jalousie_add_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(jalousie_${name} STATIC ${arg_SOURCES})
  add_library(jalousie::${name} ALIAS jalousie_${name})
  set_target_properties(jalousie_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(jalousie_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/jalousie>)
  target_link_libraries(jalousie_${name}
    PUBLIC jalousie_options ${arg_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:jalousie_warnings> ${arg_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY JALOUSIE_LIBRARIES jalousie_${name})
endfunction()

# jalousie_add_test(NAME LABELS label... SOURCES ... [LIBS ...] [TIMEOUT s])
# A GoogleTest program. Labels `cpu` and `files`: one ctest entry per case. Labels `gl`, `golden`, `slow`: one entry for
# the whole program, so that the context and its compiled shaders are made once. The presets leave `slow` out.
# The target cpu_tests builds the programs of label `cpu` and what they need; without JALOUSIE_BUILD_CPU_TESTS they are
# neither built by default nor run.
function(jalousie_add_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LIBS;LABELS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 600)
  endif()
  add_executable(${name} ${arg_SOURCES})
  # Test programs are compiled once and run once: less optimisation takes a third less time in all.
  target_compile_options(${name} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
  target_link_libraries(${name} PRIVATE ${arg_LIBS} jalousie_options jalousie_warnings GTest::gtest GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE
    JALOUSIE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" JALOUSIE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  set(environment "UBSAN_OPTIONS=print_stacktrace=1")
  if(arg_LABELS MATCHES "gl|golden|slow")
    # llvmpipe on one thread is the reproducible reference; a GPU driver ignores the variable.
    # LeakSanitizer reports the driver's own allocations, so leaks are checked in the cpu tests.
    set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)  # the files of these programs share names
    list(APPEND environment "LP_NUM_THREADS=1" "ASAN_OPTIONS=detect_leaks=0")
    add_test(NAME ${name} COMMAND ${name})
    # ctest begins with the programs of the largest cost, so that none of the long ones is left over at the end.
    set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT} COST ${arg_TIMEOUT}
      ENVIRONMENT "${environment}")
  else()
    if(NOT TARGET cpu_tests)
      add_custom_target(cpu_tests)
    endif()
    if(arg_LABELS STREQUAL "cpu")
      add_dependencies(cpu_tests ${name})
      if(NOT JALOUSIE_BUILD_CPU_TESTS)
        set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
        return()
      endif()
    endif()
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST TEST_PREFIX "${name}."
      PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT} ENVIRONMENT "${environment}")
  endif()
endfunction()
