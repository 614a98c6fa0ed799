// Converts between glTF accessors and CombinedMesh, with checked reads.
#include "bake/io/gltf_mesh.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "asset/accessor.h"
#include "asset/gltf_known.h"
#include "bake/io/kept_attributes.h"
#include "bake/mesh/bounds.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::bake {

bool hasTriangles(const tinygltf::Primitive& primitive) {
  return primitive.mode == -1 || primitive.mode >= TINYGLTF_MODE_TRIANGLES;
}

namespace {

constexpr std::size_t kMostAttributes = 16;  ///< streams that meshopt_generateVertexRemapMulti takes

template <class T>
std::vector<float> flattened(const std::vector<T>& values) {
  std::vector<float> result;
  result.reserve(values.size() * static_cast<std::size_t>(T::length()));
  for (const T& value : values)
    for (int k = 0; k < T::length(); ++k)
      result.push_back(value[k]);
  return result;
}

Attribute readAttribute(const tinygltf::Model& model, const std::string& name, int accessor, std::uint64_t limit) {
  switch (model.accessors[static_cast<std::size_t>(accessor)].type) {
    case TINYGLTF_TYPE_SCALAR:
      return {name, 1, asset::readScalars(model, accessor, limit)};
    case TINYGLTF_TYPE_VEC2:
      return {name, 2, flattened(asset::readVec2(model, accessor, limit))};
    case TINYGLTF_TYPE_VEC3:
      if (name.starts_with("COLOR_")) break;  // becomes VEC4 with alpha 1
      return {name, 3, flattened(asset::readVec3(model, accessor, limit))};
    default:
      break;
  }
  return {name, 4, flattened(asset::readVec4(model, accessor, limit))};
}

/// The vertices to read: all if the list is empty.
Attribute readAttributeOf(const tinygltf::Model& model, const std::string& name, int accessor,
                          const std::vector<std::uint32_t>& vertices, std::uint64_t limit) {
  if (vertices.empty()) return readAttribute(model, name, accessor, limit);
  return readAttribute(asset::extractElements(model, accessor, vertices, limit), name, 0, limit);
}

/// Many primitives may share one large vertex buffer. If a primitive uses less than half of it, returns the vertices
/// it uses, in ascending order, and rewrites the indices to number these; else returns an empty list.
std::vector<std::uint32_t> usedVertices(std::vector<std::uint32_t>& indices, std::uint32_t vertexCount) {
  if (indices.empty() || indices.size() > vertexCount / 2) return {};
  std::vector<std::uint32_t> used = indices;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& index : indices)
    index = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), index) - used.begin());
  return used;
}

/// Matrices cannot be averaged.
bool isMatrix(const tinygltf::Model& model, int accessor) {
  const int type = model.accessors[static_cast<std::size_t>(accessor)].type;
  return type == TINYGLTF_TYPE_MAT2 || type == TINYGLTF_TYPE_MAT3 || type == TINYGLTF_TYPE_MAT4;
}

std::uint32_t countOf(const tinygltf::Model& model, int accessor, std::uint64_t limit) {
  const std::uint64_t count = model.accessors[static_cast<std::size_t>(accessor)].count;
  if (count > limit) throw Error(ErrorCode::kLimit, fmt::format("an accessor has {} elements", count));
  return static_cast<std::uint32_t>(count);
}

/// The triangles of a list, a strip or a fan, in the order and the winding of glTF 2.0, 3.7.2.1.
std::vector<std::uint32_t> trianglesOfMode(std::vector<std::uint32_t> indices, int mode) {
  std::vector<std::uint32_t> triangles;
  if (mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) {
    indices.resize(indices.size() / 3 * 3);
    return indices;
  }
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    const std::size_t odd = i % 2;
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      triangles.insert(triangles.end(), {indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
    } else {
      triangles.insert(triangles.end(), {indices[i + 1], indices[i + 2], indices[0]});
    }
  }
  return triangles;
}

std::vector<std::uint32_t> readIndicesOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                         std::uint32_t vertexCount, std::uint64_t limit) {
  std::vector<std::uint32_t> indices;
  if (primitive.indices >= 0) {
    indices = asset::readIndices(model, primitive.indices, vertexCount, limit);
  } else {
    indices.resize(vertexCount);
    std::iota(indices.begin(), indices.end(), 0U);
  }
  return trianglesOfMode(std::move(indices), primitive.mode);
}

