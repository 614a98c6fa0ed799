// The viewer with files that are opened, closed, changed and broken; with changed shaders; settings; and scripts.
#include <fstream>
#include <nlohmann/json.hpp>

#include "asset/gltf_file.h"
#include "view_fixture.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

class ViewFiles : public test::ViewTest {
 protected:
  /// Steps until a condition holds, at most 8 s. @return whether it holds
  template <class Condition>
  bool waitFor(Condition condition) {
    const double start = glfwGetTime();
    while (!condition() && glfwGetTime() - start < 8.0)
      viewer_->step();
    return condition();
  }
  /// Copies the shaders of the source tree, so that a test can change them.
  fs::path copyShaders() {
    fs::copy(fs::path(JALOUSIE_SOURCE_DIR) / "shaders", folder_ / "shaders", fs::copy_options::recursive);
    return folder_ / "shaders";
  }
  static void replaceText(const fs::path& file, const std::string& from, const std::string& to) {
    std::ifstream in(file);
    std::string text(std::istreambuf_iterator<char>(in), {});
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    std::ofstream(file) << text;
  }
};

TEST_F(ViewFiles, MissingAndBrokenFilesAreMessagesAndTheProgramLivesOn) {
  std::ofstream(folder_ / "broken.glb") << "words";
  app::ViewOptions options;
  options.files = {folder_ / "no.glb", folder_ / "broken.glb", scene()};
  if (!open(options)) GTEST_SKIP() << "no display";
  EXPECT_NE(viewer_->document(0).error().find("no.glb"), std::string::npos);
  EXPECT_NE(viewer_->document(1).error().find("broken.glb"), std::string::npos);
  EXPECT_EQ(viewer_->document(2).error(), "");
  drag(1, 550, 200, 600, 210);
  EXPECT_TRUE(viewer_->document(2).camera.pose.has_value());
  EXPECT_EQ(state().current, 2U);
  expectHeadlessEqual("beside broken ones");
}

TEST_F(ViewFiles, DroppedFilesOpenBesideEachOther) {
  app::ViewOptions options;
  if (!open(options)) GTEST_SKIP() << "no display";
  EXPECT_EQ(viewer_->documentCount(), 0U);
  GLFWdropfun drop = glfwSetDropCallback(window_->handle(), nullptr);
  glfwSetDropCallback(window_->handle(), drop);
  const std::string file = scene().string();
  const char* paths[] = {file.c_str()};
  drop(window_->handle(), 1, paths);
  settle();
  ASSERT_EQ(viewer_->documentCount(), 1U);
  expectHeadlessEqual("dropped");
  const std::string folder = folder_.path().string();
  const char* folders[] = {folder.c_str()};
  drop(window_->handle(), 1, folders);
  settle();
  EXPECT_EQ(viewer_->documentCount(), 2U) << "a folder stands for its files";
  EXPECT_EQ(viewer_->region(1).x, 320.0F);
}

TEST_F(ViewFiles, WatchedFilesAreReadAgain) {
  app::ViewOptions options;
  options.files = {scene()};
  options.watch = true;
  if (!open(options)) GTEST_SKIP() << "no display";
  const auto objects = [&] { return viewer_->document(0).side(0)->scene().objects.size(); };
  EXPECT_EQ(objects(), 27U);
  test::writeSpheres(scene(), 3);
  EXPECT_TRUE(waitFor([&] { return viewer_->document(0).side(0) != nullptr && objects() == 11; }));
  std::ofstream(scene()) << "half a file";
  EXPECT_TRUE(waitFor([&] { return !viewer_->document(0).error().empty(); }));
  EXPECT_EQ(objects(), 11U) << "the last good scene stays";
  fs::remove(scene());
  for (int i = 0; i < 20; ++i)
    viewer_->step();
  EXPECT_EQ(objects(), 11U);
  test::writeSpheres(scene(), 4);
  EXPECT_TRUE(waitFor([&] { return viewer_->document(0).error().empty() && viewer_->document(0).side(0) != nullptr; }));
  EXPECT_TRUE(waitFor([&] { return objects() == 18; }));
  settle();
  expectHeadlessEqual("read again");
}

