// Small animated documents, random ones among them.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>

namespace jalousie::test {

/// What a random document has.
struct AnimatedScene {
  std::uint32_t seed = 1;
  int nodes = 12;         ///< in a random hierarchy; some of them move
  int skinned = 2;        ///< meshes with skins
  int morphed = 1;        ///< meshes with morph targets
  bool flat = false;      ///< meshes without normals
  bool loose = false;     ///< nodes with points and lines as well
  glm::dvec3 place{0.0};  ///< of the whole scene
};

/// Animations of one second with all three interpolations.
tinygltf::Model animatedModel(const AnimatedScene& scene);

}  // namespace jalousie::test
