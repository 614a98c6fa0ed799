// A level of a WAD file as plain, checked records: all indices are in range.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "wad/wad_file.h"

namespace jalousie::wad {

/// One side of a line.
struct Side {
  std::string upper;
  std::string lower;
  std::string middle;
  std::uint32_t sector = 0;
};

/// A wall or a border between sectors. The first side is on the right of the direction of the line.
struct Line {
  std::array<std::uint32_t, 2> ends{};                  ///< indices of vertices, whose places differ
  std::array<std::optional<std::uint32_t>, 2> sides{};  ///< right, left
};

struct Sector {
  std::int32_t floor = 0;
  std::int32_t ceiling = 0;
  std::string floorTexture;
  std::string ceilingTexture;
  std::int32_t light = 0;  ///< 0 to 255
};

struct Thing {
  glm::ivec2 place{0};
  std::int32_t angle = 0;  ///< degrees from east, counter-clockwise
  std::uint32_t type = 0;
};

/// Coordinates: x east, y north, heights up.
struct Level {
  std::string name;
  std::vector<glm::ivec2> vertices;
  std::vector<Line> lines;  ///< without those of no length, and without those of no side
  std::vector<Side> sides;
  std::vector<Sector> sectors;
  std::vector<Thing> things;
};

/// Names of the levels, in the order of the file.
std::vector<std::string> levelNames(const WadFile& wad);

/// Reads a level in the original format. Vertices at one place become one.
/// Errors: kUsage (no such level), kMalformed, kUnsupported (the level of another engine).
Level readLevel(const WadFile& wad, const std::string& name);

/// Opens the doors: sectors without height get the lowest ceiling of their neighbours, less 4.
/// @return  how many were opened
std::size_t openDoors(Level& level);

}  // namespace jalousie::wad
