// Chains in documents: what is added, kept and passed through.
#include "bake/io/bake_document.h"

#include <gtest/gtest.h>

#include <cmath>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "asset/scene_file.h"
#include "bake/bake_fixtures.h"
#include "bake/report/report.h"
#include "support/run_program.h"

namespace jalousie::bake {
namespace {

tinygltf::Primitive primitiveOf(tinygltf::Model& model, const asset::Primitive& mesh, int material) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = material;
  primitive.attributes["POSITION"] = asset::appendVec3(model, mesh.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, mesh.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["TEXCOORD_0"] = asset::appendVec2(model, mesh.uvs, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, mesh.indices);
  return primitive;
}

/// A hierarchy: a parent that moves, two children that share one mesh of two materials, one child with lines.
tinygltf::Model document() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.materials.resize(2);
  model.materials[0].name = "stone";
  model.materials[1].name = "moss";
  model.meshes.resize(2);
  model.meshes[0].name = "rock";
  model.meshes[0].primitives = {primitiveOf(model, test::sphere(40, 20), 0),
                                primitiveOf(model, test::sphere(32, 16), 1)};
  model.meshes[1].name = "lines";
  model.meshes[1].primitives = {primitiveOf(model, test::box(glm::vec3(1)), 0)};
  model.meshes[1].primitives[0].mode = TINYGLTF_MODE_LINE;
  model.nodes.resize(4);
  model.nodes[0].name = "parent";
  model.nodes[0].translation = {1, 2, 3};
  model.nodes[0].children = {1, 2, 3};
  for (const int n : {1, 2}) {
    model.nodes[static_cast<std::size_t>(n)].name = n == 1 ? "left" : "right";
    model.nodes[static_cast<std::size_t>(n)].mesh = 0;
    model.nodes[static_cast<std::size_t>(n)].translation = {n == 1 ? -2.0 : 2.0, 0, 0};
  }
  model.nodes[3].mesh = 1;
  model.scenes.resize(1);
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  return model;
}

std::vector<MeshReport> bakeIt(tinygltf::Model& model) {
  BakeOptions options;
  options.chain.levels = 5;
  options.chain.samples = 1000;
  options.keepUnused = true;  // no material of the document has a texture
  return bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
}

TEST(BakeDocument, SharedMeshIsBakedOnceAndEveryNodeGetsItsChain) {
  tinygltf::Model model = document();
  const std::vector<MeshReport> reports = bakeIt(model);
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[0].nodes, 2U);
  EXPECT_EQ(reports[0].levels.size(), 5U);
  const std::vector<int> left = asset::lodNodes(model, 1);
  const std::vector<int> right = asset::lodNodes(model, 2);
  ASSERT_EQ(left.size(), 4U);
  ASSERT_EQ(right.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    const tinygltf::Node& a = model.nodes[static_cast<std::size_t>(left[k])];
    const tinygltf::Node& b = model.nodes[static_cast<std::size_t>(right[k])];
    EXPECT_EQ(a.mesh, b.mesh);
    EXPECT_EQ(a.translation, model.nodes[1].translation);
    EXPECT_EQ(b.translation, model.nodes[2].translation);
    const auto info = asset::lodInfo(model.meshes[static_cast<std::size_t>(a.mesh)]);
    ASSERT_TRUE(info.has_value());
    EXPECT_EQ(info->lod, k + 1);
    EXPECT_EQ(info->triangles, reports[0].levels[k + 1].triangles);
    EXPECT_EQ(info->vertices, reports[0].levels[k + 1].vertices);
    EXPECT_EQ(info->errorObject, reports[0].levels[k + 1].errorObject);
  }
  EXPECT_EQ(asset::lodCoverage(model.nodes[1]).size(), 5U);
}

TEST(BakeDocument, LevelsOfAnAnimatedNodeMoveWithIt) {
  tinygltf::Model model = document();
  tinygltf::Animation animation;
  animation.samplers.resize(1);
  animation.samplers[0].input = asset::appendScalars(model, std::vector<float>{0.0F, 1.0F}, 0);
  animation.samplers[0].output = asset::appendVec3(model, std::vector<glm::vec3>{{0, 0, 0}, {1, 1, 1}}, 0);
  animation.channels.resize(1);
  animation.channels[0].sampler = 0;
  animation.channels[0].target_node = 1;
  animation.channels[0].target_path = "translation";
  model.animations = {animation};
  bakeIt(model);
  const std::vector<int> lower = asset::lodNodes(model, 1);
  ASSERT_EQ(model.animations[0].channels.size(), 1 + lower.size());
  for (std::size_t k = 0; k < lower.size(); ++k)
    EXPECT_EQ(model.animations[0].channels[k + 1].target_node, lower[k]);
}

