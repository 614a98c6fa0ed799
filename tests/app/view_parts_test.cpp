// Parts of the viewer that need no window: poses, the option table, settings, file watching, names of outputs, keys.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "app/option_values.h"
#include "app/render_command_line.h"
#include "app/render_option_table.h"
#include "app/shown_objects.h"
#include "app/view/actions.h"
#include "app/view/command_text.h"
#include "app/view/file_watch.h"
#include "app/view/frame_history.h"
#include "app/view/output_files.h"
#include "app/view/pose.h"
#include "app/view/region.h"
#include "app/view/settings.h"
#include "app/view/view_options.h"
#include "core/error.h"
#include "support/error_code.h"
#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie::app {
namespace {

constexpr float kClose = 1e-4F;

void expectClose(const glm::vec3& a, const glm::vec3& b) {
  EXPECT_LT(glm::length(a - b), kClose) << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " "
                                        << b.z;
}

TEST(Pose, OrbitKeepsTheDistanceAndComesBack) {
  const Pose start{{3, 2, 5}, {1, 0, -1}};
  const float distance = glm::length(start.eye - start.look);
  const Pose turned = orbited(start, 0.7F, 0.2F);
  EXPECT_NEAR(glm::length(turned.eye - turned.look), distance, kClose);
  EXPECT_EQ(turned.look, start.look);
  expectClose(orbited(turned, -0.7F, -0.2F).eye, start.eye);
}

TEST(Pose, NoTurnGoesOverThePoles) {
  const Pose start{{0, 1, 5}, {0, 0, 0}};
  const Pose top = orbited(start, 0.0F, 10.0F);
  EXPECT_GT(top.eye.y, 5.0F);
  EXPECT_GT(glm::length(glm::vec2(top.eye.x, top.eye.z)), 0.01F) << "there is still a side to look from";
  expectClose(orbited(top, 6.2831853F, 0.0F).eye, top.eye);
  EXPECT_LT(turned(start, 0.0F, -10.0F).look.y, 0.0F);
}

TEST(Pose, MovingKeepsTheDirection) {
  const Pose start{{3, 2, 5}, {1, 0, -1}};
  for (const glm::vec3 step : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
    expectClose(moved(start, step).look - moved(start, step).eye, start.look - start.eye);
  EXPECT_NEAR(glm::length(moved(start, {0, 0, 2}).eye - start.eye), 2.0F, kClose);
  EXPECT_LT(glm::length(zoomed(start, 1.0F).eye - start.look), glm::length(start.eye - start.look));
  expectClose(zoomed(zoomed(start, 2.0F), -2.0F).eye, start.eye);
}

TEST(Pose, NoZoomLosesTheDirection) {
  for (const glm::vec3 look : {glm::vec3(0.0F), glm::vec3(1.0F, 0, -1.0F), glm::vec3(1e5F, 3, 1e5F)}) {
    for (const float step : {1.0F, -1.0F, 40.0F, -40.0F}) {
      Pose pose{look + glm::vec3(2, 1, 4), look};
      for (int i = 0; i < 2000; ++i) {
        pose = zoomed(pose, step);
        ASSERT_TRUE(isUsable(pose)) << "zoom " << i << " by " << step;
      }
      EXPECT_TRUE(isUsable(zoomed(pose, -step)));
      EXPECT_TRUE(isUsable(orbited(pose, 0.1F, 0.1F)));
    }
  }
}

TEST(Pose, FlyingAwayFromANearTargetKeepsTheDirection) {
  Pose pose{{0, 0, 1e-6F}, {0, 0, 0}};
  for (int i = 0; i < 200; ++i) {
    pose = moved(pose, {3.0F, 1.0F, 5.0F});
    ASSERT_TRUE(isUsable(pose)) << i;
    pose = panned(pose, 10.0F, 4.0F, 500.0F);
    ASSERT_TRUE(isUsable(pose)) << i;
  }
  const Aabb speck{glm::vec3(3e5F), glm::vec3(3e5F)};
  EXPECT_TRUE(isUsable(framed({{0, 0, 1}, {0, 0, 0}}, speck, 0.8F, 1.0F)));
}

TEST(Pose, PosesThatNoCameraCanHaveAreKnown) {
  EXPECT_TRUE(isUsable(Pose{{0, 0, 1}, {0, 0, 0}}));
  EXPECT_FALSE(isUsable(Pose{{1, 2, 3}, {1, 2, 3}}));
  EXPECT_FALSE(isUsable(Pose{{NAN, 0, 1}, {0, 0, 0}}));
  EXPECT_FALSE(isUsable(Pose{{0, 0, 1}, {0, INFINITY, 0}}));
  EXPECT_FALSE(isUsable(Pose{{3e38F, 0, 1}, {-3e38F, 0, 0}}));
}

TEST(Pose, FramedBoxIsInView) {
  const Aabb box{glm::vec3(4, 5, 6), glm::vec3(7, 6, 9)};
  const Pose pose = framed({{0, 0, 9}, {0, 0, 0}}, box, 0.8F, 0.5F);
  const scene::Camera camera = scene::lookAt(pose.eye, pose.look, box);
  const glm::mat4 clip = scene::clipFromWorld(camera, 0.5F);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec4 p =
        clip * glm::vec4((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                         (corner & 4) != 0 ? box.max.z : box.min.z, 1.0F);
    EXPECT_LE(std::abs(p.x), p.w);
    EXPECT_LE(std::abs(p.y), p.w);
  }
}

TEST(Pose, PoseOfACameraGivesTheCamera) {
  const Aabb scene{glm::vec3(-2), glm::vec3(2)};
  const scene::Camera camera = scene::lookAt({3, 2, 5}, {1, 0, -1}, scene);
  const Pose pose = poseOf(camera, targetDistance(camera, scene));
  const scene::Camera again = scene::lookAt(pose.eye, pose.look, scene);
  for (glm::length_t column = 0; column < 4; ++column)
    expectClose(glm::vec3(again.worldFromCamera[column]), glm::vec3(camera.worldFromCamera[column]));
}

TEST(Pose, PoseOfAnOrthographicCameraShowsAsMuchAtItsTarget) {
  const Aabb scene{glm::vec3(-2), glm::vec3(2)};
  scene::Camera camera = scene::lookAt({0, 0, 50}, {0, 0, 0}, scene);
  camera.halfSize = glm::vec2(3, 3);
  const Pose pose = poseOf(camera, targetDistance(camera, scene));
  const scene::Camera perspective = scene::lookAt(pose.eye, pose.look, scene);
  const glm::vec4 corner = scene::clipFromWorld(perspective, 1.0F) * glm::vec4(3, 3, 0, 1);
  expectClose(glm::vec3(corner / corner.w), glm::vec3(1, 1, corner.z / corner.w));
}

TEST(Pose, PosesFarFromTheOriginComeBack) {
  const glm::dvec3 origin(6e6, -3e6, 40);
  const Pose pose{{0.1F, 0.2F, 0.3F}, {1, 2, 3}};
  const WorldPose world = inWorld(pose, origin);
  EXPECT_EQ(relativeTo(origin, world).look, pose.look);
  expectClose(relativeTo(origin, world).eye, pose.eye);
  RenderOptions options;
  options.eye = world.eye;
  options.look = world.look;
  const std::string text = renderCommand(options, "x.png");
  const std::size_t at = text.find("--eye=") + 6;
  EXPECT_EQ(parsePoint(text.substr(at, text.find(' ', at) - at)), world.eye) << text;
}

RenderOptions parsed(const std::string& text) {
  RenderOptions options;
  CLI::App parser;
  addMethodOptions(parser, options);
  addPictureOptions(parser, options);
  parser.parse(text);
  return options;
}

TEST(RenderOptionTable, EveryRowHasWordsForPeople) {
  for (const RenderOption& option : renderOptionTable()) {
    EXPECT_TRUE(std::string(option.name).starts_with("--"));
    EXPECT_GT(std::string(option.label).size(), 2U) << option.name;
    EXPECT_GT(std::string(option.help).size(), 20U) << option.name;
    const bool number = std::holds_alternative<NumberValue>(option.value) ||
                        std::holds_alternative<MaybeNumberValue>(option.value) ||
                        std::holds_alternative<CountValue>(option.value);
    EXPECT_EQ(*option.unit != '\0', number || std::holds_alternative<MaybeCountValue>(option.value)) << option.name;
    EXPECT_EQ(!option.needs.empty(), option.applies != nullptr) << option.name;
  }
}

TEST(RenderOptionTable, PanelHasEveryOptionOfRender) {
  RenderOptions options;
  CLI::App parser;
  addRenderOptions(parser, options);
  // Widgets of their own: the camera, the time, the window's size, what is written. The last four mean nothing in a
  // window, and the limit on memory is for the whole process.
  const std::set<std::string> others = {"scene",        "--help",         "--path",       "--frame",       "--eye",
                                        "--look",       "--freeze-frame", "--freeze-eye", "--freeze-look", "--size",
                                        "--output",     "--json",         "--repeat",     "--stats-only",  "--quiet",
                                        "--max-memory", "--camera",       "--time",       "--force"};
  std::size_t rows = 0;
  for (const CLI::Option* option : parser.get_options()) {
    const std::string name = option->get_positional() ? option->get_name(true) : option->get_name();
    if (others.contains(name)) continue;
    const auto table = renderOptionTable();
    EXPECT_TRUE(std::any_of(table.begin(), table.end(), [&](const RenderOption& row) { return name == row.name; }))
        << name << " is neither in the table nor known to have a widget of its own";
    ++rows;
  }
  EXPECT_EQ(rows, renderOptionTable().size());
}

TEST(RenderOptionTable, TextOfOptionsReadsBackAsTheSame) {
  for (const char* text :
       {"", "--tau 0.3333333 --relax 7", "--mode hom --lod linear --lv coverage --cull-threshold 0.95",
        "--mode hom-depth --occluder-distance 3.25 --occluder-tau 0.1 --view occlusion --map-level 3",
        "--detail tessellation --max-tessellation 7 --calm --boxes --draws per-object --core",
        "--calm --hysteresis 1.5 --fade 3", "--masking --lod pixel-error",
        "--capacity 12 --min-pixels 4 --importance 'a mask.png' --settle 5 --view holes",
        "--mode chc++ --multiquery objects --tight-bounds 2 --requery 3 --query-batch 10 --query-threshold 4",
        "--mode eye-siding --query-units single --plane-depth 5 --importance mask.png --query-importance 0.5",
        "--hide 'a door,3-7' --only 5 --view levels"}) {
    const RenderOptions options = parsed(text);
    const std::string written = methodOptions(options);
    EXPECT_EQ(methodOptions(parsed(written)), written) << text;
    for (const RenderOption& option : renderOptionTable())
      EXPECT_EQ(valueText(option, parsed(written)), valueText(option, options)) << text << ": " << option.name;
  }
}

TEST(RenderOptionTable, WhatDoesNotApplyIsDropped) {
  RenderOptions options = parsed("--mode hom --cull-threshold 0.9 --lod linear --view occlusion --map-level 2");
  options.frameOptions.cullMode = CullMode::kFrustum;
  options.frameOptions.lodRule = LodRule::kFinest;
  options.frameOptions.view = View::kShaded;
  options.lv = LvMeasure::kThesis;
  dropInapplicable(options);
  EXPECT_EQ(methodOptions(options), "--mode frustum --lod finest");
  EXPECT_NO_THROW(options.finishFrame());
}

TEST(RenderOptionTable, ContradictionsAreRefused) {
  for (const char* text : {"--tau 1 --lod finest", "--map-level 1", "--view phase --mode full",
                           "--view holes --mode full", "--settle 2 --mode frustum --lod pixel-error"}) {
    RenderOptions options = parsed(text);
    EXPECT_THROW(options.finishFrame(), Error) << text;
  }
}

TEST(Settings, ComeBackAndSurviveNonsense) {
  const test::TemporaryFolder folder;
  ViewSettings settings;
  settings.speed = 2.5F;
  settings.layout = "[Window]\n\"quoted\"";
  settings.bookmarks["/a b/c.glb"][4] = WorldPose{{0.1F, 0.2F, 0.3F}, {1, 2, 3}};
  saveSettings(settings, folder / "deep/er");
  const ViewSettings read = loadSettings(folder / "deep/er");
  EXPECT_EQ(read.speed, 2.5F);
  EXPECT_EQ(read.layout, settings.layout);
  ASSERT_TRUE(read.bookmarks.at("/a b/c.glb")[4].has_value());
  EXPECT_EQ(read.bookmarks.at("/a b/c.glb")[4]->eye, glm::dvec3(0.1F, 0.2F, 0.3F));
  std::ofstream(folder / "deep/er/view.json") << "{\"speed\": \"fast\", \"bookmarks\": 3";
  EXPECT_EQ(loadSettings(folder / "deep/er").speed, 1.0F);
  EXPECT_EQ(loadSettings(folder / "nowhere").speed, 1.0F);
  std::ofstream(folder / "deep/er/view.json")
      << R"({"speed": 1e30, "width": 0, "height": 4000000000, "bookmarks": {"/a.glb": {"0": [1,1,1,1,1,1], "1": [0,0,1,0,0,0], "77": [0,0,1,0,0,0]}}})";
  // One broken entry costs itself alone.
  const ViewSettings wild = loadSettings(folder / "deep/er");
  EXPECT_EQ(wild.speed, kMostSpeed);
  EXPECT_EQ(wild.width, 1280U);
  EXPECT_EQ(wild.height, 720U);
  EXPECT_FALSE(wild.bookmarks.at("/a.glb")[0].has_value()) << "an eye in its own target is no place";
  EXPECT_TRUE(wild.bookmarks.at("/a.glb")[1].has_value());
  std::ofstream(folder / "deep/er/view.json")
      << R"({"speed": "fast", "graph": true, "bookmarks": {"/a": {"x": 1, "2": null, "3": [1,2], "4": [0,0,1,0,0,0]}, "/b": 7}})";
  const ViewSettings mended = loadSettings(folder / "deep/er");
  EXPECT_EQ(mended.speed, 1.0F);
  EXPECT_TRUE(mended.graph);
  EXPECT_TRUE(mended.bookmarks.at("/a")[4].has_value());
  ViewSettings odd;
  odd.bookmarks["/caf\xe9.glb"][0] = WorldPose{{0, 0, 1}, {0, 0, 0}};
  EXPECT_NO_THROW(saveSettings(odd, folder / "deep/er")) << "a file name need not be UTF-8";
}

TEST(Settings, BookmarksOfAnotherViewerAreAddedNotReplaced) {
  const WorldPose ours{{0, 0, 1}, {0, 0, 0}};
  const WorldPose theirs{{0, 0, 2}, {0, 0, 0}};
  ViewSettings settings;
  settings.bookmarks["/a.glb"][0] = ours;
  ViewSettings others;
  others.bookmarks["/a.glb"][0] = theirs;
  others.bookmarks["/a.glb"][1] = theirs;
  others.bookmarks["/b.glb"][8] = theirs;
  mergeBookmarks(settings, others);
  EXPECT_EQ(settings.bookmarks["/a.glb"][0]->eye, ours.eye);
  EXPECT_EQ(settings.bookmarks["/a.glb"][1]->eye, theirs.eye);
  EXPECT_EQ(settings.bookmarks["/b.glb"][8]->eye, theirs.eye);
}

TEST(Settings, RecentFilesAreFewAndEachOnce) {
  const test::TemporaryFolder folder;
  ViewSettings settings;
  for (int i = 0; i < 14; ++i)
    addRecent(settings, "/" + std::to_string(i % 12) + ".glb");
  ASSERT_EQ(settings.recent.size(), kMostRecent);
  EXPECT_EQ(settings.recent[0], "/1.glb");
  EXPECT_EQ(settings.recent[1], "/0.glb");
  EXPECT_EQ(settings.recent[2], "/11.glb");
  saveSettings(settings, folder.path());
  EXPECT_EQ(loadSettings(folder.path()).recent, settings.recent);
  std::ofstream(folder / "view.json") << R"({"recent": [1, 2], "speed": 3})";
  EXPECT_TRUE(loadSettings(folder.path()).recent.empty());
  EXPECT_EQ(loadSettings(folder.path()).speed, 3.0F);
}

TEST(FrameHistory, CsvHasALinePerFrameAndAColumnPerPass) {
  FrameHistory history;
  render::FrameStatistics statistics;
  statistics.triangles = 1234;
  history.add(makeSample(1.0, {{"cull", 0.5}, {"draw", 2.0}}, statistics));
  history.add(makeSample(1.5, {{"cull", 0.25}, {"count", 1.0}, {"draw", 2.0}, {"draw", 1.0}}, statistics));
  std::istringstream text(history.csv());
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(text, line);)
    lines.push_back(split(line + ",", ','));
  ASSERT_EQ(lines.size(), 3U);
  const auto at = [&](std::size_t line, const std::string& name) {
    const auto column = std::find(lines[0].begin(), lines[0].end(), name) - lines[0].begin();
    return lines[line].at(static_cast<std::size_t>(column));
  };
  EXPECT_EQ(lines[1].size(), lines[0].size());
  EXPECT_EQ(lines[2].size(), lines[0].size());
  EXPECT_EQ(at(1, "frame_ms"), "2.5");
  EXPECT_EQ(at(2, "triangles"), "1234");
  EXPECT_EQ(at(1, "count ms"), "");
  EXPECT_EQ(at(2, "count ms"), "1");
  EXPECT_EQ(at(2, "draw ms"), "3") << "passes of one name add up";
}

/// Three spheres of two nodes and two meshes.
asset::SceneFile namedFile() {
  asset::SceneFile file = test::sphereChain(2);
  file.meshes[0].name = "ball";
  file.nodeNames = {"door", "12"};
  for (const std::uint32_t node : {0U, 1U, 1U})
    file.instances.push_back({0, glm::mat4(1.0F), node});
  return file;
}

std::vector<std::uint32_t> hiddenBy(const std::string& hide, const std::string& only = "") {
  RenderOptions options;
  options.hide = hide;
  options.only = only;
  return hiddenObjects(namedFile(), options);
}

TEST(ShownObjects, ListsHoldNamesNumbersAndRanges) {
  using Objects = std::vector<std::uint32_t>;
  EXPECT_EQ(hiddenBy(""), Objects{});
  EXPECT_EQ(hiddenBy("door"), Objects{0});
  EXPECT_EQ(hiddenBy("ball"), (Objects{0, 1, 2})) << "a mesh stands for all its objects";
  EXPECT_EQ(hiddenBy("1-2"), (Objects{1, 2}));
  EXPECT_EQ(hiddenBy("2,door"), (Objects{0, 2}));
  EXPECT_EQ(hiddenBy("", "1"), (Objects{0, 2}));
  EXPECT_EQ(hiddenBy("1", "door,1"), (Objects{1, 2})) << "both lists count";
}

TEST(ShownObjects, WhatIsNoObjectIsRefused) {
  for (const char* list : {"window", "3", "12", "2-1", "0-3", "0,,1", ",", "1-", "-1", "99999999999999999999"})
    EXPECT_EQ(test::codeOf([&] { hiddenBy(list); }), ErrorCode::kUsage) << list;
  EXPECT_EQ(test::codeOf([&] { hiddenBy("", "window"); }), ErrorCode::kUsage);
}

TEST(ShownObjects, TheShorterListIsWritten) {
  RenderOptions options;
  hideObjects(options, {1, 2, 3, 7}, 20);
  EXPECT_EQ(options.hide, "1-3,7");
  EXPECT_EQ(options.only, "");
  std::vector<std::uint32_t> most;
  for (std::uint32_t i = 0; i < 20; ++i)
    if (i != 4) most.push_back(i);
  hideObjects(options, most, 20);
  EXPECT_EQ(options.hide, "");
  EXPECT_EQ(options.only, "4");
  hideObjects(options, {}, 20);
  EXPECT_EQ(options.hide + options.only, "");
  hideObjects(options, {0, 1}, 2);
  EXPECT_EQ(options.hide, "0-1") << "an empty --only would show all";
}

TEST(ShownObjects, HiddenObjectsAreNotBuilt) {
  RenderOptions options;
  options.only = "1";
  options.cells = {};
  const asset::SceneFile file = namedFile();
  const scene::SceneData scene = scene::buildScene(file, buildOptionsOf(file, options));
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.objects[0].owner, 1U) << "numbers stay those of the file";
  EXPECT_EQ(scene.objects[0].object, 0U);
  EXPECT_EQ(scene.names.nodeName(1), "12");
  options.only = "";
  options.hide = "ball";
  const scene::SceneData empty = scene::buildScene(file, buildOptionsOf(file, options));
  EXPECT_TRUE(empty.objects.empty());
  EXPECT_FALSE(empty.boundsWorld.empty()) << "the cameras stay where they are";
}

