// Serialisation as GLB: write the JSON, settle what is not referred to, repack the bytes, assemble the chunks.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "asset/accessor_layout.h"
#include "asset/gltf_file.h"
#include "asset/gltf_merge.h"
#include "asset/gltf_meshopt.h"
#include "asset/gltf_model.h"
#include "asset/gltf_references.h"
#include "asset/image_io.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

using nlohmann::json;
using tinygltf::Model;

std::size_t aligned(std::size_t size) {
  return (size + 3) / 4 * 4;
}

void appendAligned(std::vector<unsigned char>& data, std::span<const std::byte> bytes) {
  data.resize(aligned(data.size()));
  const std::size_t offset = data.size();
  data.resize(offset + bytes.size());
  if (!bytes.empty()) std::memcpy(data.data() + offset, bytes.data(), bytes.size());
}

using Buffers = std::vector<std::vector<unsigned char>>;

/// Gives each picture a view of its bytes, appended unless it has one already.
void embedImages(Model& model) {
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    tinygltf::Image& image = model.images[i];
    image.uri.clear();
    std::span<const std::byte> bytes = std::as_bytes(std::span(image.image));
    std::span<const std::byte> there;
    if (image.bufferView >= 0) there = detail::viewBytes(model, image.bufferView);
    if (bytes.empty()) bytes = there;
    if (image.mimeType.empty()) image.mimeType = imageMimeType(bytes);
    if (bytes.empty() || image.mimeType.empty())
      throw Error(ErrorCode::kUnsupported, fmt::format("image {} holds no PNG, JPEG or WebP", i));
    if (!std::equal(bytes.begin(), bytes.end(), there.begin(), there.end())) {
      if (model.buffers.empty()) model.buffers.emplace_back();
      appendAligned(model.buffers[0].data, bytes);
      tinygltf::BufferView view;
      view.buffer = 0;
      view.byteLength = bytes.size();
      view.byteOffset = model.buffers[0].data.size() - view.byteLength;
      image.bufferView = static_cast<int>(model.bufferViews.size());
      model.bufferViews.push_back(std::move(view));
    }
    image.image.clear();
  }
}

/// Members that are not understood stay as they are in the original. Where the bytes are has to be what was understood.
void settlePlaces(json& merged, const json& document) {
  if (!document.contains("bufferViews")) return;
  for (std::size_t i = 0; i < document["bufferViews"].size(); ++i)
    for (const char* key : {"buffer", "byteOffset", "byteLength"})
      merged.at("bufferViews").at(i)[key] = document["bufferViews"][i].at(key);
}

/// The JSON of the model: that of its document with the changes made since, if it carries one.
json documentOf(Model& model, const json& original) {
  model.extensions_json_string.clear();
  json document = detail::jsonOf(model);
  if (original.is_null()) return document;
  json merged = original;
  detail::applyChanges(merged, detail::understoodJson(original), document);
  settlePlaces(merged, document);
  if (const auto images = merged.find("images"); images != merged.end())
    for (json& image : *images)
      image.erase("uri");  // all have views
  return merged;
}

std::span<const std::byte> bytesOf(const json& view, const Buffers& buffers) {
  const auto buffer = view.at("buffer").get<std::size_t>();
  JAL_CHECK(buffer < buffers.size());
  return std::as_bytes(std::span(buffers[buffer]))
      .subspan(view.value("byteOffset", std::size_t{0}), view.at("byteLength").get<std::size_t>());
}

/// Copies the bytes of every view into one buffer, in order.
std::vector<unsigned char> packViews(json& document, const Buffers& buffers) {
  std::vector<unsigned char> packed;
  if (!document.contains("bufferViews")) return packed;
  for (json& view : document["bufferViews"]) {
    appendAligned(packed, bytesOf(view, buffers));
    view["byteOffset"] = packed.size() - view.at("byteLength").get<std::size_t>();
    view["buffer"] = 0;
  }
  return packed;
}

