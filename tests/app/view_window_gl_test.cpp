// The viewer under pointer and keys: navigation, picking, sizes, paths; its pictures equal those of `jalousie render`.
#include <algorithm>
#include <array>
#include <fstream>
#include <glm/packing.hpp>
#include <set>

#include "app/view/command_text.h"
#include "asset/scene_file.h"
#include "view_fixture.h"

namespace jalousie {
namespace {

class ViewWindow : public test::ViewTest {
 protected:
  void SetUp() override {
    ViewTest::SetUp();
    if (!openScene()) GTEST_SKIP() << "no display";
  }
};

TEST_F(ViewWindow, OpensWithThePictureThatRenderWrites) {
  EXPECT_EQ(viewer_->documentCount(), 1U);
  EXPECT_EQ(viewer_->document(0).error(), "");
  expectHeadlessEqual("at the start");
}

TEST_F(ViewWindow, DraggingTurnsMovesAndLooks) {
  drag(1, 300, 200, 380, 230);
  const app::WorldPose turned = pose();
  EXPECT_TRUE(viewer_->document(0).camera.pose.has_value());
  expectHeadlessEqual("turned");
  drag(2, 300, 200, 340, 200);
  EXPECT_NE(pose().look, turned.look) << "the middle button moves the target";
  const app::WorldPose moved = pose();
  drag(3, 300, 200, 340, 200);
  EXPECT_EQ(pose().eye, moved.eye) << "the right button looks around";
  EXPECT_NE(pose().look, moved.look);
  expectHeadlessEqual("looked around");
}

TEST_F(ViewWindow, WheelZoomsKeysFlyAndBookmarksRemember) {
  drag(1, 300, 200, 310, 200);
  const double before = glm::length(pose().eye - pose().look);
  xdotool("mousemove 300 200 click 4");
  settle();
  EXPECT_LT(glm::length(pose().eye - pose().look), before);
  key("ctrl+1");
  const app::WorldPose marked = pose();
  xdotool("keydown w");
  xdotool("keyup w");
  settle();
  EXPECT_NE(pose().eye, marked.eye);
  key("1");
  EXPECT_EQ(pose().eye, marked.eye);
  EXPECT_EQ(pose().look, marked.look);
  const float speed = state().settings.speed;
  xdotool("mousedown 3");
  xdotool("click 4");
  xdotool("mouseup 3");
  EXPECT_GT(state().settings.speed, speed) << "the wheel sets the speed while flying";
  key("f");
  EXPECT_EQ(pose().look, glm::dvec3(viewer_->document(0).boundsWorld().center()));
  key("r");
  EXPECT_FALSE(viewer_->document(0).camera.pose.has_value()) << "reset goes back to the start";
}

/// Every mode, and every view in the first mode of each kind: which views there are depends on the kind alone.
TEST_F(ViewWindow, EveryModeAndEveryViewIsWhatRenderWrites) {
  std::set<CullMode> modes;
  std::set<std::array<bool, 3>> kinds;
  while (modes.insert(state().configurations[0].active.frameOptions.cullMode).second) {
    const CullModeRow& mode = rowOf(state().configurations[0].active.frameOptions.cullMode);
    if (!kinds.insert({mode.testsOcclusion, mode.twoPhases, mode.asksQueries}).second) {
      expectHeadlessEqual(mode.name);
      settle();
      key("m");
      continue;
    }
    std::set<View> seen;
    std::set<std::vector<std::uint8_t>> pictures;
    while (seen.insert(shownView()).second) {
      const char* view = rowOf(shownView()).name;
      expectHeadlessEqual(std::string(mode.name) + " " + view);
      const bool fresh = pictures.insert(viewer_->capture().pixels).second;
      const bool nothingCulled = !mode.twoPhases && shownView() == View::kGhosts;
      EXPECT_TRUE(fresh || nothingCulled) << view << " looks like another view";
      settle();
      key("v");
    }
    const auto shows = [&](const ViewRow& view) {
      return (!view.needsOcclusionTest || mode.testsOcclusion) && (!view.needsTwoPhases || mode.twoPhases);
    };
    EXPECT_EQ(seen.size(), std::count_if(viewTable().begin(), viewTable().end(), shows)) << mode.name;
    key("m");
  }
  EXPECT_EQ(modes.size(), cullModeTable().size());
  EXPECT_GE(kinds.size(), 4U);
}

TEST_F(ViewWindow, MapLevelsAndRectangles) {
  while (shownView() != View::kOcclusion)
    key("v");
  key("o");
  for (int level = 0; level < 4; ++level) {
    EXPECT_EQ(state().configurations[0].active.frameOptions.mapLevel, static_cast<unsigned>(level));
    expectHeadlessEqual("level");
    key("bracketright");
  }
  key("bracketleft");
  EXPECT_EQ(state().configurations[0].active.frameOptions.mapLevel, 3U);
}

TEST_F(ViewWindow, ClickSelectsAndExplains) {
  xdotool("mousemove 320 205 click 1");
  settle();
  ASSERT_TRUE(state().inspection.has_value());
  const app::Inspection& i = *state().inspection;
  EXPECT_EQ(i.instance, 0U) << "the sphere in front";
  EXPECT_TRUE(i.hasRect);
  ASSERT_TRUE(i.block.has_value());
  EXPECT_LE(i.block->block.x.count, 16U);
  EXPECT_GE(std::max(i.block->block.x.count, i.block->block.y.count), 8U);
  EXPECT_EQ(i.block->spectrum.size(), i.block->block.opacity.size());
  EXPECT_EQ(i.levels.size(), 3U);
  EXPECT_GT(i.levels[2].errorPixels, i.levels[1].errorPixels);
  EXPECT_EQ(i.chosen, i.readout.state.lod);
  EXPECT_FALSE(i.why.empty());
  expectHeadlessEqual("with a selection");
  key("f");
  EXPECT_EQ(pose().look, glm::dvec3(i.boundsWorld.center())) << "F frames the selection";
  xdotool("mousemove 5 5 click 1");
  settle();
  EXPECT_FALSE(state().selection.has_value()) << "the background selects nothing";
}

TEST_F(ViewWindow, ObjectsAreHiddenAndIsolatedAsRenderDoes) {
  const ImageRgba8 whole = viewer_->capture();
  settle();
  xdotool("mousemove 320 205 click 1");
  settle();
  ASSERT_TRUE(state().selection.has_value());
  EXPECT_EQ(state().selection->instance, 0U);
  key("h");
  EXPECT_FALSE(state().selection.has_value()) << "what is hidden is not selected";
  EXPECT_NE(viewer_->command(0).find("--hide 0"), std::string::npos) << viewer_->command(0);
  expectHeadlessEqual("hidden");
  EXPECT_NE(viewer_->capture().pixels, whole.pixels);
  settle();
  xdotool("mousemove 320 205 click 1");
  settle();
  ASSERT_TRUE(state().selection.has_value()) << "a sphere behind the hidden one";
  const std::uint32_t behind = state().selection->instance;
  EXPECT_NE(behind, 0U);
  key("i");
  ASSERT_TRUE(state().selection.has_value()) << "it is found again in the new scene";
  ASSERT_TRUE(state().inspection.has_value());
  EXPECT_EQ(state().inspection->instance, behind);
  EXPECT_NE(viewer_->command(0).find("--only " + std::to_string(behind)), std::string::npos) << viewer_->command(0);
  expectHeadlessEqual("isolated");
  key("shift+h");
  EXPECT_EQ(viewer_->command(0).find("--only"), std::string::npos);
  EXPECT_EQ(viewer_->command(0).find("--hide"), std::string::npos);
  EXPECT_EQ(viewer_->capture().pixels, whole.pixels);
  settle();
}

TEST_F(ViewWindow, TheListHasEveryObjectWithItsCost) {
  key("l");
  ASSERT_EQ(viewer_->objects().objects.size(), 27U);
  EXPECT_EQ(viewer_->objectRows().order.size(), 27U);
  EXPECT_EQ(viewer_->objects().objects[viewer_->objectRows().order[0]].instance, 0U) << "the most triangles first";
  std::uint64_t triangles = 0;
  for (const app::ListedObject& object : viewer_->objects().objects) {
    EXPECT_FALSE(object.hidden);
    EXPECT_EQ(object.drawn, object.triangles > 0);
    triangles += object.triangles;
  }
  const auto& samples = state().history.samples();
  ASSERT_FALSE(samples.empty());
  EXPECT_GE(triangles, samples.back().statistics.triangles) << "of whole objects, whose cells can be culled";
  EXPECT_LE(triangles, samples.back().statistics.trianglesFinest);
  xdotool("mousemove 320 350 click 1");
  key("h");
  const auto hidden = std::count_if(viewer_->objects().objects.begin(), viewer_->objects().objects.end(),
                                    [](const app::ListedObject& object) { return object.hidden; });
  EXPECT_LE(hidden, 1);
  key("l");
  EXPECT_FALSE(state().settings.objects);
}

TEST_F(ViewWindow, FramesAreSavedAsCsvAndStepped) {
  key("ctrl+g");
  std::ifstream file(folder_ / "jalousie-frames-0001.csv");
  std::string head;
  ASSERT_TRUE(std::getline(file, head)) << state().message;
  EXPECT_TRUE(head.starts_with("seconds,frame_ms,objects,")) << head;
  std::size_t lines = 0;
  for (std::string line; std::getline(file, line); ++lines)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(head.begin(), head.end(), ','));
  EXPECT_EQ(lines, state().history.samples().size());
  key("Right");
  EXPECT_EQ(state().message, "The file has no camera path and no animation.");
  xdotool("key ctrl+r");
  xdotool("mousemove 300 200 mousedown 1");
  for (int i = 1; i <= 12; ++i)
    xdotool("mousemove " + std::to_string(300 + 6 * i) + " 200");
  xdotool("mouseup 1");
  xdotool("key ctrl+r");
  settle();
  const std::uint32_t frames = viewer_->document(0).pathFrames();
  ASSERT_GT(frames, 2U);
  const auto frame = [&] { return viewer_->document(0).camera.frame.value_or(-1.0F); };
  key("Left");
  EXPECT_EQ(frame(), 0.0F) << "no frame before the first";
  key("Right");
  EXPECT_EQ(frame(), 1.0F);
  EXPECT_FALSE(viewer_->document(0).camera.pose.has_value());
  expectHeadlessEqual("the second frame");
}

TEST_F(ViewWindow, InspectionAgreesWithTheKernel) {
  // Every object's block measured again by the plain twin gives the LV that the kernel wrote.
  app::ViewOptions options;
  options.files = {scene()};
  options.render.lv = LvMeasure::kChord;
  options.render.frameOptions.view = View::kHoles;
  options.render.frameOptions.lodRule = LodRule::kLvError;
  options.outputs = folder_.path();
  options.render.width = kWidth;
  options.render.height = kHeight;
  int measured = 0;
  for (std::uint32_t trial = 0; trial < 24; ++trial) {
    const std::uint32_t object = std::array{7U, 8U, 9U, 12U, 14U, 17U, 18U, 19U}[trial / 3];
    options.render.frameOptions.cullMode = std::array{CullMode::kHom, CullMode::kHomDepth, CullMode::kHiz}[trial % 3];
    options.select = object;
    options.finish();
    viewer_.reset();  // one interface at a time
    viewer_ = std::make_unique<app::Viewer>(*window_, options);
    settle();
    ASSERT_TRUE(state().inspection.has_value());
    const app::Inspection& i = *state().inspection;
    EXPECT_EQ(i.instance, object);
    if (i.readout.state.verdict != gpu::kVerdictPartial) continue;
    EXPECT_NEAR(i.block->lv[static_cast<std::size_t>(LvMeasure::kChord)], i.readout.state.lv, 1e-4F) << object;
    const glm::vec2 cover = glm::unpackHalf2x16(i.readout.box.cover);
    EXPECT_NEAR(cover.x, 1.0F - i.block->openShare, 1e-3F) << object;
    EXPECT_NEAR(cover.y, std::min(i.block->chordPixels, 32768.0F), 1e-3F * cover.y) << object;
    ++measured;
  }
  EXPECT_GT(measured, 2) << "some spheres are partly covered";
}

TEST_F(ViewWindow, OddSizesOddWindows) {
  for (const glm::ivec2 size : {glm::ivec2(333, 217), {97, 400}, {640, 33}, {1023, 511}, {2, 3}}) {
    glfwSetWindowSize(window_->handle(), size.x, size.y);
    for (int i = 0; i < 10; ++i)
      viewer_->step();
    settle();
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    window_->framebufferSize(width, height);
    EXPECT_EQ(width, static_cast<std::uint32_t>(size.x));
    EXPECT_EQ(height, static_cast<std::uint32_t>(size.y));
    std::vector<std::uint8_t> drawn = viewer_->captureWithInterface().pixels;
    for (std::size_t i = 3; i < drawn.size(); i += 4)
      drawn[i] = 255;  // the window's has no meaning
    const std::vector<std::uint8_t> seen = shown(width, height);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i)
      wrong += drawn[i] != seen[i] ? 1 : 0;
    EXPECT_EQ(wrong, 0U) << "what the window itself shows";
    expectHeadlessEqual("another size");
  }
  glfwIconifyWindow(window_->handle());
  for (int i = 0; i < 5; ++i)
    viewer_->step();
  glfwRestoreWindow(window_->handle());
  glfwHideWindow(window_->handle());
  viewer_->step();
  glfwShowWindow(window_->handle());
  settle();
  expectHeadlessEqual("after it was away");
}

