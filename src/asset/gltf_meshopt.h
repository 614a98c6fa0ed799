// EXT_meshopt_compression, and what is the same in KHR_meshopt_compression: decodes and encodes buffer views, given a
// document's JSON and its buffers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "asset/read_limits.h"

namespace jalousie::asset::detail {

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// For each buffer whether it only stands in for compressed data and has no bytes of its own: it says so, or it has
/// neither a URI nor a chunk and all views on it are compressed. @param hasChunk  the file has bytes for buffer 0
std::vector<bool> findMeshoptFallbacks(const nlohmann::json& document, bool hasChunk);

/// Decodes every compressed buffer view into a new buffer of its own and takes the extension out of the document, so
/// that nothing else needs to know of it. @param buffers  bytes by index, appended to Errors: kMalformed (ranges,
/// strides, modes, filters, data that does not decode), kLimit (all decoded bytes together above limits.maxFileBytes,
/// checked before allocation), each naming the view.
void decodeMeshoptViews(nlohmann::json& document, std::vector<std::vector<unsigned char>>& buffers,
                        const Limits& limits, const std::filesystem::path& file);

/// Compresses vertex attributes and triangle indices of a document with one buffer. Views that would not shrink stay as
/// they are. The document gets a second buffer without bytes, which describes the decoded layout.
/// @param binary  the buffer's bytes; replaced. Same input, same bytes.
void encodeMeshoptViews(nlohmann::json& document, std::vector<unsigned char>& binary);

}  // namespace jalousie::asset::detail
