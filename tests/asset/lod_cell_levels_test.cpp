// Groups of cells of the baked format: through files, cuts, and broken tables.
#include "asset/lod_cell_levels.h"

#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "asset/asset_fixtures.h"
#include "asset/cell_cut.h"
#include "asset/gltf_quantize.h"

namespace jalousie::asset {
namespace {

using test::addNode;

const LodMeasures kMeasuredLevel{10.0, {0.5, 0.25}, {0.75, 0.125}, {0.75, 0.2}, {3.0, 9.0}, {0.01, 0.03}, 0.5, ""};

/// Three levels of 4, 3 and 2 cells with a triangle each. Groups of LOD 0: cells 0 and 2, cells 1 and 3; of LOD 1: all.
std::vector<LodCellLevels> tables() {
  return {{{}, {0, 1, 0, 1}, {{0.5, 0.125}, {0.25, 0.0625}}}, {{1, 2}, {0, 0, 0}, {{0.75, 0.125}}}, {{2}, {}, {}}};
}

tinygltf::Model cellLevelChain(const std::vector<LodCellLevels>& levels = tables()) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  std::vector<int> lower;
  for (std::uint32_t lod = 0; lod < levels.size(); ++lod) {
    const std::uint32_t filled = filledCells(levels[lod]);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t t = 0; t < filled; ++t)
      for (const glm::vec3 corner : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}) {
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(corner + glm::vec3(t, 0, 0));
      }
    tinygltf::Mesh mesh;
    mesh.primitives.resize(1);
    mesh.primitives[0].mode = TINYGLTF_MODE_TRIANGLES;
    mesh.primitives[0].attributes["POSITION"] = appendVec3(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER);
    mesh.primitives[0].indices = appendIndices(model, indices);
    setLodInfo(mesh, {lod, filled, 3 * filled, 0.25 * lod, kMeasuredLevel});
    CellTriangles cells = {std::vector<std::uint32_t>(4, 0)};
    std::fill_n(cells[0].begin(), filled, 1U);
    setLodCells(mesh, cells);
    setLodCellLevels(mesh, levels[lod]);
    model.meshes.push_back(mesh);
    addNode(model, static_cast<int>(lod));
    if (lod > 0) lower.push_back(static_cast<int>(lod));
  }
  setLodChain(model, 0, lower, std::vector<float>{});
  test::setScene(model, {0});
  return model;
}

TEST(LodCellLevels, SurviveEveryKindOfFile) {
  for (const bool quantize : {false, true}) {
    for (const bool compress : {false, true}) {
      tinygltf::Model model = cellLevelChain();
      if (quantize) quantizeModel(model);
      const tinygltf::Model read = parseGltf(encodeGlb(model, {compress}), "levels.glb");
      for (std::size_t k = 0; k < 3; ++k) {
        const LodCellLevels level = lodCellLevels(read, read.meshes[k]);
        EXPECT_EQ(level.producedCells, tables()[k].producedCells);
        EXPECT_EQ(level.groupOf, tables()[k].groupOf);
        ASSERT_EQ(level.errors.size(), tables()[k].errors.size());
        if (quantize) continue;
        for (std::size_t group = 0; group < level.errors.size(); ++group)
          EXPECT_EQ(level.errors[group].max, tables()[k].errors[group].max) << "four digits are enough for it";
      }
    }
  }
}

TEST(LodCellLevels, ErrorsAreRoundedUpToFourDigits) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> exponent(-30.0, 30.0);
  std::vector<LodCellLevels> levels = tables();
  for (int i = 0; i < 200; ++i) {
    const double error = std::pow(10.0, exponent(random));
    levels[1].errors[0] = {2.0 * error, error};
    levels[0].errors = {{error, 0.0}, {0.0, 0.0}};
    tinygltf::Model model = cellLevelChain(levels);
    const double read = lodCellLevels(model, model.meshes[1]).errors[0].mean;
    EXPECT_GE(read, error);
    EXPECT_LE(read, 1.0011 * error);
  }
}

TEST(LodCellLevels, NewInfoRemovesThemAndOlderFormatsHaveNone) {
  tinygltf::Model model = cellLevelChain();
  tinygltf::Value::Object own = model.meshes[1].extras.Get("jalousie").Get<tinygltf::Value::Object>();
  own["format"] = tinygltf::Value(5);
  tinygltf::Mesh older = model.meshes[1];
  older.extras = tinygltf::Value(tinygltf::Value::Object{{"jalousie", tinygltf::Value(std::move(own))}});
  EXPECT_TRUE(lodCellLevels(model, older).empty());
  setLodInfo(model.meshes[0], {0, 4, 12, 0.0, kMeasuredLevel});
  EXPECT_TRUE(lodCellLevels(model, model.meshes[0]).empty());
}

nlohmann::json documentIn(const std::vector<std::byte>& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const char* text = reinterpret_cast<const char*>(glb.data()) + 20;
  return nlohmann::json::parse(text, text + length);
}

/// The message about a file with one other value; empty if it can be read.
std::string refusalOf(const std::string& pointer, const nlohmann::json& value) {
  const std::vector<std::byte> good = encodeGlb(cellLevelChain());
  nlohmann::json document = documentIn(good);
  document[nlohmann::json::json_pointer(pointer)] = value;
  std::uint32_t length = 0;
  std::memcpy(&length, good.data() + 12, 4);
  const char* binary = reinterpret_cast<const char*>(good.data()) + 28 + length;
  const std::string bad =
      test::glb(document.dump(), std::string(binary, reinterpret_cast<const char*>(good.data() + good.size())));
  try {
    parseGltf(std::as_bytes(std::span(bad)), "bad.glb");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMalformed) << error.what();
    return error.what();
  }
  return {};
}

