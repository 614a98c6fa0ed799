// The jalousie program as its users run it: options, exit codes, files, figures.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/gl_debug.h"
#include "asset/gltf_file.h"
#include "asset/image_io.h"
#include "asset/lod_chain.h"
#include "compare/image_error.h"
#include "support/animated_model.h"
#include "support/gl_test.h"
#include "support/run_program.h"
#include "support/scene_writer.h"
#include "support/scenes.h"

namespace jalousie {
namespace {

using test::ProgramResult;

ProgramResult jalousie(const std::vector<std::string>& arguments) {
  return test::runProgram(JALOUSIE_PROGRAM, arguments);
}

/// A GLB of nine spheres, one in front of the others.
void writeScene(const std::filesystem::path& file, const std::vector<double>& place = {0, 0, 0}) {
  tinygltf::Model model = test::emptyModel();
  const int mesh = test::addMesh(model, test::sphere(16, 8));
  tinygltf::Node root;
  root.translation = place;
  for (int row = -1; row <= 1; ++row)
    for (int column = -1; column <= 1; ++column)
      root.children.push_back(
          test::addMeshNode(model, mesh, {1.5 * column, 1.5 * row, row == 0 && column == 0 ? 3.0 : -3.0}));
  model.nodes.push_back(std::move(root));
  model.scenes[0].nodes = {static_cast<int>(model.nodes.size()) - 1};
  asset::saveGlb(model, file);
}

class RenderCommand : public test::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    writeScene(scene());
  }
  std::string scene() const { return (folder_ / "scene.glb").string(); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(std::ifstream(folder_ / name)); }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(RenderCommand, HelpShowsExamplesAndSucceeds) {
  const ProgramResult help = jalousie({"render", "--help"});
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_NE(help.standardOutput.find("Examples"), std::string::npos);
  for (const char* option :
       {"--frame", "--eye", "--size", "--mode", "--lod", "--lv", "--detail", "--view", "--json", "--freeze-eye"})
    EXPECT_NE(help.standardOutput.find(option), std::string::npos) << option;
  EXPECT_EQ(jalousie({"--version"}).exitCode, 0);
}

TEST_F(RenderCommand, ProgramsOfTestsRunWithOpenGlDebugOutput) {
  const ProgramResult environment = test::runProgram("/usr/bin/env", {});
  EXPECT_NE(("\n" + environment.standardOutput).find("\nJALOUSIE_GL_DEBUG=1\n"), std::string::npos);
  // The program reads the variable: a value that is no truth value is an error of the command line.
  for (const char* command : {"render", "compare", "view"}) {
    const ProgramResult refused = test::runProgram(JALOUSIE_PROGRAM, {command, scene(), "-o", file("x")},
                                                   {.environment = {"JALOUSIE_GL_DEBUG=perhaps"}});
    EXPECT_EQ(refused.exitCode, static_cast<int>(ErrorCode::kUsage)) << command;
    EXPECT_NE(refused.standardError.find("--debug"), std::string::npos) << refused.standardError;
  }
}

TEST_F(RenderCommand, DebugMessagesBecomeExitCode70) {
  const app::GlDebug debug(true);
  EXPECT_NO_THROW(debug.check());
  glBindFramebuffer(GL_FRAMEBUFFER, 12345);  // no such name
  try {
    debug.check();
    FAIL() << "a mistake went unreported";
  } catch (const Error& error) {
    EXPECT_EQ(error.exitCode(), 70);
  }
  const app::GlDebug off(false);
  glBindFramebuffer(GL_FRAMEBUFFER, 12345);
  EXPECT_NO_THROW(off.check());
}

TEST_F(RenderCommand, PictureAndFiguresHaveTheAskedSizeAndTheFixedKeys) {
  const ProgramResult result = jalousie({"render", scene(), "--size", "123x45", "--mode", "frustum", "--json",
                                         file("stats.json"), "-o", file("frame.png")});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const ImageRgba8 image = asset::loadImage(file("frame.png"));
  EXPECT_EQ(image.width, 123U);
  EXPECT_EQ(image.height, 45U);
  const nlohmann::json stats = json("stats.json");
  for (const char* key : {"renderer",
                          "width",
                          "height",
                          "mode",
                          "lod",
                          "lv",
                          "detail",
                          "objects",
                          "culled_frustum",
                          "occluders",
                          "culled_occlusion",
                          "culled_small",
                          "drawn",
                          "drawn_early",
                          "drawn_stale",
                          "dropped",
                          "triangles",
                          "triangles_full",
                          "lod_histogram",
                          "points",
                          "segments",
                          "passes",
                          "frame_ms"})
    EXPECT_TRUE(stats.contains(key)) << key;
  EXPECT_EQ(stats["objects"], 9);
  EXPECT_EQ(stats["drawn"], 9);
  EXPECT_LE(stats["visible"], stats["drawn"]);
  EXPECT_GT(stats["visible"], 0);
  EXPECT_EQ(stats["wrong_pixels"], 0);
  EXPECT_EQ(stats["triangles_full"], 9 * 2 * 16 * 7);
  EXPECT_EQ(stats["lod"], "price");
  EXPECT_EQ(stats["lv"], "pixels");
  EXPECT_EQ(stats["tau"], 1.0);
  EXPECT_FALSE(stats.contains("masking"));
}

TEST_F(RenderCommand, FiguresSayWhetherErrorsWereMasked) {
  const ProgramResult result =
      jalousie({"render", scene(), "--size", "64x64", "--masking", "--stats-only", "--json", file("masked.json")});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  EXPECT_EQ(json("masked.json")["masking"], true);
}

/// Two spheres with two levels each. Either each sphere has its own chain, or both are a group with levels.
void writeLevels(const std::filesystem::path& file, bool isGroup, const std::vector<float>& coverage) {
  tinygltf::Model model = test::emptyModel();
  int meshes[2];
  for (std::uint32_t lod = 0; lod < 2; ++lod) {
    meshes[lod] = test::addMesh(model, test::sphere(lod == 0 ? 48 : 6, lod == 0 ? 24 : 4));
    asset::LodInfo info{lod, 1, 1, 0.2 * lod};
    info.measures.emplace().twoSided = {0.2 * lod, 0.1 * lod};
    asset::setLodInfo(model.meshes[lod], info);
  }
  const auto addLevel = [&](int mesh) {
    std::vector<int> nodes = {test::addMeshNode(model, mesh, {-1.25, 0.0, 0.0}),
                              test::addMeshNode(model, mesh, {1.25, 0.5, 0.0}, 0.75)};
    if (!isGroup) return nodes;
    const int group = test::addMeshNode(model, -1);
    model.nodes.back().children = nodes;
    return std::vector<int>{group};
  };
  const std::vector<int> finest = addLevel(meshes[0]);
  const std::vector<int> coarse = addLevel(meshes[1]);
  for (std::size_t i = 0; i < finest.size(); ++i) {
    asset::setLodChain(model, finest[i], std::vector<int>{coarse[i]}, std::vector<float>{1.0F, 0.0F});
    if (coverage.empty()) model.nodes[static_cast<std::size_t>(finest[i])].extras = {};
  }
  model.scenes[0].nodes = finest;
  asset::saveGlb(model, file);
}

TEST_F(RenderCommand, GroupsWithLevelsLookLikeMeshesWithLevels) {
  writeLevels(file("meshes.glb"), false, {1.0F});
  writeLevels(file("group.glb"), true, {1.0F});
  for (const char* tau : {"0.001", "1000"}) {  // all at LOD 0, all at LOD 1
    ImageRgba8 pictures[2];
    for (const bool isGroup : {false, true}) {
      const ProgramResult result = jalousie({"render", file(isGroup ? "group.glb" : "meshes.glb"), "--eye", "0.4,1,6",
                                             "--look", "0,0,0", "--size", "320x180", "--lod", "pixel-error", "--tau",
                                             tau, "-o", file("levels.png"), "--json", file("levels.json")});
      ASSERT_EQ(result.exitCode, 0) << result.standardError;
      EXPECT_TRUE(result.standardError.empty()) << result.standardError;
      pictures[isGroup ? 1 : 0] = asset::loadImage(file("levels.png"));
      const nlohmann::json stats = json("levels.json");
      EXPECT_EQ(stats["drawn"], isGroup ? 1 : 2);
      EXPECT_EQ(stats["triangles_full"], 2 * 2 * 48 * 23);
      EXPECT_EQ(stats["lod_histogram"][tau == std::string("1000") ? 1 : 0], isGroup ? 1 : 2);
    }
    std::size_t differing = 0;
    std::size_t covered = 0;
    for (std::size_t i = 0; i < pictures[0].pixels.size(); i += 4) {
      bool differs = false;
      for (std::size_t c = i; c < i + 3; ++c)
        differs = differs || std::abs(pictures[0].pixels[c] - pictures[1].pixels[c]) > 2;
      differing += differs ? 1 : 0;
      covered += pictures[0].pixels[i] != pictures[0].pixels[0] ? 1 : 0;
    }
    EXPECT_GT(covered, 3000U);
    EXPECT_LT(differing, 20U) << "a silhouette may move by a rounding";
  }
}

TEST_F(RenderCommand, CoverageFollowsTheThresholdsOfTheFile) {
  writeLevels(file("with.glb"), false, {1.0F});
  writeLevels(file("without.glb"), false, {});
  const auto levels = [&](const std::string& name, const std::string& distance, const std::string& tau) {
    const ProgramResult result =
        jalousie({"render", file(name), "--eye", "0,0," + distance, "--look", "0,0,0", "--size", "320x180", "--mode",
                  "full", "--lod", "coverage", "--tau", tau, "--stats-only", "--json", file("coverage.json")});
    EXPECT_EQ(result.exitCode, 0) << result.standardError;
    const bool warns = result.standardError.find("MSFT_screencoverage") != std::string::npos;
    EXPECT_EQ(warns, name == "without.glb") << result.standardError;
    return json("coverage.json")["lod_histogram"];
  };
  EXPECT_EQ(levels("with.glb", "1.6", "1")[0], 2) << "larger than the screen";
  EXPECT_EQ(levels("with.glb", "9", "1")[1], 2);
  EXPECT_EQ(levels("with.glb", "9", "0.05")[0], 2) << "counts as 20 times as large";
  EXPECT_EQ(levels("without.glb", "900", "1")[0], 2);
}

TEST_F(RenderCommand, LevelsOfOthersWithoutErrorsAreDrawnByCoverageAlone) {
  writeLevels(file("foreign.glb"), false, {1.0F});
  tinygltf::Model model = asset::loadGltf(file("foreign.glb"));
  for (tinygltf::Mesh& mesh : model.meshes)
    mesh.extras = {};
  asset::saveGlb(model, file("foreign.glb"));
  const auto levels = [&](const std::string& rule) {
    const ProgramResult result =
        jalousie({"render", file("foreign.glb"), "--eye", "0,0,9", "--look", "0,0,0", "--size", "320x180", "--mode",
                  "full", "--lod", rule, "--tau", "1", "--stats-only", "--json", file("foreign.json")});
    EXPECT_EQ(result.exitCode, 0) << result.standardError;
    EXPECT_EQ(result.standardError.find("no measured error") != std::string::npos, rule != "coverage") << rule;
    return json("foreign.json")["lod_histogram"];
  };
  for (const char* rule : {"pixel-error", "price"})
    EXPECT_EQ(levels(rule)[0], 2) << rule << ": a level of unknown error is never taken";
  EXPECT_EQ(levels("coverage")[1], 2);
}

TEST_F(RenderCommand, CamerasAreChosenByNameAndNumber) {
  tinygltf::Model model = test::emptyModel();
  tinygltf::Camera camera;
  camera.type = "perspective";
  camera.perspective.yfov = 0.5;
  camera.perspective.znear = 0.1;
  model.cameras = {camera, camera};
  model.scenes[0].nodes.clear();
  const auto addCamera = [&](const char* name, double x) {
    tinygltf::Node node;
    node.name = name;
    node.camera = static_cast<int>(model.scenes[0].nodes.size());
    node.translation = {x, 0, 5};
    model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
  };
  addCamera("front", 0);
  addCamera("right", 40);  // sees the background only
  model.scenes[0].nodes.push_back(test::addMeshNode(model, test::addMesh(model, test::box(glm::vec3(0.5F)))));
  asset::saveGlb(model, file("two.glb"));
  const auto drawn = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all = {"render",       file("two.glb"), "--size",        "64x48",
                                    "--stats-only", "--json",        file("two.json")};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult result = jalousie(all);
    EXPECT_EQ(result.exitCode, 0) << result.standardError;
    return json("two.json")["drawn"].get<int>();
  };
  EXPECT_EQ(drawn({}), 1) << "the first camera";
  EXPECT_EQ(drawn({"--camera", "front"}), 1);
  EXPECT_EQ(drawn({"--camera", "0"}), 1);
  EXPECT_EQ(drawn({"--camera", "right"}), 0);
  EXPECT_EQ(drawn({"--camera", "1"}), 0);
  const ProgramResult refused = jalousie({"render", file("two.glb"), "--camera", "left", "-o", file("left.png")});
  EXPECT_EQ(refused.exitCode, static_cast<int>(ErrorCode::kUsage));
  EXPECT_NE(refused.standardError.find("right"), std::string::npos) << "the names that there are";
}

