// What the program refuses because of memory: before it allocates, with the reason and the option in one line.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "asset/accessor.h"
#include "asset/camera_write.h"
#include "asset/gltf_file.h"
#include "asset/image_io.h"
#include "support/gl_test.h"
#include "support/run_program.h"
#include "support/scene_writer.h"
#include "support/scenes.h"

namespace jalousie {
namespace {

using test::ProgramResult;

constexpr std::uint64_t kMiB = 1ULL << 20U;

class MemoryLimits : public test::GlTest {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// A box whose nodes have `count` instances each, through one accessor without data.
  std::string writeInstances(int nodes, std::size_t count, const std::string& name = "instances.glb") const {
    tinygltf::Model model = test::emptyModel();
    const int mesh = test::addMesh(model, test::box(glm::vec3(1.0F)));
    tinygltf::Accessor zeros;
    zeros.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    zeros.type = TINYGLTF_TYPE_VEC3;
    zeros.count = count;
    model.accessors.push_back(zeros);
    const tinygltf::Value::Object attributes = {
        {"TRANSLATION", tinygltf::Value(static_cast<int>(model.accessors.size()) - 1)}};
    const tinygltf::Value value(tinygltf::Value::Object{{"attributes", tinygltf::Value(attributes)}});
    for (int i = 0; i < nodes; ++i) {
      const int node = test::addMeshNode(model, mesh);
      model.nodes[static_cast<std::size_t>(node)].extensions["EXT_mesh_gpu_instancing"] = value;
      model.scenes[0].nodes.push_back(node);
    }
    model.extensionsUsed = {"EXT_mesh_gpu_instancing"};
    asset::saveGlb(model, folder_ / name);
    return file(name);
  }

  static ProgramResult jalousie(const std::vector<std::string>& arguments) {
    return test::runProgram(JALOUSIE_PROGRAM, arguments);
  }

