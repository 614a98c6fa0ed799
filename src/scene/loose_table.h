// Points and lines as one vertex buffer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asset/scene_types.h"
#include "core/aabb.h"
#include "scene/vertex.h"

namespace jalousie::scene {

/// Points and lines of all nodes. They have no object: they are drawn whole in each frame, and hide nothing.
struct LooseTable {
  /// World space: two for each segment, then the points. A normal of 0: it is not lit.
  std::vector<Vertex> vertices;
  std::uint32_t lineVertices = 0;  ///< how many of them belong to segments

  std::uint32_t points() const { return static_cast<std::uint32_t>(vertices.size()) - lineVertices; }
  std::uint32_t segments() const { return lineVertices / 2; }
};

/// Where the vertices of a loose instance lie; 0 and 0 where it is hidden.
struct LoosePlace {
  std::uint32_t firstLine = 0;  ///< index into LooseTable::vertices
  std::uint32_t firstPoint = 0;
  bool isShown = false;
};

struct LooseScene {
  LooseTable table;
  Aabb boundsWorld;                ///< of all, the hidden ones as well
  std::vector<LoosePlace> places;  ///< by SceneFile::looseInstances
};

/// Segments of all instances, then their points. @param hidden  instances that are left out, ascending
/// Errors: kLimit if there are more than 32-bit counts reach.
LooseScene makeLooseScene(const asset::SceneFile& file, std::span<const std::uint32_t> hidden);

}  // namespace jalousie::scene
