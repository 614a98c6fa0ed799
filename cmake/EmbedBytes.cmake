# cmake -DOUTPUT=FILE -DINPUT=FILE -DHEADER=app/x.h -DNAMESPACE=a::b -DFUNCTION=name -P EmbedBytes.cmake
# Writes a C++ file that defines std::span<const std::byte> NAMESPACE::FUNCTION(): the bytes of a file.

file(READ "${INPUT}" hex HEX)
string(REGEX REPLACE "(................................)" "\\1\n" hex "${hex}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1, " bytes "${hex}")
get_filename_component(name "${INPUT}" NAME)
file(WRITE "${OUTPUT}" "// Generated from ${name}.
#include \"${HEADER}\"

namespace ${NAMESPACE} {

std::span<const std::byte> ${FUNCTION}() {
  static constexpr unsigned char kBytes[] = {
${bytes}};
  return std::as_bytes(std::span(kBytes));
}

}  // namespace ${NAMESPACE}
")
