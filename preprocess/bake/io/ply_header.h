// Parses the header of a PLY file.
#pragma once

#include "bake/io/ply_values.h"

namespace jalousie::bake::ply {

/// Reads up to the end of the header, and checks that the file can hold the elements that it declares. Errors:
/// kMalformed, kLimit.
Header readHeader(Input& input);

}  // namespace jalousie::bake::ply
