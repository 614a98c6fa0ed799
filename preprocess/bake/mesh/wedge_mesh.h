// The mesh that is simplified: topology on welded positions, attributes on wedges.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace jalousie::bake {

enum class AttributeKind : std::uint8_t { kNormal, kTangent, kUv, kColor, kOther };

/// Where one glTF attribute lies among a wedge's floats.
struct AttributeSlot {
  std::string name;  ///< glTF semantic
  std::uint32_t components = 0;
  std::uint32_t offset = 0;
  AttributeKind kind = AttributeKind::kOther;
};

/// Triangles whose corners are wedges. A wedge is one vertex with one set of attributes in one primitive. A texture
/// seam, a hard edge or the border between two materials has several wedges at one vertex, so it stays closed.
struct WedgeMesh {
  std::vector<AttributeSlot> slots;        ///< union over all primitives, POSITION excluded
  std::uint32_t stride = 0;                ///< floats per wedge
  std::vector<glm::vec3> positions;        ///< [V] object space
  std::vector<std::uint32_t> vertexOf;     ///< [W] below V
  std::vector<std::uint32_t> primitiveOf;  ///< [W]
  std::vector<float> attributes;           ///< [W * stride]; zeros where a primitive lacks the attribute
  std::vector<std::uint32_t> corners;      ///< [3 F] wedges
  std::vector<std::uint32_t> sourceWedge;  ///< [W] its wedge in the finest mesh

  std::uint32_t triangles() const { return static_cast<std::uint32_t>(corners.size() / 3); }
  /// Vertex of corner c.
  std::uint32_t vertexAt(std::size_t c) const { return vertexOf[corners[c]]; }
  /// The slot of a semantic, null if there is none.
  const AttributeSlot* slot(const std::string& name) const;
  glm::vec3 vec3At(std::uint32_t wedge, const AttributeSlot& slot) const {
    const float* values = &attributes[std::size_t{wedge} * stride + slot.offset];
    return {values[0], values[1], values[2]};
  }
};

/// The vertices of all corners, in threes.
std::vector<std::uint32_t> vertexIndices(const WedgeMesh& mesh);

}  // namespace jalousie::bake
