// The examples of docs/pipeline.md do what they say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

class Pipeline : public testing::Test {
 protected:
  Pipeline() {
    fs::copy(fs::path(JALOUSIE_SOURCE_DIR) / "examples/pipeline", folder_.path(), fs::copy_options::recursive);
    fs::create_directory(folder_ / "models");
    write("models/rock.ply", test::spherePly(12, 6));
    write("models/tree.obj", "mtllib tree.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl bark\nf 1 2 3 4\n");
    write("models/tree.mtl", "newmtl bark\nKd 0.4 0.2 0.1\n");
    write("models/chair.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "meshes":[{"name":"chair","primitives":[{"attributes":{"POSITION":0}}]}],
      "buffers":[{"byteLength":36,"uri":"chair.bin"}],"bufferViews":[{"buffer":0,"byteLength":36}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}]})");
    write("models/chair.bin", triangle('\x3F'));
  }
  /// A triangle with an edge of 1 (exponent 0x3F) or longer.
  static std::string triangle(char exponent) {
    std::string bytes(36, '\0');
    for (const std::size_t at : {std::size_t{12}, std::size_t{28}}) {
      bytes[at + 2] = '\x80';
      bytes[at + 3] = exponent;
    }
    return bytes;
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  test::ProgramResult run(const std::string& program, const std::vector<std::string>& arguments,
                          std::vector<std::string> environment = {}) const {
    environment.push_back("PATH=" + fs::path(JALOUSIE_BAKE_PROGRAM).parent_path().string() + ":" + std::getenv("PATH"));
    return test::runProgram(program, arguments, {.environment = environment, .folder = folder_.path()});
  }
  bool baked(const std::string& name) const { return fs::exists(folder_ / "baked" / name); }

  const test::TemporaryFolder folder_;
};

TEST_F(Pipeline, NinjaBakesWhatHasChanged) {
  if (!fs::exists("/usr/bin/ninja")) GTEST_SKIP() << "Ninja is not installed";
  const auto ninja = [&](std::vector<std::string> arguments = {}) { return run("/usr/bin/ninja", arguments); };
  const test::ProgramResult first = ninja();
  ASSERT_EQ(first.exitCode, 0) << first.standardOutput << first.standardError;
  EXPECT_TRUE(baked("chair.glb") && baked("tree.glb") && baked("rock.glb"));
  EXPECT_NE(ninja().standardOutput.find("no work to do"), std::string::npos);
  for (const auto& [file, text, output] :
       {std::tuple("models/chair.bin", triangle('\x40'), "bake baked/chair.glb"),
        {"models/tree.mtl", std::string("newmtl bark\nKd 1 1 1\n"), "bake baked/tree.glb"}}) {
    fs::last_write_time(folder_ / "baked/chair.glb", fs::file_time_type::clock::now() - std::chrono::hours(1));
    fs::last_write_time(folder_ / "baked/tree.glb", fs::file_time_type::clock::now() - std::chrono::hours(1));
    ninja();
    write(file, text);
    fs::last_write_time(folder_ / file, fs::file_time_type::clock::now() + std::chrono::seconds(2));
    const std::string said = ninja().standardOutput;
    EXPECT_NE(said.find(output), std::string::npos) << file << ": " << said;
    EXPECT_NE(said.find("[1/1]"), std::string::npos) << "and nothing else: " << said;
    fs::last_write_time(folder_ / file, fs::file_time_type::clock::now() - std::chrono::hours(2));
    ninja();
  }
  write("models/rock.ply", "ply\n");
  fs::last_write_time(folder_ / "models/rock.ply", fs::file_time_type::clock::now() + std::chrono::seconds(2));
  EXPECT_NE(ninja().exitCode, 0);
}

TEST_F(Pipeline, ParallelLogsEveryExitCode) {
  if (!fs::exists("/usr/bin/parallel")) GTEST_SKIP() << "GNU parallel is not installed";
  write("models/broken.ply", "ply\nformat ascii 1.0\n");
  fs::create_directory(folder_ / "models/old");
  write("models/old/rock.ply", test::spherePly(8, 5));
  const test::ProgramResult result = run("/bin/sh", {"parallel.sh", "models", "baked"});
  EXPECT_EQ(result.exitCode, 1) << "one job failed: " << result.standardError;
  EXPECT_TRUE(baked("chair.glb") && baked("tree.glb") && baked("rock.glb"));
  EXPECT_TRUE(baked("old/rock.glb")) << "files of one name stay apart";
  EXPECT_FALSE(baked("broken.glb"));
  EXPECT_EQ(result.standardOutput, "exit code 5: ./broken.ply\n");
}

TEST_F(Pipeline, SlurmTasksShareTheWork) {
  write("files", "models/rock.ply\nmodels/tree.obj\nmodels/chair.gltf\nmodels/missing.glb\n");
  const auto task = [&](const std::string& id, const std::string& count = "2") {
    return run("/bin/sh", {"bake.slurm", "files", "baked"},
               {"SLURM_ARRAY_TASK_ID=" + id, "SLURM_ARRAY_TASK_COUNT=" + count, "SLURM_ARRAY_TASK_MIN=0",
                "SLURM_CPUS_PER_TASK=1"});
  };
  EXPECT_EQ(task("9", "10").exitCode, 0) << "more tasks than files";
  const test::ProgramResult whole = task("0");
  EXPECT_EQ(whole.exitCode, 0) << whole.standardError;
  EXPECT_TRUE(baked("models/rock.glb") && baked("models/chair.glb"));
  EXPECT_FALSE(baked("models/tree.glb"));
  EXPECT_EQ(task("1").exitCode, 11) << "a file is missing";
  EXPECT_TRUE(baked("models/tree.glb"));
  const nlohmann::json report = nlohmann::json::parse(std::ifstream(folder_ / "baked/report-1.json"));
  EXPECT_EQ(report["files"][1]["error"]["code"], 3);
  fs::remove(folder_ / "baked/models/tree.glb");
  task("1");
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(folder_ / "baked/report-1.json"))["summary"]["cached"], 1);
}

}  // namespace
}  // namespace jalousie
