// Plain types of a scene that was read from a file: images, materials, meshes, LOD chains, instances, cameras.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "asset/scene_motion.h"
#include "core/convex_solid.h"
#include "core/image.h"
#include "core/room_plan.h"
#include "core/shared_vector.h"

namespace jalousie::asset {

enum class AlphaMode : std::uint32_t { kOpaque = 0, kMask = 1, kBlend = 2 };

/// What lies beyond the borders of a texture.
enum class Wrap : std::uint32_t { kRepeat = 0, kClamp = 1, kMirror = 2 };
/// Which mip levels a texture is read from.
enum class Mip : std::uint32_t { kLinear = 0, kNearest = 1, kNone = 2 };

/// How texels are read.
struct Sampling {
  Wrap wrapU = Wrap::kRepeat;
  Wrap wrapV = Wrap::kRepeat;
  bool magnifyNearest = false;
  bool minifyNearest = false;  ///< within one mip level
  Mip mip = Mip::kLinear;

  friend bool operator==(const Sampling&, const Sampling&) = default;
};

/// A picture on a surface.
struct TextureUse {
  std::uint32_t image = 0;  ///< index into SceneFile::images
  std::uint32_t uvSet = 0;  ///< 0: TEXCOORD_0, 1: TEXCOORD_1
  Sampling sampling;
  glm::vec4 uvAxes{1.0F, 0.0F, 0.0F, 1.0F};  ///< what u (xy) and v (zw) become
  glm::vec2 uvOffset{0.0F};                  ///< added to them

  /// Whether it is read as a texture without a sampler and without KHR_texture_transform, by TEXCOORD_0.
  bool isPlain() const {
    return uvSet == 0 && sampling == Sampling{} && uvAxes == glm::vec4(1.0F, 0.0F, 0.0F, 1.0F) &&
           uvOffset == glm::vec2(0.0F);
  }
};

struct Material {
  std::string name;
  glm::vec4 baseColor{1.0F};                  ///< linear RGB, alpha
  std::optional<TextureUse> baseTexture;      ///< sRGB
  glm::vec3 emission{0.0F};                   ///< linear RGB, times KHR_materials_emissive_strength
  std::optional<TextureUse> emissiveTexture;  ///< sRGB
  std::optional<TextureUse> normalTexture;    ///< tangent space, +y towards falling v
  float normalScale = 1.0F;                   ///< of x and y of the texture's normals
  bool isUnlit = false;                       ///< the base colour is what is seen
  AlphaMode alphaMode = AlphaMode::kOpaque;
  float alphaCutoff = 0.5F;
  bool doubleSided = false;
};

/// Whether a material reads TEXCOORD_1.
inline bool usesSecondUvs(const Material& material) {
  const auto uses = [](const std::optional<TextureUse>& texture) { return texture && texture->uvSet == 1; };
  return uses(material.baseTexture) || uses(material.emissiveTexture) || uses(material.normalTexture);
}

/// Triangles of one material. Attribute vectors have positions.size() elements; indices are in range, three per
/// triangle. Triangle strips and fans are converted; points and lines are LooseGeometry.
struct Primitive {
  std::vector<glm::vec3> positions;  ///< object space
  /// Unit. If the file has none, one normal per face, as glTF requires; the vertices are then not shared.
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;     ///< TEXCOORD_0; zeros if absent
  std::vector<glm::vec2> uvs1;    ///< TEXCOORD_1; empty, and no other size, where the material does not use it
  std::vector<glm::vec4> colors;  ///< COLOR_0, linear; ones if absent
  std::vector<std::uint32_t> indices;
  std::uint32_t material = 0;  ///< index into SceneFile::materials; the last one is glTF's default material
  /// Where the triangles are in the order of spatial cells: per cell the first index behind its triangles. Ascending
  /// multiples of 3, the last one is indices.size(). All primitives of all levels of a chain have equally many, or
  /// none. A cell may be empty.
  std::vector<std::uint32_t> cellEnds;
  /// Groups of its triangles that face alike (FaceTree of asset/face_groups.h); none crosses the border of a cell.
  /// Empty if the file has none.
  std::vector<std::uint32_t> faceTree;
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

/// A point, or an end of a line segment.
struct LooseVertex {
  glm::vec3 position;
  glm::vec3 normal;            ///< unit; 0 if the file has none: it is not lit (glTF 2.0, 3.9.6)
  glm::vec2 uv;                ///< TEXCOORD_0; 0 if absent
  glm::vec4 color;             ///< COLOR_0, linear; 1 if absent
  std::uint32_t material = 0;  ///< index into SceneFile::materials
};

/// What a mesh shows beside its triangles, object space. Strips and loops of lines are converted to segments.
struct LooseGeometry {
  std::vector<LooseVertex> points;
  std::vector<LooseVertex> lines;  ///< two for each segment
};

/// Loose geometry that a node shows.
struct LooseInstance {
  std::uint32_t geometry = 0;  ///< index into SceneFile::looseGeometries
  glm::mat4 worldFromObject{1.0F};
  std::optional<std::uint32_t> instance;  ///< of the triangles of the same mesh; absent if it has none
};

struct LodLevel {
  std::uint32_t mesh = 0;    ///< index into SceneFile::meshes
  float errorObject = 0.0F;  ///< largest deviation; 0 for LOD 0; infinite where the file does not say
  std::optional<float> meanErrorObject = std::nullopt;  ///< mean deviation; absent where the file does not say
};

/// A convex solid or polygon in the mesh of a chain, object space: it hides what lies behind it (jalousie_occluders).
struct Occluder {
  ConvexSolid solid;         ///< without faults
  std::uint32_t levels = 0;  ///< it lies inside so many of the first levels

