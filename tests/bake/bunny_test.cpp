// Compares the Stanford bunny with gltfpack's figures. Skipped if assets/fetch has not been run.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "bake/bake_fixtures.h"
#include "bake/io/gltf_mesh.h"
#include "bake/io/import.h"
#include "bake/mesh/bounds.h"
#include "bake/simplify/chain.h"

namespace jalousie::bake {
namespace {

const std::filesystem::path kBunny = std::filesystem::path(JALOUSIE_SOURCE_DIR) / "assets/fetched/bunny.ply";

/// Mean distance (% of the diagonal) and mean normal deviation (degrees) of gltfpack 1.3.0 -si R -se 1 -noq at 50, 25,
/// ... 1.5 %, measured with bench/bake_bench.
struct Rival {
  double mean, degrees;
};
constexpr std::array<Rival, 6> kGltfpack = {
    {{0.06172, 1.31}, {0.17326, 3.17}, {0.37650, 5.39}, {0.83384, 9.03}, {1.59006, 16.10}, {2.57106, 27.04}}};

WedgeMesh bunny() {
  Notes notes;
  const tinygltf::Model model = importFiles({kBunny}, {}, notes);
  return makeWedges(readCombinedMesh(model, model.meshes[0], {}));
}

TEST(Bunny, BestBeatsGltfpackInDistanceAndNormalsAtEveryLevel) {
  if (!std::filesystem::exists(kBunny)) GTEST_SKIP() << "assets/fetch bunny has not been run";
  ChainOptions options;
  options.levels = 7;
  const WedgeMesh mesh = bunny();
  const LevelChain chain = makeChain(mesh, options);
  ASSERT_EQ(chain.levels.size(), 7U);
  const double diagonal = boundsOf(mesh.positions).diagonal();
  for (std::size_t k = 0; k < kGltfpack.size(); ++k) {
    const Deviation& deviation = chain.levels[k + 1].deviation;
    EXPECT_LT(100.0 * deviation.twoSided.mean / diagonal, (k < 2 ? 0.8 : 0.75) * kGltfpack[k].mean) << k;
    EXPECT_LT(deviation.normalDegrees.mean, kGltfpack[k].degrees) << k;
  }
}

TEST(Bunny, FastIsNearerStill) {
  if (!std::filesystem::exists(kBunny)) GTEST_SKIP() << "assets/fetch bunny has not been run";
  ChainOptions options;
  options.levels = 7;
  options.preset = Preset::kFast;
  const WedgeMesh mesh = bunny();
  const LevelChain chain = makeChain(mesh, options);
  ASSERT_EQ(chain.levels.size(), 7U);
  const double diagonal = boundsOf(mesh.positions).diagonal();
  for (std::size_t k = 2; k < kGltfpack.size(); ++k)
    EXPECT_LT(100.0 * chain.levels[k + 1].deviation.twoSided.mean / diagonal, (k == 2 ? 0.6 : 0.45) * kGltfpack[k].mean)
        << k;
}

}  // namespace
}  // namespace jalousie::bake
