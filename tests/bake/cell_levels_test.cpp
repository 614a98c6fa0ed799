// A level per cell: every legal cut of a baked file is the surface, once and without a crack.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "asset/accessor.h"
#include "asset/cell_cut.h"
#include "asset/gltf_quantize.h"
#include "asset/lod_cell_levels.h"
#include "asset/scene_file.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/io/cut_document.h"
#include "core/error.h"
#include "support/run_program.h"

namespace jalousie::bake {
namespace {

using asset::CellCut;
using asset::CellHierarchy;
using Point = std::array<float, 3>;

tinygltf::Model rowOfMeshes(const std::vector<asset::Primitive>& primitives, float step = 0.5F) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.materials.resize(primitives.size());
  tinygltf::Mesh mesh;
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    mesh.primitives.push_back(
        test::movedPrimitive(model, primitives[p], glm::vec3(step * static_cast<float>(p), 0, 0)));
    mesh.primitives.back().material = static_cast<int>(p);
  }
  test::showMesh(model, std::move(mesh));
  return model;
}

/// A surface with bumps, closed, so that errors differ from place to place.
asset::Primitive bumpySphere(std::uint32_t slices, std::uint32_t stacks) {
  asset::Primitive mesh = test::sphere(slices, stacks);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3 p = mesh.positions[v];
    const float bump = p.x > 0.0F ? 0.08F * std::sin(9.0F * p.y) * std::sin(8.0F * p.z) * p.x : 0.0F;
    mesh.positions[v] = p * (1.0F + bump);
  }
  return mesh;
}

/// One sphere cut in two materials along an edge: the triangles left and right of a plane.
std::vector<asset::Primitive> twoMaterials() {
  const asset::Primitive whole = bumpySphere(64, 32);
  std::vector<asset::Primitive> halves(2);
  for (asset::Primitive& half : halves) {
    half.positions = whole.positions;
    half.normals = whole.normals;
  }
  for (std::size_t i = 0; i < whole.indices.size(); i += 3) {
    float x = 0.0F;
    for (std::size_t k = 0; k < 3; ++k)
      x += whole.positions[whole.indices[i + k]].y;
    for (std::size_t k = 0; k < 3; ++k)
      halves[x > 0.0F ? 1 : 0].indices.push_back(whole.indices[i + k]);
  }
  return halves;
}

BakeOptions optionsWith(std::uint32_t trianglesPerCell) {
  BakeOptions options;
  options.chain.levels = 7;
  options.chain.samples = 3000;
  options.cells = {trianglesPerCell, false, true};
  return options;
}

void bakeInto(tinygltf::Model& model, const BakeOptions& options) {
  bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
}

/// A chain as a reader gets it.
struct Read {
  asset::SceneFile scene;
  CellHierarchy hierarchy;
};

std::vector<asset::LodCellLevels> tablesOf(const tinygltf::Model& model) {
  std::vector<asset::LodCellLevels> tables = {asset::lodCellLevels(model, model.meshes[0])};
  for (const int node : asset::lodNodes(model, 0))
    tables.push_back(asset::lodCellLevels(
        model, model.meshes[static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(node)].mesh)]));
  return tables;
}

Read bakeAndRead(tinygltf::Model model, const BakeOptions& options) {
  bakeInto(model, options);
  const std::vector<asset::LodCellLevels> tables = tablesOf(model);
  if (options.quantized) asset::quantizeModel(model);
  const tinygltf::Model file = asset::parseGltf(asset::encodeGlb(model), "cut.glb");
  return {asset::readScene(file, "cut.glb"), CellHierarchy(tables)};
}

Point pointOf(const glm::vec3& p) {
  return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
}

/// Calls visit(primitive, first corner, level) for each triangle of a cut.
template <class Visit>
void forEachTriangle(const Read& read, const CellCut& cut, const Visit& visit) {
  const auto& levels = read.scene.chains.at(0).levels;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    for (const asset::Primitive& primitive : read.scene.meshes[levels[k].mesh].primitives) {
      for (std::uint32_t cell = 0; cell < read.hierarchy.cells(k); ++cell) {
        if (!read.hierarchy.isDrawn(cut, k, cell)) continue;
        for (std::uint32_t i = cell == 0 ? 0 : primitive.cellEnds[cell - 1]; i < primitive.cellEnds[cell]; i += 3)
          visit(primitive, i, k);
      }
    }
  }
}

