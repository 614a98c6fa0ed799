// Documents of many small meshes: what they cost, and that threads do not change them.
#include <gtest/gtest.h>

#include <atomic>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/io/equal_meshes.h"
#include "bake/pipeline/threads.h"
#include "bake/simplify/chain.h"

namespace jalousie::bake {
namespace {

void addNode(tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  tinygltf::Mesh mesh;
  mesh.name = "part" + std::to_string(model.meshes.size());
  mesh.primitives = {primitive};
  tinygltf::Node node;
  node.mesh = static_cast<int>(model.meshes.size());
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
  model.meshes.push_back(mesh);
  model.nodes.push_back(node);
}

tinygltf::Model emptyModel() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.scenes.resize(1);
  model.defaultScene = 0;
  return model;
}

tinygltf::Model spheres(std::uint32_t count) {
  tinygltf::Model model = emptyModel();
  for (std::uint32_t k = 0; k < count; ++k) {
    const asset::Primitive mesh = test::sphere(8 + k % 5, 6);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = asset::appendVec3(model, mesh.positions, 0);
    primitive.attributes["NORMAL"] = asset::appendVec3(model, mesh.normals, 0);
    primitive.indices = asset::appendIndices(model, mesh.indices);
    addNode(model, primitive);
  }
  return model;
}

/// Parts that index one vertex buffer which holds the vertices of all of them.
tinygltf::Model partsOfOneBuffer(std::uint32_t count) {
  tinygltf::Model model = emptyModel();
  const asset::Primitive mesh = test::box(glm::vec3(1));
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<int> indices;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    std::vector<std::uint32_t> own = mesh.indices;
    for (std::uint32_t& index : own)
      index += first;
    indices.push_back(asset::appendIndices(model, own));
    for (const glm::vec3& p : mesh.positions)
      positions.push_back(p + glm::vec3(3.0F * static_cast<float>(k), 0, 0));
    normals.insert(normals.end(), mesh.normals.begin(), mesh.normals.end());
  }
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, positions, 0);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, normals, 0);
  for (const int accessor : indices) {
    primitive.indices = accessor;
    addNode(model, primitive);
  }
  return model;
}

std::vector<MeshReport> bakeIt(tinygltf::Model& model, const BakeOptions& options) {
  return bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
}

TEST(ManyMeshes, ThreadsDoNotChangeTheFile) {
  BakeOptions options;
  tinygltf::Model one = spheres(30);
  bakeIt(one, options);
  options.tasks = threadedTasks(4);
  tinygltf::Model four = spheres(30);
  bakeIt(four, options);
  EXPECT_GT(one.nodes.size(), 60U);  // the spheres have levels
  EXPECT_EQ(asset::encodeGlb(one), asset::encodeGlb(four));
}

TEST(ManyMeshes, ThreeThousandPartsOfOneBufferAreBakedEachByItself) {
  BakeOptions options;
  options.chain.preset = Preset::kFast;
  options.chain.levels = 1;
  tinygltf::Model model = partsOfOneBuffer(3000);
  const std::vector<MeshReport> reports = bakeIt(model, options);
  ASSERT_EQ(reports.size(), 3000U);
  for (std::size_t k = 0; k < reports.size(); ++k) {
    ASSERT_EQ(reports[k].passedThrough, "");
    ASSERT_EQ(reports[k].levels[0].triangles, 12U);
    ASSERT_EQ(reports[k].levels[0].vertices, test::box(glm::vec3(1)).positions.size());
    const int accessor = model.meshes[k].primitives[0].attributes.at("POSITION");
    const tinygltf::Accessor& positions = model.accessors[static_cast<std::size_t>(accessor)];
    ASSERT_EQ(positions.minValues[0], 3.0 * static_cast<double>(k) - 1.0);
    ASSERT_EQ(positions.maxValues[0], 3.0 * static_cast<double>(k) + 1.0);
  }
}

TEST(ManyMeshes, TheFirstMeshThatFailsIsNamedWhateverTheThreads) {
  for (const unsigned threads : {1U, 4U}) {
    tinygltf::Model model = spheres(40);
    for (const std::size_t broken : {17U, 18U, 30U}) {
      const int accessor = model.meshes[broken].primitives[0].attributes.at("POSITION");
      model.accessors[static_cast<std::size_t>(accessor)].count -= 1;
    }
    BakeOptions options;
    options.tasks = threadedTasks(threads);
    try {
      bakeIt(model, options);
      FAIL() << "the attributes have different counts";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("part17"), std::string::npos) << error.what();
    }
  }
}

