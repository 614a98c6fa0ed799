// Turns checked JSON into tinygltf's structs and back.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace jalousie::asset::detail {

/// What tinygltf asks for through its callbacks, in place of the files a document names.
struct Resources {
  std::vector<std::vector<unsigned char>> buffers;
  std::vector<tinygltf::Image> images;  ///< encoded bytes, URI, MIME type and buffer view of the document
};

/// The model of a document whose buffers and images have the URIs "buffer/I" and "image/I". A channel without a node
/// gets the node -1. @param resources  the bytes are moved out
/// @param keepDocument  the model carries the document as it was   Errors: kMalformed, kLimit.
tinygltf::Model modelOf(nlohmann::json document, Resources& resources, const std::filesystem::path& file,
                        bool keepDocument);

/// The JSON of a model, with what tinygltf's writer gets wrong put right. Takes its buffers, so that none is encoded,
/// and its accessors, buffer views, meshes and nodes.
nlohmann::json jsonOf(tinygltf::Model& model);

/// The JSON that jsonOf makes of the model of a document: what tinygltf understands of it, without bytes.
nlohmann::json understoodJson(nlohmann::json document);

}  // namespace jalousie::asset::detail
