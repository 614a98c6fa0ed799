// Nodes below nodes, bands of spheres that bend, and keys at random times.
#include "support/animated_model.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "core/random.h"
#include "support/scenes.h"

namespace jalousie::test {
namespace {

using asset::appendIndices;
using asset::appendScalars;
using asset::appendVec3;
using asset::appendVec4;

constexpr int kJoints = 4;

class Builder {
 public:
  explicit Builder(const AnimatedContent& content) : content_(content), random_(content.seed) {}

  tinygltf::Model build() {
    model_.asset.version = "2.0";
    tinygltf::Node root;
    root.translation = {content_.place.x, content_.place.y, content_.place.z};
    model_.nodes.push_back(root);
    tinygltf::Scene scene;
    scene.nodes = {0};
    model_.scenes = {scene};
    model_.defaultScene = 0;
    for (int i = 0; i < content_.nodes; ++i)
      addRigid();
    for (int i = 0; i < content_.skinned; ++i)
      addSkinned();
    for (int i = 0; i < content_.morphed; ++i)
      addMorphed();
    return std::move(model_);
  }

 private:
  glm::vec3 randomPoint(float reach) {
    const float x = random_.uniform(-reach, reach);
    const float y = random_.uniform(-reach, reach);
    return {x, y, random_.uniform(-reach, reach)};
  }

  glm::quat randomTurn() {
    const glm::vec3 v = randomPoint(1.0F);
    return glm::normalize(glm::quat(random_.uniform(-1.0F, 1.0F), v.x, v.y, v.z + 0.01F));
  }

  int addNode(int parent) {
    const int index = static_cast<int>(model_.nodes.size());
    const glm::vec3 at = randomPoint(4.0F);
    const glm::quat turn = randomTurn();
    tinygltf::Node node;
    node.translation = {at.x, at.y, at.z};
    node.rotation = {turn.x, turn.y, turn.z, turn.w};
    const float mirror = random_.below(4) == 0 ? -1.0F : 1.0F;
    node.scale = {mirror * random_.uniform(0.6F, 1.2F), random_.uniform(0.6F, 1.2F), random_.uniform(0.6F, 1.2F)};
    model_.nodes.push_back(node);
    model_.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
    return index;
  }

  std::vector<float> times() {
    std::vector<float> times;
    for (float t = random_.uniform(0.0F, 0.5F); t < kAnimatedSeconds; t += random_.uniform(0.1F, 0.9F))
      times.push_back(t);
    times.push_back(kAnimatedSeconds);
    return times;
  }

  /// Adds a channel; values are made one after another, three for each key of a spline.
  template <class Make>
  void animate(int node, const char* path, std::size_t width, const Make& make) {
    static const char* const kWays[] = {"LINEAR", "STEP", "CUBICSPLINE"};
    const std::string way = kWays[random_.below(3)];
    const std::vector<float> keys = times();
    std::vector<float> values;
    for (std::size_t i = 0; i < keys.size() * (way == "CUBICSPLINE" ? 3 : 1); ++i)
      make(values, way == "CUBICSPLINE" && i % 3 != 1);
    tinygltf::Animation animation;
    tinygltf::AnimationSampler sampler;
    sampler.input = appendScalars(model_, keys, 0);
    sampler.interpolation = way;
    sampler.output = appendScalars(model_, values, 0);
    tinygltf::Accessor& output = model_.accessors.back();
    if (width > 1) output.type = width == 3 ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4;
    output.count = values.size() / width;
    output.minValues.clear();
    output.maxValues.clear();
    animation.samplers.push_back(sampler);
    tinygltf::AnimationChannel channel;
    channel.sampler = 0;
    channel.target_node = node;
    channel.target_path = path;
    animation.channels.push_back(channel);
    model_.animations.push_back(animation);
  }

  void moveNode(int node) {
    const auto vector = [this](float low, float high) {
      return [this, low, high](std::vector<float>& values, bool isTangent) {
        for (int k = 0; k < 3; ++k)
          values.push_back(isTangent ? random_.uniform(-0.5F, 0.5F) : random_.uniform(low, high));
      };
    };
    if (random_.below(2) == 0) animate(node, "translation", 3, vector(-4.0F, 4.0F));
    if (random_.below(2) == 0) {
      animate(node, "rotation", 4, [this](std::vector<float>& values, bool isTangent) {
        const glm::quat q = isTangent ? glm::quat(0.1F, 0.1F, -0.1F, 0.2F) : randomTurn();
        values.insert(values.end(), {q.x, q.y, q.z, q.w});
      });
    }
    if (random_.below(2) == 0) animate(node, "scale", 3, vector(0.5F, 1.5F));
  }

