// Assembles the output model: meshes of the chain, instances, occluder, camera and its animation.
#include "scatter/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "asset/accessor.h"
#include "asset/camera_write.h"
#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "asset/mesh_occluders.h"
#include "core/error.h"
#include "scatter/bounce.h"
#include "scatter/camera_path.h"
#include "scatter/city.h"
#include "scatter/city_path.h"
#include "scatter/layout.h"
#include "scatter/occluder.h"
#include "scatter/source_asset.h"

namespace jalousie::scatter {
namespace {

using tinygltf::Model;

/// Planes of the camera, relative to the object's radius and to the farthest thing in sight.
constexpr float kNearShare = 0.02F;
constexpr float kFarShare = 1.5F;

/// Everything but nodes, scenes, cameras and animations.
Model withoutNodes(Model&& input) {
  Model model;
  model.asset = input.asset;
  model.asset.generator = "jalousie-scatter";
  model.buffers = std::move(input.buffers);
  model.bufferViews = std::move(input.bufferViews);
  model.accessors = std::move(input.accessors);
  model.materials = std::move(input.materials);
  model.textures = std::move(input.textures);
  model.images = std::move(input.images);
  model.samplers = std::move(input.samplers);
  model.extensions = std::move(input.extensions);
  model.extensions.erase(kLights);
  model.extensionsUsed = std::move(input.extensionsUsed);
  std::erase(model.extensionsUsed, kLights);
  std::erase(model.extensionsUsed, "MSFT_lod");
  std::erase(model.extensionsUsed, "EXT_mesh_gpu_instancing");
  model.extensionsRequired = std::move(input.extensionsRequired);
  return model;
}

int addNode(Model& model, const std::string& name, int mesh) {
  tinygltf::Node node;
  node.name = name;
  node.mesh = mesh;
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

std::vector<double> numbers(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

/// Adds the meshes of an asset to the output, each once.
class Objects {
 public:
  /// @param meshes  of the input
  Objects(Model& model, const std::vector<tinygltf::Mesh>& meshes) : model_(model), meshes_(meshes) {}

  /// Adds the nodes of a part's chain; all levels share the instance accessors. @return  the node of LOD 0
  int add(const SourcePart& part, const std::string& name, const asset::Instances& instances) {
    const tinygltf::Value instancing = asset::appendInstances(model_, instances);
    std::vector<int> nodes;
    for (std::size_t lod = 0; lod < part.meshes.size(); ++lod) {
      const int mesh = meshOf(part.meshes[lod]);
      nodes.push_back(addNode(model_, lod == 0 ? name : fmt::format("{} lod {}", name, lod), mesh));
      model_.nodes.back().extensions["EXT_mesh_gpu_instancing"] = instancing;
      if (lod == 0) model_.nodes.back().weights = part.weights;
    }
    return link(nodes, part);
  }

  /// Adds the nodes of a chain with a pose of their own. @return  the node of LOD 0
  int addChain(const SourcePart& part, const std::string& name, const Pose& pose) {
    std::vector<int> nodes;
    for (std::size_t lod = 0; lod < part.meshes.size(); ++lod) {
      nodes.push_back(addNode(model_, lod == 0 ? name : fmt::format("{} lod {}", name, lod), meshOf(part.meshes[lod])));
      tinygltf::Node& node = model_.nodes.back();
      node.translation = numbers(pose.translation);
      node.rotation = {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w};
      node.scale = numbers(pose.scale);
      if (lod == 0) node.weights = part.weights;
    }
    return link(nodes, part);
  }

 private:
  int link(const std::vector<int>& nodes, const SourcePart& part) {
    std::vector<int> lower(nodes.begin() + 1, nodes.end());
    if (part.endsInNothing) {
      const std::string& name = model_.nodes[static_cast<std::size_t>(nodes[0])].name;
      lower.push_back(addNode(model_, fmt::format("{} lod {}", name, nodes.size()), -1));
    }
    std::vector<float> coverage = part.coverage;
    if (!coverage.empty()) coverage.resize(lower.size() + 1, 0.0F);
    asset::setLodChain(model_, nodes[0], lower, coverage);
    return nodes[0];
  }

  int meshOf(int source) {
    const auto [place, isNew] = known_.try_emplace(source, static_cast<int>(model_.meshes.size()));
    if (isNew) model_.meshes.push_back(meshes_[static_cast<std::size_t>(source)]);
    return place->second;
  }

  Model& model_;
  const std::vector<tinygltf::Mesh>& meshes_;
  std::map<int, int> known_;  ///< of the input to the output
};

/// Adds objects that move, each as nodes of its own: EXT_mesh_gpu_instancing has no animated instances.
class Movers {
 public:
  /// @param halfSide  of the cube, world units
  Movers(Model& model, Objects& objects, const SourceAsset& source, float halfSide)
      : model_(model), objects_(objects), source_(source), halfSide_(halfSide) {
    animation_.name = "bouncing";
  }

  /// @return  the node that moves
  int add(const Placement& placed, const glm::dvec3& velocity) {
    const auto mover = static_cast<int>(model_.nodes.size());
    model_.nodes.emplace_back();
    std::vector<int> children;
    for (const SourcePart& part : source_.parts)
      for (const Pose& pose : part.poses)
        children.push_back(objects_.addChain(part, fmt::format("moving {}", mover),
                                             {pose.translation - source_.center, pose.rotation, pose.scale}));
    tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(mover)];
    node.name = "mover";
    node.children = std::move(children);
    node.translation = numbers(placed.place);
    node.rotation = {placed.turn.x, placed.turn.y, placed.turn.z, placed.turn.w};
    node.scale = numbers(glm::vec3(placed.factor));
    animate(mover, bouncePath(placed.place, velocity, halfSide_, kLastSecond));
    return mover;
  }

  void finish() { model_.animations.push_back(std::move(animation_)); }

 private:
  static constexpr double kLastSecond = double{kFrameCount - 1} / kFramesPerSecond;

  void animate(int node, const BouncePath& path) {
    tinygltf::AnimationSampler sampler;
    sampler.input = asset::appendScalars(model_, path.times, 0);
    sampler.output = asset::appendVec3(model_, path.positions, 0);
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation_.samplers.size());
    channel.target_node = node;
    channel.target_path = "translation";
    animation_.samplers.push_back(std::move(sampler));
    animation_.channels.push_back(std::move(channel));
  }

  Model& model_;
  Objects& objects_;
  const SourceAsset& source_;
  float halfSide_;
  tinygltf::Animation animation_;
};

/// Bounds of an object wherever the cube lets it be.
Aabb boundsOfMover(const SourceAsset& source, const Placement& placed, float halfSide) {
  Aabb box;
  for (const SourcePart& part : source.parts)
    box.add(boundsOf(instancesOf({{glm::vec3(0.0F), placed.turn, placed.factor}}, source, part), part.boxObject));
  return {box.min - halfSide, box.max + halfSide};
}

/// Adds all objects that move, and leaves the others. @return  the nodes of the movers
std::vector<int> addMovers(Movers& movers, const SourceAsset& source, const Layout& layout,
                           std::vector<Placement>& placements, Summary& summary) {
  const std::vector<Mover> chosen = chooseMovers(layout, summary.side);
  if (chosen.empty()) return {};
  std::vector<int> nodes;
  std::vector<bool> moves(placements.size(), false);
  for (const Mover& mover : chosen) {
    const Placement& placed = placements[mover.object];
    moves[mover.object] = true;
    nodes.push_back(movers.add(placed, mover.velocity));
    summary.boundsWorld.add(boundsOfMover(source, placed, 0.5F * summary.side));
  }
  movers.finish();
  summary.moving = static_cast<std::uint32_t>(chosen.size());
  std::vector<Placement> resting;
  for (std::size_t i = 0; i < placements.size(); ++i)
    if (!moves[i]) resting.push_back(placements[i]);
  placements = std::move(resting);
  return nodes;
}

/// Adds all parts and their bounds. @return  their nodes
std::vector<int> addParts(Objects& objects, const SourceAsset& source, const std::vector<Placement>& placements,
                          Summary& summary) {
  std::vector<int> nodes;
  for (const SourcePart& part : source.parts) {
    const asset::Instances instances = instancesOf(placements, source, part);
    const std::string name = source.isSingle() || part.name.empty() ? "objects" : part.name;
    nodes.push_back(objects.add(part, name, instances));
    summary.boundsWorld.add(boundsOf(instances, part.boxObject));
  }
  return nodes;
}

int addMaterial(Model& model, const std::string& name, const glm::vec3& color, bool doubleSided) {
  tinygltf::Material material;
  material.name = name;
  material.doubleSided = doubleSided;
  material.pbrMetallicRoughness.baseColorFactor = {color.x, color.y, color.z, 1.0};
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

/// Adds a mesh with a material of its own. @return  its index
int addMesh(Model& model, const PlainMesh& geometry, const std::string& name, const glm::vec3& color,
            bool doubleSided = true) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, geometry.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, geometry.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, geometry.indices);
  primitive.material = addMaterial(model, name, color, doubleSided);
  tinygltf::Mesh mesh;
  mesh.name = name;
  mesh.primitives.push_back(std::move(primitive));
  model.meshes.push_back(std::move(mesh));
  return static_cast<int>(model.meshes.size()) - 1;
}

/// Adds the occluder's mesh and node; nullopt if nothing is covered.
std::optional<int> addOccluder(Model& model, const Occluder& occluder, const PathSubject& subject, std::uint64_t seed,
                               Summary& summary) {
  const OccluderPlace place = placeOccluder(subject);
  const PlainMesh geometry = makeOccluder(occluder, place.halfSize, seed);
  if (geometry.indices.empty()) return std::nullopt;
  const glm::vec3 color =
      occluder.kind == OccluderKind::kFoliage ? glm::vec3(0.1F, 0.3F, 0.06F) : glm::vec3(0.3F, 0.25F, 0.2F);
  const glm::vec3 position(0.0F, 0.0F, place.distance);
  const int node = addNode(model, "occluder", addMesh(model, geometry, occluderName(occluder.kind), color));
  model.nodes.back().translation = numbers(position);
  summary.occluderTriangles = geometry.indices.size() / 3;
  summary.trianglesFull += summary.occluderTriangles;
  for (const glm::vec3& p : geometry.positions)
    summary.boundsWorld.add(p + position);
  return node;
}

/// Adds the ground under all objects. @param top  y, world units   @return  its node
int addGround(Model& model, const SourceAsset& source, const Layout& layout, float top, Summary& summary) {
  constexpr float kThickness = 0.1F;  // in diagonals of the object
  const float margin = layout.scale.max * source.diagonal;
  const float half = 0.5F * summary.side + margin;
  const float thickness = kThickness * source.diagonal;
  const PlainMesh geometry = makeSlab(half, thickness);
  const int node = addNode(model, "ground", addMesh(model, geometry, "ground", {0.25F, 0.3F, 0.2F}));
  model.nodes.back().translation = numbers({0.0F, top - 0.5F * thickness, 0.0F});
  model.nodes.back().rotation = {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};  // z becomes y
  summary.groundTriangles = geometry.indices.size() / 3;
  summary.trianglesFull += summary.groundTriangles;
  summary.boundsWorld.add(Aabb{{-half, top - thickness, -half}, {half, top, half}});
  return node;
}

/// Adds a camera. @param farthest  distance of what it sees, world units   @return  its node
int addCamera(Model& model, const std::string& name, const CameraPath& path, float objectRadius, float farthest) {
  asset::Camera camera;
  camera.fovY = kFovY;
  camera.zNear = kNearShare * objectRadius;
  camera.zFar = kFarShare * farthest;
  camera.track = {path.times, path.positions, path.times, path.rotations};
  return asset::appendCamera(model, name, camera);
}

float reachOf(const Aabb& box) {
  return glm::length(glm::max(glm::abs(box.min), box.max));
}

/// Instances of the buildings of one design.
asset::Instances buildingsOf(const City& city, std::uint32_t design, float ground) {
  static const std::array<glm::quat, 4> kTurns = {
      glm::quat(1.0F, 0.0F, 0.0F, 0.0F), glm::quat(std::sqrt(0.5F), 0.0F, std::sqrt(0.5F), 0.0F),
      glm::quat(0.0F, 0.0F, 1.0F, 0.0F), glm::quat(std::sqrt(0.5F), 0.0F, -std::sqrt(0.5F), 0.0F)};
  asset::Instances instances;
  for (const Building& building : city.buildings) {
    if (building.design != design) continue;
    instances.translations.emplace_back(building.place.x, ground, building.place.y);
    instances.rotations.push_back(kTurns[building.quarterTurns]);
    instances.scales.emplace_back(1.0F);
  }
  return instances;
}

/// The mesh of a design, with its boxes as occluders. @return  its index
int addBuilding(Model& model, const City& city, std::uint32_t design) {
  PlainMesh geometry;
  std::vector<asset::Occluder> occluders;
  for (const Aabb& box : city.designs[design].boxes) {
    addBox(geometry, box);
    occluders.push_back({solidOf(box), 1});
  }
  const auto shade = static_cast<float>(design) / static_cast<float>(city.designs.size());
  const glm::vec3 color(0.45F + 0.3F * shade, 0.4F, 0.5F - 0.3F * shade);
  const int mesh = addMesh(model, geometry, fmt::format("building {}", design), color, /*doubleSided=*/false);
  asset::setOccluders(model.meshes[static_cast<std::size_t>(mesh)], occluders);
  return mesh;
}

/// Adds the buildings, one node for each design that is used. @param ground  y, world units   @return  the nodes
std::vector<int> addBuildings(Model& model, const City& city, float ground, Summary& summary) {
  constexpr std::uint64_t kBoxTriangles = 12;
  std::vector<int> nodes;
  for (std::uint32_t design = 0; design < city.designs.size(); ++design) {
    const asset::Instances instances = buildingsOf(city, design, ground);
    const std::size_t count = instances.translations.size();
    if (count == 0) continue;
    const int mesh = addBuilding(model, city, design);
    nodes.push_back(addNode(model, model.meshes[static_cast<std::size_t>(mesh)].name, mesh));
    model.nodes.back().extensions["EXT_mesh_gpu_instancing"] = asset::appendInstances(model, instances);
    Aabb bounds;
    for (const Aabb& box : city.designs[design].boxes)
      bounds.add(box);
    summary.buildings += count;
    summary.buildingBoxes += count * city.designs[design].boxes.size();
    summary.boundsWorld.add(boundsOf(instances, bounds));
  }
  summary.blocks = city.blocks;
  summary.buildingTriangles = kBoxTriangles * summary.buildingBoxes;
  summary.trianglesFull += summary.buildingTriangles;
  return nodes;
}

/// @param city  null without   @return  the nodes of the cameras
std::vector<int> addCameras(Model& model, const City* city, const PathSubject& subject, const Aabb& boundsWorld) {
  if (city == nullptr)
    return {addCamera(model, "walkthrough", makeCameraPath(subject), subject.objectRadius,
                      outsideDistance(subject) + reachOf(boundsWorld))};
  std::vector<int> nodes;
  for (const CityPath& path : cityPaths(*city))
    nodes.push_back(addCamera(model, path.name, path.path, subject.objectRadius, 2.0F * reachOf(boundsWorld)));
  return nodes;
}

void append(std::vector<int>& nodes, const std::vector<int>& more) {
  nodes.insert(nodes.end(), more.begin(), more.end());
}

/// The camera path squares lengths, so the squares must be finite too.
void requireRepresentable(const Aabb& box) {
  if (!std::isfinite(glm::dot(box.min, box.min)) || !std::isfinite(glm::dot(box.max, box.max)))
    throw Error(ErrorCode::kUsage, "--side or --scale is too large for this object");
}

}  // namespace

