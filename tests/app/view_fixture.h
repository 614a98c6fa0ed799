// Fixture of the viewer tests: a viewer in a window of the test's X server, driven by events of xdotool.
#pragma once

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/view/viewer.h"
#include "asset/accessor.h"
#include "asset/gltf_file.h"
#include "asset/image_io.h"
#include "asset/lod_chain.h"
#include "core/error.h"
#include "gl/debug_log.h"
#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie::test {

/// Writes a GLB of spheres with three LODs and their errors: a large sphere in front, a grid of small ones behind it,
/// and a small one that the large one occludes from the camera of the start.
/// @param side  spheres along each side of the grid
inline void writeSpheres(const std::filesystem::path& file, int side = 5) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  constexpr std::array<std::array<std::uint32_t, 2>, 3> kShapes = {{{24, 12}, {12, 6}, {6, 4}}};
  constexpr std::array<double, 3> kErrors = {0.0, 0.03, 0.12};
  for (std::size_t level = 0; level < kShapes.size(); ++level) {
    const asset::Primitive mesh = sphere(kShapes[level][0], kShapes[level][1]);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = asset::appendVec3(model, mesh.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["NORMAL"] = asset::appendVec3(model, mesh.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.indices = asset::appendIndices(model, mesh.indices);
    model.meshes.emplace_back();
    model.meshes.back().primitives.push_back(primitive);
    asset::setLodInfo(model.meshes.back(),
                      {static_cast<std::uint32_t>(level), static_cast<std::uint32_t>(mesh.indices.size() / 3),
                       static_cast<std::uint32_t>(mesh.positions.size()), kErrors[level]});
  }
  std::vector<int> lower;
  for (const int mesh : {1, 2}) {
    tinygltf::Node node;
    node.mesh = mesh;
    lower.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
  }
  model.scenes.emplace_back();
  model.defaultScene = 0;
  const std::array<float, 3> coverage = {0.1F, 0.01F, 0.0F};
  const auto add = [&](double x, double y, double z, double scale) {
    tinygltf::Node node;
    node.mesh = 0;
    node.translation = {x, y, z};
    node.scale = {scale, scale, scale};
    const auto index = static_cast<int>(model.nodes.size());
    model.nodes.push_back(node);
    asset::setLodChain(model, index, lower, coverage);
    model.scenes[0].nodes.push_back(index);
  };
  add(0.0, 0.0, 2.0, 1.0);
  for (int i = 0; i < side * side; ++i)
    add(1.1 * (i % side - side / 2), 1.1 * (i / side - side / 2), -3.0, 0.5);
  add(-0.42, -0.48, 0.8, 0.15);
  asset::saveGlb(model, file);
}

/// Runs a command line as the viewer copies it.
inline ProgramResult runCommand(const std::string& command) {
  return runProgram("/bin/sh", {"-c", "exec \"" JALOUSIE_PROGRAM "\" " + command.substr(command.find(' ') + 1)});
}

class ViewTest : public testing::Test {
 protected:
  static constexpr std::uint32_t kWidth = 640;
  static constexpr std::uint32_t kHeight = 400;

  void SetUp() override {
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
    writeSpheres(scene());
  }

  void TearDown() override {
    viewer_.reset();
    if (!log_) return;
    glFinish();
    for (const std::string& problem : log_->problems())
      ADD_FAILURE() << "OpenGL debug output: " << problem;
    log_.reset();
    window_.reset();
  }

  /// Opens the viewer. @return false if there is no display   @param interface  leaves the panel open
  bool open(app::ViewOptions options, bool interface = false) {
    options.outputs = folder_.path();
    options.render.width = kWidth;
    options.render.height = kHeight;
    options.finish();
    try {
      window_.emplace(
          platform::WindowOptions{.width = kWidth, .height = kHeight, .title = "jalousie test", .debug = true});
    } catch (const Error& error) {
      EXPECT_EQ(std::getenv("DISPLAY"), nullptr) << "there is a display: " << error.what();
      return false;
    }
    log_.emplace();
    viewer_ = std::make_unique<app::Viewer>(*window_, options);
    settle();
    xdotool("search --sync --name jalousie windowfocus --sync");
    if (!interface) key("Tab");
    return true;
  }
  bool openScene() {
    app::ViewOptions options;
    options.files = {scene()};
    return open(options);
  }

  /// Steps until the viewer is idle.
  void settle() {
    for (int i = 0; i < 4; ++i)
      viewer_->step();
    for (int i = 0; i < 400 && !viewer_->idle(); ++i)
      viewer_->step();
    EXPECT_TRUE(viewer_->idle());
  }
  void xdotool(const std::string& arguments) {
    std::istringstream words(arguments);
    const ProgramResult result =
        runProgram(JALOUSIE_XDOTOOL, {std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()});
    EXPECT_EQ(result.exitCode, 0) << arguments << ": " << result.standardError;
    for (int i = 0; i < 3; ++i)
      viewer_->step();
  }
  void key(const std::string& keys) {
    xdotool("key " + keys);
    settle();
  }
  void drag(int button, int fromX, int fromY, int toX, int toY) {
    xdotool("mousemove " + std::to_string(fromX) + " " + std::to_string(fromY));
    xdotool("mousedown " + std::to_string(button));
    xdotool("mousemove " + std::to_string((fromX + toX) / 2) + " " + std::to_string((fromY + toY) / 2));
    xdotool("mousemove " + std::to_string(toX) + " " + std::to_string(toY));
    xdotool("mouseup " + std::to_string(button));
    settle();
  }

  /// Expects that the copied command renders the picture of the current document, bit for bit.
  void expectHeadlessEqual(const std::string& what) {
    const std::filesystem::path file = folder_ / "headless.png";
    const std::string command = viewer_->command(0, file.string());
    const ProgramResult result = runCommand(command);
    ASSERT_EQ(result.exitCode, 0) << what << ": " << command << ": " << result.standardError;
    const ImageRgba8 expected = asset::loadImage(file);
    const app::Region where = viewer_->region(state().current);
    const ImageRgba8 actual =
        columns(viewer_->capture(), static_cast<std::uint32_t>(where.x), static_cast<std::uint32_t>(where.width));
    ASSERT_EQ(actual.width, expected.width) << command;
    ASSERT_EQ(actual.height, expected.height) << command;
    EXPECT_TRUE(actual.pixels == expected.pixels) << what << ": " << command;
    settle();
  }

  /// Pixels of the window itself as it was last shown, row 0 at the top.
  static std::vector<std::uint8_t> shown(std::uint32_t width, std::uint32_t height) {
    std::vector<std::uint8_t> rows(std::size_t{4} * width * height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), GL_RGBA, GL_UNSIGNED_BYTE,
                 rows.data());
    std::vector<std::uint8_t> pixels;
    for (std::size_t y = height; y-- > 0;)
      pixels.insert(pixels.end(), rows.begin() + static_cast<std::ptrdiff_t>(4 * width * y),
                    rows.begin() + static_cast<std::ptrdiff_t>(4 * width * (y + 1)));
    for (std::size_t i = 3; i < pixels.size(); i += 4)
      pixels[i] = 255;
    return pixels;
  }
  static ImageRgba8 columns(const ImageRgba8& image, std::uint32_t from, std::uint32_t count) {
    ImageRgba8 part{count, image.height, {}};
    for (std::uint32_t y = 0; y < image.height; ++y)
      part.pixels.insert(part.pixels.end(), image.pixels.begin() + static_cast<std::ptrdiff_t>(image.offset(from, y)),
                         image.pixels.begin() + static_cast<std::ptrdiff_t>(image.offset(from, y) + 4UL * count));
    return part;
  }

  const app::ViewState& state() const { return viewer_->state(); }
  View shownView() const { return state().configurations[0].active.frameOptions.view; }
  app::WorldPose pose() { return viewer_->document(0).camera.pose.value_or(app::WorldPose{}); }
  std::filesystem::path scene() const { return folder_ / "scene.glb"; }

  TemporaryFolder folder_;
  std::optional<platform::Window> window_;
  std::optional<gl::DebugLog> log_;
  std::unique_ptr<app::Viewer> viewer_;
};

}  // namespace jalousie::test