/// @param vertices  see readAttributeOf
void readAttributes(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                    const std::vector<std::uint32_t>& vertices, std::uint64_t limit, PrimitiveData& data) {
  const int positions = primitive.attributes.at("POSITION");
  data.attributes.push_back(readAttributeOf(model, "POSITION", positions, vertices, limit));
  data.vertexCount = static_cast<std::uint32_t>(data.attributes[0].values.size() / 3);
  const std::vector<KeptAttribute> kept = keptAttributes(model, primitive);
  for (const auto& [name, accessor] : primitive.attributes) {
    if (name == "POSITION") continue;
    const std::string& key = name;
    const bool isKept =
        std::any_of(kept.begin(), kept.end(), [&](const KeptAttribute& attribute) { return attribute.name == key; });
    if (countOf(model, accessor, limit) != countOf(model, positions, limit))
      throw Error(ErrorCode::kMalformed, "attributes of one primitive have different counts");
    if (isKept) continue;
    data.attributes.push_back(readAttributeOf(model, name, accessor, vertices, limit));
    const Attribute& attribute = data.attributes.back();
    if (attribute.values.size() != std::size_t{data.vertexCount} * attribute.components)
      throw Error(ErrorCode::kMalformed, "attributes of one primitive have different counts");
    for (float& value : data.attributes.back().values) {
      if (std::isfinite(value)) continue;
      value = 0.0F;
      ++data.repairedValues;
    }
  }
}

/// Shares bit-identical vertices: rewrites indices and compacts the attributes. @param kept  further bytes that count
/// @return  per vertex its new index, ~0 if it is not used
/// @pre indices in threes, below vertexCount, at least three; at most kMostAttributes attributes, of at most 4 floats
std::vector<std::uint32_t> shareVertices(PrimitiveData& data, std::vector<std::uint32_t>& indices,
                                         const std::vector<PackedElements>& kept) {
  JAL_CHECK((data.attributes.size() + kept.size() <= kMostAttributes && indices.size() % 3 == 0 && !indices.empty()));
  std::vector<meshopt_Stream> streams;
  for (const Attribute& attribute : data.attributes) {
    const std::size_t bytes = attribute.components * sizeof(float);
    streams.push_back({attribute.values.data(), bytes, bytes});
  }
  for (const PackedElements& packed : kept)
    streams.push_back({packed.bytes.data(), packed.elementBytes, packed.elementBytes});
  std::vector<std::uint32_t> remap(data.vertexCount);
  const std::size_t unique = meshopt_generateVertexRemapMulti(remap.data(), indices.data(), indices.size(),
                                                              data.vertexCount, streams.data(), streams.size());
  for (Attribute& attribute : data.attributes) {
    const std::size_t bytes = attribute.components * sizeof(float);
    std::vector<float> compact(unique * attribute.components);
    meshopt_remapVertexBuffer(compact.data(), attribute.values.data(), data.vertexCount, bytes, remap.data());
    attribute.values = std::move(compact);
  }
  meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), remap.data());
  data.vertexCount = static_cast<std::uint32_t>(unique);
  return remap;
}

/// Per vertex the number of its values of the kept attributes, by their first appearance.
std::vector<std::uint32_t> numberValues(const std::vector<PackedElements>& kept, std::size_t vertices) {
  std::map<std::string, std::uint32_t> numbers;
  std::vector<std::uint32_t> keys(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    std::string value;
    for (const PackedElements& packed : kept)
      value.append(reinterpret_cast<const char*>(&packed.bytes[v * packed.elementBytes]), packed.elementBytes);
    keys[v] = numbers.try_emplace(std::move(value), static_cast<std::uint32_t>(numbers.size())).first->second;
  }
  return keys;
}