TEST_F(ViewWindow, LosingTheFocusEndsADrag) {
  xdotool("mousemove 300 200 mousedown 1 mousemove 330 200");
  const app::WorldPose before = pose();
  GLFWwindowfocusfun focus = glfwSetWindowFocusCallback(window_->handle(), nullptr);
  glfwSetWindowFocusCallback(window_->handle(), focus);
  focus(window_->handle(), GLFW_FALSE);
  xdotool("mousemove 400 250");
  EXPECT_EQ(pose().eye, before.eye);
  xdotool("mouseup 1");
  focus(window_->handle(), GLFW_TRUE);
  drag(1, 300, 200, 340, 200);
  EXPECT_NE(pose().eye, before.eye);
}

TEST_F(ViewWindow, FrozenCullingCameraStaysWhereItIs) {
  drag(1, 300, 200, 320, 200);
  key("c");
  const app::WorldPose frozen = *viewer_->document(0).camera.freezePose;
  drag(1, 300, 200, 500, 260);
  EXPECT_EQ(viewer_->document(0).camera.freezePose->eye, frozen.eye);
  EXPECT_NE(pose().eye, frozen.eye);
  EXPECT_NE(viewer_->command(0).find("--freeze-eye"), std::string::npos);
  expectHeadlessEqual("behind the scene");
  while (shownView() != View::kGhosts)
    key("v");
  expectHeadlessEqual("ghosts behind the scene");
  key("c");
  EXPECT_FALSE(viewer_->document(0).camera.frozen());
}