  int addMesh(std::uint32_t segments, bool skinned, int targets) {
    const asset::Primitive sphere = test::sphere(segments, segments / 2);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = appendVec3(model_, sphere.positions, 0);
    if (!content_.flat) primitive.attributes["NORMAL"] = appendVec3(model_, sphere.normals, 0);
    primitive.indices = appendIndices(model_, sphere.indices);
    if (skinned) addInfluences(primitive, sphere.positions);
    for (int target = 0; target < targets; ++target)
      addTarget(primitive, sphere.positions);
    tinygltf::Mesh mesh;
    mesh.primitives = {primitive};
    model_.meshes.push_back(mesh);
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  void addInfluences(tinygltf::Primitive& primitive, const std::vector<glm::vec3>& positions) {
    std::vector<std::uint8_t> joints;
    std::vector<glm::vec4> weights;
    for (const glm::vec3& p : positions) {
      const float along = (p.y + 1.0F) / 2.0F * (kJoints - 1);
      const float first = std::min(std::floor(along), static_cast<float>(kJoints - 2));
      const auto lower = static_cast<std::uint8_t>(first);
      joints.insert(joints.end(), {lower, static_cast<std::uint8_t>(lower + 1), 0, 0});
      weights.emplace_back(1.0F - (along - first), along - first, 0.0F, 0.0F);
    }
    tinygltf::Accessor accessor;
    accessor.bufferView = asset::appendView(model_, std::as_bytes(std::span(joints)), 0);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    accessor.type = TINYGLTF_TYPE_VEC4;
    accessor.count = joints.size() / 4;
    model_.accessors.push_back(accessor);
    primitive.attributes["JOINTS_0"] = static_cast<int>(model_.accessors.size()) - 1;
    primitive.attributes["WEIGHTS_0"] = appendVec4(model_, weights, 0);
  }

  void addTarget(tinygltf::Primitive& primitive, const std::vector<glm::vec3>& positions) {
    std::vector<glm::vec3> offsets;
    std::vector<glm::vec3> normals;
    const glm::vec3 way = randomPoint(1.0F);
    for (const glm::vec3& p : positions) {
      offsets.push_back(p.y > 0.0F ? p.y * way : glm::vec3(0.0F));
      normals.push_back(0.3F * way * p.x);
    }
    std::map<std::string, int> target = {{"POSITION", appendVec3(model_, offsets, 0)}};
    if (!content_.flat) target["NORMAL"] = appendVec3(model_, normals, 0);
    primitive.targets.push_back(target);
  }

  /// Gives a node its mesh, and a coarser level. @return  the node of the level, or -1
  int show(int node, bool skinned, int targets) {
    const auto index = static_cast<std::size_t>(node);
    model_.nodes[index].mesh = addMesh(12, skinned, targets);
    if (!content_.levels) return -1;
    tinygltf::Node level = model_.nodes[index];
    level.children.clear();
    level.mesh = addMesh(6, skinned, targets);
    asset::LodInfo info;
    info.lod = 1;
    info.errorObject = 0.1;
    info.measures.emplace();
    asset::setLodInfo(model_.meshes[static_cast<std::size_t>(level.mesh)], info);
    model_.nodes.push_back(level);
    const int lower = static_cast<int>(model_.nodes.size()) - 1;
    const std::vector<float> coverage = {0.5F, 0.1F};
    asset::setLodChain(model_, node, std::vector<int>{lower}, coverage);
    return lower;
  }

  void addRigid() {
    const int node = addNode(parents_[random_.below(static_cast<std::uint32_t>(parents_.size()))]);
    parents_.push_back(node);
    if (random_.below(2) == 0) moveNode(node);
    show(node, false, 0);
    if (content_.loose) addLoose(model_.nodes[static_cast<std::size_t>(node)].mesh);
  }

  void addLoose(int mesh) {
    const std::vector<glm::vec3> positions = {randomPoint(2.0F), randomPoint(2.0F), randomPoint(2.0F)};
    for (const int mode : {TINYGLTF_MODE_POINTS, TINYGLTF_MODE_LINE_STRIP}) {
      tinygltf::Primitive primitive;
      primitive.mode = mode;
      primitive.attributes["POSITION"] = appendVec3(model_, positions, 0);
      model_.meshes[static_cast<std::size_t>(mesh)].primitives.push_back(primitive);
    }
  }

  void addSkinned() {
    tinygltf::Skin skin;
    int parent = 0;
    for (int j = 0; j < kJoints; ++j) {
      parent = addNode(parent);
      skin.joints.push_back(parent);
      moveNode(parent);
    }
    model_.skins.push_back(skin);
    const int node = addNode(0);
    const int lower = show(node, true, 1);
    for (const int shown : {node, lower}) {
      if (shown < 0) continue;
      model_.nodes[static_cast<std::size_t>(shown)].skin = static_cast<int>(model_.skins.size()) - 1;
      model_.nodes[static_cast<std::size_t>(shown)].weights = {0.4};
    }
  }

  void addMorphed() {
    const int node = addNode(0);
    if (random_.below(2) == 0) moveNode(node);
    const int lower = show(node, false, 2);
    const auto two = [this](std::vector<float>& values, bool) {
      values.push_back(random_.uniform(-1.0F, 1.0F));
      values.push_back(random_.uniform(0.0F, 1.0F));
    };
    animate(node, "weights", 1, two);
    if (lower >= 0) {
      tinygltf::AnimationChannel channel = model_.animations.back().channels.front();
      channel.target_node = lower;
      model_.animations.back().channels.push_back(channel);
    }
  }

  AnimatedContent content_;
  Random random_;
  std::vector<int> parents_ = {0};  ///< nodes of the hierarchy, without levels
  tinygltf::Model model_;
};

}  // namespace

tinygltf::Model animatedModel(const AnimatedContent& content) {
  return Builder(content).build();
}

}  // namespace jalousie::test
