// libFuzzer target; see exercise.h.
#include "fuzz/exercise.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  jalousie::test::exerciseStl(std::as_bytes(std::span(data, size)));
  return 0;
}
