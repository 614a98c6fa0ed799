// Crowds of loose parts: foliage keeps area and colour, and what vanished pulls nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bake/bake_fixtures.h"
#include "bake/mesh/normals.h"
#include "bake/simplify/chain.h"

namespace jalousie::bake {
namespace {

glm::vec3 directionOf(Random& random) {
  for (;;) {
    const glm::vec3 d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (glm::length(d) > 0.1F && glm::length(d) < 1.0F) return glm::normalize(d);
  }
}

glm::vec3 across(const glm::vec3& d) {
  return glm::normalize(glm::cross(d, std::abs(d.x) < 0.9F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
}

/// Appends a mesh as a primitive of its own or to the last one.
void append(CombinedMesh& whole, const asset::Primitive& part, bool newPrimitive) {
  const CombinedMesh mesh = test::combined(part);
  const auto first = static_cast<std::uint32_t>(whole.positions.size());
  if (newPrimitive) whole.primitives.push_back(mesh.primitives[0]);
  if (newPrimitive) whole.primitives.back().firstVertex = first;
  const auto primitive = static_cast<std::uint32_t>(whole.primitives.size() - 1);
  whole.positions.insert(whole.positions.end(), mesh.positions.begin(), mesh.positions.end());
  whole.primitiveOf.resize(whole.positions.size(), primitive);
  for (const std::uint32_t index : mesh.indices)
    whole.indices.push_back(first + index);
}

/// Square leaves at random places of a ball.
asset::Primitive leaves(std::uint32_t count, float side, Random& random) {
  asset::Primitive mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::vec3 normal = directionOf(random);
    const glm::vec3 u = across(normal) * side;
    const glm::vec3 v = glm::cross(normal, u);
    const glm::vec3 corner = directionOf(random) * std::cbrt(random.uniform());
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {corner, corner + u, corner + u + v, corner + v});
    mesh.normals.insert(mesh.normals.end(), 4, normal);
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  }
  return mesh;
}

/// Thin tubes of twelve sides through the ball.
asset::Primitive twigs(std::uint32_t count, Random& random) {
  asset::Primitive mesh;
  constexpr std::uint32_t kSides = 12;
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::vec3 along = directionOf(random);
    const glm::vec3 x = across(along);
    const glm::vec3 y = glm::cross(along, x);
    const glm::vec3 foot = directionOf(random) * 0.8F;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kSides;
      const glm::vec3 normal = static_cast<float>(std::cos(angle)) * x + static_cast<float>(std::sin(angle)) * y;
      for (const float end : {0.0F, 0.3F}) {
        mesh.positions.push_back(foot + 0.004F * normal + end * along);
        mesh.normals.push_back(normal);
      }
      const std::uint32_t a = first + 2 * k;
      const std::uint32_t b = first + 2 * ((k + 1) % kSides);
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  return mesh;
}

std::vector<double> areas(const WedgeMesh& mesh, std::size_t primitives) {
  std::vector<double> result(primitives, 0.0);
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    result[mesh.primitiveOf[mesh.corners[c]]] += triangleArea(
        mesh.positions[mesh.vertexAt(c)], mesh.positions[mesh.vertexAt(c + 1)], mesh.positions[mesh.vertexAt(c + 2)]);
  return result;
}

class EveryRefit : public testing::TestWithParam<Preset> {};
INSTANTIATE_TEST_SUITE_P(Presets, EveryRefit, testing::Values(Preset::kBest, Preset::kFast));

/// Area of every material, and so the mean colour of the whole, within 10 % down to 5 % of the triangles.
void expectAreas(const CombinedMesh& source, Preset preset, std::size_t levels) {
  ChainOptions options;
  options.preset = preset;
  options.ratios = {0.5, 0.25, 0.12, 0.05};
  const LevelChain chain = makeChain(makeWedges(source), options);
  ASSERT_EQ(chain.levels.size(), levels) << chain.stopReason;
  const std::vector<double> whole = areas(chain.levels[0].mesh, source.primitives.size());
  for (const ChainLevel& level : chain.levels) {
    const std::vector<double> now = areas(level.mesh, source.primitives.size());
    for (std::size_t p = 0; p < now.size(); ++p)
      EXPECT_NEAR(now[p], whole[p], 0.1 * whole[p]) << "material " << p << " at " << level.mesh.triangles();
  }
}

TEST_P(EveryRefit, TwigsAndLeavesKeepTheirAreaAndColour) {
  Random random(3);
  CombinedMesh mesh;
  append(mesh, twigs(60, random), true);
  append(mesh, leaves(1440, 0.075F, random), true);
  expectAreas(mesh, GetParam(), 5);
}

TEST_P(EveryRefit, ABallOfLeavesKeepsItsArea) {
  Random random(4);
  CombinedMesh mesh;
  append(mesh, leaves(1500, 0.08F, random), true);
  expectAreas(mesh, GetParam(), 5);
}

TEST_P(EveryRefit, LeavesStayNearTheirPlaces) {
  Random random(5);
  CombinedMesh mesh;
  append(mesh, leaves(1000, 0.05F, random), true);
  ChainOptions options;
  options.preset = GetParam();
  options.ratios = {0.5};
  const LevelChain chain = makeChain(makeWedges(mesh), options);
  ASSERT_EQ(chain.levels.size(), 2U);
  // A leaf that becomes one triangle of its area reaches no further than its own size.
  EXPECT_LT(chain.levels[1].errorMax, 0.075);
}

TEST_P(EveryRefit, APartThatVanishesDoesNotPullItsNeighbour) {
  // A plate, and above it crumbs that go first. The plate stays flat.
  CombinedMesh mesh;
  append(mesh, test::grid(24), true);
  Random random(6);
  asset::Primitive crumbs = leaves(5, 0.01F, random);
  for (glm::vec3& p : crumbs.positions)
    p = glm::vec3(0.5F + 0.2F * p.x, 0.5F + 0.2F * p.y, 0.02F);
  crumbs.normals.assign(crumbs.positions.size(), glm::vec3(0, 0, 1));
  append(mesh, crumbs, false);
  // primitive 0 has the crumbs' normals, too
  std::vector<float>& normals = mesh.primitives[0].attributes[1].values;
  for (const glm::vec3& n : crumbs.normals)
    normals.insert(normals.end(), {n.x, n.y, n.z});
  std::vector<float>& positions = mesh.primitives[0].attributes[0].values;
  for (const glm::vec3& p : crumbs.positions)
    positions.insert(positions.end(), {p.x, p.y, p.z});
  mesh.primitives[0].vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
  ChainOptions options;
  options.preset = GetParam();
  options.ratios = {0.02};
  const LevelChain chain = makeChain(makeWedges(mesh), options);
  ASSERT_EQ(chain.levels.size(), 2U);
  for (const glm::vec3& p : chain.levels[1].mesh.positions)
    EXPECT_NEAR(p.z, 0.0F, 1e-6F);
}

}  // namespace
}  // namespace jalousie::bake
