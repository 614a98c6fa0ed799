// Marks the cells that triangles touch, fills the rest, and searches the largest box of cells inside.
#include "bake/mesh/inner_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "bake/mesh/largest_rectangle.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

constexpr std::uint8_t kOpen = 0;     ///< not looked at yet
constexpr std::uint8_t kTouched = 1;  ///< by a triangle, or part of a box already
constexpr std::uint8_t kInside = 2;
constexpr std::uint8_t kOutside = 3;
/// Share of a length by which touching is decided generously.
constexpr double kSlack = 1e-6;

using Triangle = glm::dvec3[3];

/// Calls visit(triangle) for each triangle until it returns true. @return  whether it did
template <class Visit>
bool anyTriangle(const LevelSurface& surface, const Visit& visit) {
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const Triangle triangle = {glm::dvec3(surface.positions[surface.indices[i]]),
                               glm::dvec3(surface.positions[surface.indices[i + 1]]),
                               glm::dvec3(surface.positions[surface.indices[i + 2]])};
    if (visit(triangle)) return true;
  }
  return false;
}

bool windsAround(std::span<const LevelSurface> levels, const glm::dvec3& point, bool insideOut) {
  return std::all_of(levels.begin(), levels.end(), [&](const LevelSurface& level) {
    const double winding = windingNumber(level, point);
    return (insideOut ? std::abs(winding) : winding) > 0.5;
  });
}

bool isTouched(const Aabb& box, std::span<const LevelSurface> levels) {
  const glm::dvec3 low(box.min);
  const glm::dvec3 high(box.max);
  return std::any_of(levels.begin(), levels.end(), [&](const LevelSurface& level) {
    return anyTriangle(level, [&](const Triangle& t) { return touches(t, 0.5 * (low + high), 0.5 * (high - low)); });
  });
}

/// A box of cells, from `low` to before `high`.
struct CellBox {
  glm::uvec3 low{0U};
  glm::uvec3 high{0U};
  std::uint64_t volume() const {
    const glm::uvec3 side = high - low;
    return std::uint64_t{side.x} * side.y * side.z;
  }
};

class Grid {
 public:
  Grid(std::span<const LevelSurface> levels, std::uint32_t cells)
      : cells_(cells), state_(cells * cells * cells, kOpen) {
    for (const LevelSurface& level : levels)
      for (const std::uint32_t index : level.indices)
        bounds_.add(level.positions[index]);
    origin_ = bounds_.min;
    cell_ = (glm::dvec3(bounds_.max) - origin_) / static_cast<double>(cells);
  }

  const Aabb& bounds() const { return bounds_; }
  bool isFlat() const { return !(cell_.x > 0.0 && cell_.y > 0.0 && cell_.z > 0.0); }

  void mark(const LevelSurface& level) {
    anyTriangle(level, [&](const Triangle& t) {
      const glm::uvec3 first = cellAt(glm::min(glm::min(t[0], t[1]), t[2]) - kSlack * cell_);
      const glm::uvec3 last = cellAt(glm::max(glm::max(t[0], t[1]), t[2]) + kSlack * cell_);
      forEach({first, last + 1U}, [&](const glm::uvec3& at) {
        if (touches(t, origin_ + (glm::dvec3(at) + 0.5) * cell_, (0.5 + kSlack) * cell_)) state(at) = kTouched;
      });
      return false;
    });
  }

  /// Says of each open cell whether the levels wind around it; once for cells that are connected.
  void fill(std::span<const LevelSurface> levels, bool insideOut) {
    forEach({glm::uvec3(0U), glm::uvec3(cells_)}, [&](const glm::uvec3& at) {
      if (state(at) != kOpen) return;
      const glm::dvec3 middle = origin_ + (glm::dvec3(at) + 0.5) * cell_;
      spread(at, windsAround(levels, middle, insideOut) ? kInside : kOutside);
    });
  }

  /// The largest box of cells inside; the first of equal ones.
  CellBox largest() const {
    CellBox best;
    std::vector<std::uint8_t> column(std::size_t{cells_} * cells_);
    for (std::uint32_t z = 0; z < cells_; ++z) {
      std::fill(column.begin(), column.end(), std::uint8_t{1});
      for (std::uint32_t end = z + 1; end <= cells_; ++end) {
        for (std::uint32_t y = 0; y < cells_; ++y)
          for (std::uint32_t x = 0; x < cells_; ++x)
            if (state({x, y, end - 1}) != kInside) column[y * cells_ + x] = 0;
        const CellRectangle found = largestRectangle(column, cells_);
        const CellBox box{{found.low, z}, {found.high, end}};
        if (box.volume() > best.volume()) best = box;
      }
    }
    return best;
  }

  void take(const CellBox& box) {
    forEach(box, [&](const glm::uvec3& at) { state(at) = kTouched; });
  }

  /// Where a box of cells lies, a little smaller.
  Aabb place(const CellBox& box) const {
    return {glm::vec3(origin_ + (glm::dvec3(box.low) + 1e-4) * cell_),
            glm::vec3(origin_ + (glm::dvec3(box.high) - 1e-4) * cell_)};
  }
  glm::vec3 cell() const { return glm::vec3(cell_); }

