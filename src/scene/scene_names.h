// Names of what a scene's file holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/shared_vector.h"

namespace jalousie::scene {

/// A file may leave out any name, and give several things the same. Names are bytes of an untrusted file.
struct SceneNames {
  SharedVector<std::string> nodes;    ///< copies of a scene share them
  std::vector<std::uint32_t> nodeOf;  ///< [instances], index into nodes; one out of range: unnamed
  std::vector<std::string> meshes;    ///< [chains], of LOD 0

  /// Of the node that an instance belongs to; empty where it has none. @param instance  gpu::Object::owner
  std::string_view nodeName(std::uint32_t instance) const;
  /// Of LOD 0 of a chain; empty where it has none.
  std::string_view meshName(std::uint32_t chain) const;
};

/// A name for people: the node's, else the mesh's, else the number. At most kLongestShownName bytes; a longer one ends
/// in "...". Control characters become spaces.
std::string shownName(const SceneNames& names, std::uint32_t instance, std::uint32_t chain);

inline constexpr std::size_t kLongestShownName = 120;

}  // namespace jalousie::scene
