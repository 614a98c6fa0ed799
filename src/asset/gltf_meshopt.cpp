// Checks every number of the extension, then lets meshoptimizer's codecs work.
#include "asset/gltf_meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "asset/gltf_json.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;
using Bytes = std::vector<unsigned char>;

/// Most bytes that one compressed byte can stand for.
constexpr std::uint64_t kMaxMeshoptExpansion = 64;
constexpr std::uint64_t kFreeMeshoptBytes = 64ULL << 20U;

/// One compressed view, its numbers checked.
struct Compressed {
  const unsigned char* data = nullptr;
  std::size_t size = 0;
  std::size_t stride = 0;
  std::size_t count = 0;
  std::string mode;
  std::string filter;
};

[[noreturn]] void malformed(std::size_t view, const std::string& what, const Path& file) {
  throw Error(ErrorCode::kMalformed, fmt::format("buffer view {}: {}: {}", view, kMeshoptExtension, what), file);
}

std::string stringMember(const json& object, const char* key, const char* fallback, std::size_t view,
                         const Path& file) {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  if (!found->is_string()) malformed(view, fmt::format("\"{}\" is not a string", key), file);
  return found->get<std::string>();
}

void checkStride(const Compressed& source, std::size_t view, const Path& file) {
  const std::size_t stride = source.stride;
  if (source.mode == "ATTRIBUTES") {
    if (stride == 0 || stride % 4 != 0 || stride > 256)
      malformed(view, "byteStride is no multiple of 4 up to 256", file);
  } else if (source.mode == "TRIANGLES" || source.mode == "INDICES") {
    if (stride != 2 && stride != 4) malformed(view, "byteStride of indices is neither 2 nor 4", file);
    if (source.mode == "TRIANGLES" && source.count % 3 != 0) malformed(view, "count is no multiple of 3", file);
    if (source.filter != "NONE") malformed(view, "indices have a filter", file);
  } else {
    malformed(view, "unknown mode", file);
  }
  if (source.filter == "OCTAHEDRAL") {
    if (stride != 4 && stride != 8) malformed(view, "byteStride of OCTAHEDRAL is neither 4 nor 8", file);
  } else if (source.filter == "QUATERNION") {
    if (stride != 8) malformed(view, "byteStride of QUATERNION is not 8", file);
  } else if (source.filter != "NONE" && source.filter != "EXPONENTIAL") {
    malformed(view, "unknown filter", file);
  }
}

/// Version 1 of the vertex codec and the filter of colours belong to KHR_meshopt_compression only.
bool isKnownCodec(const Compressed& source) {
  constexpr unsigned kVertexHeader = 0xa0;
  const bool isNewer = source.mode == "ATTRIBUTES" && source.size > 0 && (source.data[0] & 0xf0U) == kVertexHeader &&
                       (source.data[0] & 0x0fU) > 0;
  return !isNewer && source.filter != "COLOR";
}

/// Whether a view has its bytes without the extension, too.
bool hasPlainBytes(const json& bufferView, const std::vector<Bytes>& buffers, const Path& file) {
  const std::uint64_t buffer = unsignedMember(bufferView, "buffer", ~0ULL, file);
  const std::uint64_t offset = unsignedMember(bufferView, "byteOffset", 0, file);
  const std::uint64_t length = unsignedMember(bufferView, "byteLength", ~0ULL, file);
  return buffer < buffers.size() && offset <= buffers[buffer].size() && length <= buffers[buffer].size() - offset;
}