TEST(BakeDocument, MaterialsHierarchyAndNamesSurviveTheRoundTrip) {
  tinygltf::Model model = document();
  bakeIt(model);
  const test::TemporaryFolder folder;
  asset::saveGlb(model, folder / "baked.glb");
  const tinygltf::Model read = asset::loadGltf(folder / "baked.glb");
  EXPECT_EQ(read.scenes[0].nodes, std::vector<int>{0});
  EXPECT_EQ(read.nodes[0].children, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(read.nodes[1].name, "left");
  EXPECT_EQ(read.materials[1].name, "moss");
  const tinygltf::Mesh& rock = read.meshes[static_cast<std::size_t>(read.nodes[1].mesh)];
  ASSERT_EQ(rock.primitives.size(), 2U);
  EXPECT_EQ(rock.primitives[1].material, 1);
  EXPECT_TRUE(rock.primitives[0].attributes.contains("TEXCOORD_0"));

  const asset::SceneFile scene = asset::readSceneFile(folder / "baked.glb");
  EXPECT_EQ(scene.instances.size(), 2U);
  ASSERT_EQ(scene.chains.size(), 1U);
  ASSERT_EQ(scene.chains[0].levels.size(), 5U);
  for (std::size_t k = 1; k < 5; ++k)
    EXPECT_GE(scene.chains[0].levels[k].errorObject, scene.chains[0].levels[k - 1].errorObject);
}

TEST(BakeDocument, GroupsWithLevelsPassThrough) {
  tinygltf::Model model = document();  // node 0 is the parent of 1 and 2, which show the rock, and 3
  model.meshes.push_back(model.meshes[0]);
  tinygltf::Node lower;
  lower.mesh = 2;
  model.nodes.push_back(lower);
  tinygltf::Node level;
  level.children = {static_cast<int>(model.nodes.size()) - 1};
  model.nodes.push_back(level);
  asset::setLodChain(model, 0, std::vector<int>{static_cast<int>(model.nodes.size()) - 1},
                     std::vector<float>{0.5F, 0.0F});
  const std::size_t nodes = model.nodes.size();
  const std::vector<MeshReport> reports = bakeIt(model);
  EXPECT_EQ(reports[0].passedThrough, "it is part of a group that has levels already");
  EXPECT_EQ(reports[2].passedThrough, "it is a level of a chain already");
  EXPECT_EQ(model.nodes.size(), nodes);
  const test::TemporaryFolder folder;
  asset::saveGlb(model, folder / "passed.glb");
  EXPECT_EQ(asset::readSceneFile(folder / "passed.glb").chains.at(0).levels.size(), 2U);
}

TEST(BakeDocument, WhatCannotBeBakedIsPassedThroughWithTheReason) {
  tinygltf::Model model = document();
  const tinygltf::Mesh before = model.meshes[1];
  const std::vector<MeshReport> reports = bakeIt(model);
  EXPECT_FALSE(reports[1].passedThrough.empty());
  EXPECT_TRUE(model.meshes[1] == before);
  tinygltf::Model again = model;  // a second bake leaves chains alone
  EXPECT_FALSE(bakeIt(again)[0].passedThrough.empty());
}

TEST(BakeDocument, SameInputSameBytes) {
  tinygltf::Model a = document();
  tinygltf::Model b = document();
  bakeIt(a);
  bakeIt(b);
  EXPECT_EQ(asset::encodeGlb(a), asset::encodeGlb(b));
}

TEST(BakeDocument, NanPositionsAreDroppedAndCounted) {
  tinygltf::Model model = document();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(model.buffers[0].data.data(), &nan, sizeof(nan));
  const std::vector<MeshReport> reports = bakeIt(model);
  EXPECT_GT(reports[0].findings.cleaned.notFinite, 0U);
  EXPECT_EQ(reports[0].levels.size(), 5U);
}

TEST(BakeDocument, MeasuresAreWrittenIntoTheFile) {
  tinygltf::Model model = document();
  const std::vector<MeshReport> reports = bakeIt(model);
  const std::vector<int> lower = asset::lodNodes(model, 1);
  const auto info =
      asset::lodInfo(model.meshes[static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(lower[3])].mesh)]);
  ASSERT_TRUE(info && info->measures);
  const asset::LodMeasures& measures = *info->measures;
  EXPECT_GT(measures.toOriginal.mean, 0.0);
  EXPECT_GT(measures.fromOriginal.mean, 0.0);
  EXPECT_GE(measures.normalDegrees.p95, measures.normalDegrees.mean * 0.5);
  EXPECT_GT(measures.uv.mean, 0.0);
  EXPECT_EQ(measures.stop, reports[0].stopReason);
  EXPECT_EQ(measures.coverage, asset::lodCoverage(model.nodes[1])[4]);
}

