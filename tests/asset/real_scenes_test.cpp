// Two whole scenes made by others; their folder comes from the environment variable JALOUSIE_SCENES.
#include <cstdlib>
#include <set>

#include "asset/asset_fixtures.h"
#include "asset/scene_file.h"

namespace jalousie::asset {
namespace {

struct Expected {
  const char* name;
  std::size_t instances;
  std::size_t meshes;
  std::uint64_t triangles;
  std::size_t maskMaterials;
};

class RealScenes : public testing::TestWithParam<Expected> {};

std::uint64_t triangleCount(const SceneFile& scene) {
  std::uint64_t triangles = 0;
  for (const Instance& instance : scene.instances) {
    for (const Primitive& primitive : scene.meshes[scene.chains[instance.chain].levels[0].mesh].primitives)
      triangles += primitive.indices.size() / 3;
  }
  return triangles;
}

TEST_P(RealScenes, ReadsCompletely) {
  const char* folder = std::getenv("JALOUSIE_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "JALOUSIE_SCENES does not name a folder of scenes";
  const std::filesystem::path file = std::filesystem::path(folder) / GetParam().name / "scene.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " does not exist";
  const SceneFile scene = readSceneFile(file);
  EXPECT_EQ(scene.instances.size(), GetParam().instances);
  EXPECT_EQ(scene.meshes.size(), GetParam().meshes);
  EXPECT_EQ(triangleCount(scene), GetParam().triangles);
  std::size_t masks = 0;
  for (const Material& material : scene.materials)
    masks += material.alphaMode == AlphaMode::kMask ? 1 : 0;
  EXPECT_EQ(masks, GetParam().maskMaterials);
  EXPECT_GT(scene.images.size(), 50U);
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      EXPECT_EQ(primitive.normals.size(), primitive.positions.size());
      EXPECT_EQ(primitive.uvs.size(), primitive.positions.size());
      EXPECT_LT(primitive.material, scene.materials.size());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RealScenes,
                         testing::Values(Expected{"cornfield_crossing", 486, 61, 330'694, 26},
                                         Expected{"candela_city", 807, 63, 444'660, 22}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace jalousie::asset