/// Absent if the installed library does not know the codec or filter.
std::optional<Compressed> readExtension(const json& extension, const json& bufferView, std::size_t view,
                                        const std::vector<Bytes>& buffers, const Path& file) {
  if (!extension.is_object()) malformed(view, "not an object", file);
  const std::uint64_t none = ~0ULL;
  const std::uint64_t buffer = unsignedMember(extension, "buffer", none, file);
  const std::uint64_t offset = unsignedMember(extension, "byteOffset", 0, file);
  const std::uint64_t length = unsignedMember(extension, "byteLength", none, file);
  const std::uint64_t stride = unsignedMember(extension, "byteStride", none, file);
  const std::uint64_t count = unsignedMember(extension, "count", none, file);
  if (buffer >= buffers.size()) malformed(view, "buffer is out of range", file);
  const Bytes& bytes = buffers[buffer];
  if (offset > bytes.size() || length > bytes.size() - offset) malformed(view, "data lies outside its buffer", file);
  const std::uint64_t decoded = unsignedMember(bufferView, "byteLength", 0, file);
  if (stride > 256 || count == 0 || decoded == 0 || count != decoded / std::max<std::uint64_t>(stride, 1) ||
      count * stride != decoded)
    malformed(view, "count times byteStride is not byteLength", file);
  Compressed source{bytes.data() + offset,
                    static_cast<std::size_t>(length),
                    static_cast<std::size_t>(stride),
                    static_cast<std::size_t>(count),
                    stringMember(extension, "mode", "", view, file),
                    stringMember(extension, "filter", "NONE", view, file)};
  if (!isKnownCodec(source)) return std::nullopt;
  checkStride(source, view, file);
  // Both codecs spend at least two bits on sixteen bytes; more is a demand for memory, not data.
  if (decoded / kMaxMeshoptExpansion > source.size)
    malformed(view, "the data is too short for what it unfolds to", file);
  return source;
}

/// @pre checkStride accepted the source: the codecs and filters abort on other strides and counts
Bytes decode(const Compressed& source, std::size_t view, const Path& file) {
  Bytes decoded(source.count * source.stride);
  int failure = 0;
  if (source.mode == "ATTRIBUTES") {
    failure = meshopt_decodeVertexBuffer(decoded.data(), source.count, source.stride, source.data, source.size);
  } else if (source.mode == "TRIANGLES") {
    failure = meshopt_decodeIndexBuffer(decoded.data(), source.count, source.stride, source.data, source.size);
  } else {
    failure = meshopt_decodeIndexSequence(decoded.data(), source.count, source.stride, source.data, source.size);
  }
  if (failure != 0) malformed(view, "the data does not decode", file);
  if (source.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), source.count, source.stride);
  if (source.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), source.count, source.stride);
  if (source.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), source.count, source.stride);
  return decoded;
}

constexpr std::array kNames = {kMeshoptExtension, "KHR_meshopt_compression"};

/// The name under which an object has the extension; null if it has not.
const char* nameIn(const json& object) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return nullptr;
  for (const char* name : kNames)
    if (extensions->contains(name)) return name;
  return nullptr;
}

/// What a view holds, as far as it can be compressed.
struct Content {
  std::size_t stride = 0;
  std::size_t count = 0;
  bool isTriangles = false;
};

std::size_t elementSize(const json& accessor) {
  const int component = accessor.value("componentType", 0);
  const std::size_t bytes = component == 5120 || component == 5121 ? 1 : component == 5122 || component == 5123 ? 2 : 4;
  const std::string type = accessor.value("type", "");
  const std::size_t components = type == "SCALAR" ? 1
                                 : type == "VEC2" ? 2
                                 : type == "VEC3" ? 3
                                 : type == "VEC4" ? 4
                                                  : 0;
  return bytes * components;
}

/// Accessors, sparse blocks and images that lie in each view.
std::vector<int> countUsers(const json& document, std::size_t views) {
  std::vector<int> users(views, 0);
  const auto note = [&](const json& object) {
    if (object.contains("bufferView")) ++users.at(object["bufferView"].get<std::size_t>());
  };
  for (const json& image : document.value("images", json::array()))
    note(image);
  for (const json& accessor : document.value("accessors", json::array())) {
    note(accessor);
    if (!accessor.contains("sparse")) continue;
    note(accessor["sparse"].at("indices"));
    note(accessor["sparse"].at("values"));
  }
  return users;
}

/// Accessors with a use for which their order matters. The codec of triangles may begin a triangle at another corner.
std::set<std::size_t> accessorsBesidesTriangles(const json& document) {
  std::set<std::size_t> accessors;
  for (const json& mesh : document.value("meshes", json::array())) {
    for (const json& primitive : mesh.at("primitives")) {
      for (const auto& [name, accessor] : primitive.at("attributes").items())
        accessors.insert(accessor.get<std::size_t>());
      for (const json& target : primitive.value("targets", json::array()))
        for (const auto& [name, accessor] : target.items())
          accessors.insert(accessor.get<std::size_t>());
      if (primitive.contains("indices") && primitive.value("mode", 4) != 4)
        accessors.insert(primitive["indices"].get<std::size_t>());
    }
  }
  for (const json& animation : document.value("animations", json::array())) {
    for (const json& sampler : animation.at("samplers")) {
      accessors.insert(sampler.at("input").get<std::size_t>());
      accessors.insert(sampler.at("output").get<std::size_t>());
    }
  }
  return accessors;
}

