// Loading: every file is read and the document is checked here; tinygltf only turns checked JSON into its structs.
#include "asset/gltf_file.h"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "asset/accessor_layout.h"
#include "asset/gltf_draco.h"
#include "asset/gltf_images.h"
#include "asset/gltf_json.h"
#include "asset/gltf_meshopt.h"
#include "asset/gltf_model.h"
#include "asset/gltf_resources.h"
#include "asset/gltf_validate.h"
#include "asset/image_io.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::asset {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

constexpr std::uint32_t kGlbMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kGlbJson = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kGlbBinary = 0x004E4942;  // "BIN\0"

/// The two parts of a file; `binary` is absent in .gltf files and in GLB files without a second chunk.
struct Parts {
  std::string_view json;
  std::optional<std::span<const std::byte>> binary;
};

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string_view asText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Takes the chunk at `offset`. @param type  it must have; absent: any. Errors: kMalformed.
std::span<const std::byte> chunkAt(std::span<const std::byte> glb, std::size_t offset,
                                   std::optional<std::uint32_t> type, const Path& file) {
  if (glb.size() - offset < 8) throw Error(ErrorCode::kMalformed, "GLB chunk header is cut off", file);
  const std::uint32_t length = word(glb, offset);
  if (length > glb.size() - offset - 8)
    throw Error(ErrorCode::kMalformed, fmt::format("GLB chunk of {} bytes is cut off", length), file);
  if (type && word(glb, offset + 4) != *type) throw Error(ErrorCode::kMalformed, "GLB chunk has the wrong type", file);
  if (length % 4 != 0) throw Error(ErrorCode::kMalformed, "GLB chunk is not padded to four bytes", file);
  return glb.subspan(offset + 8, length);
}

Parts splitGlb(std::span<const std::byte> bytes, const Path& file) {
  if (bytes.size() < 12) throw Error(ErrorCode::kMalformed, "GLB header is cut off", file);
  const std::uint32_t version = word(bytes, 4);
  if (version != 2) throw Error(ErrorCode::kUnsupported, fmt::format("GLB version {}, only 2 is read", version), file);
  const std::uint32_t length = word(bytes, 8);
  if (length < 12 || length > bytes.size())
    throw Error(ErrorCode::kMalformed, fmt::format("GLB says {} bytes, the file has {}", length, bytes.size()), file);
  const std::span<const std::byte> glb = bytes.first(length);
  const std::span<const std::byte> text = chunkAt(glb, 12, kGlbJson, file);
  Parts parts{asText(text), std::nullopt};
  std::size_t next = 12 + 8 + text.size();
  if (next < glb.size()) parts.binary = chunkAt(glb, next, kGlbBinary, file);
  if (parts.binary) next += 8 + parts.binary->size();
  while (next < glb.size())  // chunks of extensions: passed over, but whole
    next += 8 + chunkAt(glb, next, std::nullopt, file).size();
  return parts;
}

Parts split(std::span<const std::byte> bytes, const Path& file) {
  if (bytes.size() >= 4 && word(bytes, 0) == kGlbMagic) return splitGlb(bytes, file);
  const std::string_view text = asText(bytes);
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string_view::npos || (text[first] != '{' && text[first] != '['))
    throw Error(ErrorCode::kMalformed, "neither glTF nor GLB (jalousie-bake makes GLB of PLY and OBJ)", file);
  return {text, std::nullopt};
}

std::optional<std::string> uriOf(const json& object, const Path& file) {
  const auto found = object.find("uri");
  if (found == object.end()) return std::nullopt;
  if (!found->is_string()) throw Error(ErrorCode::kMalformed, "\"uri\" is not a string", file);
  return found->get<std::string>();
}

std::vector<unsigned char> loadBuffer(const json& buffer, std::size_t index, const Parts& parts,
                                      detail::ResourceLoader& loader, const Path& file) {
  const std::uint64_t length = detail::unsignedMember(buffer, "byteLength", 0, file);
  if (length == 0) throw Error(ErrorCode::kMalformed, fmt::format("buffer {} has no byteLength", index), file);
  std::vector<unsigned char> data;
  if (const auto uri = uriOf(buffer, file)) {
    data = loader.load(*uri);
  } else {
    if (index != 0 || !parts.binary)
      throw Error(ErrorCode::kMalformed, fmt::format("buffer {} has neither URI nor chunk", index), file);
    data = loader.copy(*parts.binary, true);
  }
  if (data.size() < length)
    throw Error(ErrorCode::kMalformed, fmt::format("buffer {} has {} of {} bytes", index, data.size(), length), file);
  data.resize(length);
  return data;
}

/// The bytes of a picture; none if its file is missing, because not every program needs every picture.
std::vector<unsigned char> pictureBytes(const std::string& uri, detail::ResourceLoader& loader) {
  try {
    return loader.load(uri);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kFileNotFound) return {};
    throw;
  }
}

