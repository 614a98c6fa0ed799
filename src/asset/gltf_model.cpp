// tinygltf reads nothing but what it is handed through its callbacks, so that no URI of a document reaches it.
#include "asset/gltf_model.h"

#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <utility>

#include "asset/gltf_elements.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using nlohmann::json;
using tinygltf::Model;

bool resourceExists(const std::string&, void*) {
  return true;
}

std::string samePath(const std::string& path, void*) {
  return path;
}

bool readResource(std::vector<unsigned char>* out, std::string*, const std::string& path, void* user) {
  auto& resources = *static_cast<Resources*>(user);
  const std::size_t slash = path.rfind('/');
  const std::size_t index = std::stoul(path.substr(slash + 1));
  if (path.substr(0, slash).ends_with("buffer")) {
    *out = std::move(resources.buffers.at(index));
  } else {
    out->assign(1, 0);  // the image callback supplies the bytes; tinygltf only insists on some
  }
  return true;
}

bool refuseWrite(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

bool keepEncoded(tinygltf::Image* image, const int index, std::string*, std::string*, int, int, const unsigned char*,
                 int, void* user) {
  tinygltf::Image& source = static_cast<Resources*>(user)->images.at(static_cast<std::size_t>(index));
  image->image = std::move(source.image);
  image->uri = std::move(source.uri);
  image->mimeType = std::move(source.mimeType);
  image->bufferView = -1;
  image->as_is = true;
  return true;
}

/// Calls a function for the target of every channel. Shapes have been checked.
template <class Visit>
void forEachTarget(json& document, const Visit& visit) {
  const auto animations = document.find("animations");
  if (animations == document.end()) return;
  for (json& animation : *animations) {
    const auto channels = animation.find("channels");
    if (channels == animation.end()) continue;
    for (json& channel : *channels)
      visit(channel["target"]);
  }
}

/// tinygltf writes null for empty objects and arrays, and zfar 0 for an infinite projection; it leaves out the names of
/// samplers.
void mendJson(json& document, const Model& model) {
  for (std::size_t i = 0; i < model.samplers.size(); ++i)
    if (!model.samplers[i].name.empty()) document["samplers"][i]["name"] = model.samplers[i].name;
  for (const char* key : {"scenes", "textures", "skins"}) {
    if (!document.contains(key)) continue;
    for (json& entry : document[key]) {
      if (entry.is_null()) entry = json::object();
    }
  }
  if (document.contains("animations") && document["animations"].is_null()) document.erase("animations");
  forEachTarget(document, [](json& target) {
    if (target.value("node", -1) < 0) target.erase("node");
  });
  if (!document.contains("cameras")) return;
  for (json& camera : document["cameras"]) {
    const auto perspective = camera.find("perspective");
    if (perspective != camera.end() && perspective->value("zfar", 0.0) <= 0.0) perspective->erase("zfar");
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

}  // namespace

Model modelOf(json document, Resources& resources, const std::filesystem::path& file, bool keepDocument) {
  std::string kept;
  if (keepDocument && document.contains("animations")) kept = document.dump();
  // tinygltf leaves out channels without a node, such as those of KHR_animation_pointer.
  forEachTarget(document, [](json& target) { target.emplace("node", -1); });
  std::string text = document.dump();
  document = nullptr;  // large ones must not be in memory twice
  if (text.size() > std::numeric_limits<unsigned int>::max())
    throw Error(ErrorCode::kLimit, "the JSON exceeds 4 GiB", file);
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({resourceExists, samePath, readResource, refuseWrite, &resources});
  parser.SetImageLoader(keepEncoded, &resources);
  Model model;
  std::string errors;
  std::string warnings;
  if (!parser.LoadASCIIFromString(&model, &errors, &warnings, text.data(), static_cast<unsigned int>(text.size()),
                                  "")) {
    errors = errors.substr(0, errors.find('\n'));
    throw Error(ErrorCode::kMalformed, errors.empty() ? "no valid glTF" : errors, file);
  }
  if (keepDocument) model.extensions_json_string = kept.empty() ? std::move(text) : std::move(kept);
  return model;
}

json jsonOf(Model& model) {
  settleDefaults(model);
  model.buffers.clear();
  json elements = takeElements(model);
  tinygltf::TinyGLTF writer;
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  if (!writer.WriteGltfSceneToStream(&model, stream, false, false))
    throw Error(ErrorCode::kInternal, "glTF serialisation failed");
  json document = json::parse(stream.str());
  mendJson(document, model);
  for (auto& [key, list] : elements.items())
    document[key] = std::move(list);
  return document;
}

json understoodJson(json document) {
  Resources none;
  if (const auto buffers = document.find("buffers"); buffers != document.end()) {
    for (json& buffer : *buffers)
      buffer["byteLength"] = 1;
    none.buffers.assign(buffers->size(), std::vector<unsigned char>(1, 0));
  }
  if (const auto images = document.find("images"); images != document.end()) none.images.resize(images->size());
  Model model = modelOf(std::move(document), none, {}, false);
  return jsonOf(model);
}

}  // namespace jalousie::asset::detail