TEST(OutputFiles, NoFileIsNamedTwice) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(freshOutput(folder.path(), "shot", ".png"), folder / "shot-0001.png");
  std::ofstream(folder / "shot-0001.png") << "x";
  EXPECT_EQ(freshOutput(folder.path(), "shot", ".png"), folder / "shot-0002.png");
  EXPECT_EQ(freshOutput(folder.path(), "shot", ".json"), folder / "shot-0001.json");
}

TEST(Region, DividerSplitsItIntoWholeColumns) {
  const Region region{100.0F, 0.0F, 33.0F, 20.0F};
  for (const float share : {0.0F, 0.5F, 0.51F, 1.0F}) {
    const Region left = region.leftOf(share);
    const Region right = region.rightOf(share);
    EXPECT_EQ(left.x, region.x);
    EXPECT_EQ(left.width, std::round(left.width));
    EXPECT_EQ(left.x + left.width, right.x);
    EXPECT_EQ(left.width + right.width, region.width);
    EXPECT_EQ(right.height, region.height);
  }
  EXPECT_TRUE(region.holds({100.0F, 0.0F}));
  EXPECT_FALSE(region.holds({133.0F, 0.0F})) << "the next document's first column";
}

TEST(FileWatch, ReportsAChangeOnceItIsOver) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "a.txt") << "one";
  FileWatch file(folder / "a.txt");
  FileWatch all(folder.path(), /*recursive=*/true);
  EXPECT_FALSE(file.changed());
  std::ofstream(folder / "a.txt") << "longer";
  EXPECT_FALSE(file.changed()) << "may still be written";
  EXPECT_TRUE(file.changed());
  EXPECT_FALSE(file.changed());
  std::ofstream(folder / "b.txt") << "new";
  EXPECT_FALSE(all.changed());
  EXPECT_TRUE(all.changed());
  FileWatch alone(folder.path());
  std::ofstream(folder / "c.txt") << "new";
  EXPECT_FALSE(alone.changed());
  EXPECT_FALSE(alone.changed()) << "a folder that stands for a scene is not searched";
}

