// Primitives to lists of triangles, segments and points: indices, strips, missing normals, checks for finite values.
#include "asset/scene_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "asset/lod_faces.h"
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

/// The vertices of a primitive in the order in which it uses them.
std::vector<std::uint32_t> readElements(const Source& source, ElementBudget& budget) {
  if (source.primitive.indices >= 0) {
    const std::uint64_t count = source.count(source.primitive.indices);
    budget.take(count);
    return readIndices(source.model, source.primitive.indices, static_cast<std::uint32_t>(source.vertexCount), count);
  }
  std::vector<std::uint32_t> indices(source.vertexCount);
  std::iota(indices.begin(), indices.end(), 0U);
  return indices;
}

std::vector<std::uint32_t> readTriangles(const Source& source, ElementBudget& budget) {
  std::vector<std::uint32_t> indices = readElements(source, budget);
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

void countVertices(Source& source, ElementBudget& budget) {
  source.vertexCount = source.count(source.accessor("POSITION"));
  budget.take(source.vertexCount);
  if (source.vertexCount > 0xFFFFFFFFULL) throw Error(ErrorCode::kLimit, "more than 2^32 vertices");
}

std::uint32_t materialOf(const Source& source, const MeshContext& context) {
  const int material = source.primitive.material;
  return static_cast<std::uint32_t>(material >= 0 ? static_cast<std::size_t>(material) : context.materials.size() - 1);
}

/// Reads the attributes of a primitive and bends them. Normals stay empty where the file has none, and are not unit.
/// @param bending  as readMesh, of one primitive; may be null
void readAttributes(const Source& source, const MeshContext& context, Primitive& primitive,
                    PrimitiveBending* bending = nullptr) {
  primitive.positions = attribute<glm::vec3>(source, "POSITION", {}, readVec3);
  primitive.uvs = attribute<glm::vec2>(source, "TEXCOORD_0", glm::vec2(0.0F), readVec2);
  if (usesSecondUvs(context.materials[primitive.material]))
    primitive.uvs1 = attribute<glm::vec2>(source, "TEXCOORD_1", glm::vec2(0.0F), readVec2);
  primitive.colors = attribute<glm::vec4>(source, "COLOR_0", glm::vec4(1.0F), readVec4);
  if (source.accessor("NORMAL") >= 0) primitive.normals = attribute<glm::vec3>(source, "NORMAL", {}, readVec3);
  if (bending != nullptr)
    *bending = readBending(source.model, source.primitive, *context.tables, context.budget,
                           {primitive.positions, primitive.normals});
  if (context.pose.isRest()) return;
  applyPose(source.model, source.primitive, context.pose, context.budget, {primitive.positions, primitive.normals});
  requireFinite(primitive.positions, source.mesh, "a pose is not finite");
}

Primitive readPrimitive(Source source, const MeshContext& context, PrimitiveBending* bending) {
  ElementBudget& budget = context.budget;
  countVertices(source, budget);
  Primitive primitive;
  primitive.material = materialOf(source, context);
  primitive.indices = readTriangles(source, budget);
  if (primitive.indices.empty()) return primitive;
  const bool flat = source.accessor("NORMAL") < 0;
  if (flat) budget.take(primitive.indices.size());
  readAttributes(source, context, primitive, bending);
  if (flat) {
    if (bending != nullptr) *bending = flatBending(*bending, primitive.indices, budget);
    makeFlat(primitive);
    return primitive;
  }
  for (glm::vec3& normal : primitive.normals)
    normal = unitOr(normal, glm::vec3(0.0F, 0.0F, 1.0F));
  return primitive;
}

/// Pairs of vertices of the segments that lines, a strip or a loop consist of.
std::vector<std::uint32_t> segmentsOf(std::vector<std::uint32_t> elements, int mode) {
  if (mode == TINYGLTF_MODE_LINE) {
    elements.resize(elements.size() / 2 * 2);
    return elements;
  }
  std::vector<std::uint32_t> segments;
  for (std::size_t i = 0; i + 1 < elements.size(); ++i)
    segments.insert(segments.end(), {elements[i], elements[i + 1]});
  if (mode == TINYGLTF_MODE_LINE_LOOP && elements.size() > 1)
    segments.insert(segments.end(), {elements.back(), elements.front()});
  return segments;
}

/// Adds a primitive of points or lines.
void addLoose(Source source, const MeshContext& context, LooseGeometry& geometry) {
  countVertices(source, context.budget);
  std::vector<std::uint32_t> elements = readElements(source, context.budget);
  const int mode = source.primitive.mode;
  context.budget.take(looseVertexCount(source.primitive, elements.size()));
  if (mode != TINYGLTF_MODE_POINTS) elements = segmentsOf(std::move(elements), mode);
  Primitive primitive;
  primitive.material = materialOf(source, context);
  readAttributes(source, context, primitive);
  std::vector<LooseVertex>& vertices = mode == TINYGLTF_MODE_POINTS ? geometry.points : geometry.lines;
  for (const std::uint32_t v : elements) {
    const glm::vec3 normal =
        primitive.normals.empty() ? glm::vec3(0.0F) : unitOr(primitive.normals[v], glm::vec3(0.0F));
    vertices.push_back({primitive.positions[v], normal, primitive.uvs[v], primitive.colors[v], primitive.material});
  }
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

Mesh readMesh(const tinygltf::Model& model, int mesh, const MeshContext& context,
              std::vector<PrimitiveBending>* bending) {
  const tinygltf::Mesh& source = model.meshes[static_cast<std::size_t>(mesh)];
  Mesh result;
  result.name = source.name;
  const CellTriangles cells = lodCells(model, source);
  const LodFaces faces = lodFaces(model, source);
  for (std::size_t p = 0; p < source.primitives.size(); ++p) {
    const tinygltf::Primitive& primitive = source.primitives[p];
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || !primitive.attributes.contains("POSITION")) continue;
    PrimitiveBending own;
    const bool isBent = context.tables != nullptr && bending != nullptr;
    Primitive read = readPrimitive({model, primitive, mesh}, context, isBent ? &own : nullptr);
    if (read.indices.empty()) continue;
    if (isBent) bending->push_back(std::move(own));
    if (!cells.empty() && !isBent) read.cellEnds = cellEnds(cells[p]);
    if (!faces.trees.empty() && !isBent) read.faceTree = faces.trees[p];
    result.primitives.push_back(std::move(read));
  }
  return result;
}

bool isLoose(const tinygltf::Primitive& primitive) {
  return primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES &&
         primitive.attributes.contains("POSITION");
}

bool hasLooseGeometry(const tinygltf::Mesh& mesh) {
  return std::any_of(mesh.primitives.begin(), mesh.primitives.end(), isLoose);
}

std::uint64_t looseVertexCount(const tinygltf::Primitive& primitive, std::uint64_t elements) {
  const bool isJoined = primitive.mode == TINYGLTF_MODE_LINE_STRIP || primitive.mode == TINYGLTF_MODE_LINE_LOOP;
  return isJoined ? 2 * elements : elements;
}

LooseGeometry readLooseGeometry(const tinygltf::Model& model, int mesh, const MeshContext& context) {
  LooseGeometry geometry;
  for (const tinygltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(mesh)].primitives)
    if (isLoose(primitive)) addLoose({model, primitive, mesh}, context, geometry);
  return geometry;
}

}  // namespace jalousie::asset::detail
