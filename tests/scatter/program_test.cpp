// Runs jalousie-scatter: exit codes, one line per failure, no output after a failure, report.
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "asset/gltf_file.h"
#include "scatter/scatter_fixtures.h"

namespace jalousie {
namespace {

struct Outcome {
  int code;
  std::string output;
  std::string errors;
};

std::string textOf(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = readFile(path, 1U << 24U);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class ScatterProgram : public testing::Test {
 protected:
  void SetUp() override { asset::saveGlb(test::bakedBall(), folder_ / "ball.glb"); }

  /// Runs in the folder; arguments are split by the shell.
  Outcome run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.path().string() + "' && '" + JALOUSIE_SCATTER_PROGRAM + "' " +
                                arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(folder_ / "stdout.txt"),
            textOf(folder_ / "stderr.txt")};
  }

  bool written(const char* name) const { return std::filesystem::exists(folder_ / name); }

  test::TempFolder folder_;
};

TEST_F(ScatterProgram, WritesSceneAndReport) {
  const Outcome outcome = run("ball.glb --count 12 --rotate x --seed 5 -o scene.glb --json report.json");
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_TRUE(outcome.errors.empty());
  EXPECT_NE(outcome.output.find("12 objects"), std::string::npos);
  EXPECT_NO_THROW(asset::loadGltf(folder_ / "scene.glb"));
  const auto report = nlohmann::json::parse(textOf(folder_ / "report.json"));
  EXPECT_EQ(report["objects"], 12);
  EXPECT_EQ(report["seed"], 5);
  EXPECT_EQ(report["triangles_full"], 12 * 128);
  EXPECT_TRUE(report["occluder"].is_null());
  EXPECT_EQ(report["bounds"]["min"].size(), 3U);
  EXPECT_EQ(report["camera_frames"], 1800);
}

TEST_F(ScatterProgram, AShareOfTheObjectsMoves) {
  const Outcome outcome = run("ball.glb --count 200 --moving 0.5 -o scene.glb --json report.json");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const auto report = nlohmann::json::parse(textOf(folder_ / "report.json"));
  EXPECT_NEAR(report["moving"].get<double>(), 100.0, 25.0);
  EXPECT_NE(outcome.output.find(" of them moving"), std::string::npos);
  const tinygltf::Model model = asset::loadGltf(folder_ / "scene.glb");
  EXPECT_EQ(model.animations.at(0).channels.size(), report["moving"].get<std::size_t>());
  EXPECT_EQ(run("ball.glb --count 20 --moving 2 -o none.glb").code, 2);
  EXPECT_EQ(run("ball.glb --count 20 --moving nan -o none.glb").code, 2);
}

TEST_F(ScatterProgram, SaysWhatIsLeftOutInOneLineAKind) {
  ASSERT_EQ(run("ball.glb --count 3 -o crowd.glb").code, 0);
  const Outcome outcome = run("crowd.glb --count 2 -o crowds.glb --json report.json");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.errors,
            "jalousie-scatter: warning: crowd.glb: not scattered: 2 animation channels\n"
            "jalousie-scatter: warning: crowd.glb: not scattered: 1 cameras\n");
  EXPECT_NE(outcome.output.find("2 objects of 3 meshes"), std::string::npos) << outcome.output;
  const auto report = nlohmann::json::parse(textOf(folder_ / "report.json"));
  EXPECT_EQ(report["meshes_per_object"], 3);
  EXPECT_EQ(report["ignored"]["cameras"], 1);
  EXPECT_TRUE(run("crowd.glb --count 2 -o crowds.glb --quiet").errors.empty());
}

TEST_F(ScatterProgram, InstancesOfAllMeshesHaveALimit) {
  ASSERT_EQ(run("ball.glb --count 5000 -o crowd.glb").code, 0);
  const Outcome outcome = run("crowd.glb --count 5000 -o crowds.glb");
  EXPECT_EQ(outcome.code, static_cast<int>(ErrorCode::kLimit));
  EXPECT_NE(outcome.errors.find("5000 objects of 5000 meshes"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(written("crowds.glb"));
}

TEST_F(ScatterProgram, RunningTwiceGivesTheSameBytes) {
  EXPECT_EQ(run("ball.glb --preset thesis-5001 -o a.glb").code, 0);
  EXPECT_EQ(run("ball.glb --preset thesis-5001 -o b.glb").code, 0);
  EXPECT_EQ(textOf(folder_ / "a.glb"), textOf(folder_ / "b.glb"));
}

TEST_F(ScatterProgram, QuietSaysNothing) {
  const Outcome outcome = run("ball.glb --count 2 --quiet -o scene.glb");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.output.empty());
  EXPECT_TRUE(outcome.errors.empty());
}

TEST_F(ScatterProgram, HelpShowsExamples) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.output.find("Examples:"), std::string::npos);
  EXPECT_NE(outcome.output.find("--occluder"), std::string::npos);
}

TEST_F(ScatterProgram, FailuresAreOneLineACodeAndNoFile) {
  folder_.write("broken.glb", "glTF");
  folder_.write("empty.gltf", R"({"asset":{"version":"2.0"}})");
  const std::vector<std::pair<std::string, ErrorCode>> cases = {
      {"absent.glb --count 2 -o out.glb", ErrorCode::kFileNotFound},
      {"broken.glb --count 2 -o out.glb", ErrorCode::kMalformed},
      {"empty.gltf --count 2 -o out.glb", ErrorCode::kUnsupported},
      {". --count 2 -o out.glb", ErrorCode::kFileUnreadable},
      {"ball.glb --count 2 -o absent/out.glb", ErrorCode::kWriteFailed},
      {"ball.glb --count 0 -o out.glb", ErrorCode::kUsage},
      {"ball.glb --count 2", ErrorCode::kUsage},
      {"", ErrorCode::kUsage},
  };
  for (const auto& [arguments, code] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, static_cast<int>(code)) << arguments;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    EXPECT_TRUE(outcome.errors.starts_with("jalousie-scatter: ")) << outcome.errors;
    EXPECT_FALSE(written("out.glb")) << arguments;
  }
}

TEST_F(ScatterProgram, ErrorsNameTheFileOnce) {
  folder_.write("empty.gltf", R"({"asset":{"version":"2.0"}})");
  for (const char* name : {"absent.glb", "empty.gltf"}) {
    const std::string errors = run(std::string(name) + " --count 2 -o out.glb").errors;
    const std::size_t first = errors.find(name);
    ASSERT_NE(first, std::string::npos) << errors;
    EXPECT_EQ(errors.find(name, first + 1), std::string::npos) << errors;
  }
}

}  // namespace
}  // namespace jalousie
