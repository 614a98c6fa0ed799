// bake_patches: how near Phong tessellation comes to a mesh with a fitted control mesh, with an unfitted one, and how
// near discrete levels of as many triangles come.
//
//   bake_patches FILE [PATCHES]...      prints its head and then one JSON object per line; PATCHES is 98 unless told
//
// FILE has one mesh. For each number of patches, the base is a level of the chain, as jalousie tessellates it, and
// `fitted` is the base after fitPatches. For each tessellation level, `plain`, `fitted` and `discrete` hold what
// jalousie-bake would measure (DeviationMeter): `mean` and `max` are two-sided, in % of the diagonal, and `normal` is
// the mean angle between shading normals in degrees. `discrete` is a level of about as many triangles; it is absent
// where FILE has fewer. Exit code 1 if a fit is farther from the mesh than its base.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bake/io/gltf_mesh.h"
#include "bake/io/import.h"
#include "bake/mesh/wedges.h"
#include "bake/pipeline/threads.h"
#include "bake/simplify/level_maker.h"
#include "bake/simplify/patch_fit.h"
#include "bench_head.h"
#include "cli/program.h"
#include "core/aabb.h"
#include "core/error.h"

namespace {

using namespace jalousie;
using bake::WedgeMesh;

constexpr std::array<std::uint32_t, 9> kTessellation = {1, 2, 3, 4, 6, 8, 11, 15, 20};

WedgeMesh loadOne(const std::string& file) {
  bake::Notes notes;
  const tinygltf::Model model = bake::importFiles({file}, {}, notes);
  if (model.meshes.size() != 1)
    throw Error(ErrorCode::kUnsupported, "has several meshes: give a file with one, before it is baked", file);
  return bake::makeWedges(bake::readCombinedMesh(model, model.meshes[0], {}));
}

std::uint32_t countOf(std::string_view text) {
  std::uint32_t count = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (status != std::errc() || end != text.data() + text.size() || count < bake::kMinLevelTriangles)
    throw Error(ErrorCode::kUsage, fmt::format("{} is not a number of patches from 4 on, as in 98", text));
  return count;
}

/// What one model is measured with.
class Comparison {
 public:
  explicit Comparison(const WedgeMesh& mesh)
      : mesh_(mesh), meter_(mesh, {.slices = bake::threadedSlices(0)}), percent_(percentOf(mesh)) {
    chain_.slices = bake::threadedSlices(0);
  }

  /// @return  whether the fit is at least as near as its base
  bool print(std::uint32_t patches) {
    const bake::PatchMesh plain = bake::patchesOf(level(patches));
    const bake::PatchFit fit = bake::fitPatches(mesh_, plain, {.slices = bake::threadedSlices(0)});
    const auto count = static_cast<std::uint32_t>(plain.indices.size() / 3);
    fmt::print("{}\n", nlohmann::ordered_json{{"patches", count},
                                              {"alpha", fit.mesh.alpha},
                                              {"rounds", fit.rounds},
                                              {"rms_before", fit.before * percent_},
                                              {"rms_after", fit.after * percent_}}
                           .dump());
    for (const std::uint32_t n : kTessellation) {
      const auto triangles = static_cast<std::uint32_t>(count * (bake::patchPattern(n).indices.size() / 3));
      nlohmann::ordered_json row = {{"patches", count},
                                    {"tessellation", n},
                                    {"triangles", triangles},
                                    {"plain", jsonOf(bake::measurePatches(meter_, plain, n))},
                                    {"fitted", jsonOf(bake::measurePatches(meter_, fit.mesh, n))}};
      if (triangles < mesh_.triangles()) row["discrete"] = jsonOf(meter_.measure(level(triangles)));
      fmt::print("{}\n", row.dump());
      std::fflush(stdout);
    }
    return fit.after <= fit.before;
  }

 private:
  static double percentOf(const WedgeMesh& mesh) {
    Aabb box;
    for (const glm::vec3& p : mesh.positions)
      box.add(p);
    return 100.0 / box.diagonal();
  }
  /// A level of the chain that has about as many triangles.
  WedgeMesh level(std::uint32_t triangles) const {
    bake::LevelMaker maker(mesh_, chain_);
    bake::LevelMaker::Level level = maker.make(triangles, true);
    maker.refit(level);
    return std::move(level.mesh);
  }
  nlohmann::ordered_json jsonOf(const bake::Deviation& deviation) const {
    return {{"mean", deviation.twoSided.mean * percent_},
            {"max", deviation.twoSided.max * percent_},
            {"normal", deviation.normalDegrees.mean}};
  }

  const WedgeMesh& mesh_;
  bake::ChainOptions chain_;
  bake::DeviationMeter meter_;
  double percent_;
};

int run(const std::vector<std::string>& arguments) {
  std::vector<std::uint32_t> patches;
  for (std::size_t i = 1; i < arguments.size(); ++i)
    patches.push_back(countOf(arguments[i]));
  if (patches.empty()) patches.push_back(98);
  const WedgeMesh mesh = loadOne(arguments[0]);
  fmt::print("{}\n", bench::toJson(bench::makeHead("bake_patches", arguments)).dump());
  Comparison comparison(mesh);
  bool right = true;
  for (const std::uint32_t count : patches)
    right &= comparison.print(count);
  return right ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments[0].starts_with("--")) {
    fmt::print(stderr,
               "usage: bake_patches FILE [PATCHES]...\n"
               "example: bake_patches bunny.ply 98 392\n");
    return 2;
  }
  return cli::runProgram("bake_patches", [&] { return run(arguments); });
}
