// What the tools write passes the Khronos glTF validator without an error.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "support/node.h"
#include "support/run_program.h"
#include "support/scenes.h"
#include "support/source_root.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

class Validator : public testing::Test {
 protected:
  void SetUp() override {
    node_ = test::findNode();
    if (!node_) GTEST_SKIP() << "Node.js is not installed";
    if (!fs::exists(test::kSourceRoot / "assets/fetched/gltf-validator/package.json"))
      GTEST_SKIP() << "the validator is not here; assets/fetch validator gets it from the npm registry";
    std::ofstream(folder_ / "ball.ply") << test::spherePly(32, 16);
    ASSERT_EQ(test::runProgram(JALOUSIE_BAKE_PROGRAM, {file("ball.ply"), "-o", file("ball.glb"), "--subdivide", "1"})
                  .exitCode,
              0);
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  void expectNoErrors(const std::string& name) {
    const test::ProgramResult result =
        test::runProgram(*node_, {(test::kSourceRoot / "tests/project/validate.js").string(),
                                  (test::kSourceRoot / "assets/fetched/gltf-validator").string(), file(name)});
    ASSERT_EQ(result.exitCode, 0) << result.standardError;
    const nlohmann::json issues = nlohmann::json::parse(result.standardOutput);
    EXPECT_EQ(issues["numErrors"], 0) << issues.dump(2);
    EXPECT_EQ(issues["numWarnings"], 0) << issues.dump(2);
  }

 private:
  std::optional<fs::path> node_;
  test::TemporaryFolder folder_;
};

TEST_F(Validator, AcceptsABakedFile) {
  expectNoErrors("ball.glb");
}

TEST_F(Validator, AcceptsQuantisedAndCompressedFiles) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--quantize"}, {"--compress"}, {"--quantize", "--compress"}}) {
    std::vector<std::string> arguments = {file("ball.ply"), "-o", file("small.glb"), "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ASSERT_EQ(test::runProgram(JALOUSIE_BAKE_PROGRAM, arguments).exitCode, 0);
    expectNoErrors("small.glb");
  }
}

TEST_F(Validator, AcceptsABakedObjWithMaterials) {
  std::ofstream(file("two.mtl")) << "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nd 0.5\n";
  std::ofstream(file("two.obj")) << "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nusemtl red\n"
                                    "f 1/1 2/1 3/2 4/2\nusemtl blue\nf 4 3 2 1\n";
  ASSERT_EQ(test::runProgram(JALOUSIE_BAKE_PROGRAM, {file("two.obj"), "-o", file("two.glb")}).exitCode, 0);
  expectNoErrors("two.glb");
}

TEST_F(Validator, AcceptsScatteredScenesWithCameraPathAndOccluder) {
  ASSERT_EQ(test::runProgram(JALOUSIE_SCATTER_PROGRAM, {file("ball.glb"), "--count", "50", "--rotate", "any", "--scale",
                                                        "0.5,2", "-o", file("many.glb")})
                .exitCode,
            0);
  expectNoErrors("many.glb");
  for (const char* kind : {"foliage", "grid", "fence", "plane"}) {
    ASSERT_EQ(test::runProgram(JALOUSIE_SCATTER_PROGRAM,
                               {file("ball.glb"), "--count", "1", "--occluder", kind, "-o", file("one.glb")})
                  .exitCode,
              0);
    expectNoErrors("one.glb");
  }
}

}  // namespace
}  // namespace jalousie
