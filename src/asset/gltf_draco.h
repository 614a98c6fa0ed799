// KHR_draco_mesh_compression: decodes primitives, given a document's JSON and its buffers.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "asset/read_limits.h"

namespace jalousie::asset::detail {

/// Decodes every primitive that has the extension. Its accessors get views of a new buffer, and the extension is gone
/// afterwards, so that nothing else needs to know of it. Where the accessors of a primitive have data without it, those
/// stay and the compressed data is left out. An accessor that two compressed primitives fill differently becomes two.
/// `min` and `max` of the accessors become those of the decoded values.
/// @param buffers  bytes by index, appended to
/// Errors, each naming the mesh: kMalformed (ranges, counts or types other than those of the accessors, data that does
/// not decode), kUnsupported (another version of the bitstream than 2.2, triangle strips), kLimit (all decoded bytes
/// together above limits.maxFileBytes or a multiple of the document's bytes; checked before the data is decoded).
void decodeDracoPrimitives(nlohmann::json& document, std::vector<std::vector<unsigned char>>& buffers,
                           const Limits& limits, const std::filesystem::path& file);

}  // namespace jalousie::asset::detail
