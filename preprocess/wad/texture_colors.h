// Mean colours of the textures of a WAD file: levels are drawn in plain colours.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "wad/wad_file.h"

namespace jalousie::wad {

/// Looks colours up by name. What is missing or broken is grey, because levels of one file may use another one's
/// textures.
class TextureColors {
 public:
  /// @param wad  outlives the object
  explicit TextureColors(const WadFile& wad);

  /// Linear RGB of a floor's or ceiling's texture.
  glm::vec3 flat(const std::string& name);
  /// Linear RGB of a wall's texture: the mean of its patches.
  glm::vec3 wall(const std::string& name);

 private:
  glm::vec3 flatMean(const std::string& name) const;
  glm::vec3 patchMean(std::uint32_t patch) const;
  void readTextures(const LumpReader& reader);

  const WadFile& wad_;
  std::array<glm::vec3, 256> palette_{};
  std::vector<std::string> patchNames_;
  std::map<std::string, std::vector<std::uint32_t>> patchesOf_;  ///< of textures
  std::map<std::string, glm::vec3> flats_;
  std::map<std::string, glm::vec3> walls_;
};

}  // namespace jalousie::wad
