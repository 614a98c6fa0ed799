# cmake -DOUTPUT=FILE -DROOT=DIR -DSCRIPTS=NAME;... [-DCHARTS=FILE] -P EmbedPage.cmake
# Writes a C++ file that defines the texts of compare/page.h: the page's files and the charts library.

set(text "// Generated from src/compare/page/ and the charts library.\n#include \"compare/page.h\"\n\nnamespace jalousie::compare {\n")
# Adds a function that returns the text of a file; empty if there is none. Bytes, because compilers limit literals.
macro(define name file)
  set(body "")
  if(NOT "${file}" STREQUAL "")
    file(READ "${file}" hex HEX)
    string(REGEX REPLACE "(................................)" "\\1\n" hex "${hex}")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," body "${hex}")
  endif()
  string(APPEND text "\nstd::string_view ${name}() {\n  static constexpr unsigned char kBytes[] = {\n${body}0};\n"
    "  return {reinterpret_cast<const char*>(kBytes), sizeof(kBytes) - 1};\n}\n")
endmacro()
define(pageHtml "${ROOT}/index.html")
define(pageStyle "${ROOT}/page.css")
# One function around all scripts: what they declare is theirs alone.
set(whole "'use strict';\n(() => {\n")
foreach(script IN LISTS SCRIPTS)
  file(READ "${ROOT}/${script}.js" part)
  string(APPEND whole "${part}\n")
endforeach()
file(WRITE "${OUTPUT}.js" "${whole}})();\n")
define(pageScript "${OUTPUT}.js")
define(chartsScript "${CHARTS}")
string(APPEND text "\n}  // namespace jalousie::compare\n")
file(WRITE "${OUTPUT}" "${text}")
