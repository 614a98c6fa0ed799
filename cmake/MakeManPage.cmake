# cmake -DHELP2MAN=... -DHELP=... -DPROGRAM=... -DCOMMAND=... -DPAGE=... -DSUMMARY=... "-DINCLUDES=a;b" -DSECONDS=...
#       -DVERSION=... -DOUTPUT=... -P MakeManPage.cmake
# Runs help2man on the help of a program or of one of its commands.

set(ENV{LC_ALL} C)
set(ENV{SOURCE_DATE_EPOCH} "${SECONDS}")
set(ENV{ASAN_OPTIONS} "detect_leaks=0")
list(TRANSFORM INCLUDES PREPEND "--include=")
get_filename_component(folder "${OUTPUT}" DIRECTORY)
file(MAKE_DIRECTORY "${folder}")
execute_process(
  COMMAND "${HELP2MAN}" --no-info --section=1 "--name=${SUMMARY}" "--version-string=${VERSION}"
          "--manual=jalousie" "--source=jalousie ${VERSION}" ${INCLUDES} "'${HELP}' '${PROGRAM}' ${COMMAND}"
  OUTPUT_VARIABLE page ERROR_VARIABLE complaint RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "help2man failed for ${PAGE}: ${complaint}")
endif()
# help2man names a page by the first word of the usage line.
string(TOUPPER "${PAGE}" title)
string(REGEX REPLACE "\n\\.TH [^ ]+ " "\n.TH ${title} " page "${page}")
string(REPLACE "-" "\\\\-" name "${PAGE}")  # escaped once for the expression, once for roff
string(REGEX REPLACE "\n\\.SH NAME\n[^\n]* \\\\- ${SUMMARY}\n" "\n.SH NAME\n${name} \\\\- ${SUMMARY}\n" page "${page}")
file(WRITE "${OUTPUT}" "${page}")
