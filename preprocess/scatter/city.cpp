// Draws designs, then lot by lot whether it is built, by which design, and how it is turned.
#include "scatter/city.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace jalousie::scatter {
namespace {

constexpr std::uint32_t kDesigns = 24;
constexpr float kObjectsPerBlock = 60.0F;
constexpr float kLowestRoof = 5.0F;
/// Free strip around a building on its lot: walls of neighbours do not touch.
constexpr float kSetback = 0.1F;
/// Makes the random numbers of the city independent of those of the objects.
constexpr std::uint64_t kCityStream = 0x63697479ULL;

std::uint32_t blocksAlongSide(const Layout& layout, float unit) {
  const float blocks = layout.side ? *layout.side / (kBlockPitch * unit)
                                   : std::sqrt(static_cast<float>(layout.count) / kObjectsPerBlock);
  return static_cast<std::uint32_t>(std::clamp(std::ceil(blocks), 1.0F, static_cast<float>(kMostBlocks)));
}

Aabb boxOver(const glm::vec2& low, const glm::vec2& high, float height) {
  return {{low.x, 0.0F, low.y}, {high.x, height, high.y}};
}

/// A block over the whole lot, a tower in it, or two wings in the shape of an L; all boxes stand on the ground.
BuildingDesign makeDesign(std::uint32_t kind, float unit, Random& random) {
  const float half = (0.5F * kLotSide - kSetback) * unit;
  const auto roof = [&](float low, float high) { return unit * random.uniform(low, high); };
  BuildingDesign design;
  if (kind == 0) {
    design.boxes = {boxOver(glm::vec2(-half), glm::vec2(half), roof(kLowestRoof, 14.0F))};
  } else if (kind == 1) {
    const float inner = half * random.uniform(0.45F, 0.75F);
    design.boxes = {boxOver(glm::vec2(-half), glm::vec2(half), roof(kLowestRoof, 9.0F)),
                    boxOver(glm::vec2(-inner), glm::vec2(inner), roof(12.0F, kHighestRoof))};
  } else {
    const float wing = half * random.uniform(0.0F, 0.3F);
    design.boxes = {boxOver(glm::vec2(-half), {half, -wing}, roof(6.0F, 11.0F)),
                    boxOver(glm::vec2(-half), {-wing, half}, roof(6.0F, 11.0F)),
                    boxOver({-half, -half}, {-0.2F * half, -0.2F * half}, roof(11.0F, 18.0F))};
  }
  return design;
}

bool isOnRim(std::uint32_t x, std::uint32_t z) {
  constexpr std::uint32_t kLast = kBlockLots - 1;
  return x == 0 || z == 0 || x == kLast || z == kLast;
}

/// Fills the lots of one block.
void build(City& city, const glm::uvec2& block, float share, Random& random) {
  constexpr std::uint32_t kRim = 4 * (kBlockLots - 1);
  const std::uint32_t gate = random.below(kRim);
  const std::size_t row = std::size_t{city.blocks} * kBlockLots;
  const glm::vec2 corner(city.streetAt(block.x), city.streetAt(block.y));
  std::uint32_t rim = 0;
  for (std::uint32_t z = 0; z < kBlockLots; ++z) {
    for (std::uint32_t x = 0; x < kBlockLots; ++x) {
      if (!isOnRim(x, z)) continue;
      const bool isGate = rim++ == gate;
      const bool isBuilt = random.uniform() < share && !isGate;
      const Building building{random.below(kDesigns), random.below(4),
                              corner + city.unit * (glm::vec2(x, z) * kLotSide + 0.5F * (kStreetWidth + kLotSide))};
      if (!isBuilt) continue;
      city.buildings.push_back(building);
      city.isBuilt[row * (block.y * kBlockLots + z) + block.x * kBlockLots + x] = 1;
    }
  }
}

/// Range of lots that an interval touches; empty where it lies in a street. @param from, to  units from the middle of
/// the outermost street
glm::uvec2 lotsBetween(float from, float to, std::uint32_t blocks) {
  const auto lotAt = [&](float at, bool above) {
    const float block = std::clamp(std::floor(at / kBlockPitch), 0.0F, static_cast<float>(blocks - 1));
    const float lot = (at - block * kBlockPitch - 0.5F * kStreetWidth) / kLotSide;
    const float first = std::clamp(above ? std::ceil(lot) : std::floor(lot), 0.0F, static_cast<float>(kBlockLots));
    return static_cast<std::uint32_t>(block) * kBlockLots + static_cast<std::uint32_t>(first);
  };
  return {lotAt(from, false), lotAt(to, true)};
}

}  // namespace

bool City::isFree(const glm::vec2& place, float reach) const {
  const auto along = [&](float at) {
    const float from = (at + 0.5F * side()) / unit;
    return lotsBetween(from - reach / unit, from + reach / unit, blocks);
  };
  const glm::uvec2 x = along(place.x);
  const glm::uvec2 z = along(place.y);
  const std::size_t row = std::size_t{blocks} * kBlockLots;
  for (std::size_t lotZ = z.x; lotZ < z.y; ++lotZ)
    for (std::size_t lotX = x.x; lotX < x.y; ++lotX)
      if (isBuilt[row * lotZ + lotX] != 0) return false;
  return true;
}

City planCity(const Layout& layout, float unit) {
  City city;
  city.unit = unit;
  city.blocks = blocksAlongSide(layout, unit);
  const std::size_t row = std::size_t{city.blocks} * kBlockLots;
  city.isBuilt.assign(row * row, 0);
  Random random(layout.seed ^ kCityStream);
  for (std::uint32_t design = 0; design < kDesigns; ++design)
    city.designs.push_back(makeDesign(design % 3, unit, random));
  for (std::uint32_t z = 0; z < city.blocks; ++z)
    for (std::uint32_t x = 0; x < city.blocks; ++x)
      build(city, {x, z}, layout.built, random);
  return city;
}

}  // namespace jalousie::scatter
