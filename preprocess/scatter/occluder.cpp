// Builds leaf cards, bars, slats and a wall with a hole.
#include "scatter/occluder.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace jalousie::scatter {
namespace {

constexpr float kGridCells = 40.0F;          ///< holes along a side
constexpr float kFenceSlats = 10.0F;         ///< slats along a side
constexpr float kThickness = 0.01F;          ///< of bars, slats and wall, in half sizes
constexpr float kLeafLength = 1.0F / 16.0F;  ///< in half sizes
constexpr float kLeafWidth = 0.5F;           ///< in leaf lengths
constexpr float kLeafTilt = 0.8F;            ///< largest tangent of the angle between leaf and plane
constexpr float kLeafDepth = 0.1F;           ///< half the depth of the foliage, in half sizes
constexpr float kMostFoliage = 0.99F;
constexpr float kGap = 0.25F;       ///< between objects and occluder, in radii of the objects' extent
constexpr float kOverhang = 1.15F;  ///< size relative to the smallest one that occludes all objects
/// Makes the random numbers of the leaves independent of those of the objects.
constexpr std::uint64_t kLeafStream = 0x6C656166ULL;

/// Box over a rectangle of the plane, centred on it in depth. Nothing for an empty rectangle.
void addBoxOver(PlainMesh& mesh, const glm::vec2& low, const glm::vec2& high, float thickness) {
  addBox(mesh, {glm::vec3(low, -0.5F * thickness), glm::vec3(high, 0.5F * thickness)});
}

/// Bars on the borders of square cells; a cell's open share is (1 - bar)^2.
PlainMesh makeGrid(float cover, float half) {
  PlainMesh mesh;
  const float period = 2.0F * half / kGridCells;
  const float bar = 0.5F * period * (1.0F - std::sqrt(1.0F - cover));
  if (!(bar > 0.0F)) return mesh;
  for (float i = 0.0F; i <= kGridCells; i += 1.0F) {
    const float at = -half + i * period;
    const float low = std::max(at - bar, -half);
    const float high = std::min(at + bar, half);
    addBoxOver(mesh, {low, -half}, {high, half}, kThickness * half);
    // The horizontal bars are thinner in depth: no two faces share a plane and flicker.
    addBoxOver(mesh, {-half, low}, {half, high}, 0.5F * kThickness * half);
  }
  return mesh;
}

PlainMesh makeFence(float cover, float half) {
  PlainMesh mesh;
  const float period = 2.0F * half / kFenceSlats;
  for (float i = 0.0F; i < kFenceSlats; i += 1.0F) {
    const float middle = -half + (i + 0.5F) * period;
    addBoxOver(mesh, {middle - 0.5F * cover * period, -half}, {middle + 0.5F * cover * period, half},
               kThickness * half);
  }
  return mesh;
}

PlainMesh makePlane(float cover, float half) {
  PlainMesh mesh;
  const float hole = half * std::sqrt(1.0F - cover);
  const float thickness = kThickness * half;
  addBoxOver(mesh, {-half, -half}, {-hole, half}, thickness);
  addBoxOver(mesh, {hole, -half}, {half, half}, thickness);
  addBoxOver(mesh, {-hole, -half}, {hole, -hole}, thickness);
  addBoxOver(mesh, {-hole, hole}, {hole, half}, thickness);
  return mesh;
}

glm::vec2 randomInDisc(Random& random) {
  for (;;) {
    const float x = random.uniform(-1.0F, 1.0F);
    const float y = random.uniform(-1.0F, 1.0F);
    if (x * x + y * y <= 1.0F) return {x, y};
  }
}

/// A kite of two triangles, tilted and turned at random.
void addLeaf(PlainMesh& mesh, const glm::vec3& center, float length, Random& random) {
  const glm::vec3 normal = glm::normalize(glm::vec3(kLeafTilt * randomInDisc(random), 1.0F));
  glm::vec2 heading(0.0F);
  while (glm::dot(heading, heading) < 1e-4F)
    heading = randomInDisc(random);
  const glm::vec3 side = glm::normalize(glm::cross(normal, glm::vec3(heading, 0.0F)));
  const glm::vec3 along = length * glm::cross(side, normal);
  const glm::vec3 across = 0.5F * kLeafWidth * length * side;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const glm::vec3 stem = center - 0.5F * along;
  mesh.positions.insert(mesh.positions.end(),
                        {stem, stem + 0.4F * along - across, stem + along, stem + 0.4F * along + across});
  mesh.normals.insert(mesh.normals.end(), 4, normal);
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

/// Leaves fall independently, so a point stays open with probability exp(-leaves * leafArea / area).
std::uint32_t leafCount(float cover, double area, double leafLength) {
  const double tilt = static_cast<double>(kLeafTilt) * static_cast<double>(kLeafTilt);
  const double meanCosine = 2.0 * (std::sqrt(1.0 + tilt) - 1.0) / tilt;
  const double leafArea = 0.5 * static_cast<double>(kLeafWidth) * leafLength * leafLength * meanCosine;
  const double open = 1.0 - static_cast<double>(std::min(cover, kMostFoliage));
  return static_cast<std::uint32_t>(std::lround(-std::log(open) * area / leafArea));
}

PlainMesh makeFoliage(float cover, float half, std::uint64_t seed) {
  PlainMesh mesh;
  Random random(seed ^ kLeafStream);
  const float length = kLeafLength * half;
  const float reach = half + 0.5F * length;  // leaves from beyond the border cover it like the middle
  const std::uint32_t count =
      leafCount(cover, 4.0 * static_cast<double>(reach) * static_cast<double>(reach), static_cast<double>(length));
  for (std::uint32_t i = 0; i < count; ++i) {
    const float x = random.uniform(-reach, reach);
    const float y = random.uniform(-reach, reach);
    const float z = random.uniform(-kLeafDepth, kLeafDepth) * half;
    addLeaf(mesh, {x, y, z}, length, random);
  }
  return mesh;
}

}  // namespace

OccluderPlace placeOccluder(const PathSubject& subject) {
  const float extent = subject.halfSide + subject.objectRadius;
  const float distance = (1.0F + kGap) * extent;
  float half = 0.0F;
  for (const glm::vec3& eye : eyesBehindOccluder(subject)) {
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 p(((corner & 1) != 0 ? extent : -extent), ((corner & 2) != 0 ? extent : -extent),
                        ((corner & 4) != 0 ? extent : -extent));
      const glm::vec3 onPlane = glm::mix(p, eye, (distance - p.z) / (eye.z - p.z));
      half = std::max({half, std::abs(onPlane.x), std::abs(onPlane.y)});
    }
  }
  return {distance, kOverhang * half};
}

PlainMesh makeOccluder(const Occluder& occluder, float halfSize, std::uint64_t seed) {
  switch (occluder.kind) {
    case OccluderKind::kFoliage:
      return makeFoliage(occluder.cover, halfSize, seed);
    case OccluderKind::kGrid:
      return makeGrid(occluder.cover, halfSize);
    case OccluderKind::kFence:
      return makeFence(occluder.cover, halfSize);
    case OccluderKind::kPlane:
      break;
  }
  return makePlane(occluder.cover, halfSize);
}

PlainMesh makeSlab(float halfSize, float thickness) {
  PlainMesh mesh;
  addBoxOver(mesh, glm::vec2(-halfSize), glm::vec2(halfSize), thickness);
  return mesh;
}

const char* occluderName(OccluderKind kind) {
  switch (kind) {
    case OccluderKind::kFoliage:
      return "foliage";
    case OccluderKind::kGrid:
      return "grid";
    case OccluderKind::kFence:
      return "fence";
    case OccluderKind::kPlane:
      break;
  }
  return "plane";
}

}  // namespace jalousie::scatter
