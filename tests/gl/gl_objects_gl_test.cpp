// Ownership and error reports of the OpenGL wrappers.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/pass_timer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "render/frame_renderer.h"
#include "render/program_table.h"
#include "support/gl_test.h"
#include "support/run_program.h"
#include "support/stages.h"
#include "visibility/program_table.h"

namespace jalousie::gl {
namespace {

class GlObjects : public test::GlTest {};

TEST_F(GlObjects, MovedFromHandleHoldsNothingAndTheNameDiesOnce) {
  Buffer first(64, 0, "first");
  const GLuint name = first.id();
  Buffer second = std::move(first);
  EXPECT_EQ(second.id(), name);
  EXPECT_EQ(first.id(), 0U);  // NOLINT(bugprone-use-after-move): the contract under test
  second = Buffer();
  EXPECT_EQ(glIsBuffer(name), GL_FALSE);
}

TEST_F(GlObjects, BufferKeepsWhatWasWritten) {
  const std::vector<float> values = {1, 2, 3, 4, 5};
  Buffer buffer = Buffer::fromArray(std::span<const float>(values), "values");
  EXPECT_EQ(buffer.read<float>(5), values);
  const std::array<float, 2> change = {8, 9};
  buffer.write(4, std::as_bytes(std::span(change)));
  EXPECT_EQ(buffer.read<float>(5), (std::vector<float>{1, 8, 9, 4, 5}));
}

TEST_F(GlObjects, EmptyBufferCanBeBoundAndSmallOneKeepsItsContent) {
  const Buffer empty = Buffer::fromArray(std::span<const float>(), "empty");
  empty.bindStorage(0);
  const std::vector<std::uint32_t> one = {7};
  EXPECT_EQ(Buffer::fromArray(std::span<const std::uint32_t>(one), "one").read<std::uint32_t>(1), one);
}

TEST_F(GlObjects, WritingBeyondTheEndAborts) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  Buffer buffer(16, GL_DYNAMIC_STORAGE_BIT, "small");
  const std::array<float, 5> tooMuch = {};
  EXPECT_DEATH(buffer.write(0, std::as_bytes(std::span(tooMuch))), "check failed");
}

TEST_F(GlObjects, FramebufferReadsTopRowFirst) {
  const Texture color(GL_TEXTURE_2D, GL_RGBA8, {2, 2, 1, 1}, "colour");
  const Framebuffer framebuffer(color, nullptr, "frame");
  const std::array<std::uint8_t, 16> bottomUp = {1, 0, 0, 255, 2, 0, 0, 255, 3, 0, 0, 255, 4, 0, 0, 255};
  glTextureSubImage2D(color.id(), 0, 0, 0, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, bottomUp.data());
  const ImageRgba8 image = framebuffer.readRgba8(2, 2);
  EXPECT_EQ(image.pixels[image.offset(0, 0)], 3);
  EXPECT_EQ(image.pixels[image.offset(1, 1)], 2);
}

TEST_F(GlObjects, EveryProgramOfTheTablesBuilds) {
  for (const auto table : {visibility::programTable(), render::programTable()})
    for (const ProgramSource& source : table)
      EXPECT_NO_THROW(Program{source}) << source.name;
}

TEST_F(GlObjects, EveryProgramOfARendererReadsItsShaderLibrary) {
  const test::TemporaryFolder folder;
  const ShaderLibrary library(folder.path());
  asset::SceneFile scenery = test::spheresBehindWall(0.3F);
  scenery.looseGeometries = {{{asset::LooseVertex{}}, {}}};
  scenery.looseInstances = {{0, glm::mat4(1.0F), std::nullopt}};
  scenery.motion.nodes.resize(1);
  scenery.motion.nodes.front().anchor = scenery.motion.nodes.front().translationTrack = gpu::kNoMotion;
  scenery.motion.nodes.front().rotationTrack = scenery.motion.nodes.front().scaleTrack = gpu::kNoMotion;
  scenery.motion.instances.resize(1);
  const scene::SceneData scene =
      scene::buildScene(scenery, {.cells = {scene::CellOptions::Kind::kCount, 64}, .faces = true});
  ASSERT_FALSE(scene.cells.objects.empty());
  ASSERT_FALSE(scene.faces.empty());
  std::set<std::string_view> files;
  for (const auto table : {visibility::programTable(), render::programTable()})
    for (const ProgramSource& source : table)
      files.insert(source.stages.begin(), source.stages.end());
  EXPECT_GT(files.size(), 20U);
  EXPECT_NO_THROW(render::FrameRenderer(scene, 16, 16, {.shaders = &library}));
  for (const std::string_view file : files) {
    const std::filesystem::path broken = folder / std::string(file);
    std::filesystem::create_directories(broken.parent_path());
    std::ofstream(broken) << "no version line\n";
    try {
      const render::FrameRenderer renderer(scene, 16, 16, {.shaders = &library});
      ADD_FAILURE() << file << " was not read from the folder";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kShader) << file;
    }
    std::filesystem::remove(broken);
  }
  EXPECT_NO_THROW(render::FrameRenderer(scene, 16, 16, {.shaders = &library}));
}

TEST_F(GlObjects, LinkFailureIsAnErrorWithCodeShader) {
  try {
    const Program broken({"no fragment inputs", {"render/fullscreen.vert", "render/mesh.frag"}, {}});
    FAIL() << "a program with missing inputs linked";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kShader);
  }
}

TEST_F(GlObjects, DebugLogSeesAMistake) {
  const DebugLog log;                        // replaces the fixture's, which would fail the test
  glBindFramebuffer(GL_FRAMEBUFFER, 12345);  // no such name
  EXPECT_FALSE(log.problems().empty());
}

TEST_F(GlObjects, TimerReportsPassesOnlyWhenEnabled) {
  PassTimer timer;
  timer.beginFrame();
  { const PassTimer::Scope pass(timer, "quiet"); }
  EXPECT_TRUE(timer.passes().empty());
  timer.setTiming(Timing::kWall);
  { const PassTimer::Scope pass(timer, "loud"); }
  ASSERT_EQ(timer.passes().size(), 1U);
  EXPECT_EQ(timer.passes()[0].name, "loud");
  EXPECT_GE(timer.passes()[0].ms, 0.0);
}

}  // namespace
}  // namespace jalousie::gl