TEST_F(ViewWindow, RecordsAPathAndPlaysIt) {
  xdotool("key ctrl+r");
  EXPECT_TRUE(state().recording);
  xdotool("mousemove 300 200 mousedown 1");
  for (int i = 1; i <= 12; ++i)
    xdotool("mousemove " + std::to_string(300 + 6 * i) + " 200");
  xdotool("mouseup 1");
  const app::WorldPose last = pose();
  xdotool("key ctrl+r");
  settle();
  const std::filesystem::path file = folder_ / "jalousie-path-0001.glb";
  ASSERT_TRUE(std::filesystem::exists(file)) << state().message;
  const asset::SceneFile path = asset::readSceneFile(file);
  ASSERT_EQ(path.cameras.size(), 1U);
  ASSERT_GT(viewer_->document(0).pathFrames(), 2U);
  const scene::Camera end =
      scene::cameraAtFrame(path.cameras[0], static_cast<float>(scene::frameCount(path.cameras[0]) - 1));
  EXPECT_LT(glm::distance(end.positionWorld(), glm::vec3(last.eye)), 1e-3F);
  xdotool("key space");
  EXPECT_TRUE(state().playing);
  for (int i = 0; i < 5; ++i)
    viewer_->step();
  xdotool("key space");
  EXPECT_FALSE(state().playing);
  settle();
  ASSERT_TRUE(viewer_->document(0).camera.frame.has_value());
  expectHeadlessEqual("on the path");
}

