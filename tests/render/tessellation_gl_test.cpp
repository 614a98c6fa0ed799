// The Phong tessellation path: counts, closed surfaces, bounds.
#include <gtest/gtest.h>

#include "render/frame_renderer.h"
#include "render/tessellation_limit.h"
#include "scene/patch_base.h"
#include "support/gl_test.h"
#include "support/stages.h"

namespace jalousie::render {
namespace {

class TessellationGl : public test::GlTest {
 protected:
  /// One mesh of 98 triangles, as the thesis' base bunny.
  static asset::SceneFile baseMesh() {
    asset::SceneFile file = test::sphereChain(1);
    file.meshes[0].primitives = {test::sphere(7, 8)};
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
    return file;
  }

  static FrameOptions options(gpu::uint level) {
    FrameOptions result;
    result.cullMode = CullMode::kFull;
    result.lodRule = LodRule::kFinest;
    result.detail = Detail::kTessellation;
    result.maxTessellation = level;
    return result;
  }
};

TEST_F(TessellationGl, EveryLevelGeneratesItsTriangles) {
  const scene::SceneData scene = scene::buildScene(baseMesh(), {.patches = true});
  FrameRenderer renderer(scene, 64, 64);
  const scene::Camera camera = scene::frameBox(scene.boundsWorld, 1.0F);
  GLuint query = 0;
  glGenQueries(1, &query);
  for (gpu::uint level = 1; level <= 20; ++level) {
    glBeginQuery(GL_PRIMITIVES_GENERATED, query);
    renderer.render(options(level), camera, camera);
    glEndQuery(GL_PRIMITIVES_GENERATED);
    GLuint count = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
    EXPECT_EQ(count, 98U * scene::tessellatedTriangles(level)) << "level " << level;
    if (level == 20) {
      EXPECT_EQ(count, 58800U);  // thesis 4.2.1
    }
  }
  glDeleteQueries(1, &query);
}

/// Background pixels with foreground on both sides in their row and column: holes in a convex silhouette.
std::size_t holes(const ImageRgba8& image) {
  const auto isBackground = [&](std::uint32_t x, std::uint32_t y) {
    return std::equal(image.pixels.begin(), image.pixels.begin() + 3,
                      image.pixels.begin() + static_cast<std::ptrdiff_t>(image.offset(x, y)));
  };
  std::size_t count = 0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    std::uint32_t first = image.width;
    std::uint32_t last = 0;
    for (std::uint32_t x = 0; x < image.width; ++x) {
      if (isBackground(x, y)) continue;
      first = std::min(first, x);
      last = x;
    }
    for (std::uint32_t x = first; x < last; ++x)
      count += isBackground(x, y) ? 1 : 0;
  }
  return count;
}

TEST_F(TessellationGl, FlatShadedMeshStaysClosedBecauseNormalsAreAveraged) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes[0].primitives = {test::box(glm::vec3(1.0F))};  // every corner has three normals
  test::addInstance(file, 0, {0, 0, 0}, {1, 1, 1}, 0.6F, {1, 1, 0});
  const scene::SceneData scene = scene::buildScene(file, {.patches = true});
  FrameRenderer renderer(scene, 400, 400);
  const scene::Camera camera = scene::lookAt({0, 0, 6}, {0, 0, 0}, scene.boundsWorld);
  for (const gpu::uint level : {1U, 2U, 5U, 20U}) {
    renderer.render(options(level), camera, camera);
    EXPECT_EQ(holes(renderer.readImage()), 0U) << "level " << level;
  }
}

TEST_F(TessellationGl, CurvedSurfaceReachesBeyondTheFlatBaseButStaysInItsRectangle) {
  const scene::SceneData scene = scene::buildScene(baseMesh(), {.patches = true});
  FrameRenderer renderer(scene, 300, 300);
  const scene::Camera camera = scene::lookAt({0, 0, 4}, {0, 0, 0}, scene.boundsWorld);
  const auto covered = [&](gpu::uint level) {
    renderer.render(options(level), camera, camera);
    const ImageRgba8 image = renderer.readImage();
    const gpu::ScreenBox rect = renderer.readBoxes()[0];
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < image.height; ++y) {
      for (std::uint32_t x = 0; x < image.width; ++x) {
        if (std::equal(image.pixels.begin(), image.pixels.begin() + 3,
                       image.pixels.begin() + static_cast<std::ptrdiff_t>(image.offset(x, y))))
          continue;
        ++count;
        const float centerX = static_cast<float>(x) + 0.5F;
        const float centerY = static_cast<float>(image.height - 1 - y) + 0.5F;
        EXPECT_TRUE(centerX >= rect.minX && centerX <= rect.maxX && centerY >= rect.minY && centerY <= rect.maxY);
      }
    }
    return count;
  };
  const std::size_t flat = covered(1);
  EXPECT_GT(covered(8), flat + flat / 50);
}

TEST_F(TessellationGl, LargeBaseMeshLosesNoPatchAtAnyLevelTheRendererAllows) {
  for (const std::uint32_t cells : {11U, 13U, 40U}) {
    asset::SceneFile file = test::sphereChain(1);
    file.materials[0].doubleSided = true;
    Random random(1);
    file.meshes[0].primitives = {test::perforatedWall(cells, -1.0F, random)};  // no cell is open
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
    const scene::SceneData scene = scene::buildScene(file, {.patches = true});
    FrameRenderer renderer(scene, 100, 100);
    const scene::Camera camera = scene::lookAt({0, 0, 1.5F}, {0, 0, 0}, scene.boundsWorld);
    for (const gpu::uint level : {2U, 14U, 17U, 20U}) {
      renderer.render(options(level), camera, camera);
      const ImageRgba8 image = renderer.readImage();
      std::size_t background = 0;
      for (std::size_t p = 0; p < image.pixels.size(); p += 4)
        background += image.pixels[p + 2] > image.pixels[p] ? 1 : 0;
      EXPECT_EQ(background, 0U) << cells << " cells, level " << level;
    }
  }
}

TEST(TessellationLimit, OnlySoftwareRenderersAndLargeMeshesAreLimited) {
  gl::Capabilities gpuDriver;
  EXPECT_EQ(tessellationLimit(gpuDriver, 100000), 20U);
  gl::Capabilities software;
  software.softwareRenderer = true;
  EXPECT_EQ(tessellationLimit(software, 0), 20U);
  EXPECT_EQ(tessellationLimit(software, 98), 20U);
  EXPECT_EQ(tessellationLimit(software, 341), 14U);
  EXPECT_EQ(tessellationLimit(software, 100000), 14U);
}

TEST_F(TessellationGl, HiddenSpheresUseTheirCoarseLevels) {
  const scene::SceneData scene = scene::buildScene(test::spheresBehindWall(0.15F), {.patches = true});
  FrameRenderer renderer(scene, 320, 180);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  FrameOptions linear = options(20);
  linear.cullMode = CullMode::kHom;
  linear.lodRule = LodRule::kLinear;
  linear.lvMeasure = LvMeasure::kThesis;
  linear.occluderDistance = test::kWallOccluderDistance;
  linear.skipDraw = true;
  renderer.render(linear, camera, camera);
  const FrameStatistics s = renderer.readStatistics();
  const std::uint64_t wall = std::uint64_t{scene::tessellatedTriangles(renderer.cullView().maxTessellation)} *
                             scene.lods[scene.chains[1].patchLod].triangleCount;
  EXPECT_LT(s.triangles - wall, (s.trianglesFinest - wall) / 2);
  EXPECT_EQ(s.occluders, 1U);
}

}  // namespace
}  // namespace jalousie::render
