// Files that others wrote, each with something that a baker gets wrong: bakes them and looks at what was written.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene_types.h"
#include "bake/glb_fixtures.h"
#include "bake/mesh/level_surface.h"
#include "bake/pipeline/bake_job.h"
#include "support/run_program.h"

namespace jalousie::test {

/// A file that was baked, written and read back.
struct BakedCase {
  bake::JobResult result;
  nlohmann::json report;  ///< as the program writes it with --json
  Glb glb;
  tinygltf::Model model;
  asset::SceneFile scene;

  const nlohmann::json& levels(std::size_t mesh = 0) const { return report.at("meshes").at(mesh).at("levels"); }
  double errorPercent(std::size_t level, std::size_t mesh = 0) const {
    return levels(mesh).at(level).at("error_percent").get<double>();
  }
  /// The meshes of a chain, LOD 0 first.
  std::vector<const asset::Mesh*> chain(std::size_t index = 0) const;
  /// Whether a warning has this text.
  bool warns(const std::string& text) const;
};

/// The folder is that of JALOUSIE_CASES; without it, the tests are skipped.
class CaseFiles : public testing::Test {
 protected:
  void SetUp() override;
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  /// Bakes 50, 25, 12 and 5 % of the triangles with the preset best unless the settings are changed.
  BakedCase bake(
      const std::string& name, const std::function<void(bake::JobSettings&)>& change = [](bake::JobSettings&) {}) const;
  /// As bake, for a file at another place.
  BakedCase bakeFile(const std::filesystem::path& file, const std::function<void(bake::JobSettings&)>& change) const;
  /// The content of a file that is no text.
  Glb readGlb(const std::string& name) const;
  /// What the file shows before it is baked.
  asset::SceneFile readInput(const std::string& name) const;
  /// The words of each line of a text file.
  std::vector<std::vector<std::string>> readLines(const std::string& name) const;
  std::filesystem::path temporary(const std::string& name) const { return temporary_ / name; }

 private:
  std::filesystem::path folder_;
  TemporaryFolder temporary_;
};

using Place = std::array<float, 3>;
/// Places of the two ends, the lesser first.
using PlacePair = std::pair<Place, Place>;

inline Place placeOf(const glm::vec3& p) {
  return {p.x, p.y, p.z};
}

/// All primitives of a mesh, or one of them.
bake::LevelSurface surfaceOf(const asset::Mesh& mesh);
bake::LevelSurface surfaceOf(const asset::Primitive& primitive);

/// How often an edge is used from its lesser end to the other one, and back.
struct EdgeUses {
  int there = 0;
  int back = 0;
};
/// Ends of zero length are left out.
std::map<PlacePair, EdgeUses> edgesOf(const bake::LevelSurface& surface);
/// Edges of a single triangle.
std::set<PlacePair> openEdges(const bake::LevelSurface& surface);
/// Every edge is used once in each direction.
bool isClosed(const bake::LevelSurface& surface);
/// Vertices - edges + triangles: 2 for a sphere, 0 for a torus.
std::int64_t eulerNumber(const bake::LevelSurface& surface);

/// Half the cross product of two sides.
glm::dvec3 areaVector(const bake::LevelSurface& surface, std::size_t triangle);
double areaOf(const bake::LevelSurface& surface);
/// Positive where triangles face outwards.
double volumeOf(const bake::LevelSurface& surface);
/// Of the box around it.
double diagonalOf(const bake::LevelSurface& surface);
/// The largest distance to another surface of points spread over all triangles. @param steps  of each edge
double largestDistance(const bake::LevelSurface& from, const bake::LevelSurface& to, int steps);
/// In both directions.
double largestDistanceBothWays(const bake::LevelSurface& a, const bake::LevelSurface& b, int steps);

}  // namespace jalousie::test
