// Primitives to triangle lists: indices, strips and fans, missing normals, checks for finite values.
#include "asset/scene_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <string>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

[[noreturn]] void malformed(int mesh, const char* what) {
  throw Error(ErrorCode::kMalformed, fmt::format("mesh {}: {}", mesh, what));
}

template <class Vector>
bool finite(const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i) {
    if (!std::isfinite(v[i])) return false;
  }
  return true;
}

template <class Vector>
void requireFinite(const std::vector<Vector>& values, int mesh, const char* what) {
  for (const Vector& value : values) {
    if (!finite(value)) malformed(mesh, what);
  }
}

/// One primitive while it is read: where it comes from and how its attributes are looked up.
struct Source {
  const tinygltf::Model& model;
  const tinygltf::Primitive& primitive;
  int mesh;
  std::uint64_t vertexCount = 0;

  int accessor(const char* attribute) const {
    const auto found = primitive.attributes.find(attribute);
    return found == primitive.attributes.end() ? -1 : found->second;
  }
  std::uint64_t count(int accessor) const { return model.accessors[static_cast<std::size_t>(accessor)].count; }
};

/// An attribute with as many elements as there are positions, `fill` where the file has none.
template <class Vector, class Read>
std::vector<Vector> attribute(const Source& source, const char* name, const Vector& fill, const Read& read) {
  const int accessor = source.accessor(name);
  if (accessor < 0) return std::vector<Vector>(source.vertexCount, fill);
  std::vector<Vector> values = read(source.model, accessor, source.vertexCount);
  if (values.size() != source.vertexCount) malformed(source.mesh, "attributes differ in length");
  requireFinite(values, source.mesh, "attribute is not finite");
  return values;
}

std::vector<std::uint32_t> stripTriangles(const std::vector<std::uint32_t>& strip) {
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    const std::size_t odd = i % 2;  // every second triangle of a strip is wound the other way
    triangles.insert(triangles.end(), {strip[i], strip[i + 1 + odd], strip[i + 2 - odd]});
  }
  return triangles;
}

std::vector<std::uint32_t> fanTriangles(const std::vector<std::uint32_t>& fan) {
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 1; i + 1 < fan.size(); ++i)
    triangles.insert(triangles.end(), {fan[i], fan[i + 1], fan[0]});
  return triangles;
}

std::vector<std::uint32_t> readTriangles(const Source& source, ElementBudget& budget) {
  std::vector<std::uint32_t> indices;
  if (source.primitive.indices >= 0) {
    const std::uint64_t count = source.count(source.primitive.indices);
    budget.take(count);
    indices =
        readIndices(source.model, source.primitive.indices, static_cast<std::uint32_t>(source.vertexCount), count);
  } else {
    indices.resize(source.vertexCount);
    std::iota(indices.begin(), indices.end(), 0U);
  }
  if (source.primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) return stripTriangles(indices);
  if (source.primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) return fanTriangles(indices);
  indices.resize(indices.size() / 3 * 3);
  return indices;
}

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& fallback) {
  const float length = glm::length(v);
  return length > 0.0F && std::isfinite(length) ? v / length : fallback;
}

/// Flat shading as glTF 2.0, 3.7.2.1 asks where normals are missing: each triangle gets vertices of its own.
void makeFlat(Primitive& primitive) {
  Primitive flat;
  flat.material = primitive.material;
  flat.indices.resize(primitive.indices.size());
  std::iota(flat.indices.begin(), flat.indices.end(), 0U);
  for (const std::uint32_t index : primitive.indices) {
    flat.positions.push_back(primitive.positions[index]);
    flat.uvs.push_back(primitive.uvs[index]);
    flat.colors.push_back(primitive.colors[index]);
    if (!primitive.uvs1.empty()) flat.uvs1.push_back(primitive.uvs1[index]);
  }
  for (std::size_t i = 0; i < flat.positions.size(); i += 3) {
    const glm::vec3 edge1 = flat.positions[i + 1] - flat.positions[i];
    const glm::vec3 edge2 = flat.positions[i + 2] - flat.positions[i];
    flat.normals.insert(flat.normals.end(), 3, unitOr(glm::cross(edge1, edge2), glm::vec3(0.0F, 0.0F, 1.0F)));
  }
  primitive = std::move(flat);
}

Primitive readPrimitive(Source source, const MeshContext& context) {
  ElementBudget& budget = context.budget;
  const int position = source.accessor("POSITION");
  source.vertexCount = source.count(position);
  budget.take(source.vertexCount);
  if (source.vertexCount > 0xFFFFFFFFULL) throw Error(ErrorCode::kLimit, "more than 2^32 vertices");

  Primitive primitive;
  primitive.material =
      static_cast<std::uint32_t>(source.primitive.material >= 0 ? static_cast<std::size_t>(source.primitive.material)
                                                                : context.materials.size() - 1);
  primitive.indices = readTriangles(source, budget);
  if (primitive.indices.empty()) return primitive;
  const bool flat = source.accessor("NORMAL") < 0;
  if (flat) budget.take(primitive.indices.size());
  primitive.positions = attribute<glm::vec3>(source, "POSITION", {}, readVec3);
  primitive.uvs = attribute<glm::vec2>(source, "TEXCOORD_0", glm::vec2(0.0F), readVec2);
  if (usesSecondUvs(context.materials[primitive.material]))
    primitive.uvs1 = attribute<glm::vec2>(source, "TEXCOORD_1", glm::vec2(0.0F), readVec2);
  primitive.colors = attribute<glm::vec4>(source, "COLOR_0", glm::vec4(1.0F), readVec4);
  if (!flat) primitive.normals = attribute<glm::vec3>(source, "NORMAL", {}, readVec3);
  if (!context.pose.isRest()) {
    applyPose(source.model, source.primitive, context.pose, budget, {primitive.positions, primitive.normals});
    requireFinite(primitive.positions, source.mesh, "a pose is not finite");
  }
  if (flat) {
    makeFlat(primitive);
    return primitive;
  }
  for (glm::vec3& normal : primitive.normals)
    normal = unitOr(normal, glm::vec3(0.0F, 0.0F, 1.0F));
  return primitive;
}

/// What Primitive::cellEnds holds.
std::vector<std::uint32_t> cellEnds(const std::vector<std::uint32_t>& triangles) {
  std::vector<std::uint32_t> ends;
  ends.reserve(triangles.size());
  std::uint32_t end = 0;  // at most the primitive's number of indices
  for (const std::uint32_t count : triangles)
    ends.push_back(end += 3 * count);
  return ends;
}

}  // namespace

void ElementBudget::take(std::uint64_t elements) {
  if (elements > left) throw Error(ErrorCode::kLimit, "the scene's meshes have too many vertices and indices");
  left -= elements;
}

Mesh readMesh(const tinygltf::Model& model, int mesh, const MeshContext& context) {
  const tinygltf::Mesh& source = model.meshes[static_cast<std::size_t>(mesh)];
  Mesh result;
  result.name = source.name;
  const CellTriangles cells = lodCells(model, source);
  for (std::size_t p = 0; p < source.primitives.size(); ++p) {
    const tinygltf::Primitive& primitive = source.primitives[p];
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || !primitive.attributes.contains("POSITION")) continue;
    Primitive read = readPrimitive({model, primitive, mesh}, context);
    if (read.indices.empty()) continue;
    if (!cells.empty()) read.cellEnds = cellEnds(cells[p]);
    result.primitives.push_back(std::move(read));
  }
  return result;
}

}  // namespace jalousie::asset::detail
