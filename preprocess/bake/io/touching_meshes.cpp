// Puts border vertices into the cells of a grid in the scene, and compares those of one cell and of cells nearby.
#include "bake/io/touching_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

namespace jalousie::bake {
namespace {

/// Equal places differ by the rounding of different transforms: of the diagonal of all places.
constexpr double kTolerance = 1e-6;
/// Side of a cell, in tolerances.
constexpr double kCell = 16.0;
/// Places of a cell with more are not compared one by one: all of them touch if they belong to several.
constexpr std::ptrdiff_t kCrowded = 1024;
/// A mesh of many nodes is looked at in the first of them only.
constexpr std::size_t kMostPlaces = 1U << 22U;

bool isBefore(const glm::vec3& a, const glm::vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// A border vertex of a mesh at a node.
struct Place {
  std::array<std::int64_t, 3> cell{};
  glm::dvec3 scene{0.0};  ///< position in the scene
  std::uint32_t mesh = 0;
  std::uint32_t node = 0;    ///< of the mesh
  std::uint32_t vertex = 0;  ///< of MeshBorder::places

  bool sameOwner(const Place& other) const { return mesh == other.mesh && node == other.node; }
};

bool isLess(const Place& a, const Place& b) {
  return std::tie(a.cell, a.mesh, a.node, a.vertex) < std::tie(b.cell, b.mesh, b.node, b.vertex);
}

std::array<double, 16> numbersOf(const glm::dmat4& transform) {
  std::array<double, 16> numbers{};
  for (int k = 0; k < 16; ++k)
    numbers[static_cast<std::size_t>(k)] = transform[k / 4][k % 4];
  return numbers;
}

std::vector<Place> allPlaces(std::span<const MeshBorder> meshes) {
  std::vector<Place> places;
  for (std::uint32_t m = 0; m < meshes.size(); ++m) {
    const std::vector<glm::dmat4>& nodes = meshes[m].transforms;
    const std::size_t most = std::max<std::size_t>(kMostPlaces / std::max<std::size_t>(meshes[m].places.size(), 1), 1);
    std::set<std::array<double, 16>> known;
    for (std::uint32_t n = 0; n < std::min(nodes.size(), most); ++n) {
      // Nodes that show one mesh at one place share no border: they are one surface, twice.
      if (!known.insert(numbersOf(nodes[n])).second) continue;
      for (std::uint32_t v = 0; v < meshes[m].places.size(); ++v) {
        const glm::dvec3 scene(nodes[n] * glm::dvec4(meshes[m].places[v], 1.0));
        if (std::isfinite(glm::dot(scene, scene))) places.push_back({{}, scene, m, n, v});
      }
    }
  }
  return places;
}

/// Moves the lowest corner of the places' box to the origin. @return  the length of its diagonal
double moveToOrigin(std::vector<Place>& places) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (const Place& place : places) {
    low = glm::min(low, place.scene);
    high = glm::max(high, place.scene);
  }
  for (Place& place : places)
    place.scene -= low;
  return places.empty() ? 0.0 : glm::length(high - low);
}

/// Finds which places have another one close by.
class Matcher {
 public:
  /// @param places  get their cells
  Matcher(std::vector<Place> places, double tolerance) : places_(std::move(places)), tolerance_(tolerance) {
    for (Place& place : places_)
      for (int axis = 0; axis < 3; ++axis)
        place.cell[static_cast<std::size_t>(axis)] = cellAt(place.scene[axis]);
    std::sort(places_.begin(), places_.end(), isLess);
  }

  template <class Visit>
  void forEachTouching(const Visit& visit) const {
    for (const Place& place : places_)
      if (touches(place)) visit(place);
  }

 private:
  std::int64_t cellAt(double position) const {
    return static_cast<std::int64_t>(std::floor(position / (kCell * tolerance_)));
  }

  /// Looks into the cells within the tolerance: mostly one.
  bool touches(const Place& place) const {
    std::array<std::int64_t, 3> low{};
    std::array<std::int64_t, 3> high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = cellAt(place.scene[static_cast<int>(axis)] - tolerance_);
      high[axis] = cellAt(place.scene[static_cast<int>(axis)] + tolerance_);
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
          if (touchesIn({x, y, z}, place)) return true;
    return false;
  }

  bool touchesIn(const std::array<std::int64_t, 3>& cell, const Place& place) const {
    const auto first =
        std::partition_point(places_.begin(), places_.end(), [&](const Place& other) { return other.cell < cell; });
    const auto last =
        std::partition_point(first, places_.end(), [&](const Place& other) { return other.cell == cell; });
    if (last - first > kCrowded) return !place.sameOwner(*first) || !place.sameOwner(*(last - 1));
    for (auto other = first; other != last; ++other)
      if (!place.sameOwner(*other) && glm::distance(place.scene, other->scene) <= tolerance_) return true;
    return false;
  }

  std::vector<Place> places_;
  double tolerance_;
};

}  // namespace

std::vector<std::vector<glm::vec3>> touchingPlaces(std::span<const MeshBorder> meshes) {
  std::vector<std::vector<glm::vec3>> touching(meshes.size());
  std::vector<Place> places = allPlaces(meshes);
  const double tolerance = kTolerance * moveToOrigin(places);
  if (!(tolerance > 0.0)) return touching;
  Matcher(std::move(places), tolerance).forEachTouching([&](const Place& place) {
    touching[place.mesh].push_back(meshes[place.mesh].places[place.vertex]);
  });
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
