// Random animated documents.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>

namespace jalousie::test {

/// What a random document has.
struct AnimatedContent {
  std::uint64_t seed = 1;
  int nodes = 16;         ///< of a random hierarchy, with a sphere each; about half of them move
  int skinned = 2;        ///< meshes with skins of four joints
  int morphed = 2;        ///< meshes with two morph targets
  bool flat = false;      ///< meshes without normals
  bool loose = false;     ///< points and a line with each sphere of the hierarchy
  bool levels = false;    ///< a coarser level for each mesh
  glm::dvec3 place{0.0};  ///< of the whole scene
};

/// Seconds of the last key of the documents.
inline constexpr float kAnimatedSeconds = 2.0F;

/// The document; channels interpolate in all three ways.
tinygltf::Model animatedModel(const AnimatedContent& content);

}  // namespace jalousie::test