/// Reads one primitive; those with kept attributes are divided by their values.
std::vector<Region> readRegions(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                std::uint64_t limit) {
  Region whole;
  const std::uint32_t vertexCount = countOf(model, primitive.attributes.at("POSITION"), limit);
  whole.indices = readIndicesOf(model, primitive, vertexCount, limit);
  const std::vector<std::uint32_t> vertices = usedVertices(whole.indices, vertexCount);
  readAttributes(model, primitive, vertices, limit, whole.data);
  std::vector<PackedElements> kept;
  for (const KeptAttribute& attribute : keptAttributes(model, primitive))
    kept.push_back(packedElements(model, attribute.accessor, vertices, limit));
  std::vector<std::uint32_t> remap(whole.data.vertexCount);
  std::iota(remap.begin(), remap.end(), 0U);
  if (!whole.indices.empty()) remap = shareVertices(whole.data, whole.indices, kept);
  std::vector<Region> regions;
  if (kept.empty()) {
    regions.push_back(std::move(whole));
    return regions;
  }
  const std::vector<std::uint32_t> values = numberValues(kept, remap.size());
  std::vector<std::uint32_t> keys(whole.data.vertexCount);
  whole.sourceVertex.resize(whole.data.vertexCount);
  for (std::uint32_t v = static_cast<std::uint32_t>(remap.size()); v-- > 0;) {
    if (remap[v] == ~0U) continue;
    keys[remap[v]] = values[v];
    whole.sourceVertex[remap[v]] = vertices.empty() ? v : vertices[v];
  }
  return divideByValue(std::move(whole), keys);
}

void appendRegion(Region region, CombinedMesh& combined) {
  PrimitiveData& data = region.data;
  data.firstVertex = static_cast<std::uint32_t>(combined.positions.size());
  const std::vector<float>& xyz = data.attributes[0].values;
  for (std::uint32_t v = 0; v < data.vertexCount; ++v)
    combined.positions.emplace_back(xyz[3 * std::size_t{v}], xyz[3 * std::size_t{v} + 1], xyz[3 * std::size_t{v} + 2]);
  combined.primitiveOf.resize(combined.positions.size(), static_cast<std::uint32_t>(combined.primitives.size()));
  for (const std::uint32_t index : region.indices)
    combined.indices.push_back(data.firstVertex + index);
  if (!region.sourceVertex.empty() || !combined.sourceVertex.empty()) {
    combined.sourceVertex.resize(data.firstVertex, 0);
    combined.sourceVertex.insert(combined.sourceVertex.end(), region.sourceVertex.begin(), region.sourceVertex.end());
    combined.sourceVertex.resize(combined.positions.size(), 0);
  }
  combined.primitives.push_back(std::move(data));
}

int appendAttribute(tinygltf::Model& model, const Attribute& attribute, const std::vector<std::uint32_t>& vertices) {
  const auto gather = [&]<class T>(T) {
    std::vector<T> values(vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
      for (int k = 0; k < T::length(); ++k)
        values[v][k] = attribute.values[std::size_t{vertices[v]} * attribute.components + static_cast<std::size_t>(k)];
    return values;
  };
  constexpr int kTarget = TINYGLTF_TARGET_ARRAY_BUFFER;
  if (attribute.components == 2) return asset::appendVec2(model, gather(glm::vec2()), kTarget);
  if (attribute.components == 3) return asset::appendVec3(model, gather(glm::vec3()), kTarget);
  if (attribute.components == 4) return asset::appendVec4(model, gather(glm::vec4()), kTarget);
  std::vector<float> scalars;
  scalars.reserve(vertices.size());
  for (const std::uint32_t v : vertices)
    scalars.push_back(attribute.values[v]);
  return asset::appendScalars(model, scalars, kTarget);
}

/// The regions first to end of a mesh, which come from one glTF primitive.
struct PrimitiveRange {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// Triangles of one glTF primitive, cell by cell.
struct LocalTriangles {
  std::vector<std::uint32_t> indices;    ///< of the primitive's vertices
  std::vector<std::uint32_t> cellSizes;  ///< triangles of each cell
};

LocalTriangles trianglesOf(const CombinedMesh& combined, const PrimitiveRange& range, const CellOrder& order) {
  LocalTriangles local;
  std::size_t at = 0;
  for (const std::uint32_t end : order.ends) {
    const std::size_t before = local.indices.size();
    for (; at < end; ++at) {
      const std::size_t first = 3 * std::size_t{order.triangles[at]};
      const std::uint32_t region = combined.primitiveOf[combined.indices[first]];
      if (region < range.first || region >= range.end) continue;
      for (std::size_t k = 0; k < 3; ++k)
        local.indices.push_back(combined.indices[first + k] - combined.primitives[range.first].firstVertex);
    }
    local.cellSizes.push_back(static_cast<std::uint32_t>((local.indices.size() - before) / 3));
  }
  return local;
}

/// The regions of a glTF primitive, as one.
PrimitiveData joinRegions(const CombinedMesh& combined, const PrimitiveRange& range) {
  PrimitiveData joined = combined.primitives[range.first];
  for (std::size_t p = range.first + 1; p < range.end; ++p) {
    const PrimitiveData& region = combined.primitives[p];
    joined.vertexCount += region.vertexCount;
    for (std::size_t a = 0; a < joined.attributes.size(); ++a)
      joined.attributes[a].values.insert(joined.attributes[a].values.end(), region.attributes[a].values.begin(),
                                         region.attributes[a].values.end());
  }
  return joined;
}

/// A level that is written to a mesh.
struct LevelMesh {
  const CombinedMesh& combined;
  const CellOrder& order;
  asset::FaceGrouping faces;
  Aabb bounds;
  tinygltf::Mesh& mesh;
};

/// Numbers vertices by their first use, in place. @param newIndex  per vertex ~0; it is restored
/// @return  the vertices in their new order
std::vector<std::uint32_t> renumber(std::span<std::uint32_t> indices, std::vector<std::uint32_t>& newIndex) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t& index : indices) {
    if (newIndex[index] == ~0U) {
      newIndex[index] = static_cast<std::uint32_t>(order.size());
      order.push_back(index);
    }
    index = newIndex[index];
  }
  for (const std::uint32_t vertex : order)
    newIndex[vertex] = ~0U;
  return order;
}