  /// One line with exit code 7 that names the file, what is needed, the limit and the option.
  static void expectRefused(const ProgramResult& result, const std::string& file, const std::string& what) {
    EXPECT_EQ(result.exitCode, 7) << result.standardError;
    const std::string& text = result.standardError;
    EXPECT_TRUE(text.starts_with("jalousie: " + file + ": needs about ")) << text;
    for (const std::string& part : {what, std::string("the limit is"), std::string("--max-memory lifts it")})
      EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
    EXPECT_EQ(text.find('\n'), text.size() - 1) << text;
    EXPECT_LT(result.peakBytes, 120 * kMiB) << "allocated before it refused";
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(MemoryLimits, SixteenMillionInstancesAreRefusedByEveryCommandThatReadsThem) {
  const std::string scene = writeInstances(4, std::size_t{1} << 22U);
  const ProgramResult render = jalousie({"render", scene, "-o", file("a.png")});
  expectRefused(render, scene, "for 16777216 instances");
  EXPECT_LT(render.cpuSeconds, 1.0);
  expectRefused(jalousie({"compare", scene, "-o", file("report")}), scene, "for 16777216 instances");
  expectRefused(jalousie({"record", scene, "-o", file("path.glb"), "--max-memory", "1G"}), scene,
                "for 16777216 instances");
  const std::string small = writeInstances(1, 2, "small.glb");
  const ProgramResult path = jalousie({"render", small, "-o", file("a.png"), "--path", scene, "--max-memory", "1G"});
  EXPECT_EQ(path.exitCode, 7);
  EXPECT_NE(path.standardError.find(scene + ": needs about "), std::string::npos) << path.standardError;
}

TEST_F(MemoryLimits, TheEstimateOfManyInstancesIsTheirPeak) {
  const std::string scene = writeInstances(1, 2'000'000);
  const auto count = [&](const std::string& limit) {
    return jalousie({"render", scene, "--stats-only", "-q", "--mode", "full", "--lod", "finest", "--size", "64x64",
                     "--max-memory", limit});
  };
  const ProgramResult counted = count("0");
  EXPECT_EQ(counted.exitCode, 0) << counted.standardError;
  const std::uint64_t mebibytes = counted.peakBytes / kMiB;
  EXPECT_EQ(count(std::to_string(mebibytes * 8 / 5) + "M").exitCode, 0) << "peak " << mebibytes << " MiB";
  expectRefused(count(std::to_string(mebibytes * 4 / 5) + "M"), scene, "2000000 instances");
}

TEST_F(MemoryLimits, PicturesThatAreTooLargeAreRefusedBeforeTheirTargetsAreMade) {
  const std::string scene = writeInstances(1, 2);
  expectRefused(jalousie({"render", scene, "-o", file("a.png"), "--size", "16384x16384"}), scene,
                "for 16384x16384 pixels");
  expectRefused(jalousie({"compare", scene, "-o", file("report"), "--size", "16384x16384"}), scene,
                "pictures and their errors");
}

TEST_F(MemoryLimits, DiffEstimatesFromTheHeaders) {
  const ImageRgba8 picture{3000, 2000, std::vector<std::uint8_t>(std::size_t{4} * 3000 * 2000, 90)};
  asset::savePng(picture, file("a.png"));
  expectRefused(jalousie({"diff", file("a.png"), file("a.png"), "--max-memory", "40M"}), file("a.png"),
                "Butteraugli of a tile");
  const ProgramResult compared = jalousie({"diff", file("a.png"), file("a.png")});
  EXPECT_EQ(compared.exitCode, 0) << compared.standardError;
  EXPECT_LT(compared.peakBytes, 420 * kMiB) << "the whole picture takes 480 MB for FLIP and 1.5 GB for Butteraugli";
}

TEST_F(MemoryLimits, CamerasShareTheirKeys) {
  tinygltf::Model model = test::emptyModel();
  model.scenes[0].nodes.push_back(test::addMeshNode(model, test::addMesh(model, test::box(glm::vec3(1.0F)))));
  asset::Camera camera;
  std::vector<float> times(50'000);
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = static_cast<float>(i) / 30.0F;
  camera.track.translationTimes = times;
  camera.track.translations = std::vector<glm::vec3>(times.size(), glm::vec3(0, 0, 5));
  const int first = asset::appendCamera(model, "camera", camera);
  model.scenes[0].nodes.push_back(first);
  for (int i = 0; i < 1000; ++i) {
    tinygltf::Node node;
    node.camera = model.nodes[static_cast<std::size_t>(first)].camera;
    model.nodes.push_back(node);
    model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()) - 1);
    tinygltf::AnimationChannel channel = model.animations[0].channels[0];
    channel.target_node = model.scenes[0].nodes.back();
    model.animations[0].channels.push_back(channel);
  }
  asset::saveGlb(model, file("cameras.glb"));
  const ProgramResult drawn = jalousie({"render", file("cameras.glb"), "-q", "-o", file("a.png"), "--size", "64x64"});
  EXPECT_EQ(drawn.exitCode, 0) << drawn.standardError;
  EXPECT_LT(drawn.peakBytes, 200 * kMiB) << "a thousand copies of the keys take 800 MB";
}

TEST_F(MemoryLimits, MoreMeshesThanARowOfWorkgroupsAreDrawn) {
  tinygltf::Model model = test::emptyModel();
  const int mesh = test::addMesh(model, test::box(glm::vec3(0.4F)));
  model.meshes.resize(65'600, model.meshes[static_cast<std::size_t>(mesh)]);
  for (int i = 0; i < 65'600; ++i)
    model.scenes[0].nodes.push_back(
        test::addMeshNode(model, i, {static_cast<double>(i % 256), std::floor(i / 256.0), 0.0}));
  asset::saveGlb(model, file("meshes.glb"));
  const ProgramResult counted =
      jalousie({"render", file("meshes.glb"), "--stats-only", "--mode", "full", "--lod", "finest", "--json", "-"});
  EXPECT_EQ(counted.exitCode, 0) << counted.standardError;
  EXPECT_NE(counted.standardOutput.find("65600"), std::string::npos) << counted.standardOutput;
  EXPECT_NE(counted.standardOutput.find("787200"), std::string::npos) << "triangles: " << counted.standardOutput;
}

}  // namespace
}  // namespace jalousie