TEST(BakeDocument, ABakedDocumentStaysAsItIs) {  // found by flipping bits: levels got chains of their own
  tinygltf::Model model = document();
  bakeIt(model);
  const std::vector<std::byte> once = asset::encodeGlb(model);
  tinygltf::Model again = asset::parseGltf(once, "baked.glb");
  for (const MeshReport& report : bakeIt(again))
    EXPECT_FALSE(report.passedThrough.empty()) << report.name;
  EXPECT_EQ(asset::encodeGlb(std::move(again)), once);
}

TEST(BakeDocument, NumbersThatAreNotFiniteInPassedMeshesAreRefused) {
  for (const bool inTarget : {false, true}) {
    tinygltf::Model model = document();
    const std::vector<glm::vec3> good = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<glm::vec3> bad = {{0, 0, 0}, {NAN, 0, 0}, {0, INFINITY, 0}};
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_POINTS;
    primitive.attributes["POSITION"] = asset::appendVec3(model, inTarget ? good : bad, 0);
    if (inTarget) primitive.targets = {{{"POSITION", asset::appendVec3(model, bad, 0)}}};
    model.meshes[1].primitives = {primitive};
    try {
      bakeIt(model);
      ADD_FAILURE() << inTarget;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kMalformed);
      EXPECT_NE(std::string(error.what()).find("POSITION holds NaN or an infinite number"), std::string::npos)
          << error.what();
      EXPECT_NE(std::string(error.what()).find("points or lines only"), std::string::npos) << error.what();
    }
  }
}

/// A bent panel whose squares are separate charts, as automatic unwrapping leaves them. Its material has no texture.
tinygltf::Model panelOfCharts(std::uint32_t n) {
  asset::Primitive panel;
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const auto first = static_cast<std::uint32_t>(panel.positions.size());
      for (std::uint32_t k = 0; k < 4; ++k) {
        panel.positions.emplace_back(static_cast<float>(x + k % 2), static_cast<float>(y + (k >> 1U)), 0.0F);
        panel.normals.emplace_back(0.0F, 0.0F, 1.0F);
        panel.uvs.emplace_back(static_cast<float>(7 * x + 3 * y + k % 2) * 0.01F, static_cast<float>(k >> 1U) * 0.01F);
      }
      panel.indices.insert(panel.indices.end(), {first, first + 1, first + 3, first, first + 3, first + 2});
    }
  }
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.materials.resize(1);
  model.meshes.resize(1);
  model.meshes[0].primitives = {primitiveOf(model, panel, 0)};
  model.nodes.resize(1);
  model.nodes[0].mesh = 0;
  model.scenes.resize(1);
  model.scenes[0].nodes = {0};
  return model;
}

std::vector<MeshReport> bakeHalves(tinygltf::Model& model, bool keepUnused) {
  BakeOptions options;
  options.chain.ratios = {0.5, 0.1};
  options.keepUnused = keepUnused;
  return bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
}

const tinygltf::Primitive& levelPrimitive(const tinygltf::Model& model, int k) {
  const int node = k == 0 ? 0 : asset::lodNodes(model, 0).at(static_cast<std::size_t>(k) - 1);
  return model.meshes.at(static_cast<std::size_t>(model.nodes.at(static_cast<std::size_t>(node)).mesh))
      .primitives.at(0);
}

