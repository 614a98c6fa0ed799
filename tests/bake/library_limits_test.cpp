// Calls of meshoptimizer and OpenMesh keep their preconditions, whatever a mesh and the options ask for.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "asset/accessor.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/io/import.h"
#include "bake/mesh/clean.h"
#include "bake/simplify/chain.h"
#include "bake/simplify/draft.h"

namespace jalousie::bake {
namespace {

/// Strip of `triangles` triangles in a plane; a second part of one triangle far away; a triangle without area.
struct TinyMesh {
  std::uint32_t triangles = 0;
  bool twoParts = false;
  bool degenerate = false;

  std::string obj() const {
    std::string text;
    for (std::uint32_t v = 0; v < triangles + 2; ++v)
      text += "v " + std::to_string(v / 2) + " " + std::to_string(v % 2) + " " + std::to_string(v * v % 3) + "\n";
    text += "v 50 50 50\nv 51 50 50\nv 50 51 50\n";
    for (std::uint32_t t = 0; t < triangles; ++t)
      text += "f " + std::to_string(t + 1) + " " + std::to_string(t + 2 + t % 2) + " " + std::to_string(t + 3 - t % 2) +
              "\n";
    if (twoParts) text += "f -3 -2 -1\n";
    if (degenerate) text += "f -3 -3 -2\n";
    return text;
  }
  std::uint32_t usable() const { return triangles + (twoParts ? 1U : 0U); }
};

std::vector<TinyMesh> tinyMeshes() {
  std::vector<TinyMesh> meshes;
  for (const std::uint32_t triangles : {0U, 1U, 2U, 3U, 4U, 5U, 9U})
    for (const bool twoParts : {false, true})
      for (const bool degenerate : {false, true})
        meshes.push_back({triangles, twoParts, degenerate});
  return meshes;
}

std::vector<ChainOptions> chainOptions() {
  std::vector<ChainOptions> all;
  for (const Preset preset : {Preset::kBest, Preset::kFast, Preset::kDraft}) {
    for (const std::uint32_t levels : {1U, 2U, 3U, 10U}) {
      ChainOptions options;
      options.preset = preset;
      options.levels = levels;
      options.samples = 100;
      options.untilError = 1e9;
      for (const double ratio : {0.05, 0.5, 0.95}) {
        options.ratio = ratio;
        all.push_back(options);
      }
      for (const std::uint32_t coarsest : {4U, 5U, 8U, 1000U}) {
        options.coarsest = coarsest;
        all.push_back(options);
      }
      options.coarsest.reset();
      options.ratios = {1.0, 0.9, 1e-6};
      all.push_back(options);
    }
  }
  return all;
}

TEST(LibraryLimits, TinyMeshesBakeWithEveryCombinationOfOptions) {
  for (const TinyMesh& mesh : tinyMeshes()) {
    for (const ChainOptions& chain : chainOptions()) {
      SCOPED_TRACE(testing::Message() << mesh.triangles << " triangles, " << mesh.twoParts << mesh.degenerate
                                      << ", preset " << static_cast<int>(chain.preset) << ", levels " << chain.levels
                                      << ", ratio " << chain.ratio << ", coarsest " << chain.coarsest.value_or(0));
      BakeOptions options;
      options.chain = chain;
      std::optional<std::vector<MeshReport>> reports;
      const auto code = test::codeOf([&] {
        tinygltf::Model model = importBytes(test::bytesOf(mesh.obj()), "tiny.obj", options.limits);
        reports = bakeDocument(model, options, [](auto, auto, const auto&) {});
      });
      if (mesh.usable() == 0 && !mesh.degenerate) {
        EXPECT_EQ(code, ErrorCode::kUnsupported);
        continue;
      }
      ASSERT_EQ(code, std::nullopt);
      ASSERT_EQ(reports->size(), 1U);
      if (mesh.usable() == 0) {
        EXPECT_EQ(reports->front().passedThrough, "it has no triangle with area");
        continue;
      }
      ASSERT_FALSE(reports->front().levels.empty());
      EXPECT_EQ(reports->front().levels[0].triangles, mesh.usable());
      for (std::size_t k = 1; k < reports->front().levels.size(); ++k)
        EXPECT_LT(reports->front().levels[k].triangles, reports->front().levels[k - 1].triangles);
    }
  }
}

TEST(LibraryLimits, ADraftThatAsksForMoreTrianglesThanThereAreKeepsThem) {
  const WedgeMesh mesh = test::wedges(test::grid(2));
  for (const std::uint32_t target : {8U, 9U, 40U, 1'000'000U})
    EXPECT_EQ(draftCorners(mesh, mesh.corners, target, false), mesh.corners) << target;
}

/// A grid with so many texture coordinates.
tinygltf::Model manyAttributes(std::size_t attributes) {
  const asset::Primitive source = test::grid(4);
  tinygltf::Model model;
  model.asset.version = "2.0";
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, source.positions, 0);
  for (std::size_t i = 1; i < attributes; ++i)
    primitive.attributes["TEXCOORD_" + std::to_string(i - 1)] = asset::appendVec2(model, source.uvs, 0);
  primitive.indices = asset::appendIndices(model, source.indices);
  tinygltf::Mesh mesh;
  mesh.primitives = {primitive};
  model.meshes = {mesh};
  tinygltf::Node node;
  node.mesh = 0;
  model.nodes = {node};
  return model;
}

TEST(LibraryLimits, MoreAttributesThanTheLibraryTakesArePassedOn) {
  for (const std::size_t attributes : {16U, 17U, 40U}) {
    tinygltf::Model model = manyAttributes(attributes);
    BakeOptions options;
    options.chain.samples = 100;
    const std::vector<MeshReport> reports = bakeDocument(model, options, [](auto, auto, const auto&) {});
    EXPECT_EQ(reports.at(0).passedThrough.empty(), attributes == 16) << reports[0].passedThrough;
    if (attributes > 16) {
      EXPECT_EQ(reports[0].passedThrough, "it has a primitive with " + std::to_string(attributes) + " attributes");
    }
  }
}

}  // namespace
}  // namespace jalousie::bake