/// Edges that are not used equally often in both directions, by the places of their ends.
std::vector<std::pair<Point, Point>> openEdges(const Read& read, const CellCut& cut) {
  std::map<std::pair<Point, Point>, int> uses;
  forEachTriangle(read, cut, [&](const asset::Primitive& primitive, std::uint32_t first, std::size_t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Point a = pointOf(primitive.positions[primitive.indices[first + k]]);
      const Point b = pointOf(primitive.positions[primitive.indices[first + (k + 1) % 3]]);
      if (a < b) ++uses[{a, b}];
      if (b < a) --uses[{b, a}];
    }
  });
  std::vector<std::pair<Point, Point>> open;
  for (const auto& [edge, count] : uses)
    if (count != 0) open.push_back(edge);
  return open;
}

/// Random flags, some of them for whole levels, made legal.
CellCut randomCut(const CellHierarchy& hierarchy, std::mt19937& random) {
  CellCut cut = hierarchy.uniform(0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double coarse = 0.6 + 0.4 * unit(random);
  for (std::vector<std::uint8_t>& level : cut)
    for (std::uint8_t& flag : level)
      flag = unit(random) < coarse ? 1 : 0;
  hierarchy.makeLegal(cut);
  return cut;
}

std::size_t levelsIn(const Read& read, const CellCut& cut) {
  std::set<std::size_t> levels;
  forEachTriangle(read, cut, [&](const asset::Primitive&, std::uint32_t, std::size_t k) { levels.insert(k); });
  return levels.size();
}

double volumeOf(const Read& read, const CellCut& cut) {
  double volume = 0.0;
  forEachTriangle(read, cut, [&](const asset::Primitive& primitive, std::uint32_t first, std::size_t) {
    const auto at = [&](std::uint32_t k) { return glm::dvec3(primitive.positions[primitive.indices[first + k]]); };
    volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
  });
  return volume;
}

TEST(CellLevels, AnyLegalCutOfAClosedMeshIsClosed) {
  const std::vector<std::pair<const char*, std::vector<asset::Primitive>>> meshes = {
      {"sphere", {bumpySphere(80, 40)}},
      {"two materials", twoMaterials()},
      {"two spheres", {bumpySphere(64, 32), bumpySphere(48, 24)}},
      {"flat", {test::flatShaded(bumpySphere(64, 32))}}};
  for (const auto& [name, primitives] : meshes) {
    for (const bool quantized : {false, true}) {
      BakeOptions options = optionsWith(64);
      options.quantized = quantized;
      const bool apart = std::string(name) == "two materials";
      const Read read = bakeAndRead(rowOfMeshes(primitives, apart ? 0.0F : 0.5F), options);
      ASSERT_GE(read.hierarchy.levels(), 5U) << name;
      const double volume = volumeOf(read, read.hierarchy.uniform(0));
      std::mt19937 random(7);
      std::size_t mixed = 0;
      for (int i = 0; i < 40; ++i) {
        const CellCut cut = randomCut(read.hierarchy, random);
        ASSERT_TRUE(read.hierarchy.isLegal(cut));
        EXPECT_EQ(openEdges(read, cut).size(), 0U) << name << " " << quantized << " cut " << i;
        EXPECT_NEAR(volumeOf(read, cut) / volume, 1.0, 0.05) << name;
        mixed += levelsIn(read, cut) >= 3 ? 1U : 0U;
      }
      EXPECT_GT(mixed, 10U) << name << ": cuts of several levels";
    }
  }
}

TEST(CellLevels, CutsThatAreNotLegalHaveCracksOrOverlap) {
  const Read read = bakeAndRead(rowOfMeshes({bumpySphere(80, 40)}), optionsWith(64));
  const CellHierarchy& hierarchy = read.hierarchy;
  for (std::uint32_t group = 0; group < hierarchy.groups(1); ++group) {
    CellCut cut = hierarchy.uniform(0);
    cut[1][group] = 1;  // coarse above fine ones
    EXPECT_FALSE(hierarchy.isLegal(cut));
    EXPECT_NE(openEdges(read, cut).size(), 0U);
    hierarchy.makeLegal(cut);
    EXPECT_EQ(cut, hierarchy.uniform(0));
  }
}

TEST(CellLevels, AnyLegalCutOfAFlatSheetCoversItOnce) {
  const Read read = bakeAndRead(rowOfMeshes({test::grid(60)}), optionsWith(64));
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i) {
    const CellCut cut = randomCut(read.hierarchy, random);
    double area = 0.0;
    forEachTriangle(read, cut, [&](const asset::Primitive& primitive, std::uint32_t first, std::size_t) {
      const auto at = [&](std::uint32_t k) { return glm::dvec3(primitive.positions[primitive.indices[first + k]]); };
      const double z = glm::cross(at(1) - at(0), at(2) - at(0)).z;
      EXPECT_GT(z, -1e-9) << "no triangle is turned over";
      area += 0.5 * z;
    });
    EXPECT_NEAR(area, 1.0, 1e-4);
    for (const auto& [a, b] : openEdges(read, cut)) {
      const auto onRim = [](float ka, float kb) {
        return std::abs(ka - kb) < 1e-3F && (std::abs(ka) < 1e-3F || std::abs(ka - 1.0F) < 1e-3F);
      };
      EXPECT_TRUE(onRim(a[0], b[0]) || onRim(a[1], b[1])) << a[0] << " " << a[1] << " to " << b[0] << " " << b[1];
    }
  }
}

