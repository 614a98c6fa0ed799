// Blocks are joined to rooms with a union of sets; outlines are chained from the sides of squares.
#include "support/building.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/check.h"
#include "support/scenes.h"

namespace jalousie::test {
namespace {

constexpr int kBlock = 3;  // units to a side of a block, and to the height of a storey

int rootOf(std::vector<int>& parents, int i) {
  while (parents[static_cast<std::size_t>(i)] != i)
    i = parents[static_cast<std::size_t>(i)];
  return i;
}

/// Chains directed unit edges to loops, and leaves out points in the middle of straight lines.
std::vector<std::vector<glm::dvec2>> chained(const std::vector<std::array<glm::ivec2, 2>>& edges) {
  std::multimap<std::array<int, 2>, glm::ivec2> next;
  for (const auto& [from, to] : edges)
    next.insert({{from.x, from.y}, to});
  std::vector<std::vector<glm::dvec2>> loops;
  while (!next.empty()) {
    std::vector<glm::ivec2> loop;
    glm::ivec2 at(next.begin()->first[0], next.begin()->first[1]);
    for (auto edge = next.begin(); edge != next.end(); edge = next.find({at.x, at.y})) {
      loop.push_back(at);
      at = edge->second;
      next.erase(edge);
    }
    std::vector<glm::dvec2>& corners = loops.emplace_back();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const glm::ivec2 before = loop[i] - loop[(i + loop.size() - 1) % loop.size()];
      const glm::ivec2 after = loop[(i + 1) % loop.size()] - loop[i];
      if (before != after) corners.emplace_back(loop[i]);
    }
  }
  return loops;
}

/// A unit square that looks along an axis. @param corner  of least coordinates
void addSquare(asset::Primitive& primitive, int axis, bool positive, const glm::ivec3& corner) {
  glm::vec3 u(0.0F);
  glm::vec3 v(0.0F);
  glm::vec3 normal(0.0F);
  u[(axis + 1) % 3] = 1.0F;
  v[(axis + 2) % 3] = 1.0F;
  if (!positive) std::swap(u, v);
  normal[axis] = positive ? 1.0F : -1.0F;
  const glm::vec3 at(corner);
  const auto first = static_cast<std::uint32_t>(primitive.positions.size());
  for (const glm::vec3& position : {at, at + u, at + u + v, at + v}) {
    primitive.positions.push_back(position);
    primitive.normals.push_back(normal);
    primitive.uvs.emplace_back(0.0F);
    primitive.colors.emplace_back(1.0F);
  }
  for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U})
    primitive.indices.push_back(first + index);
}

}  // namespace

int& Building::room(const glm::ivec3& cube) {
  return rooms_[static_cast<std::size_t>((cube.y * size_.z + cube.z) * size_.x + cube.x)];
}

int Building::roomOf(const glm::ivec3& cube) const {
  for (int axis = 0; axis < 3; ++axis)
    if (cube[axis] < 0 || cube[axis] >= size_[axis]) return -1;
  return rooms_[static_cast<std::size_t>((cube.y * size_.z + cube.z) * size_.x + cube.x)];
}

Building::Building(std::uint64_t seed, const BuildingOptions& options) : file_(sphereChain(4)) {
  Random random(seed);
  const int side = static_cast<int>(options.blocks) * kBlock;
  size_ = {side, static_cast<int>(options.storeys) * kBlock, side};
  rooms_.assign(static_cast<std::size_t>(size_.x * size_.y * size_.z), -1);
  divide(random, options);
  cutDoors(random, options);
  cutStairs(random, options);
  outlineRooms();
  addMeshes();
  for (std::uint32_t i = 0; i < options.spheres; ++i) {
    const glm::vec3 place(random.uniform(-1.5F, static_cast<float>(side) + 1.5F),
                          random.uniform(0.0F, static_cast<float>(size_.y)),
                          random.uniform(-1.5F, static_cast<float>(side) + 1.5F));
    const float mirror = random.below(4) == 0 ? -1.0F : 1.0F;
    const float radius = random.uniform(0.1F, 0.4F);
    addInstance(file_, 0, place, {mirror * radius, radius, radius}, random.uniform(0.0F, 6.0F));
  }
}

