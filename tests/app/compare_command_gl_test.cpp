// `jalousie compare`, `diff` and `record` as programs: a baked sphere is scattered and measured along a path.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "asset/image_io.h"
#include "asset/scene_file.h"
#include "scene/camera.h"
#include "support/gl_test.h"
#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie {
namespace {

using nlohmann::json;
using test::ProgramResult;

ProgramResult jalousie(const std::vector<std::string>& arguments) {
  return test::runProgram(JALOUSIE_PROGRAM, arguments);
}

std::string textOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

json jsonOf(const std::filesystem::path& file) {
  return json::parse(textOf(file));
}

void writePly(const std::filesystem::path& file, const asset::Primitive& mesh) {
  std::ofstream ply(file);
  ply << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.indices.size() / 3
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const glm::vec3& p : mesh.positions)
    ply << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    ply << "3 " << mesh.indices[i] << ' ' << mesh.indices[i + 1] << ' ' << mesh.indices[i + 2] << '\n';
}

class CompareCommand : public test::GlTest {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    writePly(file("sphere.ply"), test::sphere(48, 24));
    const ProgramResult bake =
        test::runProgram(JALOUSIE_BAKE_PROGRAM, {file("sphere.ply"), "-o", file("sphere.glb"), "--quiet"});
    const ProgramResult scatter =
        test::runProgram(JALOUSIE_SCATTER_PROGRAM,
                         {file("sphere.glb"), "--count", "150", "--side", "9", "-o", file("scene.glb"), "--quiet"});
    ready_ = bake.exitCode == 0 && scatter.exitCode == 0;
    why_ = bake.standardError + scatter.standardError;
    if (!ready_ || !test::SharedContext::get().context) return;
    report_ = jalousie(with(planned(), {"-o", file("report")}));
  }
  static void TearDownTestSuite() { folder_.reset(); }
  void SetUp() override {
    GlTest::SetUp();
    ASSERT_TRUE(ready_) << why_;
  }

  static std::string file(const std::string& name) { return (*folder_ / name).string(); }
  static std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// The experiment whose report several tests read: five consecutive frames, two kept frames and a sweep.
  static std::vector<std::string> planned() {
    return {"compare",  file("scene.glb"), "--configs",    "standard,calm", "--config", "coarse=--tau 6 --mode frustum",
            "--frames", "1100:1104",       "--size",       "160x90",        "--keep",   "2",
            "--sweep",  "tau=1:4",         "--butteraugli"};
  }

  /// A command line that must be refused.
  struct Mistake {
    std::vector<std::string> words;
    int exitCode;
  };
  static std::vector<Mistake> mistakes() {
    const std::string scene = file("scene.glb");
    return {{{"compare", scene}, 2},
            {{"compare", scene, "-o", file("mine")}, 2},
            {{"compare", file("none.glb"), "-o", file("x")}, 3},
            {{"compare", file("sphere.glb"), "-o", file("x")}, 2},
            {{"compare", scene, "-o", file("x"), "--configs", "hiz,fastest"}, 2},
            {{"compare", scene, "-o", file("x"), "--config", "a=--mode no"}, 2},
            {{"compare", scene, "-o", file("x"), "--config", "a=--frame 3"}, 2},
            {{"compare", scene, "-o", file("x"), "--config", "hiz="}, 2},
            {{"compare", scene, "-o", file("x"), "--config", "reference="}, 2},
            {{"compare", scene, "-o", file("x"), "--config", "a b=", "--config", "a_b="}, 2},
            {{"compare", scene, "-o", file("x"), "--configs", file("broken.json")}, 5},
            {{"compare", scene, "-o", file("x"), "--configs", file("mistyped.json")}, 5},
            {{"compare", scene, "-o", file("x"), "--configs", file("no.json")}, 3},
            {{"compare", scene, "-o", file("x"), "--baseline", "hom"}, 2},
            {{"compare", scene, "-o", file("x"), "--frames", "5:1"}, 2},
            {{"compare", scene, "-o", file("x"), "--frames", "0:1800"}, 2},
            {{"compare", scene, "-o", file("x"), "--sweep", "tau=0:1"}, 2},
            {{"compare", scene, "-o", file("x"), "--sweep", "relax=1:2"}, 2},
            {{"compare", scene, "-o", file("x"), "--sweep", "tau=1,nan,2"}, 2},
            {{"compare", scene, "-o", file("x"), "--ppd", "nan"}, 2},
            {{"render", scene, "--tau", "nan", "--stats-only"}, 2},
            {{"diff", scene, scene, "--ppd", "nan"}, 2},
            {{"record", scene, "-o", file("p.glb"), "--fov", "nan"}, 2},
            {{"compare", scene, "-o", file("mine2")}, 2},
            {{"compare", scene, "-o", file("x"), "--sweep", "tau=1", "--reference", "none"}, 2},
            {{"compare", scene, "-o", file("x"), "--butteraugli", "--reference", "none"}, 2},
            {{"compare", scene, "-o", file("x"), "--camera", "7"}, 2},
            {{"compare", scene, "-o", file("x"), "--size", "4x4"}, 2},
            {{"diff", file("none.png"), file("none.png")}, 3},
            {{"diff", scene, scene}, 6},
            {{"record", scene, "-o", file("p.glb"), "--key", "0:1,2:3,4,5"}, 2},
            {{"record", scene, "-o", file("p.glb"), "--key", "5:1,2,3:4,5,6", "--key", "5:0,0,0:1,1,1"}, 2},
            {{"record", scene, "-o", file("p.glb"), "--key", "0:1,2,3:1,2,3"}, 2},
            {{"record", scene, "-o", file("p.glb"), "--key", "0:1,2,3:4,5,6", "--orbit", "90"}, 2}};
  }

  static std::unique_ptr<test::TemporaryFolder> folder_;
  static bool ready_;
  static std::string why_;
  static ProgramResult report_;
};
std::unique_ptr<test::TemporaryFolder> CompareCommand::folder_;
bool CompareCommand::ready_ = false;
std::string CompareCommand::why_;
ProgramResult CompareCommand::report_;

