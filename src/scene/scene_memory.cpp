// Bytes per element of the structs that a scene consists of on the host.
#include "scene/scene_memory.h"

#include <algorithm>
#include <string>

#include "asset/scene_types.h"
#include "scene/scene_data.h"

namespace jalousie::scene {
namespace {

constexpr std::uint64_t kBytesPerTexel = 4;
/// Positions, normals, texture coordinates and colours of asset::Primitive.
constexpr std::uint64_t kFileVertexBytes =
    3 * sizeof(float) + 3 * sizeof(float) + 2 * sizeof(float) + 4 * sizeof(float);
/// While a node's instances are read: packed bytes, then vectors; and the exact place until all are read.
constexpr std::uint64_t kReadInstanceBytes =
    sizeof(glm::vec3) + sizeof(glm::quat) + sizeof(glm::vec3) + sizeof(glm::dvec3);
constexpr std::uint64_t kKeyBytes = sizeof(float) + sizeof(glm::quat);
/// Names, and the tables by which the reader finds what is there already.
constexpr std::uint64_t kFileChainBytes = 512;

}  // namespace

std::string counted(std::uint64_t count, const char* noun) {
  return std::to_string(count) + ' ' + noun;
}

SceneSize sizeOf(const SceneData& scene) {
  SceneSize size;
  size.instances = scene.objects.size();
  size.vertices = scene.vertices.size();
  size.secondUvs = scene.secondUvs.size();
  size.indices = scene.indices.size();
  size.looseVertices = scene.loose.vertices.size();
  size.chains = scene.chains.size();
  size.levels = scene.lods.size();
  size.cells = scene.cells.objects.size();
  size.cellLevels = scene.cells.lods.size();
  size.faceNodes = scene.faces.nodes.size();
  size.motionBytes = scene.motion.bytes();
  size.cameras = scene.cameras.size();
  for (const ImageRgba8& image : scene.textures.images)
    size.images.push_back({image.width, image.height});
  return size;
}

SceneSize withCells(SceneSize size, const CellOptions& options) {
  const bool automatic = options.kind == CellOptions::Kind::kAutomatic;
  const std::uint64_t least = automatic && size.cellEnds == 0 ? 2 : 1;
  if (options.kind == CellOptions::Kind::kOff || size.largestTriangles <= least * options.trianglesPerCell) return size;
  // A cell is at least half full, but for the last one of each object.
  const std::uint64_t parts = size.finestTriangles / options.trianglesPerCell * 2;
  size.cells = size.instances + std::min(parts, 2 * (automatic ? kMostAutomaticCells : kMostCells));
  size.cellLevels = size.levels + size.levelTriangles / options.trianglesPerCell * 2;
  return size;
}

SceneSize withFaces(SceneSize size, bool faces) {
  if (faces) size.faceNodes = size.faceNumbers + size.levels + size.cellLevels;
  return size;
}

MemoryEstimate fileNeeds(const SceneSize& size) {
  MemoryEstimate needs;
  needs.add(size.documentBytes, 1, "the document");
  needs.add(size.instances, sizeof(asset::Instance) + kReadInstanceBytes, counted(size.instances, "instances"));
  needs.add(size.vertices, kFileVertexBytes, counted(size.vertices, "vertices"));
  needs.add(size.secondUvs, sizeof(glm::vec2), counted(size.secondUvs, "second texture coordinates"));
  needs.add(size.indices, sizeof(std::uint32_t), counted(size.indices, "indices"));
  needs.add(size.looseVertices, sizeof(asset::LooseVertex), counted(size.looseVertices, "points and ends of lines"));
  needs.add(size.looseInstances, sizeof(asset::LooseInstance) + sizeof(glm::dvec3),
            counted(size.looseInstances, "instances of points and lines"));
  needs.add(size.chains, kFileChainBytes, counted(size.chains, "LOD chains"));
  needs.add(size.faceNumbers, sizeof(std::uint32_t), counted(size.faceNumbers, "numbers of groups"));
  needs.add(size.cellEnds, sizeof(std::uint32_t), counted(size.cellEnds, "ends of cells"));
  needs.add(size.motionBytes, 1, "animations");
  needs.add(size.cameras, sizeof(asset::Camera), counted(size.cameras, "cameras"));
  needs.add(size.cameraKeys, kKeyBytes, counted(size.cameraKeys, "camera keys"));
  return needs;
}

MemoryEstimate imageNeeds(const SceneSize& size) {
  std::uint64_t largest = 0;
  std::uint64_t texels = 0;
  for (const asset::ImageSize& image : size.images) {
    texels += std::uint64_t{image.width} * image.height;
    largest = std::max(largest, std::uint64_t{image.width} * image.height);
  }
  MemoryEstimate needs;
  needs.add(texels + largest, kBytesPerTexel, counted(size.images.size(), "textures"));  // one is decoded at a time
  return needs;
}

MemoryEstimate sceneNeeds(const SceneSize& size, bool patches) {
  const std::uint64_t vertices = size.vertices + (patches ? size.coarsestVertices : 0);
  const std::uint64_t indices = size.indices + (patches ? size.coarsestIndices : 0);
  MemoryEstimate needs;
  needs.add(size.instances,
            sizeof(gpu::Transform) + sizeof(gpu::Object) + 2 * sizeof(std::uint32_t) + sizeof(gpu::Tile),
            counted(size.instances, "instances"));
  needs.add(vertices, sizeof(Vertex), counted(vertices, "vertices"));
  needs.add(size.secondUvs > 0 ? vertices : 0, sizeof(glm::vec2), counted(vertices, "second texture coordinates"));
  needs.add(indices, sizeof(std::uint32_t), counted(indices, "indices"));
  needs.add(size.looseVertices, sizeof(Vertex), counted(size.looseVertices, "points and ends of lines"));
  needs.add(size.chains, sizeof(gpu::Chain), counted(size.chains, "LOD chains"));
  needs.add(size.levels, sizeof(gpu::Lod) + 2 * sizeof(gpu::Bin), counted(size.levels, "levels"));
  needs.add(size.motionBytes, 1, "animations");
  needs.add(size.faceNodes, sizeof(gpu::FaceNode) + sizeof(gpu::FaceLod),
            counted(size.faceNodes, "groups of triangles"));
  if (size.cells > 0) needs.add(indices, sizeof(std::uint32_t), counted(indices, "indices in the order of cells"));
  needs.add(size.cells, sizeof(gpu::Object) + sizeof(gpu::Tile) + sizeof(gpu::Chain), counted(size.cells, "cells"));
  needs.add(size.cellLevels, 2 * (sizeof(gpu::Lod) + sizeof(gpu::CellBounds)) + 2 * sizeof(gpu::Bin),
            counted(size.cellLevels, "levels of cells"));
  return needs;
}

}  // namespace jalousie::scene