/// Gives blocks their rooms; one in twelve is solid.
void Building::divide(Random& random, const BuildingOptions& options) {
  const int blocks = static_cast<int>(options.blocks);
  for (int storey = 0; storey < static_cast<int>(options.storeys); ++storey) {
    std::vector<int> parents(static_cast<std::size_t>(blocks * blocks));
    std::iota(parents.begin(), parents.end(), 0);
    const auto join = [&](int a, int b) {
      if (random.uniform() < options.merged) parents[static_cast<std::size_t>(rootOf(parents, a))] = rootOf(parents, b);
    };
    for (int z = 0; z < blocks; ++z) {
      for (int x = 0; x < blocks; ++x) {
        if (x > 0) join(z * blocks + x, z * blocks + x - 1);
        if (z > 0) join(z * blocks + x, (z - 1) * blocks + x);
      }
    }
    std::map<int, int> indices;
    for (int block = 0; block < blocks * blocks; ++block) {
      if (random.below(12) == 0) continue;
      const int root = rootOf(parents, block);
      const auto [known, isNew] = indices.try_emplace(root, static_cast<int>(file_.rooms.rooms.size()));
      if (isNew) {
        Room made;
        made.floor = storey * kBlock;
        made.ceiling = made.floor + kBlock;
        file_.rooms.rooms.push_back(made);
      }
      for (int i = 0; i < kBlock * kBlock * kBlock; ++i)
        room({block % blocks * kBlock + i % kBlock, storey * kBlock + i / kBlock % kBlock,
              block / blocks * kBlock + i / (kBlock * kBlock)}) = known->second;
    }
  }
}

/// Opens unit squares between two rooms, and makes a portal of them. @param low, high  of the cubes behind the squares
void Building::addOpening(int axis, const glm::ivec3& low, const glm::ivec3& high, float scale) {
  glm::ivec3 before = low;
  --before[axis];
  const int first = roomOf(before);
  const int second = roomOf(low);
  if (first < 0 || second < 0 || first == second) return;
  for (glm::ivec3 cube = low; cube.y <= high.y; ++cube.y)
    for (cube.z = low.z; cube.z <= high.z; ++cube.z)
      for (cube.x = low.x; cube.x <= high.x; ++cube.x)
        open_.insert({axis, cube});
  glm::dvec3 u(0.0);
  glm::dvec3 v(0.0);
  u[(axis + 1) % 3] = high[(axis + 1) % 3] - low[(axis + 1) % 3] + 1;
  v[(axis + 2) % 3] = high[(axis + 2) % 3] - low[(axis + 2) % 3] + 1;
  const glm::dvec3 middle = glm::dvec3(low) + 0.5 * (u + v);
  Portal portal;  // its normal is along -axis, towards the room before it
  portal.rooms = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)};
  for (const glm::dvec2& share : {glm::dvec2(-0.5, -0.5), {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}})
    portal.corners.push_back(middle + double{scale} * (share.x * u + share.y * v));
  file_.rooms.portals.push_back(std::move(portal));
}

void Building::cutDoors(Random& random, const BuildingOptions& options) {
  for (int y = 0; y < size_.y; y += kBlock) {
    for (int z = 0; z < size_.z; z += kBlock) {
      for (int x = 0; x < size_.x; x += kBlock) {
        for (const int axis : {0, 2}) {
          if (!(random.uniform() < options.doors)) continue;
          glm::ivec3 low(x, y, z);
          if (low[axis] == 0) continue;
          const int across = 2 - axis;
          low[across] += static_cast<int>(random.below(2));
          glm::ivec3 high = low + glm::ivec3(0, 1, 0);
          high[across] += static_cast<int>(random.below(2));
          addOpening(axis, low, high, options.portalScale);
        }
      }
    }
  }
}

void Building::cutStairs(Random& random, const BuildingOptions& options) {
  for (int y = kBlock; y < size_.y; y += kBlock) {
    for (int z = 0; z < size_.z; z += kBlock) {
      for (int x = 0; x < size_.x; x += kBlock) {
        if (!(random.uniform() < options.stairs)) continue;
        const glm::ivec3 low(x + static_cast<int>(random.below(2)), y, z + static_cast<int>(random.below(2)));
        addOpening(1, low, low + glm::ivec3(1, 0, 1), options.portalScale);
      }
    }
  }
}

