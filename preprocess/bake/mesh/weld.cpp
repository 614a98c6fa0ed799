// Sorts indices by position; equal positions become neighbours.
#include "bake/mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace jalousie::bake {

std::vector<std::uint32_t> weldByPosition(std::span<const glm::vec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec3& p = positions[a];
    const glm::vec3& q = positions[b];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    if (p.z != q.z) return p.z < q.z;
    return a < b;
  });
  std::vector<std::uint32_t> ids(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    ids[order[i]] = i > 0 && positions[order[i]] == positions[order[i - 1]] ? ids[order[i - 1]] : order[i];
  return ids;
}

namespace {

/// A cell of a grid whose cells are as large as the distance.
struct Cell {
  std::int64_t x, y, z;
  bool operator==(const Cell&) const = default;
};

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    const auto mix = [](std::uint64_t h, std::int64_t v) {
      return (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15ULL;
    };
    const std::uint64_t h = mix(mix(mix(0, cell.x), cell.y), cell.z);
    return static_cast<std::size_t>(h ^ h >> 32U);
  }
};

}  // namespace

std::uint64_t snapPositions(std::vector<glm::vec3>& positions, double distance) {
  if (!(distance > 0.0)) return 0;
  const auto coordinate = [&](float x) {
    return static_cast<std::int64_t>(std::floor(std::clamp(x / distance, -4e18, 4e18)));
  };
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;  // positions that others may snap to
  std::uint64_t moved = 0;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    glm::vec3& p = positions[v];
    const Cell own{coordinate(p.x), coordinate(p.y), coordinate(p.z)};
    std::uint32_t nearest = v;
    for (int k = 0; k < 27; ++k) {
      const auto found = cells.find({own.x + k % 3 - 1, own.y + k / 3 % 3 - 1, own.z + k / 9 - 1});
      if (found == cells.end()) continue;
      for (const std::uint32_t other : found->second)
        if (other < nearest && glm::distance(glm::dvec3(p), glm::dvec3(positions[other])) <= distance) nearest = other;
    }
    if (nearest == v) {
      cells[own].push_back(v);
    } else if (p != positions[nearest]) {
      p = positions[nearest];
      ++moved;
    }
  }
  return moved;
}

}  // namespace jalousie::bake