TEST_F(ViewWindow, SplitScreenIsTwoHeadlessPictures) {
  key("b");
  key("v");
  ASSERT_NE(shownView(), state().configurations[1].active.frameOptions.view);
  drag(1, 320, 100, 200, 100);
  EXPECT_NEAR(state().divider, 200.0F / kWidth, 0.01F) << "the divider follows the pointer";
  std::array<ImageRgba8, 2> sides;
  for (int side = 0; side < 2; ++side) {
    const std::filesystem::path file = folder_ / ("side" + std::to_string(side) + ".png");
    ASSERT_EQ(test::runCommand(viewer_->command(side, file.string())).exitCode, 0);
    sides[static_cast<std::size_t>(side)] = asset::loadImage(file);
  }
  const ImageRgba8 both = viewer_->capture();
  const auto divider = static_cast<std::uint32_t>(std::lround(state().divider * kWidth));
  std::size_t wrong = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      wrong += both.pixels[both.offset(x, y)] != sides[x < divider ? 0 : 1].pixels[both.offset(x, y)] ? 1 : 0;
  EXPECT_EQ(wrong, 0U);
  settle();
  key("x");
  std::set<int> shown;
  for (int i = 0; i < 200 && shown.size() < 2; ++i) {
    viewer_->step();
    shown.insert(state().flickerSide);
  }
  EXPECT_EQ(shown.size(), 2U) << "both configurations come up in turn";
}

TEST_F(ViewWindow, ScreenshotKeysWriteFiles) {
  key("F12");
  key("shift+F12");
  const ImageRgba8 plain = asset::loadImage(folder_ / "jalousie-0001.png");
  const ImageRgba8 with = asset::loadImage(folder_ / "jalousie-0002.png");
  EXPECT_EQ(plain.pixels, viewer_->capture().pixels);
  EXPECT_EQ(with.width, kWidth);
}

TEST_F(ViewWindow, CopiesTheCommandLine) {
  drag(1, 300, 200, 310, 205);
  key("ctrl+c");
  const char* clipboard = glfwGetClipboardString(window_->handle());
  ASSERT_NE(clipboard, nullptr);
  EXPECT_EQ(std::string(clipboard), viewer_->command(0));
}

}  // namespace
}  // namespace jalousie
