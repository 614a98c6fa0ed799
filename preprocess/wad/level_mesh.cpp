// An upright edge stands on a vertex of the level; all heights that any sector has there cut it.
#include "wad/level_mesh.h"

#include <algorithm>
#include <set>

namespace jalousie::wad {
namespace {

constexpr std::int32_t kLightStep = 16;

/// A piece of wall to be drawn.
struct WallPiece {
  std::uint32_t from = 0;  ///< vertex on the left as seen from the room
  std::uint32_t to = 0;
  std::int32_t low = 0;
  std::int32_t high = 0;
};

class MeshMaker {
 public:
  MeshMaker(const Level& level, const SectorParts& parts, const LevelPlan& plan)
      : level_(level), parts_(parts), plan_(plan), heights_(level.vertices.size()), meshes_(plan.plan.rooms.size()) {}

  std::vector<RoomMesh> make() {
    for (const SectorPart& part : parts_.parts) {
      const Sector& sector = level_.sectors[part.sector];
      for (const std::vector<std::uint32_t>& loop : part.loops)
        for (const std::uint32_t vertex : loop)
          heights_[vertex].insert({sector.floor, sector.ceiling});
    }
    for (std::size_t part = 0; part < parts_.parts.size(); ++part)
      if (plan_.roomOf[part]) addFlats(part);
    for (std::size_t line = 0; line < level_.lines.size(); ++line)
      for (std::size_t side = 0; side < 2; ++side)
        if (const auto& part = parts_.partOf[line][side]; part && plan_.roomOf[*part]) addWalls(line, side, *part);
    return std::move(meshes_);
  }

 private:
  Surface& surface(std::size_t part, const std::string& texture, bool isWall) {
    const std::int32_t light = level_.sectors[parts_.parts[part].sector].light / kLightStep * kLightStep;
    return meshes_[*plan_.roomOf[part]][{texture, isWall, light}];
  }

  std::uint32_t addVertex(Surface& to, std::uint32_t vertex, std::int32_t height, const glm::vec3& normal) const {
    to.positions.emplace_back(sceneFromLevel(glm::dvec2(level_.vertices[vertex]), height));
    to.normals.push_back(normal);
    return static_cast<std::uint32_t>(to.positions.size() - 1);
  }

  /// Floor and ceiling of a part.
  void addFlats(std::size_t part) {
    const Sector& sector = level_.sectors[parts_.parts[part].sector];
    const std::vector<std::uint32_t> triangles = triangulate(level_, parts_.parts[part]);
    Surface& floor = surface(part, sector.floorTexture, false);
    for (const std::uint32_t vertex : triangles)
      floor.indices.push_back(addVertex(floor, vertex, sector.floor, {0, 1, 0}));
    Surface& ceiling = surface(part, sector.ceilingTexture, false);
    for (auto vertex = triangles.rbegin(); vertex != triangles.rend(); ++vertex)
      ceiling.indices.push_back(addVertex(ceiling, *vertex, sector.ceiling, {0, -1, 0}));
  }

  void addWalls(std::size_t lineIndex, std::size_t side, std::size_t part) {
    const Line& line = level_.lines[lineIndex];
    const Side& own = level_.sides[*line.sides[side]];
    const Sector& sector = level_.sectors[own.sector];
    WallPiece piece{line.ends[side], line.ends[1 - side], sector.floor, sector.ceiling};
    if (!line.sides[1 - side]) {
      addWall(surface(part, own.middle, true), piece);
      return;
    }
    const Sector& other = level_.sectors[level_.sides[*line.sides[1 - side]].sector];
    piece.high = std::min(other.floor, sector.ceiling);
    addWall(surface(part, own.lower, true), piece);
    piece.low = std::max({other.ceiling, sector.floor, piece.high});
    piece.high = sector.ceiling;
    // Between two skies the wall shows the sky.
    const bool isSky = sector.ceilingTexture == "F_SKY1" && other.ceilingTexture == "F_SKY1";
    if (piece.low < piece.high) addWall(surface(part, isSky ? sector.ceilingTexture : own.upper, !isSky), piece);
  }

  /// The heights at a vertex from the lowest to the highest of a piece.
  std::vector<std::int32_t> cuts(std::uint32_t vertex, const WallPiece& piece) const {
    std::vector<std::int32_t> result{piece.low};
    for (const std::int32_t height : heights_[vertex])
      if (height > piece.low && height < piece.high) result.push_back(height);
    result.push_back(piece.high);
    return result;
  }

  /// A strip between two upright edges, from below.
  void addWall(Surface& to, const WallPiece& piece) const {
    if (piece.low >= piece.high) return;
    const glm::vec2 along(level_.vertices[piece.to] - level_.vertices[piece.from]);
    const glm::vec3 normal = glm::normalize(glm::vec3(along.y, 0.0F, along.x));
    const std::vector<std::int32_t> left = cuts(piece.from, piece);
    const std::vector<std::int32_t> right = cuts(piece.to, piece);
    std::size_t l = 0;
    std::size_t r = 0;
    while (l + 1 < left.size() || r + 1 < right.size()) {
      const bool stepsLeft = r + 1 == right.size() || (l + 1 < left.size() && left[l + 1] <= right[r + 1]);
      to.indices.push_back(addVertex(to, piece.from, left[l], normal));
      to.indices.push_back(addVertex(to, piece.to, right[r], normal));
      to.indices.push_back(stepsLeft ? addVertex(to, piece.from, left[l + 1], normal)
                                     : addVertex(to, piece.to, right[r + 1], normal));
      ++(stepsLeft ? l : r);
    }
  }

  const Level& level_;
  const SectorParts& parts_;
  const LevelPlan& plan_;
  std::vector<std::set<std::int32_t>> heights_;  ///< by vertex
  std::vector<RoomMesh> meshes_;
};

}  // namespace

std::vector<RoomMesh> makeMeshes(const Level& level, const SectorParts& parts, const LevelPlan& plan) {
  return MeshMaker(level, parts, plan).make();
}

}  // namespace jalousie::wad