/// Whether back faces of a primitive are never seen: groups of them can be culled.
bool isSolid(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  if (primitive.material < 0 || static_cast<std::size_t>(primitive.material) >= model.materials.size()) return true;
  const tinygltf::Material& material = model.materials[static_cast<std::size_t>(primitive.material)];
  return !material.doubleSided && material.alphaMode != "MASK" && material.alphaMode != "BLEND";
}

/// Puts the triangles of each cell in the order of groups. @param positions  of the primitive's vertices
/// @return  the trees of all cells
asset::FaceTree groupCells(LocalTriangles& local, std::span<const glm::vec3> positions, const LevelMesh& level) {
  asset::FaceTree trees;
  std::size_t first = 0;
  for (const std::uint32_t count : local.cellSizes) {
    const std::span cell = std::span(local.indices).subspan(first, 3 * std::size_t{count});
    first += cell.size();
    std::vector<asset::Triangle> triangles;
    for (std::size_t i = 0; i < cell.size(); i += 3)
      triangles.push_back({positions[cell[i]], positions[cell[i + 1]], positions[cell[i + 2]]});
    const asset::FaceOrder order = asset::groupFaces(triangles, level.bounds, level.faces);
    trees.insert(trees.end(), order.tree.begin(), order.tree.end());
    std::vector<std::uint32_t> grouped;
    grouped.reserve(cell.size());
    for (const std::uint32_t t : order.triangles)
      grouped.insert(grouped.end(), {cell[3 * t], cell[3 * t + 1], cell[3 * t + 2]});
    std::copy(grouped.begin(), grouped.end(), cell.begin());
  }
  return trees;
}

/// Reorders each cell for the vertex cache. @param newIndex  per vertex ~0; it is restored
/// @pre indices below the size of newIndex
void optimiseOrder(LocalTriangles& local, std::vector<std::uint32_t>& newIndex) {
  std::size_t first = 0;
  for (const std::uint32_t triangles : local.cellSizes) {
    const std::span cell = std::span(local.indices).subspan(first, 3 * std::size_t{triangles});
    first += cell.size();
    if (cell.empty()) continue;
    // The optimiser's time grows with the number of vertices, so it gets those of the cell.
    const std::vector<std::uint32_t> vertices = renumber(cell, newIndex);
    JAL_CHECK(cell.size() % 3 == 0U);
    meshopt_optimizeVertexCache(cell.data(), cell.data(), cell.size(), vertices.size());
    for (std::uint32_t& index : cell)
      index = vertices[index];
  }
}

}  // namespace

