// Serialisation as GLB: renumber what is referenced, repack the bytes, let tinygltf write the JSON, mend what it writes
// wrongly, assemble the chunks.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "asset/accessor_layout.h"
#include "asset/gltf_file.h"
#include "asset/gltf_meshopt.h"
#include "asset/image_io.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

using nlohmann::json;
using tinygltf::Model;

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

/// Sees an index and may change it.
using Visit = std::function<void(int&)>;

/// Visits the accessors of a node's instance attributes.
void forEachInstanceAccessor(tinygltf::Node& node, const Visit& visit) {
  const auto found = node.extensions.find(kInstancing);
  if (found == node.extensions.end() || !found->second.IsObject() || !found->second.Get("attributes").IsObject())
    return;
  auto extension = found->second.Get<tinygltf::Value::Object>();
  auto attributes = extension["attributes"].Get<tinygltf::Value::Object>();
  for (auto& [name, value] : attributes) {
    int accessor = value.GetNumberAsInt();
    visit(accessor);
    value = tinygltf::Value(accessor);
  }
  extension["attributes"] = tinygltf::Value(std::move(attributes));
  found->second = tinygltf::Value(std::move(extension));
}

/// Visits every accessor index of a model.
void forEachAccessor(Model& model, const Visit& visit) {
  for (tinygltf::Mesh& mesh : model.meshes) {
    for (tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.indices >= 0) visit(primitive.indices);
      for (auto& [name, accessor] : primitive.attributes)
        visit(accessor);
      for (auto& target : primitive.targets) {
        for (auto& [name, accessor] : target)
          visit(accessor);
      }
    }
  }
  for (tinygltf::Animation& animation : model.animations) {
    for (tinygltf::AnimationSampler& sampler : animation.samplers) {
      visit(sampler.input);
      visit(sampler.output);
    }
  }
  for (tinygltf::Skin& skin : model.skins) {
    if (skin.inverseBindMatrices >= 0) visit(skin.inverseBindMatrices);
  }
  for (tinygltf::Node& node : model.nodes)
    forEachInstanceAccessor(node, visit);
}

/// Visits every buffer view index of a model.
void forEachView(Model& model, const Visit& visit) {
  for (tinygltf::Accessor& accessor : model.accessors) {
    if (accessor.bufferView >= 0) visit(accessor.bufferView);
    if (!accessor.sparse.isSparse) continue;
    visit(accessor.sparse.indices.bufferView);
    visit(accessor.sparse.values.bufferView);
  }
  for (tinygltf::Image& image : model.images) {
    if (image.bufferView >= 0) visit(image.bufferView);
  }
}

/// Drops the elements nothing refers to and renumbers the references. @param forEach  (model, visit(int&))
template <class Element, class ForEach>
void dropUnused(Model& model, std::vector<Element>& elements, const ForEach& forEach) {
  std::vector<int> newIndex(elements.size(), -1);
  forEach(model, [&](int& index) {
    JAL_CHECK(index >= 0);
    JAL_CHECK(static_cast<std::size_t>(index) < newIndex.size());
    newIndex[static_cast<std::size_t>(index)] = 0;
  });
  std::vector<Element> kept;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (newIndex[i] < 0) continue;
    newIndex[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(elements[i]));
  }
  elements = std::move(kept);
  forEach(model, [&](int& index) { index = newIndex[static_cast<std::size_t>(index)]; });
}

std::size_t aligned(std::size_t size) {
  return (size + 3) / 4 * 4;
}

void appendAligned(std::vector<unsigned char>& data, std::span<const std::byte> bytes) {
  data.resize(aligned(data.size()));
  const std::size_t offset = data.size();
  data.resize(offset + bytes.size());
  if (!bytes.empty()) std::memcpy(data.data() + offset, bytes.data(), bytes.size());
}

/// Copies every view into one buffer, in order.
void repackViews(Model& model) {
  std::vector<unsigned char> packed;
  std::vector<std::size_t> offsets;
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    offsets.push_back(aligned(packed.size()));
    appendAligned(packed, detail::viewBytes(model, static_cast<int>(i)));
  }
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    model.bufferViews[i].buffer = 0;
    model.bufferViews[i].byteOffset = offsets[i];
  }
  model.buffers.clear();
  if (packed.empty()) return;
  model.buffers.emplace_back();
  model.buffers[0].data = std::move(packed);
}

