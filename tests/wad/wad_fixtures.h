// Small WAD files made in memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace jalousie::wad::test {

using Bytes = std::vector<std::byte>;

inline void put16(Bytes& bytes, int value) {
  bytes.push_back(static_cast<std::byte>(value & 0xFF));
  bytes.push_back(static_cast<std::byte>(value >> 8 & 0xFF));
}

inline void put32(Bytes& bytes, std::uint32_t value) {
  put16(bytes, static_cast<int>(value & 0xFFFFU));
  put16(bytes, static_cast<int>(value >> 16U));
}

inline void putName(Bytes& bytes, const std::string& name) {
  for (std::size_t i = 0; i < 8; ++i)
    bytes.push_back(i < name.size() ? static_cast<std::byte>(name[i]) : std::byte{0});
}

/// A level under construction.
struct LevelMaker {
  Bytes vertices, lines, sides, sectors, things;
  int vertexCount = 0, sideCount = 0, sectorCount = 0;

  int vertex(int x, int y) {
    put16(vertices, x);
    put16(vertices, y);
    return vertexCount++;
  }
  int sector(int floor, int ceiling, const std::string& ceilingTexture = "CEIL") {
    put16(sectors, floor);
    put16(sectors, ceiling);
    putName(sectors, "FLOOR");
    putName(sectors, ceilingTexture);
    for (const int value : {160, 0, 0})
      put16(sectors, value);
    return sectorCount++;
  }
  int side(int sector) {
    put16(sides, 0);
    put16(sides, 0);
    for (const char* texture : {"UP", "LOW", "WALL"})
      putName(sides, texture);
    put16(sides, sector);
    return sideCount++;
  }
  /// @param left  sector; -1: none
  void line(int from, int to, int right, int left = -1) {
    for (const int value : {from, to, left < 0 ? 1 : 4, 0, 0})
      put16(lines, value);
    put16(lines, side(right));
    put16(lines, left < 0 ? 0xFFFF : side(left));
  }
  void thing(int x, int y, int type) {
    for (const int value : {x, y, 90, type, 7})
      put16(things, value);
  }
  /// Lines around an outline, in clockwise order, which have a sector on their right.
  void outline(const std::vector<int>& corners, int right, int left = -1) {
    for (std::size_t i = 0; i < corners.size(); ++i)
      line(corners[i], corners[(i + 1) % corners.size()], right, left);
  }
};

/// A file of lumps.
inline Bytes wadOf(const std::vector<std::pair<std::string, Bytes>>& lumps) {
  Bytes file;
  for (const char letter : std::string("PWAD"))
    file.push_back(static_cast<std::byte>(letter));
  put32(file, static_cast<std::uint32_t>(lumps.size()));
  put32(file, 12 + 16 * static_cast<std::uint32_t>(lumps.size()));
  // The directory behind the data; its place is set at the end.
  std::vector<std::uint32_t> offsets;
  for (const auto& [name, bytes] : lumps) {
    offsets.push_back(static_cast<std::uint32_t>(file.size()));
    file.insert(file.end(), bytes.begin(), bytes.end());
  }
  const auto directory = static_cast<std::uint32_t>(file.size());
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    put32(file, offsets[i]);
    put32(file, static_cast<std::uint32_t>(lumps[i].second.size()));
    putName(file, lumps[i].first);
  }
  Bytes place;
  put32(place, directory);
  std::copy(place.begin(), place.end(), file.begin() + 8);
  return file;
}

inline Bytes wadOf(const LevelMaker& level, const std::string& name = "MAP01") {
  return wadOf({{name, {}},
                {"THINGS", level.things},
                {"LINEDEFS", level.lines},
                {"SIDEDEFS", level.sides},
                {"VERTEXES", level.vertices},
                {"SECTORS", level.sectors}});
}

/// A hall with a pillar and a sunken pool, a door, and a room behind the door, whose floor is higher.
inline LevelMaker houseLevel() {
  LevelMaker level;
  const int hall = level.sector(0, 128);
  const int pool = level.sector(-16, 128);
  const int door = level.sector(0, 0);
  const int room = level.sector(16, 96, "F_SKY1");
  std::vector<int> v;
  for (const auto& [x, y] : std::vector<std::pair<int, int>>{{0, 0},
                                                             {0, 512},
                                                             {512, 512},
                                                             {512, 320},
                                                             {512, 192},
                                                             {512, 0},
                                                             {528, 320},
                                                             {528, 192},
                                                             {528, 512},
                                                             {1024, 512},
                                                             {1024, 0},
                                                             {528, 0}})
    v.push_back(level.vertex(x, y));
  for (const auto& [from, to] : std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 3}, {4, 5}, {5, 0}})
    level.line(v[from], v[to], hall);
  level.line(v[3], v[4], hall, door);
  level.line(v[3], v[6], door);
  level.line(v[7], v[4], door);
  level.line(v[6], v[7], door, room);
  for (const auto& [from, to] : std::vector<std::pair<int, int>>{{8, 9}, {9, 10}, {10, 11}, {11, 7}, {6, 8}})
    level.line(v[from], v[to], room);
  const auto square = [&](int x, int y, int side, bool clockwise) {
    std::vector<int> corners = {level.vertex(x, y), level.vertex(x, y + side), level.vertex(x + side, y + side),
                                level.vertex(x + side, y)};
    if (!clockwise) std::reverse(corners.begin(), corners.end());
    return corners;
  };
  level.outline(square(64, 64, 32, false), hall);  // a pillar: the hall is outside of it
  level.outline(square(256, 64, 128, true), pool, hall);
  level.thing(128, 256, 1);
  level.thing(700, 256, 3001);
  level.thing(300, 128, 2012);
  level.thing(-900, 0, 2012);  // outside
  return level;
}

}  // namespace jalousie::wad::test