/// Image properties that tinygltf would act on; bytes only for images with a URI.
tinygltf::Image loadImageSource(const json& source, std::size_t index, detail::ResourceLoader& loader,
                                const Path& file) {
  tinygltf::Image image;
  const auto uri = uriOf(source, file);
  const bool hasView = source.contains("bufferView");
  if (uri.has_value() == hasView)
    throw Error(ErrorCode::kMalformed, fmt::format("image {} needs either a URI or a buffer view", index), file);
  if (source.contains("mimeType") && source["mimeType"].is_string()) image.mimeType = source["mimeType"];
  if (hasView) image.bufferView = static_cast<int>(detail::unsignedMember(source, "bufferView", 0, file));
  if (uri) {
    if (!uri->starts_with("data:")) image.uri = *uri;
    image.image = pictureBytes(*uri, loader);
  }
  return image;
}

/// Loads all resources and replaces their references in the document by "buffer/I" and "image/I".
detail::Resources takeResources(json& document, const Parts& parts, detail::ResourceLoader& loader,
                                const Limits& limits, const Path& file) {
  detail::Resources resources;
  const std::vector<bool> isFallback = detail::findMeshoptFallbacks(document, parts.binary.has_value());
  if (const auto buffers = document.find("buffers"); buffers != document.end()) {
    for (json& buffer : *buffers) {
      const std::size_t index = resources.buffers.size();
      if (isFallback[index]) {
        // Views on it get buffers of their own; one that is not compressed would lie outside of these four bytes.
        buffer["byteLength"] = 4;
        resources.buffers.emplace_back(4, static_cast<unsigned char>(0));
      } else {
        resources.buffers.push_back(loadBuffer(buffer, index, parts, loader, file));
      }
      buffer["uri"] = fmt::format("buffer/{}", index);
    }
  }
  detail::decodeMeshoptViews(document, resources.buffers, limits, file);
  detail::decodeDracoPrimitives(document, resources.buffers, limits, file);
  if (const auto images = document.find("images"); images != document.end()) {
    for (json& image : *images) {
      const std::size_t index = resources.images.size();
      resources.images.push_back(loadImageSource(image, index, loader, file));
      image.erase("bufferView");
      image["uri"] = fmt::format("image/{}", index);
    }
  }
  return resources;
}

/// Gives the images of buffer views their bytes, and looks at what all of them are.
void fillImages(tinygltf::Model& model, const detail::Resources& resources, detail::ResourceLoader& loader,
                const Limits& limits) {
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    tinygltf::Image& image = model.images[i];
    image.bufferView = resources.images[i].bufferView;
    if (image.bufferView >= 0) image.image = loader.copy(detail::viewBytes(model, image.bufferView), false);
    if (image.image.empty() && !image.uri.empty()) continue;  // missing
    if (image.mimeType.empty()) image.mimeType = imageMimeType(std::as_bytes(std::span(image.image)));
    const std::string_view foreign = detail::foreignMimeType(std::as_bytes(std::span(image.image)));
    if (!foreign.empty()) {
      image.mimeType = foreign;
      continue;
    }
    detail::useImage(model, i, [&](std::span<const std::byte> bytes) { imageSize(bytes, limits.images); });
  }
}

void clearPlaceholders(tinygltf::Model& model) {
  for (tinygltf::Buffer& buffer : model.buffers)
    buffer.uri.clear();
}

tinygltf::Model parseChecked(std::span<const std::byte> bytes, const Path& path, const Limits& limits,
                             const ReadObserver& observer, Retain retain) {
  const Parts parts = split(bytes, path);
  json document = detail::parseDocument(parts.json, limits, path);
  detail::ResourceLoader loader(path, limits, observer);
  detail::Resources resources = takeResources(document, parts, loader, limits, path);
  tinygltf::Model model = detail::modelOf(std::move(document), resources, path, retain == Retain::kDocument);
  clearPlaceholders(model);
  fillImages(model, resources, loader, limits);
  detail::validateModel(model, limits);
  return model;
}

}  // namespace

tinygltf::Model loadGltf(const Path& path, const Limits& limits, const ReadObserver& observer) {
  return parseGltf(readFile(path, limits.maxFileBytes), path, limits, observer);
}

tinygltf::Model parseGltf(std::span<const std::byte> bytes, const Path& path, const Limits& limits,
                          const ReadObserver& observer, Retain retain) {
  try {
    return parseChecked(bytes, path, limits, observer, retain);
  } catch (const Error& error) {
    if (!error.file().empty()) throw;
    throw Error(error.code(), error.what(), path);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::kLimit, "out of memory", path);
  } catch (const std::exception& error) {
    throw Error(ErrorCode::kMalformed, error.what(), path);
  }
}

void saveGlb(const tinygltf::Model& model, const Path& path, const EncodeOptions& options) {
  writeFileAtomic(path, encodeGlb(model, options));
}

}  // namespace jalousie::asset