TEST_F(ViewFiles, WhatAFileNamesIsWatchedToo) {
  tinygltf::Model model = asset::loadGltf(scene());
  tinygltf::TinyGLTF writer;
  const fs::path text = folder_ / "scene.gltf";
  model.buffers[0].uri = "scene.bin";
  ASSERT_TRUE(writer.WriteGltfSceneToFile(&model, text.string(), false, false, true, false));
  ASSERT_TRUE(fs::exists(folder_ / "scene.bin"));
  app::ViewOptions options;
  options.files = {text};
  options.watch = true;
  if (!open(options)) GTEST_SKIP() << "no display";
  ASSERT_EQ(viewer_->document(0).error(), "");
  const auto bytes = fs::file_size(folder_ / "scene.bin");
  fs::resize_file(folder_ / "scene.bin", bytes / 2);
  EXPECT_TRUE(waitFor([&] { return !viewer_->document(0).error().empty(); }));
  EXPECT_NE(viewer_->document(0).side(0), nullptr) << "the last good scene stays";
  model = asset::loadGltf(scene());
  model.buffers[0].uri = "scene.bin";
  ASSERT_TRUE(writer.WriteGltfSceneToFile(&model, text.string(), false, false, true, false));
  EXPECT_TRUE(waitFor([&] { return viewer_->document(0).error().empty(); }));
  settle();
  expectHeadlessEqual("from two files");
}

TEST_F(ViewFiles, ABrokenShaderAtTheStartIsMendedLater) {
  const fs::path shaders = copyShaders();
  replaceText(shaders / "lib/shading.glsl", "return vec3(1.0) - exp(", "return vec3(1.0) - nonsense(");
  app::ViewOptions options;
  options.files = {scene()};
  options.shaders = shaders;
  if (!open(options)) GTEST_SKIP() << "no display";
  EXPECT_NE(viewer_->document(0).error().find("shading.glsl"), std::string::npos) << viewer_->document(0).error();
  EXPECT_EQ(viewer_->document(0).side(0), nullptr);
  log_.emplace();  // the compiler's own complaint
  replaceText(shaders / "lib/shading.glsl", "return vec3(1.0) - nonsense(", "return vec3(1.0) - exp(");
  EXPECT_TRUE(waitFor([&] { return viewer_->document(0).side(0) != nullptr; }));
  EXPECT_EQ(viewer_->document(0).error(), "");
  settle();
  expectHeadlessEqual("mended");
}

TEST_F(ViewFiles, AGhostShaderThatBreaksIsAMessageToo) {
  const fs::path shaders = copyShaders();
  app::ViewOptions options;
  options.files = {scene()};
  options.render.frameOptions.view = View::kGhosts;
  options.shaders = shaders;
  if (!open(options)) GTEST_SKIP() << "no display";
  replaceText(shaders / "visibility/mark_ghosts.comp", "uint mark = marks[id];", "uint mark = nonsense;");
  EXPECT_TRUE(waitFor([&] { return !state().shaderError.empty(); }));
  EXPECT_NE(state().shaderError.find("mark_ghosts"), std::string::npos) << state().shaderError;
  drag(1, 300, 200, 330, 210);
  log_.emplace();  // the compiler's own complaint
}

TEST_F(ViewFiles, ALayoutThatIsNoLayoutIsNotBelieved) {
  fs::create_directories(folder_ / "config/jalousie");
  for (const char* layout : {R"([Table][0x00000001,-100]\nRefScale=13\nColumn 0 Width=5\n)",
                             R"([Table][0x00000001,2000000000]\nColumn 0 Width=5\n)", R"([Window][jalousie]\nPos=x)"}) {
    std::ofstream(folder_ / "config/jalousie/view.json") << "{\"layout\": \"" << layout << "\", \"width\": -5}";
    viewer_.reset();
    log_.reset();
    window_.reset();
    if (!openScene()) GTEST_SKIP() << "no display";
    EXPECT_TRUE(viewer_->idle());
  }
}

TEST_F(ViewFiles, ARecordingStaysWithItsFile) {
  test::writeSpheres(folder_ / "wide.glb", 25);
  app::ViewOptions options;
  options.files = {scene(), folder_ / "wide.glb"};
  if (!open(options)) GTEST_SKIP() << "no display";
  drag(1, 100, 200, 110, 200);
  xdotool("key ctrl+r");
  xdotool("mousemove 500 200 click 1");
  EXPECT_EQ(state().current, 1U);
  xdotool("key ctrl+r");
  settle();
  EXPECT_FALSE(viewer_->document(0).camera.path.empty()) << state().message;
  EXPECT_TRUE(viewer_->document(1).camera.path.empty());
}

