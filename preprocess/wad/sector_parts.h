// The connected parts of sectors: outlines with holes, and their triangles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "wad/level.h"

namespace jalousie::wad {

/// A connected part of a sector.
struct SectorPart {
  std::uint32_t sector = 0;
  /// Indices of vertices, the part on the left of each edge: first the outline, counter-clockwise, then holes.
  std::vector<std::vector<std::uint32_t>> loops;
};

struct SectorParts {
  std::vector<SectorPart> parts;
  /// By line and side: the part that the side looks into. None where both sides look into one sector.
  std::vector<std::array<std::optional<std::uint32_t>, 2>> partOf;
};

/// Chains the sides of each sector to loops. Errors: kUnsupported (a sector that is not closed), kLimit.
SectorParts divideSectors(const Level& level);

/// Twice the area of a loop, positive if counter-clockwise.
std::int64_t doubleArea(const Level& level, const std::vector<std::uint32_t>& loop);

/// Triangles of a part by cutting ears, counter-clockwise, three indices of vertices each. No vertex of the part lies
/// inside of an edge of a triangle. Holes are joined to the outline by bridges first.
/// Errors: kUnsupported (sides that cross), kLimit.
std::vector<std::uint32_t> triangulate(const Level& level, const SectorPart& part);

}  // namespace jalousie::wad