TEST(LodCellLevels, BrokenTablesAreRefusedWithTheReason) {
  const auto expect = [](int lod, const std::string& member, const nlohmann::json& value, const std::string& reason) {
    const std::string pointer = "/meshes/" + std::to_string(lod) + "/extras/jalousie/cellLevels" + member;
    const std::string message = refusalOf(pointer, value);
    EXPECT_NE(message.find(reason), std::string::npos) << pointer << " " << value << ": " << message;
  };
  expect(0, "", 3, "cellLevels is not an object");
  expect(0, "", {{"max", {1.0}}}, "has 1 maxima and 0 means");
  expect(0, "", {{"other", 1}}, "has neither producers nor groups");
  expect(0, "/groups", 3, "cellLevels.groups is not a list");
  expect(0, "/groups/1", 2, "cell 1 is in group 2 of 2");
  expect(0, "/groups/1", -1, "groups: entry 1 is no count");
  expect(0, "/groups/1", 0.5, "groups: entry 1 is no count");
  expect(0, "/groups", {0, 1, 0}, "cell 3 has triangles and is in no group");
  expect(0, "/groups", {0, 1, 0, 1, 0}, "counts 5 cells of 4");
  expect(0, "/groups", {0, 0, 0, 0}, "group 1 has no cell");
  expect(0, "/max/0", -0.5, "max: entry 0 is no length");
  expect(0, "/max/0", 1e300, "max: entry 0 is no length");
  expect(0, "/max/0", "1", "max: entry 0 is no length");
  expect(0, "/mean/0", 0.6, "the mean of group 0 is larger than its maximum");
  expect(0, "/mean", {0.1}, "has 2 maxima and 1 means");
  expect(0, "/producers", {4}, "LOD 0 has producers");
  expect(1, "/producers", {1, 1}, "its producers have 2 cells, its groups have 3");
  expect(1, "/producers", {3}, "it has 1 producers, the finer level has 2 groups");
  expect(1, "/max/0", 0.4, "the error of group 0 is less than that of a group below it");
  expect(1, "/mean/0", 0.05, "the error of group 0 is less than that of a group below it");
  expect(2, "/groups", {0, 0}, "cell 0 is in group 0 of 0");
  expect(2, "/producers", {2147483647}, "counts 2147483647 cells of 4");
  EXPECT_EQ(refusalOf("/meshes/1/extras/jalousie/cellLevels/max/0", 0.5), "") << "equal errors are allowed";
}

TEST(LodCellLevels, ALevelWithoutThemIsRefused) {
  for (const std::size_t without : {0U, 1U, 2U}) {
    std::vector<LodCellLevels> levels = tables();
    levels[without] = {};
    EXPECT_EQ(test::codeOf([&] { requireHierarchy(levels); }), ErrorCode::kMalformed) << without;
  }
  EXPECT_NO_THROW(requireHierarchy(tables()));
  EXPECT_NO_THROW(requireHierarchy(std::vector<LodCellLevels>(3)));
}

TEST(CellCut, IsLegalIfCoarseGroupsStandOnCoarseOnes) {
  const CellHierarchy hierarchy(tables());
  ASSERT_EQ(hierarchy.levels(), 3U);
  EXPECT_EQ(hierarchy.cells(0), 4U);
  EXPECT_EQ(hierarchy.cells(2), 2U);
  EXPECT_EQ(hierarchy.producerOf(1, 0), 0U);
  EXPECT_EQ(hierarchy.producerOf(1, 2), 1U);
  CellCut cut = {{1, 0}, {1}};
  EXPECT_FALSE(hierarchy.isLegal(cut));
  hierarchy.makeLegal(cut);
  EXPECT_EQ(cut, (CellCut{{1, 0}, {0}}));
  EXPECT_TRUE(hierarchy.isLegal(cut));
  const auto drawn = [&](std::size_t level) {
    std::vector<bool> cells;
    for (std::uint32_t cell = 0; cell < hierarchy.cells(level); ++cell)
      cells.push_back(hierarchy.isDrawn(cut, level, cell));
    return cells;
  };
  EXPECT_EQ(drawn(0), (std::vector<bool>{false, true, false, true}));
  EXPECT_EQ(drawn(1), (std::vector<bool>{true, false, false}));
  EXPECT_EQ(drawn(2), (std::vector<bool>{false, false}));
}

TEST(CellCut, ByEyeAndErrorIsLegalByItself) {
  const CellHierarchy hierarchy(tables());
  std::vector<std::vector<Aabb>> cells(3);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-2.0F, 2.0F);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::uint32_t cell = 0; cell < hierarchy.cells(k); ++cell) {
      Aabb box;
      for (int i = 0; i < 3; ++i)
        box.add(glm::vec3(place(random), place(random), place(random)));
      cells[k].push_back(box);
    }
  const auto boxes = groupBoxes(hierarchy, cells);
  std::set<CellCut> seen;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 eye(4.0F * place(random), 4.0F * place(random), 4.0F * place(random));
    const CellCut cut = cutForEye(hierarchy, boxes, eye, 0.05 + 0.01 * (i % 30));
    EXPECT_TRUE(hierarchy.isLegal(cut));
    seen.insert(cut);
    EXPECT_TRUE(hierarchy.isLegal(cutForError(hierarchy, 0.0005 * i)));
  }
  EXPECT_GE(seen.size(), 4U);
  EXPECT_EQ(cutForError(hierarchy, 0.3), (CellCut{{0, 1}, {0}}));
  EXPECT_EQ(cutForError(hierarchy, 0.3, CutBy::kMean), (CellCut{{1, 1}, {1}}));
}

}  // namespace
}  // namespace jalousie::asset
