// One node for each room, one for each kind of thing with an instance for each, and the camera.
#include "wad/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "asset/accessor.h"
#include "asset/camera_write.h"
#include "asset/instancing.h"
#include "asset/scene_rooms.h"
#include "core/error.h"
#include "wad/level_mesh.h"
#include "wad/texture_colors.h"
#include "wad/walk_path.h"

namespace jalousie::wad {
namespace {

using tinygltf::Model;

constexpr std::array<std::uint32_t, 19> kMonsters = {7,  9,  16, 58,   64,   65,   66,   67,   68,  69,
                                                     71, 72, 84, 3001, 3002, 3003, 3004, 3005, 3006};
/// Starts of players and of teleporters, which show nothing.
constexpr std::array<std::uint32_t, 6> kPlaces = {1, 2, 3, 4, 11, 14};

bool isAmong(std::span<const std::uint32_t> types, std::uint32_t type) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

class LevelDocument {
 public:
  LevelDocument(const WadFile& wad, const Level& level, const LevelPlan& plan)
      : level_(level), plan_(plan), colors_(wad) {
    result_.model.asset.version = "2.0";
    result_.model.asset.generator = "jalousie-wad";
    scene_.name = level.name;
  }

  ConvertedLevel make(const std::vector<RoomMesh>& meshes) {
    for (std::size_t room = 0; room < meshes.size(); ++room)
      addRoom(plan_.plan.rooms[room].name, meshes[room]);
    addThings("monster", {10.0F, 28.0F}, {0.45F, 0.1F, 0.08F}, true);
    addThings("item", {6.0F, 7.0F}, {0.1F, 0.25F, 0.5F}, false);
    addCamera();
    asset::setRooms(scene_, plan_.plan);
    result_.model.scenes.push_back(std::move(scene_));
    result_.model.defaultScene = 0;
    return std::move(result_);
  }

 private:
  Model& model() { return result_.model; }

  int addNode(const std::string& name, int mesh) {
    tinygltf::Node node;
    node.name = name;
    node.mesh = mesh;
    model().nodes.push_back(std::move(node));
    scene_.nodes.push_back(static_cast<int>(model().nodes.size()) - 1);
    return scene_.nodes.back();
  }

  int addMaterial(const std::string& name, const glm::vec3& color) {
    const auto [known, isNew] = materials_.try_emplace(name, static_cast<int>(model().materials.size()));
    if (!isNew) return known->second;
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {color.x, color.y, color.z, 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    model().materials.push_back(std::move(material));
    return known->second;
  }

  /// Sectors in the dark keep a quarter of the light, so that pictures show something.
  int materialOf(const SurfaceLook& look) {
    const float light = 0.25F + 0.75F * static_cast<float>(look.light) / 255.0F;
    const glm::vec3 color = look.isWall ? colors_.wall(look.texture) : colors_.flat(look.texture);
    return addMaterial(fmt::format("{} {} {}", look.isWall ? "wall" : "flat", look.texture, look.light),
                       glm::min(1.5F * light * color, glm::vec3(1.0F)));
  }

  tinygltf::Primitive primitiveOf(const Surface& surface, int material) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = asset::appendVec3(model(), surface.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["NORMAL"] = asset::appendVec3(model(), surface.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.indices = asset::appendIndices(model(), surface.indices);
    primitive.material = material;
    return primitive;
  }

  void addRoom(const std::string& name, const RoomMesh& surfaces) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    for (const auto& [look, surface] : surfaces) {
      if (surface.indices.empty()) continue;
      mesh.primitives.push_back(primitiveOf(surface, materialOf(look)));
      result_.summary.triangles += surface.indices.size() / 3;
    }
    if (mesh.primitives.empty()) return;
    model().meshes.push_back(std::move(mesh));
    addNode(name, static_cast<int>(model().meshes.size()) - 1);
  }

  /// A box that stands on the floor. @param half  of its width, and of its height, units of the level
  static Surface boxOf(const glm::vec2& half) {
    const glm::vec3 size(glm::vec3(half.x, half.y, half.x) / static_cast<float>(kUnits));
    Surface box;
    for (int axis = 0; axis < 3; ++axis) {
      for (const float sign : {-1.0F, 1.0F}) {
        glm::vec3 normal(0.0F);
        normal[axis] = sign;
        glm::vec3 u(0.0F);
        u[(axis + 1) % 3] = 1.0F;
        const glm::vec3 v = glm::cross(normal, u);
        const auto first = static_cast<std::uint32_t>(box.positions.size());
        for (const glm::vec3& corner : {normal - u - v, normal + u - v, normal + u + v, normal - u + v}) {
          box.positions.push_back((corner + glm::vec3(0.0F, 1.0F, 0.0F)) * size);
          box.normals.push_back(normal);
        }
        for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U})
          box.indices.push_back(first + index);
      }
    }
    return box;
  }

