// Derivatives, tessellation pattern and fit of control meshes.
#include "bake/simplify/patch_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "bake/bake_fixtures.h"
#include "bake/simplify/level_maker.h"
#include "core/random.h"
#include "scene/patch_base.h"

namespace jalousie::bake {
namespace {

glm::vec3 randomVector(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

/// One patch; its normals need not fit its positions.
PatchMesh randomPatch(Random& random) {
  PatchMesh mesh;
  for (int k = 0; k < 3; ++k) {
    mesh.positions.push_back(randomVector(random));
    mesh.normals.push_back(glm::normalize(randomVector(random) + glm::vec3(0, 0, 1.1F)));
  }
  mesh.indices = {0, 1, 2};
  mesh.alpha = random.uniform();
  return mesh;
}

glm::dvec3 randomBarycentric(Random& random) {
  const double u = random.uniform();
  const double v = random.uniform() * (1.0 - u);
  return {u, v, 1.0 - u - v};
}

/// The patches of a coarse level, as the program tessellates them without a fit.
PatchMesh basePatches(const WedgeMesh& mesh, std::uint32_t triangles) {
  const ChainOptions options;
  LevelMaker maker(mesh, options);
  LevelMaker::Level level = maker.make(triangles, true);
  maker.refit(level);
  return patchesOf(level.mesh);
}

TEST(PatchSurface, IsTheSurfaceThatIsDrawn) {
  Random random(26);
  for (int i = 0; i < 200; ++i) {
    const PatchMesh mesh = randomPatch(random);
    const glm::dvec3 b = randomBarycentric(random);
    const glm::vec3 drawn =
        scene::phongPoint(b, std::span<const glm::vec3, 3>(mesh.positions.data(), 3),
                          std::span<const glm::vec3, 3>(mesh.normals.data(), 3), static_cast<float>(mesh.alpha));
    EXPECT_LT(glm::distance(glm::dvec3(drawn), patchPoint(mesh, 0, b).point), 2e-6);
  }
}

TEST(PatchSurface, DerivativesEqualFiniteDifferences) {
  Random random(27);
  constexpr float kStep = 1.0F / 256.0F;
  for (int i = 0; i < 100; ++i) {
    const PatchMesh mesh = randomPatch(random);
    const glm::dvec3 b = randomBarycentric(random);
    const PatchPoint at = patchPoint(mesh, 0, b);
    for (std::size_t k = 0; k < 3; ++k) {
      PatchMesh moved = mesh;
      moved.positions[k] += kStep * randomVector(random);
      const glm::dvec3 move = glm::dvec3(moved.positions[k]) - glm::dvec3(mesh.positions[k]);
      EXPECT_LT(glm::distance(patchPoint(moved, 0, b).point, at.point + at.byPosition[k] * move), 1e-12)
          << "linear in the positions";
      PatchMesh turned = mesh;
      turned.normals[k] = glm::normalize(mesh.normals[k] + kStep * randomVector(random));
      const glm::dvec3 turn = glm::dvec3(turned.normals[k]) - glm::dvec3(mesh.normals[k]);
      EXPECT_LT(glm::distance(patchPoint(turned, 0, b).point, at.point + at.byNormal[k] * turn),
                8.0 * glm::dot(turn, turn) + 1e-6)
          << "quadratic in the normals";
    }
    PatchMesh bent = mesh;
    bent.alpha += 0.125;
    EXPECT_LT(glm::distance(patchPoint(bent, 0, b).point, at.point - 0.125 * at.bend), 1e-12) << "linear in alpha";
  }
}

TEST(PatchPattern, HasTheTrianglesOfTheTessellatorAndCoversThePatch) {
  for (std::uint32_t level = 1; level <= 20; ++level) {
    const PatchPattern pattern = patchPattern(level);
    EXPECT_EQ(pattern.indices.size() / 3, scene::tessellatedTriangles(level)) << level;
    double area = 0.0;
    for (std::size_t i = 0; i < pattern.indices.size(); i += 3) {
      const glm::dmat3 corners(pattern.points[pattern.indices[i]], pattern.points[pattern.indices[i + 1]],
                               pattern.points[pattern.indices[i + 2]]);
      EXPECT_GT(glm::determinant(corners), 0.0) << "counter-clockwise";
      area += glm::determinant(corners);
    }
    EXPECT_NEAR(area, 1.0, 1e-12) << level;
  }
}

TEST(PatchFit, ABallOfFewPatchesComesCloserToItsSphere) {
  const WedgeMesh ball = test::wedges(test::sphere(96, 48));
  const PatchMesh start = basePatches(ball, 80);
  const PatchFit fit = fitPatches(ball, start);
  EXPECT_LT(fit.after, 0.1 * fit.before);
  const DeviationMeter meter(ball, {.samples = 10000});
  const Deviation before = measurePatches(meter, start, 8);
  const Deviation after = measurePatches(meter, fit.mesh, 8);
  EXPECT_LT(after.twoSided.mean, 0.1 * before.twoSided.mean);
  EXPECT_EQ(fit.mesh.indices, start.indices);
}

TEST(PatchFit, FindsTheMeshThatMadeTheOriginal) {
  PatchMesh truth = patchesOf(test::wedges(test::sphere(8, 6)));
  truth.alpha = 0.6;
  const WedgeMesh original = tessellate(truth, patchPattern(12));
  PatchMesh start = truth;
  start.alpha = 0.75;
  Random random(3);
  for (std::size_t v = 0; v < start.positions.size(); ++v) {
    start.positions[v] += 0.03F * randomVector(random);
    start.normals[v] = glm::normalize(start.normals[v] + 0.1F * randomVector(random));
  }
  PatchFitOptions options;
  options.rounds = 20;
  const PatchFit fit = fitPatches(original, start, options);
  EXPECT_LT(fit.after, 0.3 * fit.before);
}

TEST(PatchFit, AFlatPlateStaysFlat) {
  const WedgeMesh plate = test::wedges(test::grid(12));
  const PatchFit fit = fitPatches(plate, basePatches(plate, 8));
  EXPECT_LE(fit.after, fit.before);
  const Deviation deviation = measurePatches(DeviationMeter(plate, {.samples = 2000}), fit.mesh, 4);
  EXPECT_LT(deviation.twoSided.mean, 1e-4);
}

TEST(PatchFit, DoesNotDependOnTheSlices) {
  const WedgeMesh ball = test::wedges(test::sphere(32, 16));
  const PatchMesh start = basePatches(ball, 60);
  PatchFitOptions options;
  options.samples = 3000;
  options.rounds = 4;
  const PatchFit one = fitPatches(ball, start, options);
  options.slices = [](std::size_t count, const SliceWork& work) {
    for (std::size_t end = count; end > 0;) {
      const std::size_t begin = end > 700 ? end - 700 : 0;
      work(begin, end);
      end = begin;
    }
  };
  const PatchFit many = fitPatches(ball, start, options);
  EXPECT_EQ(one.mesh.positions, many.mesh.positions);
  EXPECT_EQ(one.mesh.normals, many.mesh.normals);
  EXPECT_EQ(one.mesh.alpha, many.mesh.alpha);
  EXPECT_EQ(one.after, many.after);
}

TEST(PatchFit, IsNeverWorseAndFiniteOnBrokenSurfaces) {
  Random random(11);
  for (int i = 0; i < 20; ++i) {
    WedgeMesh soup = test::wedges(test::grid(6));
    for (glm::vec3& p : soup.positions)
      if (random.below(3) == 0) p = i % 2 == 0 ? soup.positions[0] : randomVector(random);
    PatchMesh start = patchesOf(soup);
    start.indices.resize(3 * (1 + random.below(10)));
    PatchFitOptions options;
    options.samples = 200;
    options.rounds = 3;
    const PatchFit fit = fitPatches(soup, start, options);
    EXPECT_LE(fit.after, fit.before);
    for (const glm::vec3& p : fit.mesh.positions)
      ASSERT_TRUE(std::isfinite(glm::dot(p, p)));
    for (const glm::vec3& n : fit.mesh.normals)
      ASSERT_NEAR(glm::length(n), 1.0F, 1e-5F);
  }
}

}  // namespace
}  // namespace jalousie::bake