TEST_F(RenderCommand, EveryModeViewAndDetailRuns) {
  const std::vector<std::vector<std::string>> variants = {
      {"--mode", "full"},
      {"--mode", "hom", "--lod", "finest"},
      {"--mode", "hom", "--lod", "linear", "--lv", "thesis", "--view", "lv"},
      {"--mode", "hom", "--view", "lod", "--detail", "tessellation", "--max-tessellation", "3"},
      {"--mode", "hom", "--view", "occlusion", "--map-level", "2", "--occluder-distance", "5"},
      {"--eye", "0,0,9", "--look", "0,0,0", "--freeze-eye", "3,0,9", "--freeze-look", "0,0,0"},
      {"--mode", "hom", "--repeat", "3", "--cull-threshold", "0.95"},
      {"--mode", "hom-depth", "--occluder-tau", "2", "--view", "occlusion"},
      {"--mode", "hiz", "--lod", "linear", "--view", "phase", "--settle", "0"},
      {"--mode", "hiz", "--tau", "3", "--min-pixels", "4", "--view", "occlusion", "--map-level", "2"},
      {"--mode", "hiz", "--draws", "per-object", "--core"},
      {"--mode", "hiz", "--lod", "lv-error", "--relax", "8", "--view", "lv"},
      {"--mode", "hom-depth", "--lod", "lv-error", "--lv", "spectral", "--tau", "2"},
      {"--mode", "frustum", "--lod", "lv-error", "--calm", "--settle", "12"},
      {"--mode", "hiz", "--lod", "lv-error", "--detail", "tessellation", "--max-tessellation", "3", "--calm"},
      {"--lod", "lv-error", "--eye", "0,0,9", "--look", "0,0,0", "--freeze-eye", "3,0,9", "--freeze-look", "0,0,0"},
      {"--mode", "hom", "--lod", "lv-error", "--view", "occlusion", "--lv", "pixels"},
      {"--mode", "hom", "--lod", "linear", "--lv", "coverage"},
      {"--mode", "hom", "--lod", "lv-error", "--lv", "coverage", "--masking"},
      {"--masking", "--detail", "tessellation", "--calm"},
      {"--masking", "--lod", "price"},
      {"--mode", "frustum", "--importance", "MASK"},
      {"--lod", "price", "--tau", "2", "--max-error", "0"},
      {"--lod", "price", "--triangles", "3000", "--detail", "tessellation", "--max-tessellation", "3"},
      {"--lod", "price", "--calm", "--max-error", "4", "--mode", "frustum", "--importance", "MASK"},
  };
  asset::savePng({2, 1, {0, 0, 0, 255, 255, 255, 255, 255}}, file("mask.png"));
  for (std::vector<std::string> arguments : variants) {
    std::replace(arguments.begin(), arguments.end(), std::string("MASK"), file("mask.png"));
    arguments.insert(arguments.begin(), {"render", scene(), "--size", "64x64", "-o", file("variant.png")});
    const ProgramResult result = jalousie(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.standardError;
    EXPECT_EQ(asset::loadImage(file("variant.png")).width, 64U);
  }
}

TEST_F(RenderCommand, StatsOnlyPrintsPureJson) {
  const ProgramResult result = jalousie({"render", scene(), "--stats-only", "--repeat", "8", "--json", "-"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const nlohmann::json stats = nlohmann::json::parse(result.standardOutput);
  const ProgramResult uniform =
      jalousie({"render", scene(), "--mode", "frustum", "--lod", "pixel-error", "--stats-only", "--json", "-"});
  EXPECT_FALSE(nlohmann::json::parse(uniform.standardOutput)["passes"].contains("draw"));
  EXPECT_EQ(stats["mode"], "hiz");
  EXPECT_TRUE(stats["passes"].contains("count pixels")) << "the default counts, and draws what it counts";
}

TEST_F(RenderCommand, EveryPathGivesTheSamePicture) {
  const auto bytes = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", scene(), "-o", file("path.png"), "--size", "200x100"});
    EXPECT_EQ(jalousie(arguments).exitCode, 0);
    return asset::loadImage(file("path.png")).pixels;
  };
  const auto image = bytes({});
  EXPECT_EQ(bytes({"--mode", "full"}), image);
  EXPECT_EQ(bytes({"--mode", "frustum"}), image);
  EXPECT_EQ(bytes({"--draws", "per-object"}), image);
  EXPECT_EQ(bytes({"--core"}), image);
}

TEST_F(RenderCommand, SamePictureFarFromTheOrigin) {
  const std::string far = file("far.glb");
  writeScene(far, {7e6, -3e6, 1e8});
  const auto picture = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {"render", "-o", file("place.png"), "--size", "200x100"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    EXPECT_EQ(jalousie(command).exitCode, 0);
    return asset::loadImage(file("place.png")).pixels;
  };
  EXPECT_EQ(picture({far}), picture({scene()}));
  const auto expected = picture({scene(), "--eye", "1.375,2,6", "--look", "0,0,0.0625"});
  EXPECT_EQ(picture({far, "--eye", "7000001.375,-2999998,100000006", "--look", "7e6,-3e6,100000000.0625"}), expected);
  for (const auto& [place, path] : {std::pair{scene(), file("near-path.glb")}, {far, file("far-path.glb")}})
    ASSERT_EQ(jalousie({"record", place, "-o", path, "--frames", "9", "-q"}).exitCode, 0);
  const auto along = picture({scene(), "--path", file("near-path.glb"), "--frame", "4"});
  EXPECT_EQ(picture({far, "--path", file("far-path.glb"), "--frame", "4"}), along);
}

TEST_F(RenderCommand, AFrameShowsTheAnimationsAtItsTime) {
  const std::string moving = file("moving.glb");
  asset::saveGlb(test::animatedModel({.seed = 3, .loose = true, .levels = true}), moving);
  const auto picture = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {"render", moving,   "-o",     file("place.png"),  "--size", "200x100",
                                        "--lod",  "finest", "--json", file("stats.json"), "--force"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProgramResult result = jalousie(command);
    EXPECT_EQ(result.exitCode, 0) << result.standardError;
    return asset::loadImage(file("place.png"));
  };
  const ProgramResult recorded = jalousie({"record", moving, "-o", file("path.glb"), "--frames", "61", "-q"});
  ASSERT_EQ(recorded.exitCode, 0) << recorded.standardError;
  const auto along = [&](const std::string& frame) { return picture({"--path", file("path.glb"), "--frame", frame}); };
  const ImageRgba8 later = along("45");
  EXPECT_EQ(json("stats.json")["seconds"], 1.5);
  EXPECT_TRUE(json("stats.json")["ignored"].empty());
  EXPECT_NE(later.pixels, along("0").pixels);
  // The camera of the path at frame 45 is that of the file of one frame; the pose is fixed.
  const ImageRgba8 still = picture({"--time", "1.5", "--path", file("path.glb"), "--frame", "45"});
  EXPECT_FALSE(json("stats.json").contains("seconds"));
  EXPECT_GT(compare::psnr(later, still), 30.0);
  EXPECT_LT(compare::psnr(later, along("20")), 25.0);
  // The animation is two seconds long, and the scene has no camera.
  const ImageRgba8 whole = picture({"--frame", "60"});
  EXPECT_GT(compare::psnr(whole, picture({"--frame", "60", "--mode", "full"})), 60.0);
  EXPECT_EQ(jalousie({"render", moving, "--frame", "61", "-o", file("place.png"), "--force"}).exitCode, 2);
}

TEST_F(RenderCommand, SamePictureWhateverTheThreadCount) {
  // llvmpipe reads the variable when it starts; other drivers ignore it.
  std::vector<std::vector<std::uint8_t>> images;
  const char* before = std::getenv("LP_NUM_THREADS");
  const std::string saved = before != nullptr ? before : "";
  for (const char* threads : {"1", "2", "5"}) {
    setenv("LP_NUM_THREADS", threads, 1);
    EXPECT_EQ(jalousie({"render", scene(), "--eye", "1,2,6", "--look", "0,0,0", "-o", file("threads.png")}).exitCode,
              0);
    images.push_back(asset::loadImage(file("threads.png")).pixels);
  }
  before != nullptr ? setenv("LP_NUM_THREADS", saved.c_str(), 1) : unsetenv("LP_NUM_THREADS");
  EXPECT_EQ(images[0], images[1]);
  EXPECT_EQ(images[0], images[2]);
}

TEST_F(RenderCommand, FullListsAreReported) {
  const ProgramResult result = jalousie({"render", scene(), "--capacity", "2", "--stats-only", "--json", "-"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_NE(result.standardError.find("no room"), std::string::npos) << result.standardError;
  EXPECT_EQ(nlohmann::json::parse(result.standardOutput)["dropped"], 7);
}

TEST_F(RenderCommand, SameCommandSameBytes) {
  ASSERT_EQ(jalousie({"render", scene(), "-o", file("a.png"), "--size", "200x100"}).exitCode, 0);
  ASSERT_EQ(jalousie({"render", scene(), "-o", file("b.png"), "--size", "200x100"}).exitCode, 0);
  const auto bytes = [&](const char* name) {
    std::ifstream stream(file(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
}

/// Expects one line on stderr that names `mention`, the exit code, and no output file.
void expectRefused(const ProgramResult& result, int exitCode, const std::string& mention, const std::string& output) {
  EXPECT_EQ(result.exitCode, exitCode) << result.standardError;
  EXPECT_EQ(std::count(result.standardError.begin(), result.standardError.end(), '\n'), 1) << result.standardError;
  EXPECT_NE(result.standardError.find(mention), std::string::npos) << result.standardError;
  EXPECT_FALSE(std::filesystem::exists(output)) << output;
}

TEST_F(RenderCommand, ContradictoryOrMalformedOptionsAreUsageErrors) {
  const std::string out = file("never.png");
  const std::vector<std::vector<std::string>> bad = {
      {"--mode", "frustum", "--lod", "linear"},
      {"--mode", "full", "--view", "occlusion"},
      {"--mode", "frustum", "--occluder-distance", "3"},
      {"--mode", "hiz", "--cull-threshold", "0.9"},
      {"--mode", "hiz", "--occluder-tau", "1"},
      {"--mode", "frustum", "--view", "phase"},
      {"--mode", "full", "--min-pixels", "3"},
      {"--lod", "finest", "--tau", "3"},
      {"--tau", "-1"},
      {"--lod", "pixel-error", "--relax", "3"},
      {"--lod", "price", "--relax", "3"},
      {"--lod", "lv-error", "--max-error", "3"},
      {"--lod", "lv-error", "--triangles", "3000"},
      {"--lod", "price", "--triangles", "-1"},
      {"--lod", "pixel-error", "--lv", "chord"},
      {"--lod", "lv-error", "--lv", "chord", "--mode", "frustum"},
      {"--calm", "--lod", "finest"},
      {"--masking", "--mode", "frustum"},
      {"--masking", "--lod", "linear", "--mode", "hom"},
      {"--masking", "--lv", "chord"},
      {"--lod", "lv-error", "--relax", "-1"},
      {"--mode", "hom", "--lod", "pixel-error", "--settle", "1"},
      {"--capacity", "0"},
      {"--draws", "magic"},
      {"--eye", "0,0,5"},
      {"--eye", "0,0,5", "--look", "0,0,5"},
      {"--eye", "0,0", "--look", "0,0,5"},
      {"--eye", "0,0,nan", "--look", "0,0,5"},
      {"--freeze-look", "0,0,5"},
      {"--frame", "3"},
      {"--frame", "-1"},
      {"--size", "0x10"},
      {"--size", "10"},
      {"--size", "99999x10"},
      {"--mode", "magic"},
      {"--map-level", "1"},
      {"--max-tessellation", "3"},
      {"--detail", "tessellation", "--max-tessellation", "21"},
      {"--no-such-option"},
  };
  for (std::vector<std::string> arguments : bad) {
    const std::string shown = arguments[0];
    arguments.insert(arguments.begin(), {"render", scene(), "-o", out});
    SCOPED_TRACE(shown);
    expectRefused(jalousie(arguments), 2, "jalousie: ", out);
  }
  expectRefused(jalousie({"render", scene()}), 2, "-o", out);
  expectRefused(jalousie({}), 2, "jalousie: ", out);
}

TEST_F(RenderCommand, MissingAndBrokenFilesAreNamedInOneLine) {
  const std::string out = file("never.png");
  expectRefused(jalousie({"render", file("no.glb"), "-o", out}), 3, "no.glb", out);
  std::ofstream(file("broken.glb")) << "no scene at all, just words";
  expectRefused(jalousie({"render", file("broken.glb"), "-o", out}), 5, "broken.glb", out);
  expectRefused(jalousie({"render", scene(), "-o", file("no/such/folder/x.png")}), 8, "x.png",
                file("no/such/folder/x.png"));
}

}  // namespace
}  // namespace jalousie