  void addThings(const std::string& name, const glm::vec2& half, const glm::vec3& color, bool monsters) {
    asset::Instances instances;
    for (const Thing& thing : level_.things) {
      if (isAmong(kPlaces, thing.type) || isAmong(kMonsters, thing.type) != monsters) continue;
      const std::optional<double> floor = floorAt(plan_, glm::dvec2(thing.place));
      if (!floor) continue;
      instances.translations.emplace_back(sceneFromLevel(glm::dvec2(thing.place), *floor));
      instances.rotations.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
      instances.scales.emplace_back(1.0F);
    }
    if (instances.translations.empty()) return;
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(primitiveOf(boxOf(half), addMaterial(name, color)));
    model().meshes.push_back(std::move(mesh));
    const int node = addNode(name, static_cast<int>(model().meshes.size()) - 1);
    model().nodes[static_cast<std::size_t>(node)].extensions["EXT_mesh_gpu_instancing"] =
        asset::appendInstances(model(), instances);
    result_.summary.things += instances.translations.size();
    result_.summary.triangles += 12 * instances.translations.size();
  }

  void addCamera() {
    const WalkPath path = walkThrough(level_, plan_);
    if (path.times.size() < 2) return;
    asset::Camera camera;
    camera.fovY = 0.9F;
    camera.zNear = 0.1F;
    camera.zFar = 4096.0F;  // the largest level is 65536 / 32 wide
    camera.track = {path.times, path.positions, path.times, path.rotations};
    scene_.nodes.push_back(asset::appendCamera(model(), "walk", camera));
    result_.summary.seconds = double{path.times.back()};
  }

  const Level& level_;
  const LevelPlan& plan_;
  TextureColors colors_;
  ConvertedLevel result_;
  tinygltf::Scene scene_;
  std::map<std::string, int> materials_;
};

}  // namespace

ConvertedLevel convertLevel(const WadFile& wad, const std::string& map, bool opensDoors) {
  Level level = readLevel(wad, map);
  const std::size_t opened = opensDoors ? openDoors(level) : 0;
  const SectorParts parts = divideSectors(level);
  const LevelPlan plan = planLevel(level, parts);
  if (plan.plan.empty())
    throw Error(ErrorCode::kUnsupported, fmt::format("level {} has no sector that is closed and has a height", map));
  if (const std::optional<std::string> fault = faultOf(plan.plan))
    throw Error(ErrorCode::kUnsupported, fmt::format("level {}: {}", map, *fault));
  ConvertedLevel result = LevelDocument(wad, level, plan).make(makeMeshes(level, parts, plan));
  Summary& summary = result.summary;
  summary.map = map;
  summary.lines = level.lines.size();
  summary.sectors = level.sectors.size();
  summary.rooms = plan.plan.rooms.size();
  summary.portals = plan.plan.portals.size();
  summary.openedDoors = opened;
  return result;
}

std::string reportLine(const Summary& summary) {
  return fmt::format("{}: {} rooms, {} portals, {} triangles, {} things, a walk of {:.0f} s", summary.map,
                     summary.rooms, summary.portals, summary.triangles, summary.things, summary.seconds);
}

std::string reportJson(const Summary& summary) {
  const nlohmann::ordered_json report = {{"map", summary.map},
                                         {"lines", summary.lines},
                                         {"sectors", summary.sectors},
                                         {"opened_doors", summary.openedDoors},
                                         {"rooms", summary.rooms},
                                         {"portals", summary.portals},
                                         {"triangles", summary.triangles},
                                         {"things", summary.things},
                                         {"walk_seconds", summary.seconds}};
  return report.dump(2) + "\n";
}

}  // namespace jalousie::wad
