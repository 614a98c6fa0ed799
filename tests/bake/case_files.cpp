// Bakes the files of a folder, and measures surfaces by themselves, without the code that made them.
#include "bake/case_files.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "asset/scene_file.h"
#include "bake/io/import.h"
#include "bake/mesh/triangle_bvh.h"
#include "bake/pipeline/job.h"
#include "core/file.h"

namespace jalousie::test {
namespace {

constexpr std::uint64_t kMostBytes = 64U << 20U;

glm::dvec3 corner(const bake::LevelSurface& surface, std::size_t index) {
  return {surface.positions[surface.indices[index]]};
}

}  // namespace

std::vector<const asset::Mesh*> BakedCase::chain(std::size_t index) const {
  std::vector<const asset::Mesh*> meshes;
  for (const asset::LodLevel& level : scene.chains.at(index).levels)
    meshes.push_back(&scene.meshes.at(level.mesh));
  return meshes;
}

bool BakedCase::warns(const std::string& text) const {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

void CaseFiles::SetUp() {
  const char* folder = std::getenv("JALOUSIE_CASES");
  if (folder == nullptr) GTEST_SKIP() << "JALOUSIE_CASES names no folder with the files";
  folder_ = folder;
}

BakedCase CaseFiles::bake(const std::string& name, const std::function<void(bake::JobSettings&)>& change) const {
  return bakeFile(file(name), change);
}

BakedCase CaseFiles::bakeFile(const std::filesystem::path& file,
                              const std::function<void(bake::JobSettings&)>& change) const {
  bake::JobSettings settings;
  settings.bake.chain.ratios = {0.5, 0.25, 0.12, 0.05};
  settings.bake.chain.samples = 2000;
  change(settings);
  const std::filesystem::path output = temporary_ / "baked.glb";
  BakedCase baked;
  baked.result = bake::runJob({.inputs = {file}, .output = output, .sheet = {}}, settings, [](const std::string&) {});
  baked.report = nlohmann::json::parse(baked.result.report);
  baked.glb = splitGlb(readFile(output, kMostBytes));
  baked.model = asset::loadGltf(output);
  baked.scene = asset::readSceneFile(output);
  return baked;
}

Glb CaseFiles::readGlb(const std::string& name) const {
  return splitGlb(readFile(file(name), kMostBytes));
}

asset::SceneFile CaseFiles::readInput(const std::string& name) const {
  bake::Notes notes;
  return asset::readScene(bake::importFiles({file(name)}, {}, notes), file(name));
}

std::vector<std::vector<std::string>> CaseFiles::readLines(const std::string& name) const {
  std::ifstream stream(file(name));
  EXPECT_TRUE(stream.good()) << name;
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    lines.emplace_back();
    for (std::string word; words >> word;)
      lines.back().push_back(word);
  }
  return lines;
}

bake::LevelSurface surfaceOf(const asset::Primitive& primitive) {
  return {primitive.positions, primitive.indices};
}

bake::LevelSurface surfaceOf(const asset::Mesh& mesh) {
  bake::LevelSurface surface;
  for (const asset::Primitive& primitive : mesh.primitives) {
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    surface.positions.insert(surface.positions.end(), primitive.positions.begin(), primitive.positions.end());
    for (const std::uint32_t index : primitive.indices)
      surface.indices.push_back(first + index);
  }
  return surface;
}

std::map<PlacePair, EdgeUses> edgesOf(const bake::LevelSurface& surface) {
  std::map<PlacePair, EdgeUses> edges;
  for (std::size_t c = 0; c < surface.indices.size(); ++c) {
    const Place a = placeOf(surface.positions[surface.indices[c]]);
    const Place b = placeOf(surface.positions[surface.indices[c % 3 == 2 ? c - 2 : c + 1]]);
    if (a < b) ++edges[{a, b}].there;
    if (b < a) ++edges[{b, a}].back;
  }
  return edges;
}

std::set<PlacePair> openEdges(const bake::LevelSurface& surface) {
  std::set<PlacePair> open;
  for (const auto& [edge, uses] : edgesOf(surface))
    if (uses.there + uses.back == 1) open.insert(edge);
  return open;
}

bool isClosed(const bake::LevelSurface& surface) {
  const std::map<PlacePair, EdgeUses> edges = edgesOf(surface);
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [](const auto& edge) {
    return edge.second.there == 1 && edge.second.back == 1;
  });
}

std::int64_t eulerNumber(const bake::LevelSurface& surface) {
  std::set<Place> places;
  for (const std::uint32_t index : surface.indices)
    places.insert(placeOf(surface.positions[index]));
  return static_cast<std::int64_t>(places.size()) - static_cast<std::int64_t>(edgesOf(surface).size()) +
         static_cast<std::int64_t>(surface.indices.size() / 3);
}

glm::dvec3 areaVector(const bake::LevelSurface& surface, std::size_t triangle) {
  const glm::dvec3 a = corner(surface, 3 * triangle);
  return 0.5 * glm::cross(corner(surface, 3 * triangle + 1) - a, corner(surface, 3 * triangle + 2) - a);
}

double areaOf(const bake::LevelSurface& surface) {
  double area = 0.0;
  for (std::size_t t = 0; 3 * t < surface.indices.size(); ++t)
    area += glm::length(areaVector(surface, t));
  return area;
}

double volumeOf(const bake::LevelSurface& surface) {
  double volume = 0.0;
  for (std::size_t t = 0; 3 * t < surface.indices.size(); ++t)
    volume += glm::dot(corner(surface, 3 * t), areaVector(surface, t)) / 3.0;
  return volume;
}

double diagonalOf(const bake::LevelSurface& surface) {
  glm::dvec3 low(surface.positions.at(0));
  glm::dvec3 high = low;
  for (std::size_t c = 0; c < surface.indices.size(); ++c) {
    low = glm::min(low, corner(surface, c));
    high = glm::max(high, corner(surface, c));
  }
  return glm::length(high - low);
}

double largestDistance(const bake::LevelSurface& from, const bake::LevelSurface& to, int steps) {
  const bake::TriangleBvh nearest(to.positions, to.indices);
  double largest = 0.0;
  for (std::size_t t = 0; t < from.indices.size(); t += 3) {
    for (int i = 0; i <= steps; ++i) {
      for (int k = 0; i + k <= steps; ++k) {
        const double u = static_cast<double>(i) / steps;
        const double v = static_cast<double>(k) / steps;
        const glm::dvec3 p = (1.0 - u - v) * corner(from, t) + u * corner(from, t + 1) + v * corner(from, t + 2);
        largest = std::max(largest, nearest.distance(glm::vec3(p)));
      }
    }
  }
  return largest;
}

double largestDistanceBothWays(const bake::LevelSurface& a, const bake::LevelSurface& b, int steps) {
  return std::max(largestDistance(a, b, steps), largestDistance(b, a, steps));
}

}  // namespace jalousie::test
