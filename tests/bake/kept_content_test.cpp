// A bake changes meshes and adds levels; everything else in a document stays, and every index leads to the same thing.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "asset/lod_chain.h"
#include "asset/scene_file.h"
#include "bake/glb_fixtures.h"
#include "bake/report/inspect.h"

namespace jalousie::bake {
namespace {

using nlohmann::json;
using test::BakedGlb;
using test::Glb;

Glb ball() {
  return test::oneMesh(test::sphere(24, 12));
}

/// A ball with an animation, a skin, a table and things that nothing refers to.
Glb richDocument() {
  Glb glb = ball();
  const std::size_t times = test::appendAccessor<float>(glb, {0.0F, 1.0F}, 5126, "SCALAR", 1);
  glb.json["accessors"][times]["min"] = {0.0};
  glb.json["accessors"][times]["max"] = {1.0};
  const std::size_t places = test::appendAccessor<float>(glb, {0, 0, 0, 1, 2, 3}, 5126, "VEC3", 3);
  test::appendAccessor<std::uint32_t>(glb, {7, 11, 13}, 5125, "SCALAR", 1);
  test::appendView(glb, std::as_bytes(std::span("a table of bytes", 16)));
  glb.json["materials"] = {{{"name", "red"}, {"alphaMode", "MASK"}, {"alphaCutoff", 0.5}}};
  glb.json["nodes"].push_back({{"name", "other"}});
  glb.json["scenes"][0]["nodes"].push_back(1);
  glb.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", places}}}},
       {"channels",
        {{{"sampler", 0},
          {"target",
           {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0/x"}}}}}}}},
         {{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  return glb;
}

/// The object at a JSON pointer.
json& at(json& document, const std::string& place) {
  return document[json::json_pointer(place)];
}

TEST(KeptContent, EveryIndexWhereverItStandsLeadsToTheSameBytes) {
  const std::vector<std::string> places = {"",
                                           "/asset",
                                           "/scenes/0",
                                           "/nodes/0",
                                           "/nodes/1",
                                           "/meshes/0",
                                           "/materials/0",
                                           "/accessors/3",
                                           "/accessors/4",
                                           "/bufferViews/4",
                                           "/animations/0",
                                           "/animations/0/samplers/0",
                                           "/animations/0/channels/0",
                                           "/animations/0/channels/0/target"};
  std::mt19937 random(7);
  for (int round = 0; round < 12; ++round) {
    Glb input = richDocument();
    std::set<std::string> used;
    for (int k = 0; k < 4; ++k) {
      const std::string& place = places[random() % places.size()];
      used.insert(place);
      at(input.json, place)["extensions"]["VENDOR_numbers"] = {
          {"accessor", random() % input.json["accessors"].size()},
          {"list", {{{"bufferView", random() % input.json["bufferViews"].size()}, {"node", 1}}}}};
    }
    input.json["extensionsUsed"] = {"VENDOR_numbers", "KHR_animation_pointer"};
    const BakedGlb baked = test::bakeGlb(input);
    ASSERT_GT(baked.reports[0].levels.size(), 1U);
    json output = baked.glb.json;
    for (const std::string& place : used)
      EXPECT_EQ(at(output, place)["extensions"]["VENDOR_numbers"],
                at(input.json, place)["extensions"]["VENDOR_numbers"])
          << place;
    for (std::size_t i = 0; i < input.json["accessors"].size(); ++i)
      EXPECT_EQ(baked.glb.accessor(i), input.accessor(i)) << i;
    for (std::size_t i = 0; i < input.json["bufferViews"].size(); ++i)
      EXPECT_EQ(baked.glb.view(i), input.view(i)) << i;
    EXPECT_EQ(output["nodes"][1]["name"], "other");
  }
}

TEST(KeptContent, NumbersInExtrasKeepTheirTargetsButNotTheReplacedMesh) {
  Glb input = richDocument();
  const std::size_t accessors = input.json["accessors"].size();
  const std::size_t views = input.json["bufferViews"].size();
  input.json["extras"] = {{"accessor", accessors - 1}, {"view", views - 1}};
  const BakedGlb baked = test::bakeGlb(input);
  EXPECT_EQ(baked.glb.json["extras"], input.json["extras"]);
  EXPECT_EQ(baked.glb.accessor(accessors - 1), input.accessor(accessors - 1));
  EXPECT_EQ(baked.glb.view(views - 1), input.view(views - 1));
  EXPECT_EQ(baked.glb.json["accessors"][0]["count"], 1);  // positions of the replaced mesh
  EXPECT_EQ(baked.glb.view(0).size(), 1U);
}

TEST(KeptContent, WhereNothingCanReferToThemUnusedAccessorsAreDropped) {
  const Glb input = richDocument();
  const BakedGlb baked = test::bakeGlb(input, 1);
  EXPECT_EQ(baked.glb.json["accessors"].size(), input.json["accessors"].size() - 1);  // nothing refers to {7, 11, 13}
}

TEST(KeptContent, ColumnsOfPropertyTablesKeepTheirBytes) {
  for (const bool old : {false, true}) {
    Glb input = ball();
    const std::vector<float> heights = {3.5F, 4.5F};
    const std::size_t view = test::appendView(input, std::as_bytes(std::span(heights)));
    const char* name = old ? "EXT_feature_metadata" : "EXT_structural_metadata";
    const json column = old ? json{{"bufferView", view}} : json{{"values", view}};
    const json table = {{"count", 2}, {"properties", {{"height", column}}}};
    input.json["extensions"][name] =
        old ? json{{"featureTables", {{"t", table}}}} : json{{"propertyTables", json::array({table})}};
    input.json["extensionsUsed"] = {name};
    const BakedGlb baked = test::bakeGlb(input);
    const json& written = baked.glb.json["extensions"][name];
    const json& properties =
        (old ? written["featureTables"]["t"] : written["propertyTables"][0])["properties"]["height"];
    EXPECT_EQ(baked.glb.view(properties[old ? "bufferView" : "values"].get<std::size_t>()), input.view(view)) << name;
    EXPECT_LT(baked.glb.json["bufferViews"].size(), 4 * baked.reports[0].levels.size());  // the old mesh is gone
  }
}

TEST(KeptContent, AnimationPointersKeepChannelAndSampler) {
  Glb input = richDocument();
  input.json["extensionsUsed"] = {"KHR_animation_pointer"};
  const BakedGlb baked = test::bakeGlb(input);
  const json& animation = baked.glb.json["animations"][0];
  EXPECT_EQ(animation["channels"][0], input.json["animations"][0]["channels"][0]);
  EXPECT_EQ(animation["channels"].size(), 2 + baked.reports[0].levels.size() - 1);
  EXPECT_EQ(baked.glb.accessor(animation["samplers"][0]["output"].get<std::size_t>()), input.accessor(4));
}

TEST(KeptContent, ANodeThatAPointerMovesIsTheParentOfAllItsLevels) {
  Glb input = richDocument();
  input.json["extensionsUsed"] = {"KHR_animation_pointer"};
  input.json["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] =
      "/nodes/0/translation";
  const json output = test::bakeGlb(input).glb.json;
  EXPECT_EQ(output["animations"][0]["channels"].size(), 2U) << "no channel is copied to the levels";
  EXPECT_FALSE(output["nodes"][0].contains("mesh"));
  ASSERT_EQ(output["nodes"][0]["children"].size(), 1U);
  const json& child = output["nodes"][output["nodes"][0]["children"][0].get<std::size_t>()];
  EXPECT_TRUE(child.contains("mesh"));
  EXPECT_TRUE(child["extensions"].contains("MSFT_lod"));
}

TEST(KeptContent, WhatTheLibraryDoesNotKnowIsWrittenAsItWas) {
  Glb input = richDocument();
  for (const char* place : {"/asset", "/scenes/0", "/nodes/1", "/materials/0", "/animations/0", "/accessors/3"}) {
    at(input.json, place)["extras"] = "a note";
    at(input.json, place)["extensions"]["VENDOR_words"] = {{"text", "yes"}};
  }
  input.json["asset"]["minVersion"] = "2.0";
  input.json["extensionsUsed"] = {"VENDOR_words"};
  json output = test::bakeGlb(input).glb.json;
  for (const char* place : {"/asset", "/scenes/0", "/nodes/1", "/materials/0", "/animations/0"}) {
    EXPECT_EQ(at(output, place)["extras"], "a note") << place;
    EXPECT_EQ(at(output, place)["extensions"], at(input.json, place)["extensions"]) << place;
  }
  const auto input0 = output["animations"][0]["samplers"][0]["input"].get<std::size_t>();
  EXPECT_EQ(output["accessors"][input0]["extensions"], at(input.json, "/accessors/3")["extensions"]);
  EXPECT_EQ(output["asset"]["minVersion"], "2.0");
  EXPECT_EQ(output["materials"][0]["alphaCutoff"], 0.5);
}

TEST(KeptContent, ExtrasThatAreNoObjectStay) {
  Glb input = ball();
  input.json["nodes"][0]["extras"] = "a note";
  input.json["meshes"][0]["extras"] = {1, 2, 3};
  const BakedGlb baked = test::bakeGlb(input);
  EXPECT_EQ(baked.glb.json["nodes"][0]["extras"], "a note");
  EXPECT_EQ(baked.glb.json["meshes"][0]["extras"]["value"], (json{1, 2, 3}));
  const int child = baked.model.nodes[0].children.at(0);
  EXPECT_EQ(asset::lodNodes(baked.model, child).size(), baked.reports[0].levels.size() - 1);
  EXPECT_EQ(asset::lodCoverage(baked.model.nodes[static_cast<std::size_t>(child)]).size(),
            baked.reports[0].levels.size());
}

TEST(KeptContent, UnknownExtensionsThatMayNumberVerticesPassTheMeshThrough) {
  for (const bool integer : {true, false}) {
    Glb input = ball();
    json& extension = input.json["meshes"][0]["primitives"][0]["extensions"]["VENDOR_outline"];
    if (integer) {
      extension = {{"indices", 1}};
    } else {
      extension = {{"width", 0.5}};
    }
    input.json["extensionsUsed"] = {"VENDOR_outline"};
    const BakedGlb baked = test::bakeGlb(input);
    EXPECT_EQ(baked.reports[0].passedThrough, integer ? "VENDOR_outline may refer to its vertices" : "");
    EXPECT_EQ(baked.glb.json["meshes"][0]["primitives"][0]["extensions"]["VENDOR_outline"], extension);
  }
}

/// A body at x = 1 with a head as its child, both the same ball, the head higher.
Glb bodyWithHead() {
  Glb glb = ball();
  glb.json["nodes"][0]["translation"] = {1, 0, 0};
  glb.json["nodes"][0]["children"] = {1};
  glb.json["nodes"].push_back({{"name", "head"}, {"mesh", 0}, {"translation", {0, 2, 0}}});
  return glb;
}

TEST(KeptContent, ANodeWithChildrenKeepsThemAtEveryLevel) {
  const BakedGlb baked = test::bakeGlb(bodyWithHead());
  const tinygltf::Node& body = baked.model.nodes[0];
  EXPECT_EQ(body.mesh, -1);
  EXPECT_FALSE(body.extensions.contains("MSFT_lod"));
  ASSERT_EQ(body.children.size(), 2U);
  EXPECT_EQ(body.children[0], 1);
  const int moved = body.children[1];
  EXPECT_EQ(baked.model.nodes[static_cast<std::size_t>(moved)].name, "ball");
  const std::vector<int> levels = asset::lodNodes(baked.model, moved);
  ASSERT_EQ(levels.size(), baked.reports[0].levels.size() - 1);
  for (const int level : levels) {
    EXPECT_TRUE(baked.model.nodes[static_cast<std::size_t>(level)].children.empty());
    EXPECT_TRUE(baked.model.nodes[static_cast<std::size_t>(level)].translation.empty());
  }
  EXPECT_EQ(asset::lodNodes(baked.model, 1).size(), levels.size());  // the head has nothing below it

  const asset::SceneFile scene = asset::readScene(baked.model, "output.glb");
  ASSERT_EQ(scene.instances.size(), 2U);
  for (const asset::Instance& instance : scene.instances) {
    EXPECT_EQ(instance.worldFromObject[3].x, 1.0F);
    EXPECT_EQ(scene.chains[instance.chain].levels.size(), levels.size() + 1);
  }
  const std::vector<InspectedChain> chains = inspectModel(baked.model);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].nodes, 2U);
}

TEST(KeptContent, CamerasLightsAndExtensionsOfANodeStayOnIt) {
  for (const char* what : {"camera", "light", "extension"}) {
    Glb input = ball();
    json& node = input.json["nodes"][0];
    input.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    input.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    input.json["extensionsUsed"] = {"KHR_lights_punctual", "VENDOR_sound"};
    if (what == std::string("camera")) node["camera"] = 0;
    if (what == std::string("light")) node["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
    if (what == std::string("extension")) node["extensions"]["VENDOR_sound"] = {{"loud", true}};
    json expected = node;
    expected.erase("mesh");
    expected["children"] = {1};
    const BakedGlb baked = test::bakeGlb(input);
    EXPECT_EQ(baked.glb.json["nodes"][0], expected) << what;
    EXPECT_FALSE(asset::lodNodes(baked.model, 1).empty()) << what;
  }
}

TEST(KeptContent, InstancesGoWithTheMesh) {
  Glb input = bodyWithHead();
  const std::size_t places = test::appendAccessor<float>(input, {0, 0, 0, 5, 0, 0}, 5126, "VEC3", 3);
  input.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", places}};
  input.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  const BakedGlb baked = test::bakeGlb(input);
  EXPECT_FALSE(baked.model.nodes[0].extensions.contains("EXT_mesh_gpu_instancing"));
  const int moved = baked.model.nodes[0].children.at(1);
  std::vector<int> chain = asset::lodNodes(baked.model, moved);
  chain.push_back(moved);
  for (const int node : chain)
    EXPECT_TRUE(baked.model.nodes[static_cast<std::size_t>(node)].extensions.contains("EXT_mesh_gpu_instancing"));
  EXPECT_EQ(asset::readScene(baked.model, "output.glb").instances.size(), 3U);
}

/// A grid whose left half has the feature 3 and the right half the feature 9; the halves share no vertex.
Glb twoFeatures(const char* name, int componentType) {
  asset::Primitive left = test::grid(12);
  const asset::Primitive right = left;
  const auto first = static_cast<std::uint32_t>(left.positions.size());
  for (const glm::vec3& p : right.positions)
    left.positions.emplace_back(p + glm::vec3(1.0F, 0.0F, 0.0F));
  left.normals.insert(left.normals.end(), right.normals.begin(), right.normals.end());
  for (const std::uint32_t index : right.indices)
    left.indices.push_back(first + index);
  Glb glb = test::oneMesh(left);
  std::vector<std::uint32_t> features(2 * std::size_t{first}, 3U);
  std::fill(features.begin() + first, features.end(), 70'000'001U);
  std::size_t accessor = 0;
  if (componentType == 5125) {
    accessor = test::appendAccessor(glb, features, 5125, "SCALAR", 1);
  } else {
    std::vector<float> floats(features.size(), 3.0F);
    std::fill(floats.begin() + first, floats.end(), 9.0F);
    accessor = test::appendAccessor(glb, floats, 5126, "SCALAR", 1);
  }
  glb.json["meshes"][0]["primitives"][0]["attributes"][name] = accessor;
  return glb;
}

/// Values of a scalar attribute of 4 bytes.
template <class Number>
std::vector<Number> valuesOf(const Glb& glb, const json& accessor) {
  const std::vector<std::byte> bytes = glb.view(accessor["bufferView"].get<std::size_t>());
  std::vector<Number> values(accessor["count"].get<std::size_t>());
  EXPECT_EQ(bytes.size(), values.size() * sizeof(Number));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

template <class Number>
void expectFeatures(const BakedGlb& baked, const char* name, int componentType, Number left, Number right) {
  ASSERT_GT(baked.reports[0].levels.size(), 2U);
  for (const json& mesh : baked.glb.json["meshes"]) {
    ASSERT_EQ(mesh["primitives"].size(), 1U);
    const json& attributes = mesh["primitives"][0]["attributes"];
    const json& accessor = baked.glb.json["accessors"][attributes[name].get<std::size_t>()];
    EXPECT_EQ(accessor["componentType"], componentType);
    const std::vector<Number> features = valuesOf<Number>(baked.glb, accessor);
    const std::vector<glm::vec3> positions = asset::readVec3(baked.model, attributes["POSITION"].get<int>(), 100'000);
    ASSERT_EQ(positions.size(), features.size());
    for (std::size_t v = 0; v < features.size(); ++v) {
      EXPECT_TRUE(features[v] == left || features[v] == right) << features[v];
      EXPECT_TRUE(features[v] == left ? positions[v].x <= 1.001F : positions[v].x >= 0.999F) << positions[v].x;
    }
  }
}

TEST(KeptContent, FeatureIdsKeepTypeValueAndBorder) {
  expectFeatures<std::uint32_t>(test::bakeGlb(twoFeatures("_FEATURE_ID_0", 5125)), "_FEATURE_ID_0", 5125, 3U,
                                70'000'001U);
  expectFeatures<std::uint32_t>(test::bakeGlb(twoFeatures("_ROOM", 5125)), "_ROOM", 5125, 3U, 70'000'001U);
  expectFeatures<float>(test::bakeGlb(twoFeatures("_BATCHID", 5126)), "_BATCHID", 5126, 3.0F, 9.0F);
}

TEST(KeptContent, AMeshWithAMatrixAttributeIsPassedThrough) {
  Glb input = test::oneMesh(test::grid(4));
  const std::vector<float> matrices(9 * 25, 1.0F);
  const std::size_t accessor = test::appendAccessor(input, matrices, 5126, "MAT3", 9);
  input.json["meshes"][0]["primitives"][0]["attributes"]["_FRAME"] = accessor;
  const BakedGlb baked = test::bakeGlb(input);
  EXPECT_EQ(baked.reports[0].passedThrough, "its attribute _FRAME is a matrix");
  EXPECT_EQ(baked.glb.json["meshes"][0]["primitives"][0]["attributes"]["_FRAME"], accessor);
}

TEST(KeptContent, NumbersOfVerticesDoNotStopTheSimplification) {
  Glb input = test::oneMesh(test::grid(12));
  std::vector<std::uint32_t> numbers(13 * 13);
  for (std::uint32_t v = 0; v < numbers.size(); ++v)
    numbers[v] = v;
  input.json["meshes"][0]["primitives"][0]["attributes"]["_VERTEX"] =
      test::appendAccessor(input, numbers, 5125, "SCALAR", 1);
  const BakedGlb baked = test::bakeGlb(input);
  ASSERT_EQ(baked.reports[0].levels.size(), 4U);
  for (const json& mesh : baked.glb.json["meshes"]) {
    const json& attributes = mesh["primitives"][0]["attributes"];
    const std::vector<std::uint32_t> values =
        valuesOf<std::uint32_t>(baked.glb, baked.glb.json["accessors"][attributes["_VERTEX"].get<std::size_t>()]);
    std::set<std::uint32_t> different(values.begin(), values.end());
    EXPECT_EQ(different.size(), values.size());
    EXPECT_LT(*different.rbegin(), 13U * 13U);
  }
}

TEST(KeptContent, ColoursAndCustomValuesStayWithinTheirRange) {
  asset::Primitive mesh = test::sphere(40, 20);
  Glb input = test::oneMesh(mesh);
  std::vector<float> colours;
  std::vector<float> heat;
  for (const glm::vec3& p : mesh.positions) {
    const float stripe = std::sin(9.0F * p.y) > 0.0F ? 1.0F : 0.0F;
    colours.insert(colours.end(), {stripe, 1.0F - stripe, 0.5F, 1.0F});
    heat.push_back(stripe * 100.0F);
  }
  json& attributes = input.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["COLOR_0"] = test::appendAccessor(input, colours, 5126, "VEC4", 4);
  attributes["_HEAT"] = test::appendAccessor(input, heat, 5126, "SCALAR", 1);
  const BakedGlb baked = test::bakeGlb(input, 6);
  ASSERT_EQ(baked.reports[0].levels.size(), 6U);
  for (const tinygltf::Mesh& level : baked.model.meshes) {
    for (const glm::vec4& c : asset::readVec4(baked.model, level.primitives[0].attributes.at("COLOR_0"), 100'000))
      for (int k = 0; k < 4; ++k)
        EXPECT_TRUE(c[k] >= 0.0F && c[k] <= 1.0F) << c[k];
    for (const float t : asset::readScalars(baked.model, level.primitives[0].attributes.at("_HEAT"), 100'000))
      EXPECT_TRUE(t >= 0.0F && t <= 100.0F) << t;
  }
}

TEST(KeptContent, StripsAndFansAreBakedAndLinesStay) {
  // A strip of a folded band, a fan and a line in one mesh.
  Glb input = test::oneMesh(test::sphere(24, 12));
  std::vector<float> positions;
  std::vector<std::uint32_t> strip;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const std::uint32_t step = i / 2;
    positions.insert(positions.end(), {0.1F * static_cast<float>(step), static_cast<float>(i % 2), 3.0F});
    strip.push_back(i);
  }
  const std::size_t place = test::appendAccessor(input, positions, 5126, "VEC3", 3);
  input.json["accessors"][place]["min"] = {0.0, 0.0, 3.0};
  input.json["accessors"][place]["max"] = {1.9, 1.0, 3.0};
  json& primitives = input.json["meshes"][0]["primitives"];
  const std::size_t indices = test::appendAccessor(input, strip, 5125, "SCALAR", 1);
  primitives.push_back({{"attributes", {{"POSITION", place}}}, {"indices", indices}, {"mode", 5}});
  primitives.push_back({{"attributes", {{"POSITION", place}}}, {"mode", 6}});
  primitives.push_back({{"attributes", {{"POSITION", place}}}, {"mode", 3}});
  const BakedGlb baked = test::bakeGlb(input);
  EXPECT_EQ(baked.reports[0].passedThrough, "");
  ASSERT_GT(baked.reports[0].levels.size(), 2U);
  const json& finest = baked.glb.json["meshes"][0]["primitives"];
  ASSERT_EQ(finest.size(), 4U);
  EXPECT_EQ(finest[1]["mode"], 4);
  EXPECT_EQ(baked.glb.json["accessors"][finest[1]["indices"].get<std::size_t>()]["count"], 3 * 38);
  for (const json& mesh : baked.glb.json["meshes"])
    EXPECT_EQ(mesh["primitives"].back()["mode"], 3);  // the line belongs to every level
  for (const glm::vec3& n : asset::readVec3(baked.model, finest[0]["attributes"]["NORMAL"].get<int>(), 100'000))
    EXPECT_NEAR(glm::length(n), 1.0F, 1e-3F);
}

TEST(KeptContent, TheWindingOfAStripAlternates) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0, 0, 3, 0, 1, 3, 0};
  Glb input = test::oneMesh(test::grid(2));
  const std::size_t place = test::appendAccessor(input, positions, 5126, "VEC3", 3);
  input.json["accessors"][place]["min"] = {0.0, 0.0, 0.0};
  input.json["accessors"][place]["max"] = {1.0, 3.0, 0.0};
  input.json["meshes"][0]["primitives"] = json::array({{{"attributes", {{"POSITION", place}}}, {"mode", 5}}});
  const BakedGlb baked = test::bakeGlb(input, 1);
  const tinygltf::Primitive& primitive = baked.model.meshes[0].primitives[0];
  const std::vector<glm::vec3> p = asset::readVec3(baked.model, primitive.attributes.at("POSITION"), 100);
  const std::vector<std::uint32_t> i = asset::readIndices(baked.model, primitive.indices, 8, 100);
  ASSERT_EQ(i.size(), 18U);
  for (std::size_t t = 0; t < i.size(); t += 3)
    EXPECT_GT(glm::cross(p[i[t + 1]] - p[i[t]], p[i[t + 2]] - p[i[t]]).z, 0.5F);
}

TEST(KeptContent, PicturesThatNobodyHereDecodesAreKeptAsTheyAre) {
  for (const auto& [start, type] :
       {std::pair("\xABKTX 20\xBB\r\n\x1A\n0123", "image/ktx2"), std::pair("\x01\x02\x03 ftypavif0123", "image/avif"),
        std::pair("DDS 012345678", "image/vnd-ms.dds")}) {
    Glb input = ball();
    const std::string picture = start;
    const std::size_t view = test::appendView(input, test::bytesOf(picture));
    input.json["images"] = {{{"bufferView", view}, {"mimeType", type}}};
    input.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    input.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    input.json["meshes"][0]["primitives"][0]["material"] = 0;
    input.json["extensionsUsed"] = {"KHR_texture_basisu"};
    input.json["extensionsRequired"] = {"KHR_texture_basisu"};
    const BakedGlb baked = test::bakeGlb(input);
    const json& image = baked.glb.json["images"][0];
    EXPECT_EQ(image["mimeType"], type);
    EXPECT_EQ(baked.glb.view(image["bufferView"].get<std::size_t>()), input.view(view)) << type;
    EXPECT_EQ(baked.glb.json["textures"], input.json["textures"]);
    EXPECT_EQ(baked.glb.json["extensionsRequired"], input.json["extensionsRequired"]);
  }
}

TEST(KeptContent, RequiredVariantsStayWithEveryLevel) {
  Glb input = ball();
  input.json["materials"] = {{{"name", "a"}}, {{"name", "b"}}};
  input.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "v0"}}, {{"name", "v1"}}};
  json& primitive = input.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {1}}}};
  input.json["extensionsUsed"] = {"KHR_materials_variants"};
  input.json["extensionsRequired"] = {"KHR_materials_variants"};
  const BakedGlb baked = test::bakeGlb(input);
  ASSERT_GT(baked.reports[0].levels.size(), 2U);
  for (const json& mesh : baked.glb.json["meshes"])
    EXPECT_EQ(mesh["primitives"][0]["extensions"], primitive["extensions"]);
  EXPECT_EQ(baked.glb.json["extensions"], input.json["extensions"]);
}

TEST(KeptContent, MeshoptDataOfBothNamesIsReadAndFallbackBuffersNeedNoBytes) {
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    tinygltf::Model model = importBytes(test::joinGlb(ball()), "input.glb", {});
    model.extensions_json_string.clear();
    Glb input = test::splitGlb(asset::encodeGlb(std::move(model), {true}));
    for (json& view : input.json["bufferViews"]) {
      if (!view.contains("extensions")) continue;
      const json extension = view["extensions"]["EXT_meshopt_compression"];
      view["extensions"] = {{name, extension}};
    }
    json buffers = input.json["buffers"];
    ASSERT_EQ(buffers.size(), 2U);
    buffers[1].erase("extensions");  // some writers leave "fallback" out
    input.json["extensionsUsed"] = {name};
    input.json["extensionsRequired"] = {name};
    std::vector<std::byte> bytes = test::joinGlb(input, buffers);
    const tinygltf::Model read = asset::parseGltf(bytes, "input.glb");
    EXPECT_EQ(asset::readScene(read, "input.glb").meshes[0].primitives[0].positions.size(),
              test::sphere(24, 12).positions.size())
        << name;
    EXPECT_TRUE(read.extensionsRequired.empty());
  }
}

TEST(KeptContent, AMeshoptCodecThatIsTooNewIsReadFromItsFallback) {
  tinygltf::Model model = importBytes(test::joinGlb(ball()), "input.glb", {});
  const std::vector<glm::vec3> expected =
      asset::readVec3(model, model.meshes[0].primitives[0].attributes["POSITION"], 100'000);
  for (const bool hasFallback : {true, false}) {
    Glb input = ball();
    json& view = input.json["bufferViews"][0];
    // A stream of version 1 of the vertex codec, which the library of Debian 12 does not read.
    const std::uint64_t length = view["byteLength"];
    view["extensions"]["KHR_meshopt_compression"] = {
        {"buffer", 0},      {"byteLength", 16},     {"byteOffset", input.binary.size()},
        {"byteStride", 12}, {"count", length / 12}, {"mode", "ATTRIBUTES"}};
    input.binary.resize(input.binary.size() + 16, std::byte{0xa1});
    if (!hasFallback) view["byteOffset"] = 1'000'000;
    input.json["extensionsUsed"] = {"KHR_meshopt_compression"};
    const std::vector<std::byte> bytes = test::joinGlb(input);
    if (hasFallback) {
      const tinygltf::Model read = asset::parseGltf(bytes, "input.glb");
      EXPECT_EQ(asset::readScene(read, "input.glb").meshes[0].primitives[0].positions, expected);
    } else {
      EXPECT_EQ(test::codeOf([&] { asset::parseGltf(bytes, "input.glb"); }), ErrorCode::kUnsupported);
    }
  }
}

}  // namespace
}  // namespace jalousie::bake