/// Moves encoded images behind the other data, each in a view of its own.
void embedImages(Model& model) {
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    tinygltf::Image& image = model.images[i];
    image.uri.clear();
    if (image.mimeType.empty()) image.mimeType = imageMimeType(std::as_bytes(std::span(image.image)));
    if (image.image.empty() || image.mimeType.empty())
      throw Error(ErrorCode::kUnsupported, fmt::format("image {} holds no PNG, JPEG or WebP", i));
    if (model.buffers.empty()) model.buffers.emplace_back();
    appendAligned(model.buffers[0].data, std::as_bytes(std::span(image.image)));
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteLength = image.image.size();
    view.byteOffset = model.buffers[0].data.size() - view.byteLength;
    image.bufferView = static_cast<int>(model.bufferViews.size());
    model.bufferViews.push_back(std::move(view));
    image.image.clear();
  }
}

/// Defaults that tinygltf's structs hold as values its writer would print as invalid JSON.
void settleDefaults(Model& model) {
  for (tinygltf::Mesh& mesh : model.meshes) {
    for (tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.mode < 0) primitive.mode = TINYGLTF_MODE_TRIANGLES;
    }
  }
  std::erase_if(model.animations, [](const tinygltf::Animation& animation) { return animation.channels.empty(); });
}

json modelJson(const Model& model) {
  tinygltf::TinyGLTF writer;
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  if (!writer.WriteGltfSceneToStream(&model, stream, false, false))
    throw Error(ErrorCode::kInternal, "glTF serialisation failed");
  return json::parse(stream.str());
}

/// tinygltf writes sizes as 32-bit integers with a sign.
void mendSizes(json& document, const Model& model) {
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    document["bufferViews"][i]["byteOffset"] = model.bufferViews[i].byteOffset;
    document["bufferViews"][i]["byteLength"] = model.bufferViews[i].byteLength;
  }
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    document["accessors"][i]["count"] = model.accessors[i].count;
    if (model.accessors[i].byteOffset > 0) document["accessors"][i]["byteOffset"] = model.accessors[i].byteOffset;
  }
}

/// tinygltf writes null for empty objects and arrays, and zfar 0 for an infinite projection; it leaves out the names of
/// samplers.
void mendJson(json& document, const Model& model) {
  mendSizes(document, model);
  for (std::size_t i = 0; i < model.samplers.size(); ++i)
    if (!model.samplers[i].name.empty()) document["samplers"][i]["name"] = model.samplers[i].name;
  for (const char* key : {"scenes", "nodes", "textures", "skins"}) {
    if (!document.contains(key)) continue;
    for (json& entry : document[key]) {
      if (entry.is_null()) entry = json::object();
    }
  }
  if (document.contains("animations") && document["animations"].is_null()) document.erase("animations");
  if (!document.contains("cameras")) return;
  for (json& camera : document["cameras"]) {
    const auto perspective = camera.find("perspective");
    if (perspective != camera.end() && perspective->value("zfar", 0.0) <= 0.0) perspective->erase("zfar");
  }
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

std::vector<std::byte> encodeGlb(Model model, const EncodeOptions& options) {
  for (tinygltf::Image& image : model.images) {
    // Bytes in memory are what counts; an image without them keeps those of its view.
    if (image.image.empty() && image.bufferView >= 0) {
      const auto bytes = detail::viewBytes(model, image.bufferView);
      const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
      image.image.assign(first, first + bytes.size());
    }
    image.bufferView = -1;
  }
  dropUnused(model, model.accessors, forEachAccessor);
  dropUnused(model, model.bufferViews, forEachView);
  repackViews(model);
  embedImages(model);
  settleDefaults(model);

  std::vector<unsigned char> binary =
      model.buffers.empty() ? std::vector<unsigned char>{} : std::move(model.buffers[0].data);
  model.buffers.clear();
  json document = modelJson(model);
  mendJson(document, model);
  if (!binary.empty()) document["buffers"] = json::array({json::object({{"byteLength", binary.size()}})});
  if (options.compress) detail::encodeMeshoptViews(document, binary);
  return assemble(document.dump(), std::as_bytes(std::span(binary)));
}

}  // namespace jalousie::asset
