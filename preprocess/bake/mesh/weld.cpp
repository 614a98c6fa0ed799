// Sorts indices by position; equal positions become neighbours.
#include "bake/mesh/weld.h"

#include <algorithm>
#include <numeric>

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

}  // namespace jalousie::bake