ScatteredScene scatterObjects(Model input, const Options& options, Progress& progress) {
  const Layout& layout = options.layout;
  SourceAsset source = findSourceAsset(input);
  if (layout.isOnGround()) findOutermost(input, source);
  std::optional<City> city;
  if (layout.shape == Shape::kCity) city = planCity(layout, source.diagonal);
  ScatteredScene scene;
  Summary& summary = scene.summary;
  summary.side = city ? city->side() : sideOf(layout, source);
  summary.levels = source.levels();
  summary.meshesPerObject = instancesPerObject(input);
  summary.trianglesPerObject = source.triangles();
  summary.trianglesFull = summary.trianglesPerObject * layout.count;
  summary.ignored = source.ignored;

  Model& model = scene.model;
  const std::vector<tinygltf::Mesh> meshes = std::move(input.meshes);
  model = withoutNodes(std::move(input));
  tinygltf::Scene root;
  std::vector<Placement> placements = placeObjects(layout, summary.side, progress, city ? &*city : nullptr);
  std::optional<float> ground;
  if (layout.isOnGround()) ground = standOnGround(placements, source);
  Objects objects(model, meshes);
  Movers bouncing(model, objects, source, 0.5F * summary.side);
  const std::vector<int> movers = addMovers(bouncing, source, layout, placements, summary);
  root.nodes = addParts(objects, source, placements, summary);
  append(root.nodes, movers);
  if (city) append(root.nodes, addBuildings(model, *city, *ground, summary));
  if (ground) root.nodes.push_back(addGround(model, source, layout, *ground, summary));
  requireRepresentable(summary.boundsWorld);

  const PathSubject subject{layout.count > 1 ? 0.5F * summary.side : 0.0F, 0.5F * layout.scale.max * source.diagonal,
                            options.occluder.has_value()};
  if (options.occluder) {
    const auto node = addOccluder(model, *options.occluder, subject, layout.seed, summary);
    if (node) root.nodes.push_back(*node);
  }
  append(root.nodes, addCameras(model, city ? &*city : nullptr, subject, summary.boundsWorld));
  model.scenes.push_back(std::move(root));
  model.defaultScene = 0;
  return scene;
}

}  // namespace jalousie::scatter