TEST_F(ViewFiles, ClosingAndOpeningAgain) {
  test::writeSpheres(folder_ / "other.glb", 2);
  app::ViewOptions options;
  options.files = {scene(), folder_ / "other.glb"};
  if (!open(options)) GTEST_SKIP() << "no display";
  ASSERT_EQ(viewer_->documentCount(), 2U);
  xdotool("mousemove 160 205 click 1");
  settle();
  EXPECT_TRUE(state().selection.has_value());
  key("ctrl+w");
  ASSERT_EQ(viewer_->documentCount(), 1U);
  EXPECT_EQ(viewer_->document(0).file(), folder_ / "other.glb");
  EXPECT_FALSE(state().selection.has_value());
  expectHeadlessEqual("alone");
  key("ctrl+w");
  EXPECT_EQ(viewer_->documentCount(), 0U);
  for (const char* keys : {"ctrl+w", "f", "r", "c", "space", "ctrl+r", "v", "m", "b", "F12", "ctrl+c", "1", "ctrl+1"})
    key(keys);
  EXPECT_FALSE(state().recording) << "there is no camera to record";
}

TEST_F(ViewFiles, LikeScenesShareACameraUnlikeOnesDoNot) {
  test::writeSpheres(folder_ / "same.glb");
  test::writeSpheres(folder_ / "wide.glb", 25);
  app::ViewOptions options;
  options.files = {scene(), folder_ / "same.glb", folder_ / "wide.glb"};
  if (!open(options)) GTEST_SKIP() << "no display";
  const auto moved = [&](std::size_t index) { return viewer_->document(index).camera.pose.has_value(); };
  drag(1, 100, 200, 140, 210);
  EXPECT_TRUE(moved(0));
  EXPECT_TRUE(moved(1));
  EXPECT_FALSE(moved(2));
  EXPECT_EQ(state().history.samples().back().statistics.objects, 27U);
  drag(1, 500, 200, 540, 210);
  EXPECT_TRUE(moved(2));
  EXPECT_EQ(state().history.samples().front().statistics.objects, 627U) << "the graph is the current file's alone";
}

TEST_F(ViewFiles, NothingIsLostWhenTheWindowCloses) {
  if (!openScene()) GTEST_SKIP() << "no display";
  key("ctrl+4");
  EXPECT_TRUE(fs::exists(folder_ / "config/jalousie/view.json")) << "bookmarks are kept at once";
  xdotool("key ctrl+r");
  xdotool("mousemove 300 200");
  xdotool("mousedown 1");
  xdotool("mousemove 330 200");
  xdotool("mouseup 1");
  glfwSetWindowSize(window_->handle(), 500, 300);
  for (int i = 0; i < 10; ++i)
    viewer_->step();
  viewer_->finish();
  EXPECT_TRUE(fs::exists(folder_ / "jalousie-path-0001.glb")) << "a recording that runs is saved";
  const app::ViewSettings settings = app::loadSettings(app::settingsFolder());
  EXPECT_EQ(settings.width, 500U);
  EXPECT_EQ(settings.height, 300U);
  EXPECT_TRUE(settings.bookmarks.at(fs::absolute(scene()).string())[3].has_value());
}

TEST_F(ViewFiles, WhatCannotBeWrittenIsSaid) {
  app::ViewOptions options;
  options.files = {scene()};
  if (!open(options)) GTEST_SKIP() << "no display";
  fs::remove_all(folder_ / "config");
  std::ofstream(folder_ / "config") << "a file where the folder was";
  key("ctrl+2");
  EXPECT_NE(state().message.find("config"), std::string::npos) << state().message;
  key("F1");
  EXPECT_TRUE(state().help) << "and the window lives on";
}

TEST_F(ViewFiles, PanelTakesThePointerAndChangesThePicture) {
  app::ViewOptions options;
  options.files = {scene()};
  if (!open(options, /*interface=*/true)) GTEST_SKIP() << "no display";
  ASSERT_TRUE(state().settings.panel);
  drag(1, 100, 300, 200, 330);
  EXPECT_FALSE(viewer_->document(0).camera.pose.has_value()) << "a drag over the panel turns nothing";
  // The check box of the rectangles is the first below the view and the map's level.
  for (int y = 145; y < 190 && !state().configurations[0].active.frameOptions.boxes; y += 5) {
    xdotool("mousemove 26 " + std::to_string(y));
    xdotool("mousedown 1");
    xdotool("mouseup 1");
  }
  EXPECT_TRUE(state().configurations[0].active.frameOptions.boxes);
  settle();
  expectHeadlessEqual("with rectangles");
}

