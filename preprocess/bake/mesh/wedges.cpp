// Welds vertices, flattens attributes into wedges, and converts back.
#include "bake/mesh/wedges.h"

#include <algorithm>
#include <cmath>

#include "bake/mesh/back_sheets.h"
#include "bake/mesh/weld.h"

namespace jalousie::bake {
namespace {

constexpr std::uint32_t kUnused = ~0U;

AttributeKind kindOf(const std::string& name) {
  if (name == "NORMAL") return AttributeKind::kNormal;
  if (name == "TANGENT") return AttributeKind::kTangent;
  if (name.starts_with("TEXCOORD_")) return AttributeKind::kUv;
  if (name.starts_with("COLOR_")) return AttributeKind::kColor;
  return AttributeKind::kOther;
}

/// Union of the primitives' attributes; one semantic with different component counts gets a slot per count.
void collectSlots(const CombinedMesh& source, WedgeMesh& mesh) {
  for (const PrimitiveData& primitive : source.primitives) {
    for (const Attribute& attribute : primitive.attributes) {
      if (attribute.name == "POSITION") continue;
      const bool known = std::any_of(mesh.slots.begin(), mesh.slots.end(), [&](const AttributeSlot& slot) {
        return slot.name == attribute.name && slot.components == attribute.components;
      });
      if (known) continue;
      mesh.slots.push_back({attribute.name, attribute.components, mesh.stride, kindOf(attribute.name)});
      mesh.stride += attribute.components;
    }
  }
}

const AttributeSlot& slotOf(const WedgeMesh& mesh, const Attribute& attribute) {
  return *std::find_if(mesh.slots.begin(), mesh.slots.end(), [&](const AttributeSlot& slot) {
    return slot.name == attribute.name && slot.components == attribute.components;
  });
}

/// Unit length for normals and the direction part of tangents; a sign of exactly 1 for their handedness.
void normaliseInto(AttributeKind kind, std::vector<float>& values, std::size_t first) {
  if (kind != AttributeKind::kNormal && kind != AttributeKind::kTangent) return;
  const double length = std::hypot(values[first], values[first + 1], values[first + 2]);
  for (std::size_t k = 0; k < 3; ++k)
    values[first + k] = length > 1e-12 ? static_cast<float>(values[first + k] / length) : (k == 2 ? 1.0F : 0.0F);
  if (kind == AttributeKind::kTangent && values.size() > first + 3)
    values[first + 3] = values[first + 3] < 0.0F ? -1.0F : 1.0F;
}

}  // namespace

WedgeMesh makeWedges(const CombinedMesh& source) {
  WedgeMesh mesh;
  collectSlots(source, mesh);
  const std::vector<std::uint32_t> welded = weldByPosition(source.positions);
  std::vector<std::uint32_t> vertices;
  vertices.reserve(source.indices.size());
  for (const std::uint32_t index : source.indices)
    vertices.push_back(welded[index]);
  const std::vector<std::uint8_t> backs = findBackSheets(vertices);
  const std::size_t sheets = backs.empty() ? 1 : 2;
  std::vector<std::uint32_t> vertexAt(sheets * source.positions.size(), kUnused);
  std::vector<std::uint32_t> wedgeAt(sheets * source.positions.size(), kUnused);
  std::vector<std::uint32_t> indexOf;  // of each wedge in the source
  mesh.corners.reserve(source.indices.size());
  for (std::size_t c = 0; c < source.indices.size(); ++c) {
    const std::uint32_t index = source.indices[c];
    const std::size_t sheet = backs.empty() ? 0 : backs[c / 3];
    std::uint32_t& wedge = wedgeAt[sheets * index + sheet];
    if (wedge == kUnused) {
      std::uint32_t& vertex = vertexAt[sheets * welded[index] + sheet];
      if (vertex == kUnused) {
        vertex = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(source.positions[index]);
      }
      wedge = static_cast<std::uint32_t>(mesh.vertexOf.size());
      mesh.vertexOf.push_back(vertex);
      mesh.primitiveOf.push_back(source.primitiveOf[index]);
      mesh.sourceWedge.push_back(wedge);
      indexOf.push_back(index);
    }
    mesh.corners.push_back(wedge);
  }
  mesh.attributes.assign(mesh.vertexOf.size() * mesh.stride, 0.0F);
  for (const PrimitiveData& primitive : source.primitives) {
    for (const Attribute& attribute : primitive.attributes) {
      if (attribute.name == "POSITION") continue;
      const AttributeSlot& slot = slotOf(mesh, attribute);
      for (std::uint32_t wedge = 0; wedge < indexOf.size(); ++wedge) {
        const std::uint32_t v = indexOf[wedge] - primitive.firstVertex;  // wraps around for earlier primitives
        if (indexOf[wedge] < primitive.firstVertex || v >= primitive.vertexCount) continue;
        std::copy_n(
            attribute.values.begin() + static_cast<std::ptrdiff_t>(std::size_t{v} * attribute.components),
            attribute.components,
            mesh.attributes.begin() + static_cast<std::ptrdiff_t>(std::size_t{wedge} * mesh.stride) + slot.offset);
      }
    }
  }
  return mesh;
}

namespace {

/// Makes the tangents of a primitive perpendicular to their normals.
void straightenTangents(PrimitiveData& data) {
  const auto find = [&](const char* name, std::uint32_t components) -> Attribute* {
    for (Attribute& attribute : data.attributes)
      if (attribute.name == name && attribute.components == components) return &attribute;
    return nullptr;
  };
  const Attribute* normals = find("NORMAL", 3);
  Attribute* tangents = find("TANGENT", 4);
  if (normals == nullptr || tangents == nullptr) return;
  for (std::size_t v = 0; v < data.vertexCount; ++v) {
    const glm::dvec3 n(normals->values[3 * v], normals->values[3 * v + 1], normals->values[3 * v + 2]);
    float* value = &tangents->values[4 * v];
    glm::dvec3 t(value[0], value[1], value[2]);
    const double along = glm::dot(n, t);
    if (std::abs(along) < 1e-3) continue;  // within the precision of float input; the bits are kept
    t -= along * n;
    if (glm::length(t) < 1e-6) t = glm::cross(n, std::abs(n.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
    t = glm::normalize(t);
    for (int k = 0; k < 3; ++k)
      value[k] = static_cast<float>(t[k]);
  }
}

/// The vertex of each wedge that makeWedges made of a mesh: wedges are numbered by the first use of their vertices.
std::vector<std::uint32_t> verticesByFirstUse(const CombinedMesh& mesh) {
  std::vector<bool> seen(mesh.positions.size(), false);
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t index : mesh.indices) {
    if (!seen[index]) vertices.push_back(index);
    seen[index] = true;
  }
  return vertices;
}

/// Fills sourceVertex of a mesh whose vertices are the wedges in the order of their primitives.
void traceVertices(const WedgeMesh& mesh, const CombinedMesh& source,
                   const std::vector<std::vector<std::uint32_t>>& wedgesOf, CombinedMesh& combined) {
  if (source.sourceVertex.empty()) return;
  const std::vector<std::uint32_t> vertices = verticesByFirstUse(source);
  combined.sourceVertex.reserve(combined.positions.size());
  for (const std::vector<std::uint32_t>& wedges : wedgesOf)
    for (const std::uint32_t w : wedges)
      combined.sourceVertex.push_back(source.sourceVertex[vertices.at(mesh.sourceWedge[w])]);
}

}  // namespace

CombinedMesh combineWedges(const WedgeMesh& mesh, const CombinedMesh& source) {
  CombinedMesh combined;
  const std::size_t primitives = source.primitives.size();
  std::vector<std::vector<std::uint32_t>> wedgesOf(primitives);
  for (std::uint32_t w = 0; w < mesh.vertexOf.size(); ++w)
    wedgesOf[mesh.primitiveOf[w]].push_back(w);
  std::vector<std::uint32_t> vertexOfWedge(mesh.vertexOf.size());
  for (std::size_t p = 0; p < primitives; ++p) {
    PrimitiveData data;
    data.source = source.primitives[p].source;
    data.firstVertex = static_cast<std::uint32_t>(combined.positions.size());
    data.vertexCount = static_cast<std::uint32_t>(wedgesOf[p].size());
    for (const std::uint32_t w : wedgesOf[p]) {
      vertexOfWedge[w] = static_cast<std::uint32_t>(combined.positions.size());
      combined.positions.push_back(mesh.positions[mesh.vertexOf[w]]);
      combined.primitiveOf.push_back(static_cast<std::uint32_t>(p));
    }
    for (const Attribute& attribute : source.primitives[p].attributes) {
      Attribute copy{attribute.name, attribute.components, {}};
      copy.values.reserve(wedgesOf[p].size() * attribute.components);
      const bool isPosition = attribute.name == "POSITION";
      const AttributeSlot slot = isPosition ? AttributeSlot() : slotOf(mesh, attribute);
      for (const std::uint32_t w : wedgesOf[p]) {
        const std::size_t first = copy.values.size();
        for (std::uint32_t k = 0; k < attribute.components; ++k)
          copy.values.push_back(isPosition ? mesh.positions[mesh.vertexOf[w]][static_cast<int>(k)]
                                           : mesh.attributes[std::size_t{w} * mesh.stride + slot.offset + k]);
        if (!isPosition) normaliseInto(slot.kind, copy.values, first);
      }
      data.attributes.push_back(std::move(copy));
    }
    straightenTangents(data);
    combined.primitives.push_back(std::move(data));
  }
  traceVertices(mesh, source, wedgesOf, combined);
  combined.indices.reserve(mesh.corners.size());
  for (const std::uint32_t wedge : mesh.corners)
    combined.indices.push_back(vertexOfWedge[wedge]);
  return combined;
}

}  // namespace jalousie::bake
