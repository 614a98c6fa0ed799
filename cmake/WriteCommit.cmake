# cmake -DSOURCE=DIR -DOUTPUT=FILE -P WriteCommit.cmake
# Writes a header that defines JALOUSIE_BENCH_COMMIT as the commit of the working tree. The file changes only if the
# commit does, so that nothing is compiled again without need.

cmake_minimum_required(VERSION 3.25)
set(commit "")
find_program(git git)
if(git AND EXISTS "${SOURCE}/.git")
  execute_process(COMMAND "${git}" -C "${SOURCE}" describe --always --dirty
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(commit STREQUAL "")
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#define JALOUSIE_BENCH_COMMIT \"@commit@\"\n" @ONLY)