TEST_F(ViewFiles, ShadersAreBuiltAgainAndErrorsLeaveTheLastGoodOnes) {
  const fs::path shaders = copyShaders();
  app::ViewOptions options;
  options.files = {scene()};
  options.shaders = shaders;
  if (!open(options)) GTEST_SKIP() << "no display";
  const std::vector<std::uint8_t> before = viewer_->capture().pixels;
  settle();
  replaceText(shaders / "lib/shading.glsl", "return vec3(1.0) - exp(", "return vec3(1.0) - nonsense(");
  EXPECT_TRUE(waitFor([&] { return !state().shaderError.empty(); }));
  EXPECT_NE(state().shaderError.find("shading.glsl"), std::string::npos) << state().shaderError;
  EXPECT_EQ(viewer_->capture().pixels, before) << "the last good program goes on";
  settle();
  log_.emplace();  // the compiler's own complaint about the shader that this test broke
  replaceText(shaders / "visibility/reduce_depth.comp", "void main() {", "void main() { nonsense;");
  replaceText(shaders / "visibility/reduce_map.comp", "void main() {", "void main() { nonsense;");
  glfwSetWindowSize(window_->handle(), 500, 300);
  for (int i = 0; i < 10; ++i)
    viewer_->step();
  EXPECT_NE(viewer_->document(0).side(0), nullptr) << "another size needs no new program";
  glfwSetWindowSize(window_->handle(), kWidth, kHeight);
  for (int i = 0; i < 10; ++i)
    viewer_->step();
  EXPECT_EQ(viewer_->capture().pixels, before);
  settle();
  log_.emplace();
  replaceText(shaders / "visibility/reduce_depth.comp", "void main() { nonsense;", "void main() {");
  replaceText(shaders / "visibility/reduce_map.comp", "void main() { nonsense;", "void main() {");
  replaceText(shaders / "lib/shading.glsl", "return vec3(1.0) - nonsense(", "return vec3(0.5) - 0.5 * exp(");
  EXPECT_TRUE(waitFor([&] { return state().shaderError.empty(); }));
  settle();
  EXPECT_NE(viewer_->capture().pixels, before) << "the new program draws";
}

TEST_F(ViewFiles, ImportanceMaskAndItsFailure) {
  asset::savePng({2, 1, {0, 0, 0, 255, 255, 255, 255, 255}}, folder_ / "mask.png");
  app::ViewOptions options;
  options.files = {scene()};
  options.render.importance = folder_ / "mask.png";
  options.render.given.insert("--importance");
  if (!open(options)) GTEST_SKIP() << "no display";
  EXPECT_EQ(viewer_->document(0).error(), "");
  expectHeadlessEqual("with a mask");
}

TEST_F(ViewFiles, AMaskThatIsMissingIsAMessageUntilAnotherOneIsThere) {
  app::ViewOptions options;
  options.files = {scene()};
  options.watch = true;
  options.render.importance = folder_ / "late.png";
  options.render.given.insert("--importance");
  if (!open(options)) GTEST_SKIP() << "no display";
  EXPECT_NE(viewer_->document(0).error().find("late.png"), std::string::npos);
  asset::savePng({2, 1, {0, 0, 0, 255, 255, 255, 255, 255}}, folder_ / "late.png");
  test::writeSpheres(scene(), 4);  // what is read again is tried again
  EXPECT_TRUE(waitFor([&] { return viewer_->document(0).error().empty() && viewer_->document(0).side(0) != nullptr; }));
  settle();
  expectHeadlessEqual("with a late mask");
}

TEST_F(ViewFiles, SettingsGoToTheConfigFolderAlone) {
  if (!openScene()) GTEST_SKIP() << "no display";
  drag(1, 300, 200, 330, 200);
  const app::WorldPose marked = pose();
  key("ctrl+3");
  viewer_->finish();
  EXPECT_TRUE(fs::exists(folder_ / "config/jalousie/view.json"));
  std::size_t beside = 0;
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    beside += entry.path().filename() != "config" && entry.path() != scene() ? 1 : 0;
  EXPECT_EQ(beside, 0U) << "nothing is written beside the file";
  viewer_.reset();
  log_.reset();
  window_.reset();
  ASSERT_TRUE(openScene());
  key("3");
  EXPECT_EQ(pose().eye, marked.eye) << "the bookmark is there again";
}