/// Per view what can be compressed: views with one accessor that fills them, used as a vertex attribute or as the
/// indices of triangles.
std::vector<std::optional<Content>> findContents(const json& document) {
  const json& views = document.at("bufferViews");
  const json accessors = document.value("accessors", json::array());
  const std::vector<int> users = countUsers(document, views.size());
  const std::set<std::size_t> keptInOrder = accessorsBesidesTriangles(document);
  std::vector<std::optional<Content>> contents(views.size());
  const auto note = [&](std::size_t index, bool isTriangles) {
    const json& accessor = accessors.at(index);
    if (!accessor.contains("bufferView") || accessor.contains("sparse") || accessor.value("byteOffset", 0) != 0) return;
    const auto view = accessor["bufferView"].get<std::size_t>();
    const std::size_t size = elementSize(accessor);
    const std::size_t stride = views[view].value("byteStride", size);
    const auto count = accessor["count"].get<std::size_t>();
    if (isTriangles && keptInOrder.contains(index)) return;
    const bool fits = isTriangles ? (size == 2 || size == 4) && stride == size && count % 3 == 0
                                  : size > 0 && stride % 4 == 0 && stride <= 256;
    if (users[view] != 1 || !fits || stride * count != views[view]["byteLength"].get<std::size_t>()) return;
    contents[view] = Content{stride, count, isTriangles};
  };
  for (const json& mesh : document.value("meshes", json::array())) {
    for (const json& primitive : mesh.at("primitives")) {
      for (const auto& [name, accessor] : primitive.at("attributes").items())
        note(accessor.get<std::size_t>(), false);
      if (primitive.contains("indices") && primitive.value("mode", 4) == 4)
        note(primitive["indices"].get<std::size_t>(), true);
    }
  }
  return contents;
}

/// @pre the data holds count elements, stride apart
Bytes encode(const Content& content, const unsigned char* data) {
  Bytes encoded;
  JAL_CHECK(content.count > 0U);
  if (content.isTriangles) {
    JAL_CHECK(content.count % 3 == 0U);  // of both calls below
    std::vector<unsigned int> indices(content.count);
    for (std::size_t i = 0; i < content.count; ++i)
      std::memcpy(&indices[i], data + i * content.stride, content.stride);  // little-endian, zero-extended
    const unsigned int most = *std::max_element(indices.begin(), indices.end());
    encoded.resize(meshopt_encodeIndexBufferBound(content.count, std::size_t{most} + 1));
    meshopt_encodeIndexVersion(1);
    encoded.resize(meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices.data(), indices.size()));
  } else {
    JAL_CHECK((content.stride > 0 && content.stride <= 256 && content.stride % 4 == 0));  // of both calls below
    encoded.resize(meshopt_encodeVertexBufferBound(content.count, content.stride));
    meshopt_encodeVertexVersion(0);
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), data, content.count, content.stride));
  }
  return encoded;
}

void addExtensionName(json& document, const char* key) {
  json& names = document[key];
  if (!names.is_array()) names = json::array();
  if (std::find(names.begin(), names.end(), json(kMeshoptExtension)) == names.end()) names.push_back(kMeshoptExtension);
}

std::size_t aligned(std::size_t size) {
  return (size + 3) / 4 * 4;
}

}  // namespace

std::vector<bool> findMeshoptFallbacks(const json& document, bool hasChunk) {
  const json buffers = document.value("buffers", json::array());
  std::vector<bool> fallback(buffers.size(), false);
  std::vector<bool> mayBe(buffers.size(), false);
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (buffers[i].contains("uri")) continue;
    const char* name = nameIn(buffers[i]);
    const json* extension = name == nullptr ? nullptr : &buffers[i]["extensions"][name];
    fallback[i] =
        extension != nullptr && extension->is_object() && extension->value("fallback", json(false)) == json(true);
    mayBe[i] = !fallback[i] && (i > 0 || !hasChunk);
  }
  std::vector<bool> isViewed(buffers.size(), false);
  for (const json& view : document.value("bufferViews", json::array())) {
    const json index = view.value("buffer", json());
    if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= buffers.size()) continue;
    const auto buffer = index.get<std::size_t>();
    isViewed[buffer] = true;
    if (nameIn(view) == nullptr) mayBe[buffer] = false;
  }
  for (std::size_t i = 0; i < buffers.size(); ++i)
    fallback[i] = fallback[i] || (mayBe[i] && isViewed[i]);
  return fallback;
}

