// Records have fixed sizes; their number follows from the size of the lump.
#include "wad/level.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.h"

namespace jalousie::wad {
namespace {

constexpr std::uint32_t kNoSide = 0xFFFF;
constexpr std::int32_t kDoorGap = 4;
constexpr std::size_t kLumpsOfLevel = 11;

/// The lump of a name among those that follow a level's marker.
std::optional<std::size_t> lumpOf(const WadFile& wad, std::size_t marker, std::string_view name) {
  for (std::size_t i = marker + 1; i < wad.count() && i <= marker + kLumpsOfLevel; ++i)
    if (wad.nameOf(i) == name) return i;
  return std::nullopt;
}

bool isMarker(const WadFile& wad, std::size_t lump) {
  return lump + 1 < wad.count() && wad.nameOf(lump + 1) == "THINGS";
}

/// Calls read(reader, offset) for each record of a lump.
template <class Read>
void readRecords(const WadFile& wad, std::size_t marker, const char* name, std::size_t bytes, const Read& read) {
  const std::optional<std::size_t> lump = lumpOf(wad, marker, name);
  if (!lump) throw Error(ErrorCode::kMalformed, fmt::format("level {} has no {}", wad.nameOf(marker), name));
  const LumpReader reader = wad.read(*lump);
  if (reader.size() % bytes != 0)
    throw Error(ErrorCode::kMalformed, fmt::format("{} of level {} has {} bytes, no multiple of {}", name,
                                                   wad.nameOf(marker), reader.size(), bytes));
  if (reader.size() / bytes > kNoSide)
    throw Error(ErrorCode::kLimit, fmt::format("{} of level {} has more than 65535 entries", name, wad.nameOf(marker)));
  for (std::size_t offset = 0; offset < reader.size(); offset += bytes)
    read(reader, offset);
}

void requireBelow(std::uint32_t index, std::size_t count, const char* what, std::size_t record) {
  if (index >= count)
    throw Error(ErrorCode::kMalformed, fmt::format("{} {} refers to number {} of {}", what, record, index, count));
}

std::optional<std::uint32_t> sideAt(const LumpReader& reader, std::size_t offset, std::size_t count,
                                    std::size_t record) {
  const std::uint32_t side = reader.uint16At(offset);
  if (side == kNoSide) return std::nullopt;
  requireBelow(side, count, "line", record);
  return side;
}

void readLines(const WadFile& wad, std::size_t marker, const std::vector<std::uint32_t>& firstAt, Level& level) {
  std::size_t record = 0;
  readRecords(wad, marker, "LINEDEFS", 14, [&](const LumpReader& reader, std::size_t at) {
    Line line;
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint32_t vertex = reader.uint16At(at + 2 * end);
      requireBelow(vertex, firstAt.size(), "line", record);
      line.ends[end] = firstAt[vertex];
      line.sides[end] = sideAt(reader, at + 10 + 2 * end, level.sides.size(), record);
    }
    ++record;
    if (line.ends[0] != line.ends[1] && (line.sides[0] || line.sides[1])) level.lines.push_back(line);
  });
}

/// @return  for each vertex the first one at its place
std::vector<std::uint32_t> readVertices(const WadFile& wad, std::size_t marker, Level& level) {
  std::vector<std::uint32_t> firstAt;
  std::map<std::array<int, 2>, std::uint32_t> known;
  readRecords(wad, marker, "VERTEXES", 4, [&](const LumpReader& reader, std::size_t at) {
    const glm::ivec2 place(reader.int16At(at), reader.int16At(at + 2));
    const auto index = static_cast<std::uint32_t>(level.vertices.size());
    level.vertices.push_back(place);
    firstAt.push_back(known.try_emplace({place.x, place.y}, index).first->second);
  });
  return firstAt;
}

}  // namespace

std::vector<std::string> levelNames(const WadFile& wad) {
  std::vector<std::string> names;
  for (std::size_t lump = 0; lump < wad.count(); ++lump)
    if (isMarker(wad, lump)) names.push_back(wad.nameOf(lump));
  return names;
}

Level readLevel(const WadFile& wad, const std::string& name) {
  const std::optional<std::size_t> marker = wad.find(name);
  if (!marker || !isMarker(wad, *marker)) {
    const std::vector<std::string> names = levelNames(wad);
    std::string list;
    for (std::size_t i = 0; i < names.size() && i < 40; ++i)
      list += " " + names[i];
    throw Error(ErrorCode::kUsage, fmt::format("no level {}; --map may be:{}", name, list.empty() ? " none" : list));
  }
  if (lumpOf(wad, *marker, "BEHAVIOR"))
    throw Error(ErrorCode::kUnsupported, fmt::format("level {} is for another engine (BEHAVIOR)", name));
  Level level;
  level.name = name;
  const std::vector<std::uint32_t> firstAt = readVertices(wad, *marker, level);
  readRecords(wad, *marker, "SECTORS", 26, [&](const LumpReader& reader, std::size_t at) {
    level.sectors.push_back({reader.int16At(at), reader.int16At(at + 2), reader.nameAt(at + 4), reader.nameAt(at + 12),
                             std::clamp(reader.int16At(at + 20), 0, 255)});
  });
  readRecords(wad, *marker, "SIDEDEFS", 30, [&](const LumpReader& reader, std::size_t at) {
    const std::uint32_t sector = reader.uint16At(at + 28);
    requireBelow(sector, level.sectors.size(), "side", level.sides.size());
    level.sides.push_back({reader.nameAt(at + 4), reader.nameAt(at + 12), reader.nameAt(at + 20), sector});
  });
  readLines(wad, *marker, firstAt, level);
  readRecords(wad, *marker, "THINGS", 10, [&](const LumpReader& reader, std::size_t at) {
    level.things.push_back(
        {{reader.int16At(at), reader.int16At(at + 2)}, reader.int16At(at + 4), reader.uint16At(at + 6)});
  });
  return level;
}

std::size_t openDoors(Level& level) {
  std::vector<std::int32_t> lowest(level.sectors.size(), 0x7FFF);
  std::vector<bool> isDoor(level.sectors.size());
  for (std::size_t s = 0; s < level.sectors.size(); ++s)
    isDoor[s] = level.sectors[s].ceiling <= level.sectors[s].floor;
  for (const Line& line : level.lines) {
    if (!line.sides[0] || !line.sides[1]) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t own = level.sides[*line.sides[side]].sector;
      const std::uint32_t other = level.sides[*line.sides[1 - side]].sector;
      if (own != other && !isDoor[other]) lowest[own] = std::min(lowest[own], level.sectors[other].ceiling);
    }
  }
  std::size_t opened = 0;
  for (std::size_t s = 0; s < level.sectors.size(); ++s) {
    Sector& sector = level.sectors[s];
    if (!isDoor[s] || lowest[s] == 0x7FFF || lowest[s] - kDoorGap <= sector.floor) continue;
    sector.ceiling = lowest[s] - kDoorGap;
    ++opened;
  }
  return opened;
}

}  // namespace jalousie::wad
