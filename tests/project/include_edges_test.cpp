// Who may include whom: reads every #include line and fails on an edge that the layering does not allow.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace jalousie {
namespace {

namespace fs = std::filesystem;

/// Folder -> folders it may include, besides itself. `shared` is shaders/shared; `tools` everything below preprocess.
/// visibility and render may use gl only in their *_pass files and render's files; see mayUseGl.
const std::map<std::string, std::set<std::string>>& allowed() {
  static const std::map<std::string, std::set<std::string>> kAllowed = {
      {"core", {}},
      {"shared", {}},
      {"asset", {"core", "shared"}},
      {"gl", {"core"}},
      {"platform", {"core", "gl"}},
      {"scene", {"core", "asset", "shared"}},
      {"visibility", {"core", "scene", "shared", "gl"}},
      {"render", {"core", "scene", "visibility", "shared", "gl"}},
      {"compare", {"core", "asset", "scene", "render", "shared"}},
      {"app", {"core", "asset", "gl", "platform", "scene", "visibility", "render", "compare", "shared"}},
      {"bake", {"core", "asset"}},
      {"scatter", {"core", "asset"}},
      {"tools", {"core", "asset", "bake", "scatter"}},
  };
  return kAllowed;
}

/// Files of visibility that may touch OpenGL: the passes and the table of their programs.
bool mayUseGl(const std::string& folder, const std::string& file) {
  if (folder != "visibility") return folder == "gl" || folder == "platform" || folder == "render" || folder == "app";
  return file.find("_pass.") != std::string::npos || file.starts_with("program_table.");
}

bool isGlHeader(const std::string& header) {
  return header.starts_with("epoxy/") || header.starts_with("EGL/") || header.starts_with("GL/") ||
         header.starts_with("GLFW/");
}

/// The interface library belongs to the viewer.
bool isInterfaceHeader(const std::string& header) {
  return header.starts_with("imgui") || header.starts_with("backends/imgui");
}

/// Empty if the edge is fine, else what is wrong with it.
std::string judge(const std::string& folder, const std::string& file, const std::string& header) {
  if (isGlHeader(header)) return mayUseGl(folder, file) ? "" : "OpenGL outside the OpenGL folders";
  if (isInterfaceHeader(header)) return folder == "app" ? "" : "the interface outside app";
  const std::string target = header.substr(0, header.find('/'));
  if (target == folder || !allowed().contains(target)) return "";  // its own folder, or a system header
  if (!allowed().at(folder).contains(target)) return folder + " may not include " + target;
  if (target == "gl" && !mayUseGl(folder, file)) return "gl outside the pass files";
  return "";
}

std::string folderOf(const fs::path& root, const fs::path& file) {
  const fs::path relative = file.lexically_relative(root);
  const std::string top = relative.begin()->string();
  const std::string second = std::next(relative.begin())->string();
  if (top == "src") return second;
  if (top == "preprocess") return second == file.filename() ? "tools" : second;
  return "shared";
}

std::vector<std::string> includesOf(const fs::path& file) {
  std::vector<std::string> headers;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line.compare(hash, 8, "#include") != 0) continue;
    const std::size_t open = line.find_first_of("\"<", hash);
    const std::size_t close = line.find_first_of("\">", open + 1);
    if (open != std::string::npos && close != std::string::npos)
      headers.push_back(line.substr(open + 1, close - open - 1));
  }
  return headers;
}

TEST(IncludeEdges, SourceTreeKeepsTheLayering) {
  const fs::path root = JALOUSIE_SOURCE_DIR;
  std::size_t files = 0;
  for (const char* top : {"src", "preprocess", "shaders/shared"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      ++files;
      const std::string folder = folderOf(root, entry.path());
      ASSERT_TRUE(allowed().contains(folder)) << folder << " is a folder this test does not know";
      for (const std::string& header : includesOf(entry.path())) {
        const std::string problem = judge(folder, entry.path().filename().string(), header);
        EXPECT_TRUE(problem.empty()) << entry.path() << " includes " << header << ": " << problem;
      }
    }
  }
  EXPECT_GT(files, 80U);
}

TEST(IncludeEdges, ForbiddenEdgesAreFound) {
  EXPECT_FALSE(judge("core", "x.h", "asset/gltf_file.h").empty());
  EXPECT_FALSE(judge("scene", "x.h", "visibility/lod_policy.h").empty());
  EXPECT_FALSE(judge("scene", "x.h", "epoxy/gl.h").empty());
  EXPECT_FALSE(judge("visibility", "overlap_reference.cpp", "gl/buffer.h").empty());
  EXPECT_FALSE(judge("bake", "x.cpp", "scene/scene_data.h").empty());
  EXPECT_FALSE(judge("render", "x.cpp", "asset/image_io.h").empty());
  EXPECT_FALSE(judge("gl", "x.cpp", "render/draw_pass.h").empty());
  EXPECT_TRUE(judge("visibility", "visibility_pass.cpp", "gl/buffer.h").empty());
  EXPECT_TRUE(judge("app", "x.cpp", "render/frame_renderer.h").empty());
  EXPECT_TRUE(judge("core", "x.cpp", "vector").empty());
  EXPECT_FALSE(judge("render", "x.cpp", "imgui.h").empty());
}

}  // namespace
}  // namespace jalousie
