// Every file of the folder has a test; and what a bake must not lose or bend: references, identifiers, children.
#include <cctype>
#include <set>

#include "asset/lod_chain.h"
#include "bake/case_files.h"
#include "bake/io/import.h"
#include "core/file.h"

namespace jalousie::test {
namespace {

using nlohmann::json;

/// "two_meshes.glb" -> "TwoMeshes".
std::string testNameOf(const std::filesystem::path& file) {
  std::string name;
  bool isFirst = true;
  for (const char c : file.stem().string()) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0) name += isFirst ? static_cast<char>(std::toupper(letter)) : c;
    isFirst = c == '_';
  }
  return name;
}

TEST_F(CaseFiles, EachHasATest) {
  std::set<std::string> tests;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *program.GetTestSuite(s);
    for (int t = 0; suite.name() == std::string("CaseFiles") && t < suite.total_test_count(); ++t)
      tests.insert(suite.GetTestInfo(t)->name());
  }
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(file(""))) {
    if (!bake::isImportable(entry.path())) continue;  // a picture or a library of materials
    ++files;
    EXPECT_EQ(tests.count(testNameOf(entry.path())), 1U) << entry.path();
  }
  EXPECT_GE(files, 31U);
}

/// The numbers of a scalar attribute of one primitive at every level.
struct LevelValues {
  std::vector<float> values;
  std::vector<glm::vec3> positions;
  int componentType = 0;
  tinygltf::Primitive primitive;
};

