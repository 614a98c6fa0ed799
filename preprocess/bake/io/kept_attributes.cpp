// Copies elements as bytes, so that integers of 32 bits keep all of them.
#include "bake/io/kept_attributes.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>

#include "asset/accessor.h"

namespace jalousie::bake {
namespace {

constexpr std::uint32_t kNone = ~0U;

bool mustBeKept(const std::string& name, const tinygltf::Accessor& accessor) {
  if (name.starts_with("_FEATURE_ID") || name.starts_with("_BATCHID")) return true;
  return name.starts_with("_") && accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !accessor.normalized;
}

/// Adds vertices of a primitive to a region.
class RegionBuilder {
 public:
  RegionBuilder(const Region& whole, Region& region, std::vector<std::uint32_t>& newIndex)
      : whole_(whole), region_(region), newIndex_(newIndex) {
    region_.data.source = whole.data.source;
    for (const Attribute& attribute : whole.data.attributes)
      region_.data.attributes.push_back({attribute.name, attribute.components, {}});
  }

  void add(std::uint32_t vertex) {
    if (newIndex_[vertex] == kNone) {
      newIndex_[vertex] = region_.data.vertexCount++;
      vertices_.push_back(vertex);
      region_.sourceVertex.push_back(whole_.sourceVertex[vertex]);
      for (std::size_t a = 0; a < whole_.data.attributes.size(); ++a) {
        const Attribute& from = whole_.data.attributes[a];
        const float* values = &from.values[std::size_t{vertex} * from.components];
        std::vector<float>& to = region_.data.attributes[a].values;
        to.insert(to.end(), values, values + from.components);
      }
    }
    region_.indices.push_back(newIndex_[vertex]);
  }

  ~RegionBuilder() {
    for (const std::uint32_t vertex : vertices_)
      newIndex_[vertex] = kNone;
  }
  RegionBuilder(const RegionBuilder&) = delete;
  RegionBuilder& operator=(const RegionBuilder&) = delete;

 private:
  const Region& whole_;
  Region& region_;
  std::vector<std::uint32_t>& newIndex_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace

std::vector<KeptAttribute> keptAttributes(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  std::vector<KeptAttribute> kept;
  for (const auto& [name, accessor] : primitive.attributes)
    if (mustBeKept(name, model.accessors[static_cast<std::size_t>(accessor)])) kept.push_back({name, accessor});
  return kept;
}

PackedElements packedElements(const tinygltf::Model& model, int accessor, const std::vector<std::uint32_t>& vertices,
                              std::uint64_t limit) {
  std::vector<std::uint32_t> elements = vertices;
  const std::size_t count = model.accessors[static_cast<std::size_t>(accessor)].count;
  if (elements.empty()) {
    elements.resize(count);
    std::iota(elements.begin(), elements.end(), 0U);
  }
  const tinygltf::Model extract = asset::extractElements(model, accessor, elements, limit);
  const auto& view = extract.bufferViews.at(0);
  const auto* bytes = extract.buffers.at(0).data.data() + view.byteOffset;
  const std::size_t size = view.byteLength / elements.size();
  PackedElements packed;
  packed.elementBytes = (size + 3) / 4 * 4;
  packed.bytes.resize(packed.elementBytes * elements.size(), std::byte{0});
  for (std::size_t i = 0; i < elements.size(); ++i)
    std::memcpy(&packed.bytes[i * packed.elementBytes], bytes + i * size, size);
  return packed;
}

int appendElements(tinygltf::Model& model, int accessor, const std::vector<std::uint32_t>& elements) {
  const PackedElements packed = packedElements(model, accessor, elements, ~0ULL);
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  tinygltf::Accessor copy;
  copy.bufferView = asset::appendView(model, packed.bytes, TINYGLTF_TARGET_ARRAY_BUFFER, packed.elementBytes);
  copy.componentType = source.componentType;
  copy.type = source.type;
  copy.normalized = source.normalized;
  copy.count = elements.size();
  model.accessors.push_back(std::move(copy));
  return static_cast<int>(model.accessors.size()) - 1;
}

std::vector<Region> divideByValue(Region whole, const std::vector<std::uint32_t>& keys) {
  std::map<std::uint32_t, std::vector<std::size_t>> trianglesOf;
  std::size_t mixed = 0;
  for (std::size_t t = 0; t + 2 < whole.indices.size(); t += 3) {
    const std::uint32_t key = keys[whole.indices[t]];
    trianglesOf[key].push_back(t);
    mixed += key != keys[whole.indices[t + 1]] || key != keys[whole.indices[t + 2]] ? 1U : 0U;
  }
  std::vector<Region> regions;
  if (trianglesOf.size() < 2 || mixed > whole.indices.size() / 3 / 10) {
    regions.push_back(std::move(whole));
    return regions;
  }
  std::vector<std::uint32_t> newIndex(whole.data.vertexCount, kNone);
  for (const auto& [key, triangles] : trianglesOf) {
    Region region;
    {
      RegionBuilder builder(whole, region, newIndex);
      for (const std::size_t t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
          builder.add(whole.indices[t + k]);
    }
    regions.push_back(std::move(region));
  }
  regions.front().data.repairedValues = whole.data.repairedValues;
  return regions;
}

}  // namespace jalousie::bake
