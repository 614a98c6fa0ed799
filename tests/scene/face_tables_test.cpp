// The cones of groups against those of meshoptimizer.
#include "scene/face_tables.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>

#include "core/random.h"
#include "scene/scene_data.h"
#include "support/scenes.h"

namespace jalousie::scene {
namespace {

/// Whether meshoptimizer's test for a perspective camera culls.
bool culls(const meshopt_Bounds& bounds, const glm::dvec3& eye) {
  const glm::dvec3 apex(bounds.cone_apex[0], bounds.cone_apex[1], bounds.cone_apex[2]);
  const glm::dvec3 axis(bounds.cone_axis[0], bounds.cone_axis[1], bounds.cone_axis[2]);
  return glm::dot(glm::normalize(apex - eye), axis) >= double{bounds.cone_cutoff};
}

/// The same with the cone of a group: n.(apex - eye) > 0 for all normals of the cone.
bool culls(const gpu::FaceNode& node, const glm::dvec3& eye) {
  const double cosine = node.axis.w;
  if (!(cosine > 0.0)) return false;
  const glm::dvec3 axis(node.axis);
  const glm::dvec3 v = glm::dvec3(node.apex) - eye;
  return cosine * glm::dot(v, axis) > std::sqrt(1.0 - cosine * cosine) * glm::length(glm::cross(v, axis));
}

TEST(FaceTables, ConesCullAsMuchAsThoseOfMeshoptimizer) {
  asset::SceneFile file = test::randomSpheres(12, 6.0F, 3);
  test::groupFaces(file, asset::FaceGrouping::kMeshlets);
  const SceneData scene = buildScene(file, {.faces = true});
  Random random(4);
  std::uint64_t own = 0;
  std::uint64_t theirs = 0;
  std::uint64_t tests = 0;
  for (const gpu::FaceLod& lod : scene.faces.lods) {
    for (gpu::uint n = lod.firstNode; n < lod.firstNode + lod.nodeCount; ++n) {
      const gpu::FaceNode& node = scene.faces.nodes[n];
      if (!(node.inradius > 0.0F)) continue;
      const meshopt_Bounds bounds = meshopt_computeClusterBounds(
          &scene.indices[node.firstIndex], node.indexCount,
          &scene.vertices[static_cast<std::size_t>(lod.baseVertex)].position.x,
          scene.vertices.size() - static_cast<std::size_t>(lod.baseVertex), sizeof(Vertex));
      for (int i = 0; i < 40; ++i, ++tests) {
        const auto along = [&] { return double{random.uniform(-4.0F, 4.0F)}; };
        const glm::dvec3 eye = glm::dvec3(node.sphere) + glm::dvec3(along(), along(), along());
        own += culls(node, eye) ? 1 : 0;
        theirs += culls(bounds, eye) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(theirs, tests / 5);
  EXPECT_GE(own, theirs * 98 / 100) << "of " << tests;
}

}  // namespace
}  // namespace jalousie::scene