std::string unbakeableReason(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  if (mesh.primitives.empty()) return "it has no primitives";
  if (std::none_of(mesh.primitives.begin(), mesh.primitives.end(), hasTriangles)) return "it has points or lines only";
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    if (!primitive.targets.empty()) return "it has morph targets";
    if (!hasTriangles(primitive)) continue;
    if (!primitive.attributes.contains("POSITION")) return "it has a primitive without positions";
    if (primitive.attributes.contains("JOINTS_0")) return "it is skinned";
    if (primitive.attributes.size() > kMostAttributes)
      return fmt::format("it has a primitive with {} attributes", primitive.attributes.size());
    for (const auto& [name, accessor] : primitive.attributes)
      if (isMatrix(model, accessor)) return fmt::format("its attribute {} is a matrix", oneLine(name));
    for (const auto& [name, extension] : primitive.extensions)
      if (asset::mayReferToVertices(name, extension)) return fmt::format("{} may refer to its vertices", oneLine(name));
  }
  return "";
}

CombinedMesh readCombinedMesh(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const asset::Limits& limits) {
  CombinedMesh combined;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    if (!hasTriangles(mesh.primitives[p])) continue;
    for (Region& region : readRegions(model, mesh.primitives[p], limits.maxAccessorElements)) {
      region.data.source = static_cast<std::uint32_t>(p);
      appendRegion(std::move(region), combined);
    }
  }
  return combined;
}

namespace {

/// Appends one primitive with the triangles of some regions; none if they have no triangle.
void appendPrimitive(tinygltf::Model& model, const tinygltf::Primitive& source, const PrimitiveRange& range,
                     const LevelMesh& level, WrittenMesh& written) {
  LocalTriangles local = trianglesOf(level.combined, range, level.order);
  if (local.indices.empty()) return;
  const PrimitiveData data = joinRegions(level.combined, range);
  std::vector<std::uint32_t> newIndex(data.vertexCount, ~0U);
  optimiseOrder(local, newIndex);
  const bool grouped = level.faces != asset::FaceGrouping::kOff && isSolid(model, source);
  const auto positions = std::span(level.combined.positions).subspan(data.firstVertex, data.vertexCount);
  written.faces.trees.push_back(grouped ? groupCells(local, positions, level) : asset::FaceTree());
  const std::vector<std::uint32_t> vertices = renumber(local.indices, newIndex);
  tinygltf::Primitive primitive = source;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes.clear();
  for (const Attribute& attribute : data.attributes)
    primitive.attributes[attribute.name] = appendAttribute(model, attribute, vertices);
  std::vector<std::uint32_t> elements;
  for (const KeptAttribute& attribute : keptAttributes(model, source)) {
    for (std::size_t v = elements.size(); v < vertices.size(); ++v)
      elements.push_back(level.combined.sourceVertex.at(data.firstVertex + vertices[v]));
    primitive.attributes[attribute.name] = appendElements(model, attribute.accessor, elements);
  }
  primitive.indices = asset::appendIndices(model, local.indices);
  level.mesh.primitives.push_back(std::move(primitive));
  written.vertices += static_cast<std::uint32_t>(vertices.size());
  written.cells.push_back(std::move(local.cellSizes));
}

}  // namespace

WrittenMesh appendLevelMesh(tinygltf::Model& model, const tinygltf::Mesh& source, const CombinedMesh& combined,
                            const CellOrder& order, asset::FaceGrouping faces) {
  tinygltf::Mesh mesh;
  mesh.name = source.name;
  WrittenMesh written;
  written.faces.grouping = faces;
  const LevelMesh level{combined, order, faces, boundsOf(combined.positions), mesh};
  std::size_t at = 0;
  for (std::size_t p = 0; p < source.primitives.size(); ++p) {
    if (!hasTriangles(source.primitives[p])) {
      mesh.primitives.push_back(source.primitives[p]);
      written.cells.emplace_back(order.ends.size(), 0U);
      written.faces.trees.emplace_back();
      continue;
    }
    PrimitiveRange range{at, at};
    while (range.end < combined.primitives.size() && combined.primitives[range.end].source == p)
      ++range.end;
    at = range.end;
    if (range.end > range.first) appendPrimitive(model, source.primitives[p], range, level, written);
  }
  written.mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(std::move(mesh));
  return written;
}

}  // namespace jalousie::bake