void decodeMeshoptViews(json& document, std::vector<Bytes>& buffers, const Limits& limits, const Path& file) {
  for (const char* name : kNames)
    forgetExtension(document, name);
  if (const auto list = document.find("buffers"); list != document.end()) {
    for (json& buffer : *list) {
      if (const char* name = nameIn(buffer)) buffer["extensions"].erase(name);
    }
  }
  const auto views = document.find("bufferViews");
  if (views == document.end()) return;
  std::uint64_t total = 0;
  std::uint64_t given = 0;
  for (const Bytes& buffer : buffers)
    given += buffer.size();
  const std::uint64_t most = std::min(limits.maxFileBytes, kFreeMeshoptBytes + kMaxMeshoptExpansion * given);
  for (std::size_t i = 0; i < views->size(); ++i) {
    json& view = (*views)[i];
    const char* name = nameIn(view);
    if (name == nullptr) continue;
    const std::optional<Compressed> known = readExtension(view["extensions"][name], view, i, buffers, file);
    if (!known) {
      if (!hasPlainBytes(view, buffers, file))
        throw Error(ErrorCode::kUnsupported,
                    fmt::format("buffer view {}: KHR_meshopt_compression with a codec or filter that the installed "
                                "meshoptimizer does not have",
                                i),
                    file);
      view["extensions"].erase(name);
      continue;
    }
    const Compressed& source = *known;
    total += std::uint64_t{source.count} * source.stride;
    if (total > most)
      throw Error(ErrorCode::kLimit, fmt::format("compressed data unfolds to more than {} bytes", most), file);
    Bytes decoded = decode(source, i, file);
    view["extensions"].erase(name);
    view["buffer"] = buffers.size();
    view["byteOffset"] = 0;
    document["buffers"].push_back({{"byteLength", decoded.size()}, {"uri", fmt::format("buffer/{}", buffers.size())}});
    buffers.push_back(std::move(decoded));
  }
}

void encodeMeshoptViews(json& document, Bytes& binary) {
  if (binary.empty() || !document.contains("bufferViews")) return;
  const std::vector<std::optional<Content>> contents = findContents(document);
  Bytes packed;
  std::size_t fallback = 0;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    json& view = document["bufferViews"][i];
    const std::size_t offset = view.value("byteOffset", std::size_t{0});
    const auto length = view["byteLength"].get<std::size_t>();
    packed.resize(aligned(packed.size()));
    Bytes encoded;
    if (contents[i]) encoded = encode(*contents[i], binary.data() + offset);
    if (encoded.empty() || encoded.size() >= length) {
      view["byteOffset"] = packed.size();
      packed.insert(packed.end(), binary.begin() + static_cast<std::ptrdiff_t>(offset),
                    binary.begin() + static_cast<std::ptrdiff_t>(offset + length));
      continue;
    }
    view["extensions"][kMeshoptExtension] = {{"buffer", 0},
                                             {"byteOffset", packed.size()},
                                             {"byteLength", encoded.size()},
                                             {"byteStride", contents[i]->stride},
                                             {"count", contents[i]->count},
                                             {"mode", contents[i]->isTriangles ? "TRIANGLES" : "ATTRIBUTES"}};
    view["buffer"] = 1;
    view["byteOffset"] = fallback;
    fallback += aligned(length);
    packed.insert(packed.end(), encoded.begin(), encoded.end());
  }
  if (fallback == 0) return;
  binary = std::move(packed);
  document["buffers"] = json::array(
      {json::object({{"byteLength", binary.size()}}),
       json::object({{"byteLength", fallback}, {"extensions", {{kMeshoptExtension, {{"fallback", true}}}}}})});
  addExtensionName(document, "extensionsUsed");
  addExtensionName(document, "extensionsRequired");
}

}  // namespace jalousie::asset::detail