 private:
  std::uint8_t& state(const glm::uvec3& at) { return state_[(at.z * cells_ + at.y) * cells_ + at.x]; }
  std::uint8_t state(const glm::uvec3& at) const { return state_[(at.z * cells_ + at.y) * cells_ + at.x]; }

  glm::uvec3 cellAt(const glm::dvec3& point) const {
    const glm::dvec3 at = glm::floor((point - origin_) / cell_);
    return glm::uvec3(glm::clamp(at, glm::dvec3(0.0), glm::dvec3(cells_ - 1U)));
  }

  template <class Visit>
  static void forEach(const CellBox& box, const Visit& visit) {
    for (std::uint32_t z = box.low.z; z < box.high.z; ++z)
      for (std::uint32_t y = box.low.y; y < box.high.y; ++y)
        for (std::uint32_t x = box.low.x; x < box.high.x; ++x)
          visit(glm::uvec3(x, y, z));
  }

  void spread(const glm::uvec3& from, std::uint8_t kind) {
    std::vector<glm::uvec3> next = {from};
    state(from) = kind;
    while (!next.empty()) {
      const glm::uvec3 at = next.back();
      next.pop_back();
      for (int side = 0; side < 6; ++side) {
        glm::uvec3 beside = at;
        const int axis = side / 2;
        if (side % 2 == 0 ? at[axis] == 0 : at[axis] + 1 == cells_) continue;
        beside[axis] += side % 2 == 0 ? ~0U : 1U;
        if (state(beside) != kOpen) continue;
        state(beside) = kind;
        next.push_back(beside);
      }
    }
  }

  std::uint32_t cells_;
  std::vector<std::uint8_t> state_;
  Aabb bounds_;
  glm::dvec3 origin_{0.0};
  glm::dvec3 cell_{0.0};
};

/// Moves each side of a box outwards, by up to `reach`, as far as nothing touches it.
Aabb grown(Aabb box, std::span<const LevelSurface> levels, const glm::vec3& reach) {
  constexpr int kSteps = 8;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    float& place = side % 2 == 0 ? box.min[axis] : box.max[axis];
    const float start = place;
    const float outward = side % 2 == 0 ? -reach[axis] : reach[axis];
    float share = 0.0F;
    for (int step = 1; step <= kSteps; ++step) {
      const float tried = share + std::exp2(static_cast<float>(-step));
      place = start + tried * outward;
      if (!isTouched(box, levels)) share = tried;
    }
    place = start + share * outward;
  }
  return box;
}

}  // namespace

bool isClosed(const LevelSurface& surface) {
  const std::vector<std::uint32_t> numberOf = firstAtPlace(surface);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::int64_t> balance;
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = numberOf[surface.indices[i + k]];
      const std::uint32_t to = numberOf[surface.indices[i + (k + 1) % 3]];
      if (from != to) balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  }
  return !balance.empty() &&
         std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

double windingNumber(const LevelSurface& surface, const glm::dvec3& point) {
  double sum = 0.0;
  anyTriangle(surface, [&](const Triangle& t) {
    const std::array<glm::dvec3, 3> v = {t[0] - point, t[1] - point, t[2] - point};
    const std::array<double, 3> length = {glm::length(v[0]), glm::length(v[1]), glm::length(v[2])};
    const double volume = glm::dot(v[0], glm::cross(v[1], v[2]));
    const double rest = length[0] * length[1] * length[2] + glm::dot(v[0], v[1]) * length[2] +
                        glm::dot(v[0], v[2]) * length[1] + glm::dot(v[1], v[2]) * length[0];
    sum += 2.0 * std::atan2(volume, rest);
    return false;
  });
  return sum / (4.0 * std::numbers::pi);
}

std::vector<Aabb> innerBoxes(std::span<const LevelSurface> levels, const InnerBoxOptions& options) {
  JAL_CHECK(!levels.empty());
  JAL_CHECK(options.cells >= 1U);
  JAL_CHECK(options.cells <= 64U);
  Grid grid(levels, options.cells);
  if (grid.bounds().empty() || grid.isFlat()) return {};
  for (const LevelSurface& level : levels)
    grid.mark(level);
  grid.fill(levels, options.insideOut);
  const double total = std::pow(static_cast<double>(options.cells), 3.0);
  std::vector<Aabb> boxes;
  while (boxes.size() < options.boxes) {
    const CellBox found = grid.largest();
    if (static_cast<double>(found.volume()) < std::max(options.least * total, 1.0)) break;
    grid.take(found);
    const Aabb box = grown(grid.place(found), levels, grid.cell());
    if (liesInside(box, levels, options.insideOut)) boxes.push_back(box);
  }
  return boxes;
}

bool liesInside(const Aabb& box, std::span<const LevelSurface> levels, bool insideOut) {
  return !isTouched(box, levels) && windsAround(levels, 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max)), insideOut);
}

}  // namespace jalousie::bake