TEST(CellLevels, CellsOfDifferentLevelsMeetWithEqualNormals) {
  const Read read = bakeAndRead(rowOfMeshes({bumpySphere(80, 40)}), optionsWith(64));
  std::mt19937 random(5);
  std::size_t shared = 0;
  for (int i = 0; i < 20; ++i) {
    std::map<Point, std::pair<glm::vec3, std::size_t>> normals;
    forEachTriangle(read, randomCut(read.hierarchy, random),
                    [&](const asset::Primitive& primitive, std::uint32_t first, std::size_t level) {
                      for (std::uint32_t k = 0; k < 3; ++k) {
                        const std::uint32_t v = primitive.indices[first + k];
                        const auto [found, isNew] =
                            normals.try_emplace(pointOf(primitive.positions[v]), primitive.normals[v], level);
                        EXPECT_EQ(found->second.first, primitive.normals[v]);
                        shared += found->second.second != level ? 1U : 0U;
                      }
                    });
  }
  EXPECT_GT(shared, 500U);
}

TEST(CellLevels, UniformCutsAreTheStoredLevels) {
  const Read read = bakeAndRead(rowOfMeshes({bumpySphere(64, 32), bumpySphere(48, 24)}), optionsWith(64));
  const auto& levels = read.scene.chains.at(0).levels;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    std::size_t triangles = 0;
    forEachTriangle(read, read.hierarchy.uniform(k), [&](const asset::Primitive&, std::uint32_t, std::size_t level) {
      EXPECT_EQ(level, k);
      ++triangles;
    });
    std::size_t stored = 0;
    for (const asset::Primitive& primitive : read.scene.meshes[levels[k].mesh].primitives)
      stored += primitive.indices.size() / 3;
    EXPECT_EQ(triangles, stored);
    EXPECT_TRUE(read.hierarchy.isLegal(read.hierarchy.uniform(k)));
  }
}

