// Sorts border vertices by transform and position, and compares neighbours.
#include "bake/io/touching_meshes.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace jalousie::bake {
namespace {

struct Place {
  std::uint32_t transform = 0;
  glm::vec3 position{0.0F};
  std::uint32_t mesh = 0;
};

bool isBefore(const glm::vec3& a, const glm::vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

bool isLess(const Place& a, const Place& b) {
  if (a.transform != b.transform) return a.transform < b.transform;
  if (a.position != b.position) return isBefore(a.position, b.position);
  return a.mesh < b.mesh;
}

std::array<double, 16> numbersOf(const glm::dmat4& transform) {
  std::array<double, 16> numbers{};
  for (int k = 0; k < 16; ++k)
    numbers[static_cast<std::size_t>(k)] = transform[k / 4][k % 4];
  return numbers;
}

}  // namespace

std::vector<std::vector<glm::vec3>> touchingPlaces(std::span<const MeshBorder> meshes) {
  std::map<std::array<double, 16>, std::uint32_t> numberOf;
  std::vector<Place> places;
  for (std::uint32_t m = 0; m < meshes.size(); ++m) {
    for (const glm::dmat4& transform : meshes[m].transforms) {
      const auto next = static_cast<std::uint32_t>(numberOf.size());
      const std::uint32_t number = numberOf.try_emplace(numbersOf(transform), next).first->second;
      for (const glm::vec3& position : meshes[m].places)
        places.push_back({number, position, m});
    }
  }
  std::sort(places.begin(), places.end(), isLess);
  std::vector<std::vector<glm::vec3>> touching(meshes.size());
  for (std::size_t first = 0; first < places.size();) {
    std::size_t end = first + 1;
    while (end < places.size() && places[end].transform == places[first].transform &&
           places[end].position == places[first].position)
      ++end;
    if (places[first].mesh != places[end - 1].mesh)
      for (std::size_t i = first; i < end; ++i)
        touching[places[i].mesh].push_back(places[i].position);
    first = end;
  }
  for (std::vector<glm::vec3>& own : touching) {
    std::sort(own.begin(), own.end(), isBefore);
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  return touching;
}

std::vector<std::uint8_t> verticesAt(const WedgeMesh& mesh, std::span<const glm::vec3> places) {
  std::vector<std::uint8_t> marks;
  if (places.empty()) return marks;
  for (const glm::vec3& position : mesh.positions)
    marks.push_back(std::binary_search(places.begin(), places.end(), position, isBefore) ? 1 : 0);
  return marks;
}

}  // namespace jalousie::bake
