// Walks the document once for each kind of reference.
#include "asset/gltf_references.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>

#include "asset/gltf_known.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using nlohmann::json;

/// Sees an index and may change it.
using Visit = std::function<void(json&)>;

Unused fateBy(const json& value) {
  Unused worst = Unused::kDrop;
  if (!value.is_structured()) return worst;
  for (const auto& [key, member] : value.items()) {
    Unused fate = Unused::kDrop;
    if (value.is_object() && key == "extras") {
      if (mayHoldReference(member)) fate = Unused::kEmpty;
    } else if (value.is_object() && key == "extensions" && member.is_object()) {
      for (const auto& [name, extension] : member.items())
        fate =
            std::max(fate, !isKnownExtension(name) && mayHoldReference(extension) ? Unused::kKeep : fateBy(extension));
    } else {
      fate = fateBy(member);
    }
    worst = std::max(worst, fate);
  }
  return worst;
}

void visitMember(json& object, const char* key, const Visit& visit) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_number_integer() && *found >= 0) visit(*found);
}

void visitAll(json& map, const Visit& visit) {
  for (auto& [key, value] : map.items())
    if (value.is_number_integer() && value >= 0) visit(value);
}

/// The elements of a list or the members of an object; none if there is no such member.
template <class Use>
void each(json& object, const char* key, const Use& use) {
  if (!object.is_object()) return;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_structured()) return;
  for (json& element : *found)
    use(element);
}

json* extensionOf(json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() || !found->is_object() ? nullptr : &*found;
}

void visitAccessors(json& document, const Visit& visit) {
  each(document, "meshes", [&](json& mesh) {
    each(mesh, "primitives", [&](json& primitive) {
      visitMember(primitive, "indices", visit);
      if (primitive.contains("attributes")) visitAll(primitive["attributes"], visit);
      each(primitive, "targets", [&](json& target) { visitAll(target, visit); });
    });
  });
  each(document, "animations", [&](json& animation) {
    each(animation, "samplers", [&](json& sampler) {
      visitMember(sampler, "input", visit);
      visitMember(sampler, "output", visit);
    });
  });
  each(document, "skins", [&](json& skin) { visitMember(skin, "inverseBindMatrices", visit); });
  each(document, "nodes", [&](json& node) {
    json* instancing = extensionOf(node, "EXT_mesh_gpu_instancing");
    if (instancing != nullptr && instancing->contains("attributes")) visitAll((*instancing)["attributes"], visit);
  });
}

/// The columns of property tables.
void visitMetadataViews(json& document, const Visit& visit) {
  if (json* metadata = extensionOf(document, "EXT_structural_metadata")) {
    each(*metadata, "propertyTables", [&](json& table) {
      each(table, "properties", [&](json& property) {
        for (const char* key : {"values", "arrayOffsets", "stringOffsets"})
          visitMember(property, key, visit);
      });
    });
  }
  if (json* metadata = extensionOf(document, "EXT_feature_metadata")) {
    each(*metadata, "featureTables", [&](json& table) {
      each(table, "properties", [&](json& property) {
        for (const char* key : {"bufferView", "arrayOffsetBufferView", "stringOffsetBufferView"})
          visitMember(property, key, visit);
      });
    });
  }
}

void visitAccessorViews(json& accessor, const Visit& visit) {
  visitMember(accessor, "bufferView", visit);
  const auto sparse = accessor.find("sparse");
  if (sparse == accessor.end() || !sparse->is_object()) return;
  visitMember((*sparse)["indices"], "bufferView", visit);
  visitMember((*sparse)["values"], "bufferView", visit);
}

/// Views that something else than an accessor refers to.
void visitOtherViews(json& document, const Visit& visit) {
  each(document, "images", [&](json& image) { visitMember(image, "bufferView", visit); });
  visitMetadataViews(document, visit);
}

std::size_t sizeOf(const json& document, const char* key) {
  const auto found = document.find(key);
  return found == document.end() ? 0 : found->size();
}

/// @return  for each element its new index, -1 if it goes
std::vector<int> dropElements(json& document, const char* key, const std::vector<bool>& kept) {
  std::vector<int> newIndex(kept.size(), -1);
  json list = json::array();
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    newIndex[i] = static_cast<int>(list.size());
    list.push_back(std::move(document[key][i]));
  }
  if (list.empty()) {
    document.erase(key);
  } else {
    document[key] = std::move(list);
  }
  return newIndex;
}

Visit marker(std::vector<bool>& marks) {
  return [&marks](json& index) {
    const auto at = index.get<std::size_t>();
    if (at >= marks.size())
      throw Error(ErrorCode::kMalformed, fmt::format("a reference to accessor or buffer view {} is out of range", at));
    marks[at] = true;
  };
}

}  // namespace

Unused fateOfUnused(const json& document) {
  return fateBy(document);
}

References findReferences(json& document) {
  References found;
  found.accessors.assign(sizeOf(document, "accessors"), false);
  found.views.assign(sizeOf(document, "bufferViews"), false);
  visitAccessors(document, marker(found.accessors));
  for (std::size_t i = 0; i < found.accessors.size(); ++i)
    if (found.accessors[i]) visitAccessorViews(document["accessors"][i], marker(found.views));
  visitOtherViews(document, marker(found.views));
  return found;
}

References keepUnknown(json& document, json original) {
  References kept = findReferences(document);
  const References known = findReferences(original);
  for (std::size_t i = 0; i < known.accessors.size() && i < kept.accessors.size(); ++i) {
    if (known.accessors[i] || kept.accessors[i]) continue;
    kept.accessors[i] = true;
    visitAccessorViews(document["accessors"][i], marker(kept.views));
  }
  for (std::size_t i = 0; i < known.views.size() && i < kept.views.size(); ++i)
    if (!known.views[i]) kept.views[i] = true;
  return kept;
}

void dropUnreferenced(json& document, const References& kept) {
  const std::vector<int> accessors = dropElements(document, "accessors", kept.accessors);
  visitAccessors(document, [&](json& index) { index = accessors[index.get<std::size_t>()]; });
  const std::vector<int> views = dropElements(document, "bufferViews", kept.views);
  const Visit renumber = [&](json& index) { index = views[index.get<std::size_t>()]; };
  each(document, "accessors", [&](json& accessor) { visitAccessorViews(accessor, renumber); });
  visitOtherViews(document, renumber);
}

void emptyUnreferenced(json& document, const References& kept) {
  for (std::size_t i = 0; i < kept.accessors.size(); ++i)
    if (!kept.accessors[i]) document["accessors"][i] = {{"componentType", 5121}, {"count", 1}, {"type", "SCALAR"}};
  for (std::size_t i = 0; i < kept.views.size(); ++i)
    if (!kept.views[i]) document["bufferViews"][i] = {{"buffer", 0}, {"byteLength", 1}};
}

}  // namespace jalousie::asset::detail
