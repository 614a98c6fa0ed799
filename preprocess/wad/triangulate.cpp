// Ears are cut in the order of the outline (Meisters 1975), by exact tests on whole numbers.
#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "wad/sector_parts.h"

namespace jalousie::wad {
namespace {

constexpr std::uint64_t kMostSteps = 1ULL << 31U;

/// Twice the area of a triangle, positive if counter-clockwise.
std::int64_t turnOf(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

bool isBetween(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

int signOf(std::int64_t value) {
  return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0);
}

/// Whether two segments have a point in common.
bool meet(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c, const glm::ivec2& d) {
  const int c1 = signOf(turnOf(a, b, c));
  const int d1 = signOf(turnOf(a, b, d));
  const int a1 = signOf(turnOf(c, d, a));
  const int b1 = signOf(turnOf(c, d, b));
  if (c1 * d1 < 0 && a1 * b1 < 0) return true;
  return (c1 == 0 && isBetween(a, b, c)) || (d1 == 0 && isBetween(a, b, d)) || (a1 == 0 && isBetween(c, d, a)) ||
         (b1 == 0 && isBetween(c, d, b));
}

class Ears {
 public:
  Ears(const Level& level, const SectorPart& part) : level_(level), part_(part), polygon_(part.loops[0]) {}

  std::vector<std::uint32_t> cut() {
    joinHoles();
    std::vector<std::uint32_t> triangles;
    while (polygon_.size() > 3) {
      const std::size_t ear = findEar();
      const std::size_t before = (ear + polygon_.size() - 1) % polygon_.size();
      const std::size_t after = (ear + 1) % polygon_.size();
      triangles.insert(triangles.end(), {polygon_[before], polygon_[ear], polygon_[after]});
      polygon_.erase(polygon_.begin() + static_cast<std::ptrdiff_t>(ear));
      start_ = ear % polygon_.size();
    }
    triangles.insert(triangles.end(), polygon_.begin(), polygon_.end());
    return triangles;
  }

 private:
  const glm::ivec2& at(std::uint32_t vertex) const { return level_.vertices[vertex]; }
  const glm::ivec2& corner(std::size_t i) const { return at(polygon_[i % polygon_.size()]); }

  void step() {
    if (++steps_ > kMostSteps)
      throw Error(ErrorCode::kLimit,
                  fmt::format("sector {} of {} takes too long to triangulate", part_.sector, level_.name));
  }

  [[noreturn]] void fail() const {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("sector {} of {} cannot be triangulated: its sides cross", part_.sector, level_.name));
  }

  /// Holes by their rightmost vertex, which mostly sees the outline or a hole that is joined already.
  void joinHoles() {
    struct Hole {
      const std::vector<std::uint32_t>* loop;
      std::size_t rightmost;
    };
    std::vector<Hole> holes;
    for (std::size_t i = 1; i < part_.loops.size(); ++i) {
      const std::vector<std::uint32_t>& loop = part_.loops[i];
      const auto rightmost = std::max_element(loop.begin(), loop.end(), [&](std::uint32_t a, std::uint32_t b) {
        return at(a).x != at(b).x ? at(a).x < at(b).x : at(a).y < at(b).y;
      });
      holes.push_back({&loop, static_cast<std::size_t>(rightmost - loop.begin())});
    }
    const auto right = [&](const Hole& hole) { return at((*hole.loop)[hole.rightmost]); };
    std::stable_sort(holes.begin(), holes.end(), [&](const Hole& a, const Hole& b) {
      return right(a).x != right(b).x ? right(a).x > right(b).x : right(a).y > right(b).y;
    });
    for (const Hole& hole : holes)
      join(*hole.loop, hole.rightmost);
  }

  /// Puts a hole into the polygon behind the nearest corner that its rightmost vertex sees.
  void join(const std::vector<std::uint32_t>& hole, std::size_t rightmost) {
    const glm::ivec2 from = at(hole[rightmost]);
    std::vector<std::size_t> order(polygon_.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = i;
    const auto distance = [&](std::size_t i) {
      const glm::dvec2 away = glm::dvec2(corner(i)) - glm::dvec2(from);
      return glm::dot(away, away);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    for (const std::size_t i : order) {
      if (!isInCone(i, from) || !isFree(from, corner(i), polygon_) || !isFreeOfHoles(from, corner(i))) continue;
      std::vector<std::uint32_t> bridge;
      for (std::size_t k = 0; k <= hole.size(); ++k)
        bridge.push_back(hole[(rightmost + k) % hole.size()]);
      bridge.push_back(polygon_[i]);
      polygon_.insert(polygon_.begin() + static_cast<std::ptrdiff_t>(i) + 1, bridge.begin(), bridge.end());
      return;
    }
    fail();
  }

  /// Whether the way from a corner to a point begins inside of the polygon.
  bool isInCone(std::size_t i, const glm::ivec2& point) const {
    const glm::ivec2 before = corner(i + polygon_.size() - 1);
    const glm::ivec2 here = corner(i);
    const glm::ivec2 after = corner(i + 1);
    if (point == here) return true;
    if (turnOf(before, here, after) >= 0) return turnOf(here, point, before) > 0 && turnOf(point, here, after) > 0;
    return !(turnOf(here, point, after) >= 0 && turnOf(point, here, before) >= 0);
  }

  /// Whether a segment meets a loop at its own ends alone.
  bool isFree(const glm::ivec2& from, const glm::ivec2& to, const std::vector<std::uint32_t>& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      step();
      const glm::ivec2& a = at(loop[i]);
      const glm::ivec2& b = at(loop[(i + 1) % loop.size()]);
      if (a == from || a == to || b == from || b == to) continue;
      if (meet(from, to, a, b)) return false;
    }
    return true;
  }

  bool isFreeOfHoles(const glm::ivec2& from, const glm::ivec2& to) {
    return std::all_of(part_.loops.begin() + 1, part_.loops.end(),
                       [&](const std::vector<std::uint32_t>& hole) { return isFree(from, to, hole); });
  }

  std::size_t findEar() {
    for (std::size_t k = 0; k < polygon_.size(); ++k) {
      const std::size_t i = (start_ + k) % polygon_.size();
      if (isEar(i)) return i;
    }
    for (std::size_t i = 0; i < polygon_.size(); ++i)  // what is left may have no area
      if (turnOf(corner(i + polygon_.size() - 1), corner(i), corner(i + 1)) == 0) return i;
    fail();
  }

  bool isEar(std::size_t i) {
    const glm::ivec2 a = corner(i + polygon_.size() - 1);
    const glm::ivec2 b = corner(i);
    const glm::ivec2 c = corner(i + 1);
    if (turnOf(a, b, c) <= 0) return a == c && b != a;  // a bridge whose sides have become neighbours
    for (std::size_t k = 0; k < polygon_.size(); ++k) {
      step();
      const glm::ivec2& p = corner(k);
      if (p == a || p == b || p == c) continue;
      if (turnOf(a, b, p) >= 0 && turnOf(b, c, p) >= 0 && turnOf(c, a, p) >= 0) return false;
    }
    return true;
  }

  const Level& level_;
  const SectorPart& part_;
  std::vector<std::uint32_t> polygon_;
  std::size_t start_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace

std::vector<std::uint32_t> triangulate(const Level& level, const SectorPart& part) {
  std::vector<std::uint32_t> triangles = Ears(level, part).cut();
  std::int64_t expected = 0;
  for (const std::vector<std::uint32_t>& loop : part.loops)
    expected += doubleArea(level, loop);
  std::int64_t area = 0;
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const std::int64_t own = doubleArea(level, {triangles[i], triangles[i + 1], triangles[i + 2]});
    area += own;
    if (own > 0) result.insert(result.end(), {triangles[i], triangles[i + 1], triangles[i + 2]});
    if (own < 0) area = expected + 1;
  }
  if (area != expected)
    throw Error(ErrorCode::kUnsupported,
                fmt::format("sector {} of {} cannot be triangulated: its sides cross", part.sector, level.name));
  return result;
}

}  // namespace jalousie::wad