TEST(CellLevels, ErrorsNeverFallAndGroupsAreLocal) {
  const Read read = bakeAndRead(rowOfMeshes({bumpySphere(80, 40)}), optionsWith(64));
  const CellHierarchy& hierarchy = read.hierarchy;
  EXPECT_GT(hierarchy.groups(0), 8U);
  for (std::size_t k = 1; k + 1 < hierarchy.levels(); ++k) {
    for (std::uint32_t cell = 0; cell < hierarchy.cells(k); ++cell) {
      const asset::DistanceInfo& own = hierarchy.error(k, hierarchy.groupOf(k, cell));
      const asset::DistanceInfo& below = hierarchy.error(k - 1, hierarchy.producerOf(k, cell));
      EXPECT_GE(own.max, below.max);
      EXPECT_GE(own.mean, below.mean);
    }
  }
  const auto& levels = read.scene.chains.at(0).levels;
  for (std::size_t k = 0; k + 1 < hierarchy.levels(); ++k) {
    double most = 0.0;
    for (std::uint32_t group = 0; group < hierarchy.groups(k); ++group)
      most = std::max(most, hierarchy.error(k, group).max);
    EXPECT_GT(most, 0.0);
    EXPECT_LE(most, 1.001 * levels[k + 1].errorObject) << "of sampled points, below the bound of the level";
  }
}

TEST(CellLevels, BordersOfAStepLieInsideAGroupOfTheNext) {
  const Read read = bakeAndRead(rowOfMeshes({bumpySphere(96, 48)}), optionsWith(64));
  const CellHierarchy& hierarchy = read.hierarchy;
  for (std::size_t k = 1; k + 1 < hierarchy.levels(); ++k) {
    std::map<std::uint32_t, std::set<std::uint32_t>> producers;
    for (std::uint32_t cell = 0; cell < hierarchy.cells(k); ++cell)
      producers[hierarchy.groupOf(k, cell)].insert(hierarchy.producerOf(k, cell));
    if (hierarchy.groups(k) < 3) break;
    std::size_t joined = 0;
    for (const auto& [group, of] : producers)
      joined += of.size() > 1 ? 1U : 0U;
    EXPECT_GE(10 * joined, 8 * producers.size()) << "level " << k;
  }
}

TEST(CellLevels, TheFileDoesNotDependOnTheThreads) {
  const auto bytes = [](const SliceRunner& slices) {
    tinygltf::Model model = rowOfMeshes({bumpySphere(64, 32)});
    BakeOptions options = optionsWith(64);
    options.chain.slices = slices;
    bakeInto(model, options);
    return asset::encodeGlb(model);
  };
  const std::vector<std::byte> once = bytes(runInOneSlice);
  EXPECT_EQ(once, bytes(runInOneSlice));
  EXPECT_EQ(once, bytes([](std::size_t count, const SliceWork& work) {
              for (std::size_t begin = 0; begin < count; begin += 37)
                work(begin, std::min(count, begin + 37));
            }));
}

TEST(CellLevels, LeavesStayWholeInTheirCells) {
  asset::Primitive leaves;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  const asset::Primitive leaf = test::grid(2);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const glm::vec3 at(place(random), place(random), place(random));
    for (const std::uint32_t index : leaf.indices)
      leaves.indices.push_back(index + static_cast<std::uint32_t>(leaves.positions.size()));
    for (std::size_t v = 0; v < leaf.positions.size(); ++v) {
      leaves.positions.push_back(0.1F * leaf.positions[v] + at);
      leaves.normals.push_back(leaf.normals[v]);
    }
  }
  const Read read = bakeAndRead(rowOfMeshes({leaves}), optionsWith(64));
  const asset::Primitive& finest = read.scene.meshes[read.scene.chains.at(0).levels[0].mesh].primitives.at(0);
  std::map<Point, std::uint32_t> cellOfPlace;
  for (std::uint32_t cell = 0; cell < read.hierarchy.cells(0); ++cell) {
    for (std::uint32_t i = cell == 0 ? 0 : finest.cellEnds[cell - 1]; i < finest.cellEnds[cell]; ++i) {
      const auto [found, isNew] = cellOfPlace.try_emplace(pointOf(finest.positions[finest.indices[i]]), cell);
      EXPECT_EQ(found->second, cell);
    }
  }
  EXPECT_GT(read.hierarchy.cells(0), 20U);
  EXPECT_GE(read.hierarchy.levels(), 4U) << "without common vertices, nothing is locked";
}

