// Passes over values of each encoding.
#include "bake/io/ply_values.h"

namespace jalousie::bake::ply {

void skipProperty(Input& input, const Property& property, Encoding encoding) {
  std::uint64_t count = 1;
  if (property.countType) {
    const double given = input.value(*property.countType, encoding);
    if (!(given >= 0.0) || given > static_cast<double>(input.left())) input.fail("bad PLY list length");
    count = static_cast<std::uint64_t>(given);
  }
  if (encoding == Encoding::kAscii) {
    for (std::uint64_t i = 0; i < count; ++i)
      input.word();
  } else {
    input.take(count * sizeOf(property.type));
  }
}

}  // namespace jalousie::bake::ply
