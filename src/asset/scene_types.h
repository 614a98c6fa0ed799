// Plain types of a scene that was read from a file: images, materials, meshes, LOD chains, instances, cameras.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/shared_vector.h"

namespace jalousie::asset {

enum class AlphaMode : std::uint32_t { kOpaque = 0, kMask = 1, kBlend = 2 };

struct Material {
  std::string name;
  glm::vec4 baseColor{1.0F};           ///< linear RGB, alpha
  std::optional<std::uint32_t> image;  ///< base colour texture (sRGB), index into SceneFile::images; TEXCOORD_0 only
  AlphaMode alphaMode = AlphaMode::kOpaque;
  float alphaCutoff = 0.5F;
  bool doubleSided = false;
};

/// Triangles of one material. All attribute vectors have positions.size() elements; indices are in range, three per
/// triangle. Triangle strips and fans are converted; points and lines are skipped (SceneFile::skippedPrimitives).
struct Primitive {
  std::vector<glm::vec3> positions;  ///< object space
  /// Unit. If the file has none, one normal per face, as glTF requires; the vertices are then not shared.
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;     ///< TEXCOORD_0; zeros if absent
  std::vector<glm::vec4> colors;  ///< COLOR_0, linear; ones if absent
  std::vector<std::uint32_t> indices;
  std::uint32_t material = 0;  ///< index into SceneFile::materials; the last one is glTF's default material
  /// Where the triangles are in the order of spatial cells: per cell the first index behind its triangles. Ascending
  /// multiples of 3, the last one is indices.size(). All primitives of all levels of a chain have equally many, or
  /// none. A cell may be empty.
  std::vector<std::uint32_t> cellEnds;
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

struct LodLevel {
  std::uint32_t mesh = 0;    ///< index into SceneFile::meshes
  float errorObject = 0.0F;  ///< largest deviation; 0 for LOD 0; infinite where the file does not say
  std::optional<float> meanErrorObject = std::nullopt;  ///< mean deviation; absent where the file does not say
};

/// LOD 0 first. One level where the file has no MSFT_lod. Nodes with the same meshes share a chain.
struct Chain {
  std::string name;
  std::vector<LodLevel> levels;
};

struct Instance {
  std::uint32_t chain = 0;
  glm::mat4 worldFromObject{1.0F};
};

/// Sampled motion of a camera; times ascending, seconds, linear interpolation (slerp for rotations).
/// Cameras of one file share keys.
struct CameraTrack {
  SharedVector<float> translationTimes;
  SharedVector<glm::vec3> translations;
  SharedVector<float> rotationTimes;
  SharedVector<glm::quat> rotations;
};

/// Perspective camera looking along -z of its node, y up.
struct Camera {
  std::string name;
  float fovY = 0.8F;                ///< radians
  float zNear = 0.1F;               ///< world units
  std::optional<float> zFar;        ///< infinite if absent
  glm::mat4 worldFromCamera{1.0F};  ///< rest pose
  CameraTrack track;                ///< of the camera's node, in its parent's frame; empty if not animated
  glm::mat4 worldFromParent{1.0F};  ///< apply to the track's poses
};

struct SceneFile {
  SharedVector<ImageRgba8> images;  ///< copies of a scene share them
  std::vector<Material> materials;  ///< never empty
  std::vector<Mesh> meshes;         ///< only meshes that a chain uses
  std::vector<Chain> chains;
  std::vector<Instance> instances;      ///< in order of depth-first traversal; EXT_mesh_gpu_instancing expanded
  std::vector<Camera> cameras;          ///< perspective cameras in the scene, in order of traversal
  std::uint32_t skippedPrimitives = 0;  ///< points and lines
};

}  // namespace jalousie::asset