/// Mean error of the chain with cells over that of the plain one at as many triangles, by interpolation in logarithms.
double worstRatio(const tinygltf::Model& document, const BakeOptions& divided) {
  BakeOptions plain = divided;
  plain.cells.levels = false;
  const auto curve = [&](const BakeOptions& options) {
    tinygltf::Model model = document;
    std::vector<std::pair<double, double>> points;  // log of triangles, log of mean
    const auto reports = bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
    for (const asset::LodInfo& level : reports.at(0).levels)
      if (level.lod > 0) points.emplace_back(std::log(level.triangles), std::log(level.measures->twoSided.mean));
    return points;
  };
  const auto reference = curve(plain);
  double worst = 0.0;
  for (const auto& [triangles, mean] : curve(divided)) {
    for (std::size_t i = 1; i < reference.size(); ++i) {
      if (triangles > reference[i - 1].first || triangles < reference[i].first) continue;
      const double t = (triangles - reference[i - 1].first) / (reference[i].first - reference[i - 1].first);
      worst = std::max(worst, std::exp(mean - glm::mix(reference[i - 1].second, reference[i].second, t)));
    }
  }
  return worst;
}

TEST(CellLevels, WholeLevelsAreNearlyAsGoodAsWithout) {
  const double worst = worstRatio(rowOfMeshes({bumpySphere(128, 64)}), optionsWith(256));
  EXPECT_GT(worst, 0.5) << "levels were compared";
  EXPECT_LT(worst, 1.2);
}

TEST(CellLevels, SmallMeshesAndSkippedOptionsHaveNone) {
  tinygltf::Model small = rowOfMeshes({test::sphere(16, 8)});
  BakeOptions options = optionsWith(256);
  options.cells.onlyLarge = true;
  bakeInto(small, options);
  EXPECT_TRUE(tablesOf(small).at(0).empty());
  tinygltf::Model plain = rowOfMeshes({bumpySphere(64, 32)});
  options.cells.levels = false;
  bakeInto(plain, options);
  EXPECT_TRUE(tablesOf(plain).at(0).empty());
}

/// The chain of a bumpy sphere, written and read again; its node is moved, turned and scaled.
tinygltf::Model placedChain() {
  tinygltf::Model model = rowOfMeshes({bumpySphere(80, 40)});
  bakeInto(model, optionsWith(64));
  for (tinygltf::Node& node : model.nodes) {
    node.translation = {5.0, 0.0, 0.0};
    node.rotation = {0.0, 0.6, 0.0, 0.8};
    node.scale = {2.0, 2.0, 2.0};
  }
  return asset::parseGltf(asset::encodeGlb(model), "placed.glb");
}

/// The scene of a cut through a file.
asset::SceneFile sceneOf(const tinygltf::Model& model) {
  return asset::readScene(asset::parseGltf(asset::encodeGlb(model), "cut.glb"), "cut.glb");
}

std::size_t openEdgesOf(const asset::Mesh& mesh) {
  std::map<std::pair<Point, Point>, int> uses;
  for (const asset::Primitive& primitive : mesh.primitives) {
    for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
      const Point a = pointOf(primitive.positions[primitive.indices[i]]);
      const Point b = pointOf(primitive.positions[primitive.indices[i % 3 == 2 ? i - 2 : i + 1]]);
      if (a < b) ++uses[{a, b}];
      if (b < a) --uses[{b, a}];
    }
  }
  return static_cast<std::size_t>(
      std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 0; }));
}

TEST(CutDocument, IsOneClosedMeshFinerTowardsTheEye) {
  CutOptions options;
  options.eye = glm::dvec3(8.0, 0.0, 0.0);  // a unit away from the nearest point
  options.pixels = 4.0;
  options.height = 720.0;
  tinygltf::Model model = placedChain();
  const std::vector<CutNode> nodes = cutDocument(model, options);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_EQ(nodes[0].leftBecause, "");
  EXPECT_LT(nodes[0].triangles, nodes[0].finestTriangles);
  EXPECT_LE(nodes[0].triangles, nodes[0].wholeTriangles);
  EXPECT_GE(std::count_if(nodes[0].cells.begin(), nodes[0].cells.end(), [](std::uint32_t n) { return n > 0; }), 2);
  const asset::SceneFile scene = sceneOf(model);
  ASSERT_EQ(scene.chains.size(), 1U);
  ASSERT_EQ(scene.chains[0].levels.size(), 1U) << "one mesh without levels";
  const asset::Mesh& mesh = scene.meshes[scene.chains[0].levels[0].mesh];
  std::size_t triangles = 0;
  for (const asset::Primitive& primitive : mesh.primitives)
    triangles += primitive.indices.size() / 3;
  EXPECT_EQ(triangles, nodes[0].triangles);
  EXPECT_EQ(openEdgesOf(mesh), 0U);
}