TEST(FileWatch, FilesThatComeIntoViewAreNoChange) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.txt", "b.txt"})
    std::ofstream(folder / name) << "one";
  FileWatch watch(folder / "a.txt");
  std::ofstream(folder / "a.txt") << "changed meanwhile";
  watch.watch({folder / "a.txt", folder / "b.txt", folder / "not there.txt"});
  EXPECT_FALSE(watch.changed());
  EXPECT_TRUE(watch.changed()) << "what was watched before is compared with what was known of it";
  std::ofstream(folder / "b.txt") << "longer";
  EXPECT_FALSE(watch.changed());
  EXPECT_TRUE(watch.changed());
  std::ofstream(folder / "not there.txt") << "now";
  EXPECT_FALSE(watch.changed());
  EXPECT_TRUE(watch.changed());
  EXPECT_FALSE(watch.changed());
}

TEST(ViewOptions, FoldersStandForTheirFiles) {
  const test::TemporaryFolder folder;
  for (const char* name : {"b.glb", "a.GLTF", "c.png"})
    std::ofstream(folder / name) << "x";
  const auto files = expandFolders({folder.path(), "other.glb"});
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].filename(), "a.GLTF");
  EXPECT_EQ(files[1].filename(), "b.glb");
  EXPECT_EQ(files[2], "other.glb");
}

TEST(Actions, NoTwoShareAKey) {
  for (const Binding& a : bindings())
    for (const Binding& b : bindings())
      EXPECT_TRUE(&a == &b || a.key != b.key || a.mods != b.mods) << a.what << ", " << b.what;
}

TEST(Actions, EachHasOneKeyAndATooltipThatNamesIt) {
  std::set<Action> actions;
  for (const Binding& binding : bindings()) {
    EXPECT_TRUE(actions.insert(binding.action).second) << binding.what;
    EXPECT_TRUE(helpText(binding.action).ends_with(std::string("(") + binding.keys + ")")) << binding.what;
  }
  EXPECT_EQ(actions.size(), kActionCount);
}

}  // namespace
}  // namespace jalousie::app
