// At a vertex with several ways on, the loop follows the border of the part that is on its left.
#include "wad/sector_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/error.h"

namespace jalousie::wad {
namespace {

/// A side of a line, directed so that its sector is on the left.
struct Edge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t line = 0;
  std::uint32_t side = 0;
};

/// A loop of one sector.
struct Loop {
  std::vector<Edge> edges;
  std::int64_t area = 0;  ///< twice
};

std::vector<std::uint32_t> verticesOf(const Loop& loop) {
  std::vector<std::uint32_t> vertices;
  for (const Edge& edge : loop.edges)
    vertices.push_back(edge.from);
  return vertices;
}

/// Angle by which one turns to the right from the way back until a direction, in (0, 2 pi].
double turnFrom(const glm::ivec2& back, const glm::ivec2& ahead) {
  const double turn = std::atan2(static_cast<double>(back.y), static_cast<double>(back.x)) -
                      std::atan2(static_cast<double>(ahead.y), static_cast<double>(ahead.x));
  const double positive = turn <= 1e-12 ? turn + 2.0 * std::numbers::pi : turn;
  return positive <= 1e-12 ? positive + 2.0 * std::numbers::pi : positive;
}

/// Takes edges of one sector, loop after loop.
class LoopChain {
 public:
  LoopChain(const Level& level, std::uint32_t sector, const std::vector<Edge>& edges) : level_(level), sector_(sector) {
    for (const Edge& edge : edges)
      next_.insert({edge.from, edge});
  }

  std::vector<Loop> loops() {
    std::vector<Loop> result;
    while (!next_.empty()) {
      Loop loop = take();
      loop.area = doubleArea(level_, verticesOf(loop));
      if (loop.area != 0) result.push_back(std::move(loop));
    }
    return result;
  }

 private:
  Loop take() {
    Loop loop;
    auto at = next_.begin();
    const std::uint32_t first = at->first;
    for (;;) {
      const Edge edge = at->second;
      loop.edges.push_back(edge);
      next_.erase(at);
      if (edge.to == first) return loop;
      at = onFrom(edge);
    }
  }

  /// The edge that borders the same part at the end of an edge.
  std::multimap<std::uint32_t, Edge>::iterator onFrom(const Edge& edge) {
    const auto [low, high] = next_.equal_range(edge.to);
    if (low == high)
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("sector {} of {} is not closed at ({}, {})", sector_, level_.name,
                              level_.vertices[edge.to].x, level_.vertices[edge.to].y));
    const glm::ivec2 back = level_.vertices[edge.from] - level_.vertices[edge.to];
    auto best = low;
    double least = std::numeric_limits<double>::infinity();
    for (auto way = low; way != high; ++way) {
      const double turn = turnFrom(back, level_.vertices[way->second.to] - level_.vertices[edge.to]);
      if (turn >= least) continue;
      least = turn;
      best = way;
    }
    return best;
  }

  const Level& level_;
  std::uint32_t sector_;
  std::multimap<std::uint32_t, Edge> next_;  ///< by the vertex that they begin at
};

/// Edges of all sectors, without lines inside of one.
std::vector<std::vector<Edge>> edgesOf(const Level& level) {
  std::vector<std::vector<Edge>> edges(level.sectors.size());
  for (std::uint32_t l = 0; l < level.lines.size(); ++l) {
    const Line& line = level.lines[l];
    if (line.sides[0] && line.sides[1] && level.sides[*line.sides[0]].sector == level.sides[*line.sides[1]].sector)
      continue;
    for (std::uint32_t side = 0; side < 2; ++side)
      if (line.sides[side])
        edges[level.sides[*line.sides[side]].sector].push_back({line.ends[1 - side], line.ends[side], l, side});
  }
  return edges;
}

/// Whether the middle of a loop's first edge is in another loop.
bool isInLoop(const Level& level, const Loop& inner, const Loop& outer) {
  const glm::dvec2 point =
      0.5 * (glm::dvec2(level.vertices[inner.edges[0].from]) + glm::dvec2(level.vertices[inner.edges[0].to]));
  bool inside = false;
  for (const Edge& edge : outer.edges) {
    const glm::dvec2 a(level.vertices[edge.from]);
    const glm::dvec2 b(level.vertices[edge.to]);
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

void addPart(const Loop& loop, std::uint32_t part, SectorParts& result) {
  result.parts[part].loops.push_back(verticesOf(loop));
  for (const Edge& edge : loop.edges)
    result.partOf[edge.line][edge.side] = part;
}

/// Each outline is a part; a hole belongs to the smallest one around it.
void addParts(const Level& level, std::uint32_t sector, const std::vector<Loop>& loops, SectorParts& result) {
  std::vector<std::uint32_t> partOfLoop(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].area < 0) continue;
    partOfLoop[i] = static_cast<std::uint32_t>(result.parts.size());
    result.parts.push_back({sector, {}});
    addPart(loops[i], partOfLoop[i], result);
  }
  for (const Loop& hole : loops) {
    if (hole.area > 0) continue;
    std::size_t best = loops.size();
    for (std::size_t i = 0; i < loops.size(); ++i)
      if (loops[i].area > -hole.area && isInLoop(level, hole, loops[i]) &&
          (best == loops.size() || loops[i].area < loops[best].area))
        best = i;
    if (best == loops.size())
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("sector {} of {} is not closed: a hole has no outline", sector, level.name));
    addPart(hole, partOfLoop[best], result);
  }
}

}  // namespace

std::int64_t doubleArea(const Level& level, const std::vector<std::uint32_t>& loop) {
  std::int64_t area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::ivec2 a = level.vertices[loop[i]];
    const glm::ivec2 b = level.vertices[loop[(i + 1) % loop.size()]];
    area += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
  }
  return area;
}

SectorParts divideSectors(const Level& level) {
  constexpr std::size_t kMostEdges = 4096;  // loops are compared with each other
  SectorParts result;
  result.partOf.resize(level.lines.size());
  const std::vector<std::vector<Edge>> edges = edgesOf(level);
  for (std::uint32_t sector = 0; sector < edges.size(); ++sector) {
    if (edges[sector].size() > kMostEdges)
      throw Error(ErrorCode::kLimit,
                  fmt::format("sector {} of {} has more than {} sides", sector, level.name, kMostEdges));
    addParts(level, sector, LoopChain(level, sector, edges[sector]).loops(), result);
  }
  return result;
}

}  // namespace jalousie::wad
