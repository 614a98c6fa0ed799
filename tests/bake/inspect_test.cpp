// Reads chains back from documents of this baker and of other tools.
#include "bake/report/inspect.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asset/accessor.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/report/sheet.h"
#include "bake/report/software_raster.h"

namespace jalousie::bake {
namespace {

void addMesh(tinygltf::Model& model, const asset::Primitive& source, int mode, const char* name) {
  constexpr int kTarget = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive primitive;
  primitive.mode = mode;
  primitive.attributes["POSITION"] = asset::appendVec3(model, source.positions, kTarget);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, source.normals, kTarget);
  primitive.indices = asset::appendIndices(model, source.indices);
  tinygltf::Mesh mesh;
  mesh.name = name;
  mesh.primitives = {primitive};
  tinygltf::Node node;
  node.mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(mesh);
  model.nodes.push_back(node);
}

tinygltf::Model twoMeshes() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  addMesh(model, test::sphere(24, 12), TINYGLTF_MODE_TRIANGLES, "ball <b>");
  addMesh(model, test::grid(1), TINYGLTF_MODE_TRIANGLE_STRIP, "strip");
  model.scenes.resize(1);
  model.scenes[0].nodes = {0, 1};
  return model;
}

tinygltf::Model baked() {
  tinygltf::Model model = twoMeshes();
  BakeOptions options;
  options.chain.levels = 4;
  options.chain.samples = 1000;
  bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
  return model;
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST(Inspect, CountsListsAndStripsOfForeignFiles) {
  const std::vector<InspectedChain> chains = inspectModel(twoMeshes());
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_EQ(chains[0].levels[0].triangles, 2U * 24 * 11);
  EXPECT_EQ(chains[1].levels[0].triangles, 4U);  // six indices as a strip
  EXPECT_FALSE(chains[0].levels[0].info.has_value());
  EXPECT_NE(inspectText(chains).find(" - "), std::string::npos);
}

TEST(Inspect, ShowsWhatTheBakerWrote) {
  const tinygltf::Model model = baked();
  const std::vector<InspectedChain> chains = inspectModel(model);
  ASSERT_EQ(chains.size(), 2U);
  ASSERT_EQ(chains[0].levels.size(), 4U);
  ASSERT_EQ(chains[0].coverage.size(), 4U);
  const nlohmann::json json = nlohmann::json::parse(inspectJson(chains));
  const auto& level = json["chains"][0]["levels"][3];
  EXPECT_EQ(level["triangles"], chains[0].levels[3].triangles);
  EXPECT_EQ(level["triangles"], chains[0].levels[3].info->triangles);
  EXPECT_EQ(level["vertices"], chains[0].levels[3].info->vertices);
  EXPECT_EQ(level["stop"], "no coarser level of the scene has fewer triangles of it");
  EXPECT_GT(level["mean_percent"], 0.0);
}

TEST(Sheet, IsOnePageWithAPictureOfEveryLevel) {
  SheetOptions options;
  options.title = "a & b";
  options.side = 32;
  const std::string page = sheetHtml(baked(), options);
  EXPECT_EQ(countOf(page, "<img "), 6U);                   // three levels, shaded and heat map
  EXPECT_EQ(countOf(page, "data:image/png;base64,"), 7U);  // and the original
  EXPECT_EQ(countOf(page, "http"), 0U);
  EXPECT_EQ(countOf(page, "<script"), 0U);
  EXPECT_EQ(countOf(page, "<svg"), 1U);
  EXPECT_NE(page.find("a &amp; b"), std::string::npos);
  EXPECT_NE(page.find("ball &lt;b&gt;"), std::string::npos);
  EXPECT_EQ(page, sheetHtml(baked(), options));
  options.maxChains = 0;
  EXPECT_NE(sheetHtml(baked(), options).find("1 are left out"), std::string::npos);
}

TEST(SoftwareRaster, CoversTheTriangleAndKeepsTheNearest) {
  asset::Primitive mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0.5F}, {0, -1, 0.5F}, {-1, 0, 0.5F}, {0, 0, 0}};
  mesh.normals.assign(7, {0, 0, 1});
  mesh.indices = {0, 1, 2, 3, 4, 5, 6, 6, 6};
  const WedgeMesh wedges = test::wedges(mesh);
  RasterView view;
  view.towardsEye = {0, 0, 1};
  view.side = 16;
  const std::vector<RasterSample> samples = rasterise(wedges, view);
  ASSERT_EQ(samples.size(), 32U * 32U);
  for (std::uint32_t y = 0; y < 32; ++y) {
    for (std::uint32_t x = 0; x < 32; ++x) {
      const double px = (x + 0.5) / 16.0 - 1.0;
      const double py = 1.0 - (y + 0.5) / 16.0;
      const std::uint32_t expected = px + py > 1e-9 ? ~0U : px + py < -1.0 - 1e-9 ? 1U : 0U;
      if (std::abs(px + py) < 1e-9 || std::abs(px + py + 1.0) < 1e-9) continue;
      EXPECT_EQ(samples[y * 32 + x].triangle, expected) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace jalousie::bake
