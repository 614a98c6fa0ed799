// Who may include whom: reads every #include line and fails on an edge that the layering does not allow, on a circle
// between units, and on a relative path.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "project/include_graph.h"

namespace jalousie {
namespace {

using test::SourceFile;

const std::vector<std::string> kFolders = {"src", "preprocess", "shaders/shared", "tests", "bench"};

/// Room -> rooms it may include, besides itself. A room is a folder with all folders below it that are not rooms of
/// their own. A room that is not there yet may stand here. Tests and benches are judged by judgeTestEdge.
const std::map<std::string, std::set<std::string>>& allowed() {
  static const std::map<std::string, std::set<std::string>> kAllowed = {
      {"shaders/shared", {}},
      {"src/core", {}},
      {"src/cli", {"src/core"}},
      {"src/asset", {"src/core", "shaders/shared"}},
      {"src/gl", {"src/core"}},
      {"src/platform", {"src/core", "src/gl"}},
      {"src/policy", {"src/core", "shaders/shared"}},
      {"src/scene", {"src/core", "src/asset", "shaders/shared"}},
      {"src/visibility", {"src/core", "src/policy", "src/scene", "src/gl", "shaders/shared"}},
      {"src/culling", {"src/core", "src/scene", "shaders/shared"}},
      {"src/render",
       {"src/core", "src/culling", "src/policy", "src/scene", "src/visibility", "src/gl", "shaders/shared"}},
      {"src/compare",
       {"src/core", "src/asset", "src/policy", "src/scene", "src/visibility", "src/render", "shaders/shared"}},
      {"src/app",
       {"src/core", "src/cli", "src/asset", "src/gl", "src/platform", "src/policy", "src/scene", "src/visibility",
        "src/render", "src/compare", "shaders/shared"}},
      {"preprocess/bake/mesh", {"src/core"}},
      {"preprocess/bake/simplify", {"src/core", "preprocess/bake/mesh"}},
      {"preprocess/bake/io", {"src/core", "src/asset", "preprocess/bake/mesh", "preprocess/bake/simplify"}},
      {"preprocess/bake/report",
       {"src/core", "src/asset", "preprocess/bake/mesh", "preprocess/bake/simplify", "preprocess/bake/io"}},
      {"preprocess/bake/pipeline",
       {"src/core", "src/cli", "src/asset", "preprocess/bake/mesh", "preprocess/bake/simplify", "preprocess/bake/io",
        "preprocess/bake/report"}},
      {"preprocess/scatter", {"src/core", "src/cli", "src/asset"}},
      {"preprocess/wad", {"src/core", "src/cli", "src/asset"}},
      // The programs' main files.
      {"preprocess",
       {"src/core", "src/cli", "src/asset", "preprocess/scatter", "preprocess/wad", "preprocess/bake/mesh",
        "preprocess/bake/simplify", "preprocess/bake/io", "preprocess/bake/report", "preprocess/bake/pipeline"}},
  };
  return kAllowed;
}

/// Test folders that share the fixtures of another one; tests/support is open to all.
const std::map<std::string, std::string> kSharedFixtures = {
    {"tests/bench", "bench"},          // what benchmarks compute without OpenGL
    {"tests/hostile", "tests/fuzz"},   // broken files are put through what the fuzzers call
    {"tests/scatter", "tests/asset"},  // small documents
};

/// Circles between units that are known and wait to be cut. The list may only become shorter.
const std::set<std::vector<std::string>> kKnownCircles = {};

bool isTestOrBench(const std::string& room) {
  return room.starts_with("tests/") || room == "bench";
}

/// The room of a file; empty if no room of the table holds it.
std::string roomOf(const std::string& path) {
  if (path.starts_with("bench/")) return "bench";
  if (path.starts_with("tests/")) return path.substr(0, path.find('/', 6));
  std::string folder = path.substr(0, path.rfind('/'));
  if (folder == "preprocess") return folder;
  while (!allowed().contains(folder)) {
    const std::size_t slash = folder.rfind('/');
    if (slash == std::string::npos) return {};
    folder.resize(slash);
    if (folder == "preprocess") return {};
  }
  return folder;
}

/// OpenGL belongs to the rooms made for it; in visibility only to the passes, the table of their programs, and the
/// buffers and dispatches that they share.
bool mayUseGl(const std::string& path, const std::string& room) {
  static const std::set<std::string> kRooms = {"src/gl", "src/platform", "src/render", "src/app"};
  if (kRooms.contains(room) || isTestOrBench(room)) return true;
  const std::string name = path.substr(path.rfind('/') + 1);
  static const std::set<std::string> kShared = {"program_table", "object_store", "storage", "dispatch"};
  return room == "src/visibility" &&
         (name.find("_pass.") != std::string::npos || kShared.contains(name.substr(0, name.find('.'))));
}

bool isGlHeader(const std::string& header) {
  return header.starts_with("epoxy/") || header.starts_with("EGL/") || header.starts_with("GL/") ||
         header.starts_with("GLFW/");
}

bool isInterfaceHeader(const std::string& header) {
  return header.starts_with("imgui") || header.starts_with("backends/imgui");
}

/// Mesh and simplification work on spans and plain structs: no documents, no files, no threads.
bool isForbiddenInMeshes(const std::string& header) {
  static const std::set<std::string> kForbidden = {
      "tiny_gltf.h", "filesystem", "fstream", "thread", "mutex", "future", "atomic", "condition_variable", "cstdio"};
  return kForbidden.contains(header) || header.starts_with("core/file") || header.starts_with("core/confined_folder");
}

/// Rules about headers that are not files of the project. Empty if the edge is fine, else what is wrong with it.
std::string judgeOutsideHeader(const std::string& path, const std::string& room, const std::string& header) {
  if (isGlHeader(header) && !mayUseGl(path, room)) return "OpenGL outside the OpenGL rooms";
  if (isInterfaceHeader(header) && room != "src/app" && room != "tests/app") return "the interface library outside app";
  const bool isMeshRoom = room == "preprocess/bake/mesh" || room == "preprocess/bake/simplify";
  if (isMeshRoom && isForbiddenInMeshes(header)) return "files, documents or threads in the mesh rooms";
  return {};
}

/// Tests and benches may include every room, but of each other only tests/support and the shared fixtures.
std::string judgeTestEdge(const std::string& room, const std::string& target) {
  if (!isTestOrBench(target) || target == "tests/support") return {};
  const auto shared = kSharedFixtures.find(room);
  if (shared != kSharedFixtures.end() && shared->second == target) return {};
  return room + " may not include " + target;
}

/// The room that a header belongs to: of the first candidate that is a file of the project, else of the first include
/// folder in which its folder is a room. Empty for headers of other projects.
std::string targetRoom(const std::string& path, const std::string& header, const std::set<std::string>& files) {
  for (const std::string& candidate : test::candidatePaths(path, header))
    if (files.contains(candidate)) return roomOf(candidate);
  if (header.find('/') == std::string::npos) return {};
  for (const char* root : {"src/", "preprocess/", "shaders/"})
    if (std::string room = roomOf(root + header); !room.empty()) return room;
  return {};
}

/// Empty if the file may include the header, else what is wrong with it.
std::string judge(const std::string& path, const std::string& header, const std::set<std::string>& files = {}) {
  if (header.starts_with("./") || header.find("../") != std::string::npos) return "a relative path";
  const std::string room = roomOf(path);
  if (std::string problem = judgeOutsideHeader(path, room, header); !problem.empty()) return problem;
  const std::string target = targetRoom(path, header, files);
  if (target.empty() || target == room) return {};
  if (isTestOrBench(room)) return judgeTestEdge(room, target);
  if (!allowed().at(room).contains(target)) return room + " may not include " + target;
  if (target == "src/gl" && !mayUseGl(path, room)) return "src/gl outside the pass files";
  return {};
}

TEST(IncludeEdges, SourceTreeKeepsTheLayering) {
  const std::vector<SourceFile> sources = test::readSources(JALOUSIE_SOURCE_DIR, kFolders);
  std::set<std::string> files;
  for (const SourceFile& source : sources)
    files.insert(source.path);
  EXPECT_GT(files.size(), 300U);
  for (const SourceFile& source : sources) {
    ASSERT_FALSE(roomOf(source.path).empty()) << source.path << " lies in a folder this test does not know";
    for (const std::string& header : source.headers) {
      const std::string problem = judge(source.path, header, files);
      EXPECT_TRUE(problem.empty()) << source.path << " includes " << header << ": " << problem;
    }
  }
}

TEST(IncludeEdges, NoUnitsIncludeEachOtherInACircle) {
  for (const std::vector<std::string>& circle :
       test::findCircles(test::unitGraph(test::readSources(JALOUSIE_SOURCE_DIR, kFolders)))) {
    std::string names;
    for (const std::string& unit : circle)
      names += "\n  " + unit;
    EXPECT_TRUE(kKnownCircles.contains(circle)) << "a circle of" << names;
  }
}

TEST(IncludeEdges, ForbiddenEdgesAreFound) {
  EXPECT_FALSE(judge("src/core/x.h", "asset/gltf_file.h").empty());
  EXPECT_FALSE(judge("src/scene/x.h", "visibility/lod_policy.h").empty());
  EXPECT_FALSE(judge("src/scene/x.h", "epoxy/gl.h").empty());
  EXPECT_FALSE(judge("src/visibility/overlap_reference.cpp", "gl/buffer.h").empty());
  EXPECT_FALSE(judge("src/render/x.cpp", "asset/image_io.h").empty());
  EXPECT_FALSE(judge("src/render/methods/hiz/x.cpp", "asset/image_io.h").empty());
  EXPECT_FALSE(judge("src/gl/x.cpp", "render/draw_pass.h").empty());
  EXPECT_FALSE(judge("src/policy/x.h", "scene/scene_data.h").empty());
  EXPECT_FALSE(judge("src/render/x.cpp", "imgui.h").empty());
  EXPECT_FALSE(judge("preprocess/bake/io/x.cpp", "scene/scene_data.h").empty());
  EXPECT_FALSE(judge("preprocess/bake/mesh/x.cpp", "bake/simplify/chain.h").empty());
  EXPECT_FALSE(judge("preprocess/bake/simplify/x.cpp", "bake/io/import.h").empty());
  EXPECT_FALSE(judge("preprocess/bake/io/x.cpp", "bake/pipeline/digest.h").empty());
  EXPECT_FALSE(judge("preprocess/bake/report/x.cpp", "bake/pipeline/threads.h").empty());
  EXPECT_FALSE(judge("preprocess/scatter/x.cpp", "bake/mesh/weld.h").empty());
}

TEST(IncludeEdges, FilesDocumentsAndThreadsStayOutOfTheMeshRooms) {
  for (const char* header :
       {"tiny_gltf.h", "filesystem", "fstream", "thread", "mutex", "future", "core/file.h", "asset/lod_chain.h"}) {
    EXPECT_FALSE(judge("preprocess/bake/simplify/x.cpp", header).empty()) << header;
    EXPECT_FALSE(judge("preprocess/bake/mesh/x.h", header).empty()) << header;
    EXPECT_TRUE(judge("preprocess/bake/io/x.cpp", header).empty()) << header;
  }
}

TEST(IncludeEdges, AllowedEdgesPass) {
  EXPECT_TRUE(judge("src/visibility/visibility_pass.cpp", "gl/buffer.h").empty());
  EXPECT_TRUE(judge("src/app/x.cpp", "render/frame_renderer.h").empty());
  EXPECT_TRUE(judge("src/render/methods/hiz/x.cpp", "render/methods/full/y.h").empty());
  EXPECT_TRUE(judge("src/compare/x.cpp", "policy/cull_mode.h").empty());
  EXPECT_TRUE(judge("src/core/x.cpp", "vector").empty());
  EXPECT_TRUE(judge("preprocess/bake/simplify/x.cpp", "bake/mesh/wedge_mesh.h").empty());
  EXPECT_TRUE(judge("tests/bake/x.cpp", "bake/pipeline/job_list.h").empty());
  EXPECT_TRUE(judge("bench/x.cpp", "render/frame_renderer.h").empty());
}

TEST(IncludeEdges, TestsAreIncludedByTestsOnly) {
  const std::set<std::string> files = {"tests/support/scenes.h", "tests/bake/bake_fixtures.h", "bench/bench_head.h"};
  EXPECT_FALSE(judge("src/core/x.cpp", "support/scenes.h", files).empty());
  EXPECT_FALSE(judge("preprocess/bake/mesh/x.cpp", "bake/bake_fixtures.h", files).empty());
  EXPECT_FALSE(judge("tests/scatter/x.cpp", "bake/bake_fixtures.h", files).empty());
  EXPECT_FALSE(judge("bench/x.cpp", "bake/bake_fixtures.h", files).empty());
  EXPECT_TRUE(judge("tests/scatter/x.cpp", "support/scenes.h", files).empty());
  EXPECT_TRUE(judge("tests/bake/x.cpp", "bake/bake_fixtures.h", files).empty());
  EXPECT_TRUE(judge("bench/x.cpp", "support/scenes.h", files).empty());
  EXPECT_TRUE(judge("bench/x.cpp", "bench_head.h", files).empty());
}

TEST(IncludeEdges, RelativePathsAreFound) {
  EXPECT_FALSE(judge("src/core/x.cpp", "../core/file.h").empty());
  EXPECT_FALSE(judge("tests/bake/x.cpp", "support/../bake/bake_fixtures.h").empty());
  EXPECT_FALSE(judge("bench/x.cpp", "./y.h").empty());
}

TEST(IncludeEdges, UnknownFoldersHaveNoRoom) {
  EXPECT_EQ(roomOf("src/core/x.h"), "src/core");
  EXPECT_EQ(roomOf("src/render/methods/hiz/x.h"), "src/render");
  EXPECT_EQ(roomOf("preprocess/bake_main.cpp"), "preprocess");
  EXPECT_EQ(roomOf("tests/bake/x.cpp"), "tests/bake");
  EXPECT_EQ(roomOf("src/unknown/x.h"), "");
  EXPECT_EQ(roomOf("preprocess/bake/x.h"), "");
}

TEST(IncludeEdges, CirclesBetweenUnitsAreFound) {
  const test::Graph graph = {{"a", {"b"}}, {"b", {"c", "d"}}, {"c", {"a"}}, {"d", {"e"}}, {"e", {}}, {"f", {"g"}}};
  using Circles = std::vector<std::vector<std::string>>;
  EXPECT_EQ(test::findCircles(graph), (Circles{{"a", "b", "c"}}));
  EXPECT_EQ(test::findCircles({{"a", {"b"}}, {"b", {"a"}}, {"x", {"y"}}, {"y", {"x", "a"}}}),
            (Circles{{"a", "b"}, {"x", "y"}}));
  // A header and its source are one unit: a.h -> b.h and b.cpp -> a.h are a circle.
  const std::vector<SourceFile> files = {{"src/core/a.h", {"core/b.h"}},
                                         {"src/core/a.cpp", {"core/a.h", "vector"}},
                                         {"src/core/b.h", {}},
                                         {"src/core/b.cpp", {"core/b.h", "core/a.h"}}};
  EXPECT_EQ(test::findCircles(test::unitGraph(files)), (Circles{{"src/core/a", "src/core/b"}}));
}

}  // namespace
}  // namespace jalousie