TEST(ManyMeshes, EqualMeshesShareTheirLevels) {
  tinygltf::Model model = spheres(12);  // sphere k equals sphere k % 5
  model.meshes[7].primitives[0].extras = tinygltf::Value(tinygltf::Value::Object{{"own", tinygltf::Value(1)}});
  model.meshes[8].extras = tinygltf::Value(tinygltf::Value::Object{{"batch", tinygltf::Value(8)}});
  tinygltf::Model alone = spheres(5);
  const std::vector<MeshReport> expected = bakeIt(alone, {});
  const std::vector<MeshReport> reports = bakeIt(model, {});
  ASSERT_EQ(reports.size(), 12U);
  std::size_t meshes = 12;
  for (std::size_t k = 0; k < 12; ++k) {
    const bool isFirst = k < 5 || k == 7;
    if (isFirst) meshes += expected[k % 5].levels.size() - 1;
    const std::size_t like = isFirst ? k : k % 5;
    EXPECT_EQ(reports[k].name, "part" + std::to_string(k));
    ASSERT_EQ(reports[k].levels.size(), expected[k % 5].levels.size());
    EXPECT_EQ(reports[k].levels.back().errorObject, expected[k % 5].levels.back().errorObject);
    EXPECT_EQ(model.meshes[k].primitives[0].indices, model.meshes[like].primitives[0].indices);
    const std::vector<int> nodes = asset::lodNodes(model, static_cast<int>(k));
    const std::vector<int> sharedNodes = asset::lodNodes(model, static_cast<int>(like));
    ASSERT_EQ(nodes.size() + 1, reports[k].levels.size());
    for (std::size_t l = 0; l < nodes.size(); ++l)
      EXPECT_EQ(model.nodes[static_cast<std::size_t>(nodes[l])].mesh,
                model.nodes[static_cast<std::size_t>(sharedNodes[l])].mesh);
    EXPECT_EQ(asset::lodInfo(model.meshes[k])->triangles, reports[k].levels[0].triangles);
  }
  EXPECT_EQ(model.meshes.size(), meshes);
  EXPECT_TRUE(model.meshes[8].extras.Has("batch"));
  EXPECT_FALSE(model.meshes[3].extras.Has("batch"));
}

TEST(ManyMeshes, MeshesThatDifferInOneByteShareNothing) {
  const tinygltf::Model same = spheres(6);
  const std::vector<std::size_t> used = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(findEqualMeshes(same, used), (std::vector<std::size_t>{0, 1, 2, 3, 4, 0}));
  const auto changed = [&](const auto& change) {
    tinygltf::Model model = same;
    change(model);
    return findEqualMeshes(model, used)[5] == 5;
  };
  const auto viewOf = [](tinygltf::Model& model, int accessor) -> tinygltf::BufferView& {
    const int view = model.accessors[static_cast<std::size_t>(accessor)].bufferView;
    return model.bufferViews[static_cast<std::size_t>(view)];
  };
  EXPECT_TRUE(changed([](tinygltf::Model& model) { model.meshes[5].primitives[0].material = 0; }));
  EXPECT_TRUE(changed([](tinygltf::Model& model) { model.meshes[5].primitives[0].attributes.erase("NORMAL"); }));
  for (const char* name : {"POSITION", "NORMAL"}) {
    EXPECT_TRUE(changed([&](tinygltf::Model& model) {
      const tinygltf::BufferView& view = viewOf(model, model.meshes[5].primitives[0].attributes[name]);
      model.buffers[0].data[view.byteOffset + view.byteLength - 1] ^= 1U;
    })) << name;
  }
  EXPECT_TRUE(changed([&](tinygltf::Model& model) {
    const tinygltf::BufferView& view = viewOf(model, model.meshes[5].primitives[0].indices);
    std::swap(model.buffers[0].data[view.byteOffset], model.buffers[0].data[view.byteOffset + 2]);
  }));
}

/// Elements of all loops of a chain that may run in slices: points that are projected or measured.
std::size_t costOf(const WedgeMesh& mesh, Preset preset) {
  std::atomic<std::size_t> elements = 0;
  ChainOptions options;
  options.preset = preset;
  options.slices = [&](std::size_t count, const SliceWork& work) {
    elements += count;
    work(0, count);
  };
  makeChain(mesh, options);
  return elements;
}

TEST(ManyMeshes, TheCostOfAMeshFollowsItsSize) {
  const WedgeMesh small = test::wedges(test::sphere(6, 5));
  ASSERT_EQ(small.triangles(), 48U);
  EXPECT_LT(costOf(small, Preset::kBest), 20'000U);
  EXPECT_LT(costOf(small, Preset::kFast), 4'000U);
  const WedgeMesh large = test::wedges(test::sphere(96, 65));
  EXPECT_GT(costOf(large, Preset::kBest), 400'000U);  // the accuracy of large meshes has not gone down
}

}  // namespace
}  // namespace jalousie::bake
