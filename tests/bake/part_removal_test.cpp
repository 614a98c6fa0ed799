// What it costs to remove a loose part that lies close to a surface like its own.
#include "bake/simplify/part_removal.h"

#include <gtest/gtest.h>

#include "bake/bake_fixtures.h"
#include "bake/mesh/bounds.h"
#include "bake/mesh/normals.h"
#include "bake/simplify/collapse.h"

namespace jalousie::bake {
namespace {

constexpr float kHeight = 0.02F;
constexpr float kSide = 0.2F;

/// A square of 10x10 cells in the plane z = 0, and a small square above its middle.
asset::Primitive plateAbove(float height) {
  asset::Primitive mesh = test::grid(10);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
    mesh.positions.emplace_back(glm::vec2(0.41F) + kSide * corner, height);
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  mesh.normals = smoothNormals(mesh.positions, mesh.indices);
  return mesh;
}

struct Measured {
  explicit Measured(WedgeMesh wedges)
      : mesh(std::move(wedges)), parts(findLooseParts(mesh)), scale(boundsOf(mesh.positions).diagonal()) {
    classes = classifyParts(mesh, findEdges(mesh), parts, scale);
    for (const LoosePart& part : parts.parts)
      alive.push_back(part.faceCount);
  }
  double cost(std::uint32_t part) const { return PartRemoval(mesh, parts, classes, scale).cost(part, alive); }

  WedgeMesh mesh;
  LooseParts parts;
  double scale;
  PartClasses classes;
  std::vector<std::uint32_t> alive;
};

TEST(PartRemoval, CostsTheDistanceToASurfaceLikeIt) {
  const Measured plate(test::wedges(plateAbove(kHeight)));
  ASSERT_EQ(plate.parts.parts.size(), 2U);
  const double expected = 2.0 * kSide * kSide * kHeight * kHeight / std::pow(plate.scale, 4.0);
  EXPECT_NEAR(plate.cost(1), expected, 1e-3 * expected) << "two triangles are one pair";
  EXPECT_LT(plate.cost(1), 0.1 * plate.classes.costs[1]);
}

TEST(PartRemoval, GrowsWhenThatSurfaceGoes) {
  Measured plate(test::wedges(plateAbove(kHeight)));
  plate.alive[0] = 0;
  EXPECT_EQ(plate.cost(1), plate.classes.costs[1]);
}

TEST(PartRemoval, AnotherMaterialOrAnotherSideStandsForNothing) {
  Measured other(test::wedges(plateAbove(kHeight)));
  for (std::uint32_t c = 0; c < other.mesh.corners.size(); ++c)
    if (other.mesh.positions[other.mesh.vertexAt(c)].z > 0.0F) other.mesh.primitiveOf[other.mesh.corners[c]] = 1;
  EXPECT_EQ(other.cost(1), other.classes.costs[1]);
  asset::Primitive turned = plateAbove(kHeight);
  for (std::size_t t = turned.indices.size() - 6; t < turned.indices.size(); t += 3)
    std::swap(turned.indices[t + 1], turned.indices[t + 2]);
  const Measured back(test::wedges(turned));
  EXPECT_EQ(back.cost(1), back.classes.costs[1]);
}

/// Rows of keys: removed one by one, their neighbours stand for them, and the whole keeps its shape.
TEST(PartRemoval, KeysBesideEachOtherGoBeforeWhatIsAlone) {
  asset::Primitive keys;
  constexpr std::uint32_t kKeys = 40;
  for (std::uint32_t k = 0; k <= kKeys; ++k) {
    asset::Primitive ball = test::sphere(8, 8);
    const float x = k < kKeys ? 0.1F * static_cast<float>(k) : 20.0F;  // the last one is alone
    const auto first = static_cast<std::uint32_t>(keys.positions.size());
    for (const glm::vec3& p : ball.positions)
      keys.positions.emplace_back(x + 0.045F * p.x, 0.5F * p.y, 0.045F * p.z);
    for (const std::uint32_t index : ball.indices)
      keys.indices.push_back(first + index);
  }
  keys.normals = smoothNormals(keys.positions, keys.indices);
  const WedgeMesh mesh = test::wedges(keys);
  EdgeCollapser collapser(mesh, {});
  collapser.collapseTo(24);
  EXPECT_GT(collapser.removedParts(), 30U);
  const WedgeMesh level = collapser.mesh();
  EXPECT_GT(boundsOf(level.positions).max.x, 19.9F) << "the part that nothing stands for is left";
}

}  // namespace
}  // namespace jalousie::bake
