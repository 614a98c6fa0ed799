# cmake -DPROGRAM=FUZZER -DKIND=NAME -DNODE=NODE -DPICTURES=picture_seeds -DSECONDS=N -DSOURCE=DIR -DWORK=DIR -P run.cmake
# Runs a fuzz target from its seeds for some seconds. What it finds stays in WORK/found.
if(KIND STREQUAL "image")
  execute_process(COMMAND ${PICTURES} ${WORK}/seeds-image/image COMMAND_ERROR_IS_FATAL ANY)
elseif(NODE)
  execute_process(COMMAND ${NODE} ${SOURCE}/../hostile/make_corpus.mjs ${WORK}/corpus-${KIND} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${NODE} ${SOURCE}/make_seeds.mjs ${WORK}/corpus-${KIND} ${WORK}/seeds-${KIND} COMMAND_ERROR_IS_FATAL ANY)
endif()
set(seeds ${WORK}/seeds-${KIND}/${KIND})
set(grown ${WORK}/grown/${KIND})
file(MAKE_DIRECTORY ${seeds} ${grown} ${WORK}/found)
execute_process(
  COMMAND ${PROGRAM} -max_total_time=${SECONDS} -timeout=10 -rss_limit_mb=2048 -max_len=4096 -print_final_stats=1
          -dict=${SOURCE}/${KIND}.dict -artifact_prefix=${WORK}/found/${KIND}- ${grown} ${seeds}
  RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${KIND}: found something; the input is in ${WORK}/found")
endif()