TEST_F(ViewFiles, ProgramWritesScreenshotsAndFiguresForScripts) {
  const auto jalousie = [](std::vector<std::string> arguments) {
    return test::runProgram(JALOUSIE_PROGRAM, arguments);
  };
  const std::string shot = (folder_ / "shot.png").string();
  const test::ProgramResult view =
      jalousie({"view", scene().string(), "--eye", "1,2,9", "--look", "0,0,0", "--view", "lod", "--size", "300x200",
                "--screenshot", shot, "--frames", "4", "--json", (folder_ / "stats.json").string(), "--debug"});
  if (view.exitCode == 9) GTEST_SKIP() << view.standardError;
  ASSERT_EQ(view.exitCode, 0) << view.standardError;
  const std::string frame = (folder_ / "frame.png").string();
  ASSERT_EQ(jalousie({"render", scene().string(), "--eye", "1,2,9", "--look", "0,0,0", "--view", "lod", "--size",
                      "300x200", "-o", frame})
                .exitCode,
            0);
  EXPECT_TRUE(asset::loadImage(shot).pixels == asset::loadImage(frame).pixels);
  const nlohmann::json stats = nlohmann::json::parse(std::ifstream(folder_ / "stats.json"));
  ASSERT_FALSE(stats["frames"].empty());
  EXPECT_EQ(stats["frames"][0]["objects"], 27);
  EXPECT_EQ(stats["ignored"], nlohmann::json::object()) << "everything is drawn";
  EXPECT_TRUE(stats["frames"][0]["passes"].contains("classify"));
  EXPECT_FALSE(fs::exists(folder_ / "config")) << "a script leaves no settings";
  const std::string file = scene().string();
  for (const std::vector<std::string>& unfulfilled : {std::vector<std::string>{"view", file, "--play"},
                                                      {"view", file, "--select", "9999"},
                                                      {"view", file, "--frame", "7"},
                                                      {"view", file, "--eye", "1,1,1", "--look", "1,1,1"}}) {
    std::vector<std::string> arguments = unfulfilled;
    arguments.insert(arguments.end(), {"--screenshot", (folder_ / "none.png").string(), "--frames", "2"});
    const test::ProgramResult result = jalousie(arguments);
    EXPECT_EQ(result.exitCode, 2) << unfulfilled[2] << ": " << result.standardError;
    EXPECT_FALSE(fs::exists(folder_ / "none.png")) << unfulfilled[2];
  }
  const test::ProgramResult missing = jalousie({"view", (folder_ / "no.glb").string(), "--screenshot", shot});
  EXPECT_NE(missing.exitCode, 0);
  EXPECT_NE(missing.standardError.find("no.glb"), std::string::npos);
}

TEST_F(ViewFiles, InterfaceDrawsAtEveryScale) {
  for (const char* scale : {"1", "2", "3.5"}) {
    const std::string shot = (folder_ / "scaled.png").string();
    const test::ProgramResult result = test::runProgram(
        JALOUSIE_PROGRAM, {"view", scene().string(), "--size", "700x500", "--scale", scale, "--interface",
                           "--screenshot", shot, "--frames", "10", "--select", "0", "--debug"});
    if (result.exitCode == 9) GTEST_SKIP() << result.standardError;
    ASSERT_EQ(result.exitCode, 0) << result.standardError;
    EXPECT_EQ(asset::loadImage(shot).width, 700U);
  }
}

TEST(ViewProgram, WithoutADisplayOneLineNamesTheHeadlessCommand) {
  const test::ProgramResult result = test::runProgram(
      "/usr/bin/env", {"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", JALOUSIE_PROGRAM, "view", "scene.glb"});
  EXPECT_EQ(result.exitCode, 9);
  EXPECT_EQ(std::count(result.standardError.begin(), result.standardError.end(), '\n'), 1);
  EXPECT_NE(result.standardError.find("jalousie render"), std::string::npos) << result.standardError;
}

}  // namespace
}  // namespace jalousie