std::vector<LevelValues> valuesAtEveryLevel(const BakedCase& baked, const std::string& attribute) {
  std::vector<LevelValues> levels;
  for (const tinygltf::Mesh& mesh : baked.model.meshes) {
    const tinygltf::Primitive& primitive = mesh.primitives.at(0);
    const int accessor = primitive.attributes.at(attribute);
    levels.push_back({asset::readScalars(baked.model, accessor, 100'000),
                      asset::readVec3(baked.model, primitive.attributes.at("POSITION"), 100'000),
                      baked.model.accessors.at(static_cast<std::size_t>(accessor)).componentType, primitive});
  }
  EXPECT_EQ(levels.size(), 5U);
  return levels;
}

/// The bytes that an index of one file and an index of another one lead to.
void expectSameAccessor(const Glb& input, const json& before, const Glb& output, const json& after) {
  EXPECT_EQ(output.accessor(after.get<std::size_t>()), input.accessor(before.get<std::size_t>()));
}

// An animation of a material through KHR_animation_pointer was lost, and its data was numbered wrongly.
TEST_F(CaseFiles, AnimationPointer) {
  const Glb input = readGlb("animation_pointer.glb");
  const BakedCase baked = bake("animation_pointer.glb");
  const json& before = input.json["animations"][0];
  const json& after = baked.glb.json["animations"][0];
  ASSERT_EQ(after["samplers"].size(), 2U);
  for (const std::size_t s : {0U, 1U})
    for (const char* end : {"input", "output"})
      expectSameAccessor(input, before["samplers"][s][end], baked.glb, after["samplers"][s][end]);
  EXPECT_EQ(after["channels"][0], before["channels"][0]);
  EXPECT_EQ(baked.glb.json["materials"], input.json["materials"]);
  EXPECT_EQ(baked.glb.json["extensionsUsed"], (json{"KHR_animation_pointer", "MSFT_lod"}));
  // The translation moves every level, whichever is shown.
  std::set<int> moved;
  for (const tinygltf::AnimationChannel& channel : baked.model.animations[0].channels)
    if (channel.target_path == "translation") moved.insert(channel.target_node);
  std::vector<int> shown = asset::lodNodes(baked.model, 0);
  ASSERT_EQ(shown.size(), 4U);
  shown.push_back(0);
  EXPECT_EQ(moved, std::set<int>(shown.begin(), shown.end()));
}

// A column of a table is a buffer view that only an extension names.
TEST_F(CaseFiles, PropertyTable) {
  const Glb input = readGlb("property_table.glb");
  const BakedCase baked = bake("property_table.glb");
  json before = input.json["extensions"]["EXT_structural_metadata"];
  json after = baked.glb.json["extensions"]["EXT_structural_metadata"];
  json& column = after["propertyTables"][0]["properties"]["height"]["values"];
  EXPECT_EQ(baked.glb.view(column.get<std::size_t>()), input.view(4));
  column = 4;
  EXPECT_EQ(after, before);
  for (const LevelValues& level : valuesAtEveryLevel(baked, "_FEATURE_ID_0")) {
    EXPECT_EQ(level.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    EXPECT_EQ(std::set<float>(level.values.begin(), level.values.end()), (std::set<float>{0.0F, 1.0F}));
  }
  for (const json& mesh : baked.glb.json["meshes"])
    EXPECT_EQ(mesh["primitives"][0]["extensions"], input.json["meshes"][0]["primitives"][0]["extensions"]);
}

/// The triangles of a level that have a corner with a value.
bake::LevelSurface partWith(const LevelValues& level, const std::vector<std::uint32_t>& indices, float value) {
  bake::LevelSurface part{level.positions, {}};
  for (std::size_t t = 0; t < indices.size(); t += 3) {
    const auto has = [&](std::size_t c) { return level.values[indices[t + c]] == value; };
    if (has(0) || has(1) || has(2))
      part.indices.insert(part.indices.end(), {indices[t], indices[t + 1], indices[t + 2]});
  }
  return part;
}

// Means of two identifiers are identifiers of something else.
TEST_F(CaseFiles, FeatureIds) {
  const BakedCase baked = bake("feature_ids.glb");
  const std::vector<LevelValues> levels = valuesAtEveryLevel(baked, "_FEATURE_ID_0");
  const tinygltf::Model input = asset::loadGltf(file("feature_ids.glb"));
  const LevelValues source = {asset::readScalars(input, 2, 10'000), asset::readVec3(input, 0, 10'000), 0, {}};
  const std::vector<std::uint32_t> indices = asset::readIndices(input, 4, 10'000, 100'000);
  const std::set<float> features = {7.0F, 1007.0F, 2007.0F, 3007.0F};
  ASSERT_EQ(std::set<float>(source.values.begin(), source.values.end()), features);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    EXPECT_EQ(levels[k].componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    EXPECT_EQ(std::set<float>(levels[k].values.begin(), levels[k].values.end()), features) << k;
    const double error = baked.levels()[k]["error_object"].get<double>();
    for (const float feature : features) {  // a vertex lies where its feature was
      const bake::LevelSurface part = partWith(source, indices, feature);
      bake::LevelSurface vertices{levels[k].positions, {}};
      for (std::uint32_t v = 0; v < levels[k].values.size(); ++v)
        if (levels[k].values[v] == feature) vertices.indices.insert(vertices.indices.end(), 3, v);
      EXPECT_LE(largestDistance(vertices, part, 1), 1.01 * error + 1e-5) << feature << " at level " << k;
    }
  }
  for (const LevelValues& level : valuesAtEveryLevel(baked, "_TEMPERATURE"))
    for (const float t : level.values)
      EXPECT_TRUE(t >= 0.0F && t <= 100.0F) << t;
  const Glb document = readGlb("feature_ids.glb");
  for (const json& mesh : baked.glb.json["meshes"])
    EXPECT_EQ(mesh["primitives"][0]["extensions"], document.json["meshes"][0]["primitives"][0]["extensions"]);
}

/// Over the surface.
glm::dvec4 meanColour(const asset::Primitive& primitive) {
  const bake::LevelSurface surface = surfaceOf(primitive);
  glm::dvec4 sum(0.0);
  for (std::size_t c = 0; c < primitive.indices.size(); ++c)
    sum += glm::length(areaVector(surface, c / 3)) / 3.0 * glm::dvec4(primitive.colors[primitive.indices[c]]);
  return sum / areaOf(surface);
}

// Stripes of pure colours: a fit that overshoots leaves the range that glTF allows.
TEST_F(CaseFiles, VertexColours) {
  const BakedCase baked = bake("vertex_colours.glb");
  const glm::dvec4 expected = meanColour(readInput("vertex_colours.glb").meshes.at(0).primitives.at(0));
  ASSERT_EQ(baked.chain().size(), 5U);
  ASSERT_EQ(baked.model.meshes.size(), 5U);
  for (const tinygltf::Mesh& mesh : baked.model.meshes) {  // as they are stored, not as a reader may clamp them
    for (const glm::vec4& c : asset::readVec4(baked.model, mesh.primitives[0].attributes.at("COLOR_0"), 100'000))
      for (int k = 0; k < 4; ++k)
        ASSERT_TRUE(c[k] >= 0.0F && c[k] <= 1.0F) << c[k];
  }
  for (const asset::Mesh* mesh : baked.chain())
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(meanColour(mesh->primitives.at(0))[k], expected[k], 0.03) << mesh->primitives[0].indices.size() / 3;
}

// MSFT_screencoverage needs an object as extras, and there is a text already.
TEST_F(CaseFiles, ExtrasNotObject) {
  const BakedCase baked = bake("extras_not_object.glb");
  EXPECT_EQ(baked.glb.json["nodes"][0]["extras"], "a note");
  EXPECT_EQ(baked.glb.json["nodes"][0]["name"], "n");
  EXPECT_EQ(baked.glb.json["meshes"][0]["extras"]["value"], (json{1, 2, 3}));
  ASSERT_EQ(baked.chain().size(), 5U);
  EXPECT_EQ(baked.scene.chains[0].coverage.size(), 5U);
}

/// The middles of the boxes of what is seen below a node, where each node with MSFT_lod is replaced by its node of a
/// level and everything below the node goes with it, as readers of the extension do.
void seenAt(const tinygltf::Model& model, int index, std::size_t level, glm::dvec3 place,
            std::vector<glm::dvec3>& seen) {
  const std::vector<int> lower = asset::lodIds(model, index);
  if (level > 0 && !lower.empty()) index = lower[std::min(level, lower.size()) - 1];
  const tinygltf::Node& node = model.nodes.at(static_cast<std::size_t>(index));
  if (!node.translation.empty()) place += glm::dvec3(node.translation[0], node.translation[1], node.translation[2]);
  if (node.mesh >= 0) {
    const int position =
        model.meshes.at(static_cast<std::size_t>(node.mesh)).primitives.at(0).attributes.at("POSITION");
    const tinygltf::Accessor& box = model.accessors.at(static_cast<std::size_t>(position));
    glm::dvec3 middle = place;
    for (int k = 0; k < 3; ++k)
      middle[k] +=
          0.5 * (box.minValues.at(static_cast<std::size_t>(k)) + box.maxValues.at(static_cast<std::size_t>(k)));
    seen.push_back(middle);
  }
  for (const int child : node.children)
    seenAt(model, child, level, place, seen);
}

// The head is a child of the body; where the body was replaced by a level, the head vanished.
TEST_F(CaseFiles, MeshWithChild) {
  const BakedCase baked = bake("mesh_with_child.glb");
  EXPECT_EQ(baked.glb.json["nodes"][1]["extras"], (json{{"hp", 3}}));
  EXPECT_EQ(baked.glb.json["scenes"][0]["nodes"], (json{1}));
  for (std::size_t level = 0; level < 5; ++level) {
    std::vector<glm::dvec3> seen;
    seenAt(baked.model, 1, level, glm::dvec3(0.0), seen);
    std::sort(seen.begin(), seen.end(), [](const glm::dvec3& a, const glm::dvec3& b) { return a.y < b.y; });
    ASSERT_EQ(seen.size(), 2U) << level;
    EXPECT_LT(glm::distance(seen[0], glm::dvec3(1.0, 0.0, 0.0)), 0.1) << "body at level " << level;
    EXPECT_LT(glm::distance(seen[1], glm::dvec3(1.0, 1.2, 0.0)), 0.1) << "head at level " << level;
  }
}

// The bytes of both pictures pass, although nothing here decodes one of them.
TEST_F(CaseFiles, TexKtx2Fallback) {
  const Glb input = readGlb("tex_ktx2_fallback.glb");
  const BakedCase baked = bake("tex_ktx2_fallback.glb");
  ASSERT_EQ(baked.glb.json["images"].size(), 2U);
  for (const std::size_t i : {0U, 1U}) {
    json image = baked.glb.json["images"][i];
    EXPECT_EQ(baked.glb.view(image["bufferView"].get<std::size_t>()), input.view(i));
    image["bufferView"] = i;
    EXPECT_EQ(image, input.json["images"][i]);
  }
  for (const char* list : {"textures", "materials"})
    EXPECT_EQ(baked.glb.json[list], input.json[list]);
  ASSERT_EQ(baked.model.meshes.size(), 5U);
  for (const tinygltf::Mesh& mesh : baked.model.meshes)
    EXPECT_TRUE(mesh.primitives.at(0).attributes.contains("TEXCOORD_0"));
}

// A required extension that the document's own lists and the primitives of every level share.
TEST_F(CaseFiles, VariantsRequired) {
  const Glb input = readGlb("variants_required.glb");
  const BakedCase baked = bake("variants_required.glb");
  for (const char* part : {"extensionsRequired", "extensions", "materials"})
    EXPECT_EQ(baked.glb.json[part], input.json[part]);
  ASSERT_EQ(baked.glb.json["meshes"].size(), 5U);
  for (const json& mesh : baked.glb.json["meshes"]) {
    EXPECT_EQ(mesh["primitives"][0]["extensions"], input.json["meshes"][0]["primitives"][0]["extensions"]);
    EXPECT_EQ(mesh["primitives"][0]["material"], 0);
  }
}

}  // namespace
}  // namespace jalousie::test
