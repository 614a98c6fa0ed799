// Foliage and other crowds of loose parts: which parts go first, and how the others grow to keep the area.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/mesh/loose_parts.h"
#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

/// Loose parts with open borders, of one primitive and of similar area (a factor of 4) and radius (a factor of 2) are a
/// class if they are kLeastInClass or more.
/// Parts of a class leave in an order that keeps the rest evenly spread, and the rest grows so that the class keeps its
/// area (Cook et al. 2007, stochastic simplification of aggregate detail).
struct PartClasses {
  static constexpr std::uint32_t kNone = ~0U;
  static constexpr std::uint32_t kLeastInClass = 32;
  std::vector<std::uint32_t> partOfVertex;  ///< of each vertex of the mesh
  std::vector<std::uint32_t> classOf;       ///< of each part; kNone: in no class
  std::vector<double> areas;                ///< of each class, object space
  std::vector<std::uint32_t> sizes;         ///< parts of each class
  std::vector<double> extents;              ///< of each class, diagonal of the box of all its parts, object space
  std::vector<std::uint8_t> isOneOfMany;    ///< of each part: 1 if kLeastInClass or more are like it, open or closed
  std::vector<double> costs;                ///< of removing each part, unit frame; comparable to those of collapses
};

/// @param scale  the object-space length that is 1 in the unit frame
PartClasses classifyParts(const WedgeMesh& mesh, const EdgeTable& edges, const LooseParts& parts, double scale);

/// Scales the parts of a level about their centres so that each class has its area: uniformly for parts that are gone,
/// across their longest direction for area that the rest has lost or gained. No vertex moves by more than about half
/// the distance between the parts that are left.
/// @param vertexMap  for each vertex of the original the one of the level, or ~0
void growParts(const PartClasses& classes, std::span<const std::uint32_t> vertexMap, WedgeMesh& level);

/// For each vertex of the level its part. @param vertexMap  as for growParts
std::vector<std::uint32_t> partsOfLevel(const PartClasses& classes, std::span<const std::uint32_t> vertexMap,
                                        const WedgeMesh& level);

}  // namespace jalousie::bake