void Building::outlineRooms() {
  constexpr std::array<std::array<glm::ivec2, 3>, 4> kSides = {{{{{0, -1}, {0, 0}, {1, 0}}},
                                                                {{{1, 0}, {1, 0}, {1, 1}}},
                                                                {{{0, 1}, {1, 1}, {0, 1}}},
                                                                {{{-1, 0}, {0, 1}, {0, 0}}}}};
  for (std::size_t r = 0; r < file_.rooms.rooms.size(); ++r) {
    Room& outlined = file_.rooms.rooms[r];
    const int y = static_cast<int>(outlined.floor);
    std::vector<std::array<glm::ivec2, 2>> edges;
    for (int z = 0; z < size_.z; ++z) {
      for (int x = 0; x < size_.x; ++x) {
        if (roomOf({x, y, z}) != static_cast<int>(r)) continue;
        for (const auto& [beside, from, to] : kSides)
          if (roomOf({x + beside.x, y, z + beside.y}) != static_cast<int>(r))
            edges.push_back({glm::ivec2(x, z) + from, glm::ivec2(x, z) + to});
      }
    }
    outlined.outline = chained(edges);
  }
}

void Building::addMeshes() {
  for (std::size_t r = 0; r < file_.rooms.rooms.size(); ++r) {
    asset::Primitive primitive;
    for (glm::ivec3 cube(0); cube.y < size_.y; ++cube.y) {
      for (cube.z = 0; cube.z < size_.z; ++cube.z) {
        for (cube.x = 0; cube.x < size_.x; ++cube.x) {
          if (roomOf(cube) != static_cast<int>(r)) continue;
          for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 beside = cube;
            ++beside[axis];
            if (roomOf(beside) != static_cast<int>(r) && !open_.contains({axis, beside}))
              addSquare(primitive, axis, false, beside);
            beside[axis] -= 2;
            if (roomOf(beside) != static_cast<int>(r) && !open_.contains({axis, cube}))
              addSquare(primitive, axis, true, cube);
          }
        }
      }
    }
    const auto mesh = static_cast<std::uint32_t>(file_.meshes.size());
    file_.meshes.push_back({"room", {std::move(primitive)}});
    file_.chains.push_back({"room", {{mesh, 0.0F}}});
    addInstance(file_, static_cast<std::uint32_t>(file_.chains.size() - 1), glm::vec3(0.0F), glm::vec3(1.0F));
  }
}

int Building::roomAt(const glm::dvec3& point) const {
  return roomOf(glm::ivec3(glm::floor(point)));
}

bool Building::sees(const glm::dvec3& from, const glm::dvec3& to) const {
  glm::ivec3 cube(glm::floor(from));
  const glm::ivec3 last(glm::floor(to));
  const glm::dvec3 along = to - from;
  while (cube != last) {
    int nextAxis = -1;
    double nextShare = 2.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (cube[axis] == last[axis]) continue;
      const double plane = along[axis] > 0.0 ? cube[axis] + 1 : cube[axis];
      const double share = (plane - from[axis]) / along[axis];
      if (share < nextShare) {
        nextShare = share;
        nextAxis = axis;
      }
    }
    const glm::ivec3 before = cube;
    cube[nextAxis] += along[nextAxis] > 0.0 ? 1 : -1;
    glm::ivec3 face = cube;
    face[nextAxis] = std::max(before[nextAxis], cube[nextAxis]);
    if (roomOf(cube) != roomOf(before) && !open_.contains({nextAxis, face})) return false;
  }
  return true;
}

glm::dvec3 Building::randomPlace(Random& random, double margin) const {
  for (;;) {
    glm::dvec3 place(0.0);
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = random.below(static_cast<std::uint32_t>(size_[axis])) + margin +
                    (1.0 - 2.0 * margin) * double{random.uniform()};
    if (roomAt(place) >= 0) return place;
  }
}

glm::dvec3 Building::randomPlaceInPortal(Random& random) const {
  JAL_CHECK(!plan().portals.empty());
  const Portal& portal = plan().portals[random.below(static_cast<std::uint32_t>(plan().portals.size()))];
  const double u = double{random.uniform(0.2F, 0.8F)};
  const double v = double{random.uniform(0.2F, 0.8F)};
  return portal.corners[0] + u * (portal.corners[1] - portal.corners[0]) + v * (portal.corners[3] - portal.corners[0]);
}

}  // namespace jalousie::test