  friend bool operator==(const Occluder&, const Occluder&) = default;
};

/// LOD 0 first. One level where the file has no MSFT_lod. Nodes with the same meshes and thresholds share a chain.
struct Chain {
  std::string name;
  std::vector<LodLevel> levels;
  /// MSFT_screencoverage: for each of the first levels the least share of the screen at which it is drawn, descending.
  /// Empty where the file states none, or broken ones.
  std::vector<float> coverage = {};
  std::vector<Occluder> occluders = {};  ///< of meshes that are neither bent nor parts of a group
};

struct Instance {
  std::uint32_t chain = 0;
  glm::mat4 worldFromObject{1.0F};
  std::uint32_t node = 0;  ///< index into SceneFile::nodeNames
};

/// Sampled motion of a camera; times ascending, seconds, linear interpolation (slerp for rotations).
/// Cameras of one file share keys.
struct CameraTrack {
  SharedVector<float> translationTimes;
  SharedVector<glm::vec3> translations;
  SharedVector<float> rotationTimes;
  SharedVector<glm::quat> rotations;
};

/// Camera looking along -z of its node, y up.
struct Camera {
  std::string name;
  float fovY = 0.8F;                  ///< radians; of a perspective camera
  std::optional<glm::vec2> halfSize;  ///< orthographic: half the width and height of what it shows, world units, > 0
  float zNear = 0.1F;                 ///< world units; > 0, or >= 0 for an orthographic camera
  std::optional<float> zFar;          ///< infinite if absent; an orthographic camera has one
  glm::dmat4 worldFromCamera{1.0};    ///< rest pose
  CameraTrack track;                  ///< in the frame of worldFromParent; empty if not animated
  glm::dmat4 worldFromParent{1.0};    ///< apply to the track's poses
};

/// Numbers of things by their names.
using ContentCounts = std::map<std::string, std::uint64_t>;

struct SceneFile {
  SharedVector<ImageRgba8> images;  ///< copies of a scene share them; colours and normals never share a picture
  std::vector<Material> materials;  ///< never empty
  std::vector<Mesh> meshes;         ///< only meshes that a chain uses
  std::vector<Chain> chains;
  std::vector<Instance> instances;             ///< in order of depth-first traversal; EXT_mesh_gpu_instancing expanded
  std::vector<LooseGeometry> looseGeometries;  ///< of LOD 0 of nodes, whatever level is drawn
  std::vector<LooseInstance> looseInstances;   ///< in order of traversal
  SharedVector<std::string> nodeNames;         ///< of the nodes with a mesh, in order of traversal; empty where unnamed
  std::vector<Camera> cameras;                 ///< cameras in the scene, in order of traversal
  /// Point of the document that all instances and cameras are placed relative to: 0, or the middle of a scene that is
  /// far from the document's origin, where a float has too few digits.
  glm::dvec3 originWorld{0.0};
  RoomPlan rooms;         ///< without faults, relative to originWorld (jalousie_rooms); empty where the file has none
  SceneMotion motion;     ///< empty, unless it was asked for (SceneReading::plays)
  ContentCounts ignored;  ///< what the document holds that is not drawn
};

}  // namespace jalousie::asset