TEST(CutDocument, MovesWithTheEyeAndTheLimit) {
  const tinygltf::Model chain = placedChain();
  std::uint64_t last = ~std::uint64_t{0};
  for (const double distance : {3.0, 6.0, 20.0, 100.0, 1000.0}) {
    CutOptions options;
    options.eye = glm::dvec3(5.0 + distance, 0.0, 0.0);
    tinygltf::Model model = chain;
    const std::uint64_t triangles = cutDocument(model, options).at(0).triangles;
    EXPECT_LE(triangles, last) << distance;
    last = triangles;
  }
  EXPECT_LT(last, 200U) << "far away the coarsest level is enough";
  last = ~std::uint64_t{0};
  for (const double error : {1e-6, 1.0, 5.0, 50.0}) {
    CutOptions options;
    options.errorPercent = error;
    tinygltf::Model model = chain;
    const CutNode node = cutDocument(model, options).at(0);
    EXPECT_EQ(node.triangles == node.finestTriangles, error == 1e-6);
    EXPECT_LE(node.triangles, last) << error;
    last = node.triangles;
    options.by = asset::CutBy::kMean;
    tinygltf::Model again = chain;
    EXPECT_LE(cutDocument(again, options).at(0).triangles, node.triangles) << "a mean is never above the maximum";
  }
}

TEST(CutDocument, SaysWhatItLeaves) {
  tinygltf::Model plain = rowOfMeshes({bumpySphere(48, 24)});
  BakeOptions options = optionsWith(64);
  options.cells.levels = false;
  bakeInto(plain, options);
  EXPECT_NE(cutDocument(plain, {}).at(0).leftBecause.find("--cell-levels"), std::string::npos);
  EXPECT_EQ(asset::lodNodes(plain, 0).size(), 6U) << "the chain stays";
  tinygltf::Model flat = placedChain();
  for (tinygltf::Node& node : flat.nodes)
    node.scale = {1.0, 0.0, 1.0};
  CutOptions eye;
  eye.eye = glm::dvec3(0.0);
  EXPECT_EQ(cutDocument(flat, eye).at(0).leftBecause, "its transform cannot be inverted");
  EXPECT_NE(cutText(cutDocument(flat, eye)).find("its chain stays"), std::string::npos);
  EXPECT_EQ(cutText({}), "no node has a chain\n");
}

TEST(CutDocument, CommandAndOptionsReportWhatIsWrong) {
  const auto codeOf = [](const std::vector<std::string>& arguments) {
    return test::runProgram(JALOUSIE_BAKE_PROGRAM, arguments).exitCode;
  };
  const int usage = static_cast<int>(ErrorCode::kUsage);
  EXPECT_EQ(codeOf({"a.ply", "-o", "a.glb", "--cell-levels", "--cells", "off"}), usage);
  EXPECT_EQ(codeOf({"a.ply", "-o", "a.glb", "--cell-levels", "--preset", "draft"}), usage);
  EXPECT_EQ(codeOf({"a.ply", "-o", "a.glb", "--cell-levels", "--error", "1%"}), usage);
  EXPECT_EQ(codeOf({"cut", "a.glb", "-o", "b.glb", "--from", "1,2"}), usage);
  EXPECT_EQ(codeOf({"cut", "a.glb", "-o", "b.glb", "--from", "1,2,nan"}), usage);
  EXPECT_EQ(codeOf({"cut", "a.glb", "-o", "b.glb", "--pixels", "2"}), usage) << "pixels need an eye";
  EXPECT_EQ(codeOf({"cut", "no_such_file.glb", "-o", "b.glb"}), static_cast<int>(ErrorCode::kFileNotFound));
}

}  // namespace
}  // namespace jalousie::bake
