// A level as a glTF document with rooms and portals.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>

#include "wad/options.h"
#include "wad/wad_file.h"

namespace jalousie::wad {

/// Counts of a conversion.
struct Summary {
  std::string map;
  std::size_t lines = 0;
  std::size_t sectors = 0;
  std::size_t rooms = 0;
  std::size_t portals = 0;
  std::size_t openedDoors = 0;
  std::size_t things = 0;  ///< that became boxes
  std::uint64_t triangles = 0;
  double seconds = 0.0;  ///< of the camera's path; 0 without
};

struct ConvertedLevel {
  tinygltf::Model model;
  Summary summary;
};

/// Errors: of readLevel, divideSectors and triangulate; kUnsupported where nothing is left to be drawn.
ConvertedLevel convertLevel(const WadFile& wad, const std::string& map, bool opensDoors);

/// One line.
std::string reportLine(const Summary& summary);
std::string reportJson(const Summary& summary);

}  // namespace jalousie::wad