TEST(UnusedAttributes, DoNotHoldAFlatPanelTogether) {
  tinygltf::Model model = panelOfCharts(10);
  const MeshReport report = bakeHalves(model, false).at(0);
  ASSERT_EQ(report.levels.size(), 3U);
  EXPECT_LE(report.levels[2].triangles, 20U);
  EXPECT_LT(report.levels[2].errorObject, 1e-5 * report.diagonal);
  EXPECT_EQ(report.findings.unusedAttributes, std::vector<std::string>{"TEXCOORD_0"});
  EXPECT_NE(reportText({report}).find("TEXCOORD_0 left out"), std::string::npos);
  // Nothing is lost at LOD 0.
  const auto& finest = levelPrimitive(model, 0).attributes;
  EXPECT_TRUE(finest.contains("TEXCOORD_0"));
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(finest.at("POSITION"))].count, 400U);
  EXPECT_FALSE(levelPrimitive(model, 1).attributes.contains("TEXCOORD_0"));
}

TEST(UnusedAttributes, AreKeptOnRequestAndWhereATextureReadsThem) {
  tinygltf::Model kept = panelOfCharts(6);
  EXPECT_TRUE(bakeHalves(kept, true).at(0).findings.unusedAttributes.empty());
  EXPECT_TRUE(levelPrimitive(kept, 1).attributes.contains("TEXCOORD_0"));
  const auto survives = [](const std::function<void(tinygltf::Model&)>& change) {
    tinygltf::Model model = panelOfCharts(6);
    change(model);
    return bakeHalves(model, false).at(0).findings.unusedAttributes.empty() &&
           levelPrimitive(model, 1).attributes.contains("TEXCOORD_0");
  };
  using tinygltf::Value;
  const auto object = [](const std::string& key, const Value& value) { return Value(Value::Object{{key, value}}); };
  EXPECT_TRUE(survives([](tinygltf::Model& model) { model.materials[0].emissiveTexture.index = 0; }));
  EXPECT_TRUE(survives([](tinygltf::Model& model) { model.meshes[0].primitives[0].material = -1; }));
  EXPECT_TRUE(survives([&](tinygltf::Model& model) {  // sets are numbered without gaps
    auto& attributes = model.meshes[0].primitives[0].attributes;
    attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"];
    model.materials[0].pbrMetallicRoughness.baseColorTexture.index = 0;
    model.materials[0].pbrMetallicRoughness.baseColorTexture.texCoord = 1;
  }));
  EXPECT_TRUE(survives([&](tinygltf::Model& model) {  // the texture of a feature belongs to no material
    const Value texture(Value::Object{{"index", Value(0)}, {"texCoord", Value(0)}});
    model.meshes[0].primitives[0].extensions["EXT_mesh_features"] =
        object("featureIds", Value(Value::Array{object("texture", texture)}));
  }));
  EXPECT_TRUE(survives([&](tinygltf::Model& model) {
    model.meshes[0].primitives[0].extensions["EXT_structural_metadata"] =
        object("propertyTextures", Value(Value::Array{Value(0)}));
    model.extensions["EXT_structural_metadata"] = object(
        "propertyTextures", Value(Value::Array{object("properties", object("heat", object("index", Value(0))))}));
  }));
  EXPECT_TRUE(survives([&](tinygltf::Model& model) {  // a texture of an extension
    model.materials[0].extensions["KHR_materials_sheen"] = object("sheenColorTexture", object("index", Value(0)));
  }));
  EXPECT_TRUE(survives([&](tinygltf::Model& model) {  // the transform chooses another set
    model.materials[0].normalTexture.index = 0;
    model.materials[0].normalTexture.texCoord = 1;
    model.materials[0].normalTexture.extensions["KHR_texture_transform"] = object("texCoord", Value(0));
  }));
  EXPECT_TRUE(survives([&](tinygltf::Model& model) {  // a variant has the texture
    model.materials.resize(2);
    model.materials[1].pbrMetallicRoughness.baseColorTexture.index = 0;
    model.meshes[0].primitives[0].extensions["KHR_materials_variants"] =
        object("mappings", Value(Value::Array{object("material", Value(1))}));
  }));
  EXPECT_FALSE(survives([](tinygltf::Model& model) {
    model.materials[0].emissiveTexture.index = 0;
    model.materials[0].emissiveTexture.texCoord = 1;
  }));
}

}  // namespace
}  // namespace jalousie::bake