/// Puts the buffers behind each other, so that what lies in the first one keeps its place.
std::vector<unsigned char> joinBuffers(json& document, Buffers buffers) {
  std::vector<std::size_t> starts;
  std::vector<unsigned char> joined;
  if (!buffers.empty()) joined = std::move(buffers[0]);
  starts.push_back(0);
  for (std::size_t i = 1; i < buffers.size(); ++i) {
    starts.push_back(aligned(joined.size()));
    appendAligned(joined, std::as_bytes(std::span(buffers[i])));
  }
  if (!document.contains("bufferViews")) return joined;
  for (json& view : document["bufferViews"]) {
    const std::size_t start = starts.at(view.at("buffer").get<std::size_t>());
    view["byteOffset"] = start + view.value("byteOffset", std::size_t{0});
    view["buffer"] = 0;
  }
  return joined;
}

/// Settles what becomes of accessors and views without a use. @return  the bytes of the one buffer
std::vector<unsigned char> settleViews(json& document, const json& original, Buffers buffers) {
  const detail::Unused fate = detail::fateOfUnused(document);
  if (fate == detail::Unused::kKeep) return joinBuffers(document, std::move(buffers));
  if (fate == detail::Unused::kEmpty && !original.is_null()) {
    detail::emptyUnreferenced(document, detail::keepUnknown(document, original));
  } else {
    detail::dropUnreferenced(document, detail::findReferences(document));
  }
  return packViews(document, buffers);
}

void appendWord(std::vector<std::byte>& out, std::uint32_t value) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  out.insert(out.end(), first, first + sizeof value);
}

void appendChunk(std::vector<std::byte>& out, std::string_view type, std::span<const std::byte> bytes, std::byte pad) {
  appendWord(out, static_cast<std::uint32_t>(aligned(bytes.size())));
  const auto name = std::as_bytes(std::span(type));
  out.insert(out.end(), name.begin(), name.end());
  out.insert(out.end(), bytes.begin(), bytes.end());
  out.resize(aligned(out.size()), pad);
}

std::vector<std::byte> assemble(const std::string& text, std::span<const std::byte> binary) {
  const std::size_t size = 12 + 8 + aligned(text.size()) + (binary.empty() ? 0 : 8 + aligned(binary.size()));
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorCode::kLimit, fmt::format("{} bytes do not fit into a GLB file", size));
  std::vector<std::byte> out;
  out.reserve(size);
  appendWord(out, 0x46546C67);  // "glTF"
  appendWord(out, 2);
  appendWord(out, static_cast<std::uint32_t>(size));
  appendChunk(out, "JSON", std::as_bytes(std::span(text)), std::byte{' '});
  if (!binary.empty()) appendChunk(out, std::string_view("BIN\0", 4), binary, std::byte{0});
  return out;
}

}  // namespace

std::vector<std::byte> encodeGlb(Model model, const EncodeOptions& options) try {
  json original;
  if (!model.extensions_json_string.empty()) original = json::parse(model.extensions_json_string);
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i)
    detail::viewBytes(model, static_cast<int>(i));  // in range
  embedImages(model);
  Buffers buffers;
  for (tinygltf::Buffer& buffer : model.buffers)
    buffers.push_back(std::move(buffer.data));
  json document = documentOf(model, original);
  std::vector<unsigned char> binary = settleViews(document, original, std::move(buffers));
  original = nullptr;  // large ones must not be in memory twice
  document.erase("buffers");
  if (!binary.empty()) document["buffers"] = json::array({json::object({{"byteLength", binary.size()}})});
  if (options.compress) detail::encodeMeshoptViews(document, binary);
  return assemble(document.dump(), std::as_bytes(std::span(binary)));
} catch (const json::exception& error) {
  throw Error(ErrorCode::kMalformed, fmt::format("the JSON cannot be kept: {}", oneLine(error.what())));
}

}  // namespace jalousie::asset