/// A summary without its times, which differ from run to run.
json withoutTimes(json value) {
  if (value.is_object()) {
    for (const char* key : {"frame_ms", "frame_ratio", "passes_ms", "command"})
      value.erase(key);
    for (auto& [key, entry] : value.items())
      entry = withoutTimes(entry);
  } else if (value.is_array()) {
    for (json& entry : value)
      entry = withoutTimes(entry);
  }
  return value;
}

TEST_F(CompareCommand, HelpListsTheConfigurationsAndExamples) {
  for (const char* command : {"compare", "diff", "record"}) {
    const ProgramResult help = jalousie({command, "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_NE(help.standardOutput.find("Examples"), std::string::npos) << command;
  }
  const std::string help = jalousie({"compare", "--help"}).standardOutput;
  for (const char* word : {"--resume", "--sweep", "thesis", "hom+lv-tessellation", "130"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
}

TEST_F(CompareCommand, TheReportHoldsWhatWasAskedFor) {
  ASSERT_EQ(report_.exitCode, 0) << report_.standardError;
  const json summary = jsonOf(file("report/summary.json"));
  EXPECT_EQ(summary["complete"], true);
  EXPECT_EQ(summary["objects"], 150);
  EXPECT_EQ(summary["frames"]["count"], 5);
  EXPECT_EQ(summary["frames"]["kept"], json({1100, 1104}));
  EXPECT_EQ(summary["baseline"], "frustum");
  ASSERT_EQ(summary["configurations"].size(), 5U);
  const json& frustum = summary["configurations"][0];
  const json& hiz = summary["configurations"][1];
  const json& coarse = summary["configurations"][4];
  EXPECT_EQ(coarse["name"], "coarse");
  EXPECT_EQ(frustum["frame_ratio"]["median"], 1.0);
  EXPECT_LT(hiz["drawn"]["median"], frustum["drawn"]["median"]) << "something is hidden";
  EXPECT_EQ(hiz["error"], frustum["error"]) << "and nobody sees that it is gone";
  EXPECT_LT(coarse["triangles"]["median"], frustum["triangles"]["median"]);
  EXPECT_GT(coarse["error"]["flip"]["mean"], frustum["error"]["flip"]["mean"]);
  ASSERT_EQ(summary["sweep"]["curves"].size(), 5U);
  EXPECT_EQ(summary["sweep"]["curves"][0]["points"].size(), 3U);
  EXPECT_EQ(linesOf(file("report/frames.csv")).size(), 1U + 5 * 5);
  EXPECT_EQ(hiz["popping"]["temporal_flip"], frustum["popping"]["temporal_flip"]);
  EXPECT_GT(coarse["popping"]["temporal_flip"], 0.0);
  for (const char* picture : {"01100-reference-image", "01104-default-lod", "01104-coarse-error", "01100-hiz-image"}) {
    const ImageRgba8 image = asset::loadImage(file(std::string("report/pictures/") + picture + ".png"));
    EXPECT_EQ(image.width, 160U) << picture;
  }
  const std::string page = textOf(file("report/index.html"));
  EXPECT_GT(page.size(), 10000U);
  EXPECT_EQ(page.find("/*DATA*/"), std::string::npos);
}

TEST_F(CompareCommand, ObjectsOfTheWorstFrameAreListed) {
  ASSERT_EQ(report_.exitCode, 0) << report_.standardError;
  const json summary = jsonOf(file("report/summary.json"));
  for (const json& c : summary["configurations"]) {
    const json& objects = c["worst_objects"];
    ASSERT_TRUE(objects.is_object()) << c["name"];
    const auto count = objects["count"].get<std::size_t>();
    EXPECT_EQ(objects["rows"].size(), std::min<std::size_t>(count, 100)) << c["name"];
    double sum = objects["flip_of_background"];
    double last = 1e30;
    for (const json& row : objects["rows"]) {
      EXPECT_LE(row["flip"], last) << "worst first";
      last = row["flip"];
      sum += last;
      EXPECT_FALSE(row["name"].get<std::string>().empty());
    }
    if (count <= 100) {
      EXPECT_NEAR(sum, objects["flip"], 1e-6);
    }
    EXPECT_GE(objects["frame"], 1100);
    EXPECT_LE(objects["frame"], 1104);
  }
  const json& frustum = summary["configurations"][0]["worst_objects"];
  const json& coarse = summary["configurations"][4]["worst_objects"];
  EXPECT_GT(coarse["flip"], frustum["flip"]);
  EXPECT_EQ(coarse["rows"][0]["error_allowed_px"], 8.0) << "--max-error, which --lod price keeps at any tau";
  EXPECT_LE(coarse["rows"][0]["error_px"], 8.0);
}

TEST_F(CompareCommand, ObjectsAreCutToTheirNumberOrLeftOut) {
  const std::vector<std::string> words = {"compare", file("scene.glb"), "--configs", "hiz",      "--frames",
                                          "1100",    "--size",          "64x36",     "--keep",   "0",
                                          "--quiet", "--force",         "-o",        file("few")};
  ASSERT_EQ(jalousie(with(words, {"--objects", "2"})).exitCode, 0);
  EXPECT_EQ(jsonOf(file("few/summary.json"))["configurations"][0]["worst_objects"]["rows"].size(), 2U);
  ASSERT_EQ(jalousie(with(words, {"--objects", "0"})).exitCode, 0);
  EXPECT_TRUE(jsonOf(file("few/summary.json"))["configurations"][0]["worst_objects"].is_null());
}

TEST_F(CompareCommand, FramesAreTheSameInEveryRunAndHoweverItIsInterrupted) {
  ASSERT_EQ(report_.exitCode, 0) << report_.standardError;
  const json whole = withoutTimes(jsonOf(file("report/summary.json")));
  const std::vector<std::string> log = linesOf(file("report/run.jsonl"));
  ASSERT_EQ(log.size(), 1U + 5 + 5 + 2 + 2 * 3);
  for (const std::size_t steps :
       {std::size_t{0}, std::size_t{2}, std::size_t{7}, std::size_t{11}, std::size_t{14}, log.size() - 1}) {
    std::filesystem::remove_all(file("again"));
    std::filesystem::create_directory(file("again"));
    std::ofstream cut(file("again/run.jsonl"));
    for (std::size_t i = 0; i <= steps; ++i)
      cut << log[i] << '\n';
    if (steps + 1 < log.size()) cut << log[steps + 1].substr(0, log[steps + 1].size() / 2);
    cut.close();
    for (const char* kept : {"pictures", "references"})
      std::filesystem::copy(file(std::string("report/") + kept), file(std::string("again/") + kept));
    const ProgramResult resumed = jalousie(with(planned(), {"-o", file("again"), "--resume", "--quiet"}));
    ASSERT_EQ(resumed.exitCode, 0) << resumed.standardError;
    EXPECT_EQ(withoutTimes(jsonOf(file("again/summary.json"))), whole) << "after " << steps << " steps";
  }
}

TEST_F(CompareCommand, AReportReplacesAReportByForceAndLeavesOtherFilesAlone) {
  const std::vector<std::string> words = {"compare", file("scene.glb"), "--configs", "hom+lv",
                                          "--size",  "64x36",           "--keep",    "1",
                                          "-o",      file("twice"),     "--quiet"};
  ASSERT_EQ(jalousie(with(words, {"--frames", "1100:1300:50"})).exitCode, 0);
  const json first = jsonOf(file("twice/summary.json"));
  EXPECT_GT(first["configurations"][0]["popping"]["switches_per_visible_object"], 0.0)
      << "levels switch from the frame before, though nothing else is remembered of it";
  std::ofstream(file("twice/pictures/mine.png")) << "not yours";
  const ProgramResult refused = jalousie(with(words, {"--frames", "0"}));
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.standardError.find("--force"), std::string::npos) << refused.standardError;
  EXPECT_EQ(jsonOf(file("twice/summary.json")), first);
  ASSERT_EQ(jalousie(with(words, {"--frames", "0", "--force"})).exitCode, 0);
  EXPECT_EQ(jsonOf(file("twice/summary.json"))["frames"]["kept"], json::array({0U}));
  EXPECT_TRUE(
      jsonOf(file("twice/summary.json"))["configurations"][0]["popping"]["switches_per_visible_object"].is_null());
  EXPECT_EQ(textOf(file("twice/pictures/mine.png")), "not yours");
  EXPECT_FALSE(std::filesystem::exists(file("twice/pictures/01200-hom+lv-image.png")));
  EXPECT_TRUE(std::filesystem::exists(file("twice/pictures/00000-hom+lv-image.png")));
}

TEST_F(CompareCommand, AnotherExperimentIsNotResumed) {
  ASSERT_EQ(report_.exitCode, 0);
  const ProgramResult other =
      jalousie({"compare", file("scene.glb"), "--frames", "0", "--size", "64x36", "-o", file("report"), "--resume"});
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_NE(other.standardError.find("another experiment"), std::string::npos) << other.standardError;
  EXPECT_TRUE(std::filesystem::exists(file("report/summary.json")));
}

TEST_F(CompareCommand, AnInterruptionLeavesAReadableReport) {
  const std::string output = file("interrupted");
  const std::vector<std::string> words = {JALOUSIE_PROGRAM, "compare",  file("scene.glb"), "--size",
                                          "160x90",         "--frames", "0:1799",          "-o",
                                          output,           "--quiet"};
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (const std::string& word : words)
      argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  for (int i = 0; i < 1200 && linesOf(output + "/run.jsonl").size() < 3; ++i)
    ::usleep(100000);
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const json summary = jsonOf(output + "/summary.json");
  EXPECT_EQ(summary["complete"], false);
  EXPECT_GE(summary["configurations"][0]["frames"], 2);
  EXPECT_GT(textOf(output + "/index.html").size(), 10000U);
}

TEST_F(CompareCommand, WithoutAReferenceOnlyCullingRuns) {
  const ProgramResult result =
      jalousie({"compare", file("scene.glb"), "--configs", "thesis", "--reference", "none", "--frames", "0:1799:450",
                "--size", "160x90", "-o", file("counts"), "--json", "-", "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const json summary = json::parse(result.standardOutput);
  EXPECT_EQ(summary, jsonOf(file("counts/summary.json")));
  EXPECT_TRUE(summary["sweep"].is_null());
  for (const json& configuration : summary["configurations"])
    EXPECT_TRUE(configuration["error"].is_null());
  EXPECT_TRUE(std::filesystem::is_empty(file("counts/pictures")));
}

TEST_F(CompareCommand, WhatCullingLosesIsReported) {
  const ProgramResult result =
      jalousie({"compare", file("scene.glb"), "--configs", "hiz", "--config", "careless=--min-pixels 2000", "--frames",
                "900", "--size", "160x90", "--keep", "1", "-o", file("losses"), "--json", "-", "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const json configurations = json::parse(result.standardOutput)["configurations"];
  EXPECT_EQ(configurations[0]["lost"], json({{"objects_most", 0}, {"pixels_most", 0}, {"frames", 0}}));
  const json& careless = configurations[1]["lost"];
  EXPECT_GT(careless["objects_most"], 0);
  EXPECT_GE(careless["pixels_most"], careless["objects_most"]);
  EXPECT_EQ(careless["frames"], 1);
  EXPECT_GE(configurations[1]["error"]["flip_covered"]["mean"], configurations[1]["error"]["flip"]["mean"])
      << "the background has no error";
}

TEST_F(CompareCommand, MistakesAreOneLineThatSaysWhatToDo) {
  std::filesystem::create_directory(file("mine"));
  std::ofstream(file("mine/letter.txt")) << "dear reader";
  std::filesystem::create_directory(file("mine2"));
  std::ofstream(file("mine2/run.jsonl")) << "{\"loss\": 0.5}\n";
  std::filesystem::create_directory(file("mine2/pictures"));
  std::ofstream(file("broken.json")) << "{\"configurations\": [{\"options\": \"\"}]}";
  std::ofstream(file("mistyped.json")) << R"({"configurations": [{"name": "a", "opts": "--tau 2"}]})";
  for (const Mistake& mistake : mistakes()) {
    const ProgramResult result = jalousie(mistake.words);
    std::string line;
    for (const std::string& word : mistake.words)
      line += word + " ";
    EXPECT_EQ(result.exitCode, mistake.exitCode) << line << result.standardError;
    EXPECT_EQ(std::count(result.standardError.begin(), result.standardError.end(), '\n'), 1)
        << line << result.standardError;
    EXPECT_TRUE(result.standardError.starts_with("jalousie: ")) << result.standardError;
  }
  EXPECT_FALSE(std::filesystem::exists(file("x")));
  EXPECT_FALSE(std::filesystem::exists(file("p.glb")));
  EXPECT_EQ(textOf(file("mine/letter.txt")), "dear reader");
  EXPECT_EQ(textOf(file("mine2/run.jsonl")), "{\"loss\": 0.5}\n");
  EXPECT_TRUE(std::filesystem::exists(file("mine2/pictures")));
}

TEST_F(CompareCommand, ConfigurationsComeFromAFileToo) {
  std::ofstream(file("two.json"))
      << R"({"configurations": [{"name": "a, \"b\"", "options": "--tau 2"}, {"name": "plain"}]})";
  const ProgramResult result =
      jalousie({"compare", file("scene.glb"), "--configs", file("two.json"), "--baseline", "plain", "--frames", "10",
                "--keep", "0", "--size", "64x36", "-o", file("named"), "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const json summary = jsonOf(file("named/summary.json"));
  EXPECT_EQ(summary["configurations"][0]["name"], "a, \"b\"");
  EXPECT_EQ(summary["baseline"], "plain");
  EXPECT_NE(textOf(file("named/frames.csv")).find("\"a, \"\"b\"\"\""), std::string::npos);
}

TEST_F(CompareCommand, ARecordedPathIsFollowed) {
  ASSERT_EQ(jalousie({"record", file("scene.glb"), "--key", "0:0,0,60:0,0,0", "--key", "30:10,4,50:0,0,0", "--key",
                      "45:20,0,40:1,0,0", "-o", file("walk.glb")})
                .exitCode,
            0);
  const asset::SceneFile walk = asset::readSceneFile(file("walk.glb"));
  ASSERT_EQ(walk.cameras.size(), 1U);
  EXPECT_EQ(scene::frameCount(walk.cameras[0]), 46U);
  EXPECT_LT(glm::distance(scene::cameraAtFrame(walk.cameras[0], 0).positionWorld(), {0, 0, 60}), 1e-3F);
  EXPECT_LT(glm::distance(scene::cameraAtFrame(walk.cameras[0], 30).positionWorld(), {10, 4, 50}), 1e-3F);
  EXPECT_LT(glm::distance(scene::cameraAtFrame(walk.cameras[0], 45).positionWorld(), {20, 0, 40}), 1e-3F);
  // No corner at the middle key: the velocity before and after it is about the same.
  const auto at = [&](float frame) { return scene::cameraAtFrame(walk.cameras[0], frame).positionWorld(); };
  EXPECT_LT(glm::distance(at(30) - at(29), at(31) - at(30)), 0.1F * glm::distance(at(31), at(30)));

  ASSERT_EQ(jalousie({"record", file("scene.glb"), "--orbit", "90", "--frames", "10", "-o", file("orbit.glb"), "-q"})
                .exitCode,
            0);
  const asset::SceneFile orbit = asset::readSceneFile(file("orbit.glb"));
  EXPECT_EQ(scene::frameCount(orbit.cameras.at(0)), 10U);
  const ProgramResult result = jalousie({"compare", file("scene.glb"), "--path", file("orbit.glb"), "--configs",
                                         "frustum", "--size", "64x36", "--keep", "1", "-o", file("along"), "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  EXPECT_EQ(jsonOf(file("along/summary.json"))["frames"]["count"], 10);
  EXPECT_EQ(jsonOf(file("along/summary.json"))["path"], "orbit.glb");
}

TEST_F(CompareCommand, DiffPrintsAllFiguresAndDrawsTheMap) {
  ASSERT_EQ(report_.exitCode, 0);
  const std::string reference = file("report/pictures/01100-reference-image.png");
  const std::string coarse = file("report/pictures/01100-coarse-image.png");
  const ProgramResult result = jalousie({"diff", reference, coarse, "-o", file("map.png"), "--json", "-"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const json figures = json::parse(result.standardOutput);
  EXPECT_GT(figures["flip"], 0.0);
  EXPECT_LT(figures["ssim"], 1.0);
  EXPECT_GT(figures["butteraugli"], 0.1);
  EXPECT_GT(figures["butteraugli_largest"], figures["butteraugli"]);
  EXPECT_GT(figures["psnr"], 10.0);
  EXPECT_EQ(asset::loadImage(file("map.png")).width, 160U);
  const ProgramResult same = jalousie({"diff", reference, reference, "--json", "-"});
  EXPECT_EQ(json::parse(same.standardOutput)["flip"], 0.0);
  EXPECT_EQ(json::parse(same.standardOutput)["butteraugli"], 0.0);
  EXPECT_TRUE(json::parse(same.standardOutput)["psnr"].is_null());
  const ProgramResult text = jalousie({"diff", reference, coarse});
  for (const char* word : {"FLIP", "Butteraugli", "SSIM", "PSNR", "dB"})
    EXPECT_NE(text.standardOutput.find(word), std::string::npos) << word;
  asset::savePng(ImageRgba8{8, 8, std::vector<std::uint8_t>(256, 7)}, file("small.png"));
  EXPECT_EQ(jalousie({"diff", reference, file("small.png")}).exitCode, 2);
}

TEST_F(CompareCommand, ThePageWorksInABrowser) {
  ASSERT_EQ(report_.exitCode, 0);
  const ProgramResult check = test::runProgram(
      "/usr/bin/env", {"node", JALOUSIE_SOURCE_DIR "/tests/compare/page_check.mjs", file("report/index.html")});
  if (check.exitCode == 77 || check.exitCode == 127) GTEST_SKIP() << "no node or Chromium: " << check.standardError;
  EXPECT_EQ(check.exitCode, 0) << check.standardOutput << check.standardError;
}

}  // namespace
}  // namespace jalousie
