// Breadth first over a grid of squares; lines that nobody can step over block the squares beside them.
#include "wad/walk_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace jalousie::wad {
namespace {

constexpr double kSpacing = 32.0;  // units of the level, unless there would be more than kMostSquares
constexpr double kMostSquares = 262144.0;
constexpr std::int32_t kPlayerHeight = 56;
constexpr std::int32_t kStep = 24;
constexpr double kSpeed = 240.0;  // units of the level a second
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool blocks(const Level& level, const Line& line) {
  if (!line.sides[0] || !line.sides[1]) return true;
  const Opening opening = openingOf(level, line);
  const std::int32_t right = level.sectors[level.sides[*line.sides[0]].sector].floor;
  const std::int32_t left = level.sectors[level.sides[*line.sides[1]].sector].floor;
  return opening.high - opening.low < kPlayerHeight || std::abs(right - left) > kStep;
}

class WalkGrid {
 public:
  explicit WalkGrid(const Level& level) : level_(level) {
    glm::dvec2 low(0.0);
    glm::dvec2 high(0.0);
    for (std::size_t i = 0; i < level.lines.size(); ++i) {
      const glm::dvec2 place(level.vertices[level.lines[i].ends[0]]);
      low = i == 0 ? place : glm::min(low, place);
      high = i == 0 ? place : glm::max(high, place);
    }
    const glm::dvec2 extent = high - low;
    spacing_ = std::max(kSpacing, std::sqrt((extent.x + kSpacing) * (extent.y + kSpacing) / kMostSquares));
    origin_ = low;
    size_ = glm::ivec2(extent / spacing_) + 2;
    isBlocked_.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y));
    for (const Line& line : level.lines)
      if (blocks(level, line)) block(line);
  }

  /// Squares from one near a place to the farthest one; empty where none is free.
  std::vector<glm::dvec2> wayFrom(const glm::ivec2& start) const {
    const std::uint32_t first = freeNear(start);
    if (first == kNone) return {};
    std::vector<std::uint32_t> before(isBlocked_.size(), kNone);
    std::vector<std::uint32_t> queue{first};
    before[first] = first;
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (const std::uint32_t next : neighbours(queue[i]))
        if (next != kNone && !isBlocked_[next] && before[next] == kNone) {
          before[next] = queue[i];
          queue.push_back(next);
        }
    std::vector<glm::dvec2> way;
    for (std::uint32_t at = queue.back(); at != first; at = before[at])
      way.push_back(middleOf(at));
    way.push_back(middleOf(first));
    std::reverse(way.begin(), way.end());
    return way;
  }

 private:
  glm::dvec2 middleOf(std::uint32_t square) const {
    const auto width = static_cast<std::uint32_t>(size_.x);
    return origin_ + spacing_ * glm::dvec2(square % width, square / width);
  }

  std::uint32_t squareAt(const glm::ivec2& square) const {
    if (square.x < 0 || square.y < 0 || square.x >= size_.x || square.y >= size_.y) return kNone;
    return static_cast<std::uint32_t>(square.y) * static_cast<std::uint32_t>(size_.x) +
           static_cast<std::uint32_t>(square.x);
  }

  std::array<std::uint32_t, 4> neighbours(std::uint32_t square) const {
    const glm::ivec2 at(static_cast<int>(square) % size_.x, static_cast<int>(square) / size_.x);
    return {squareAt(at + glm::ivec2(1, 0)), squareAt(at - glm::ivec2(1, 0)), squareAt(at + glm::ivec2(0, 1)),
            squareAt(at - glm::ivec2(0, 1))};
  }

  /// Blocks all squares whose middle is near to a line.
  void block(const Line& line) {
    constexpr double kClearance = 0.75;  // of the spacing: more than half a diagonal
    const glm::dvec2 from(level_.vertices[line.ends[0]]);
    const glm::dvec2 to(level_.vertices[line.ends[1]]);
    const int samples = 2 + static_cast<int>(2.0 * glm::length(to - from) / spacing_);
    for (int i = 0; i <= samples; ++i) {
      const glm::dvec2 place = glm::mix(from, to, static_cast<double>(i) / samples);
      const glm::ivec2 middle(glm::round((place - origin_) / spacing_));
      for (int k = 0; k < 9; ++k) {
        const std::uint32_t square = squareAt(middle + glm::ivec2(k % 3 - 1, k / 3 - 1));
        if (square == kNone) continue;
        if (squaredDistance(middleOf(square), from, to) <= kClearance * kClearance * spacing_ * spacing_)
          isBlocked_[square] = true;
      }
    }
  }

  std::uint32_t freeNear(const glm::ivec2& place) const {
    constexpr int kReach = 2;
    const glm::ivec2 middle(glm::round((glm::dvec2(place) - origin_) / spacing_));
    std::uint32_t best = kNone;
    double least = std::numeric_limits<double>::infinity();
    for (int y = -kReach; y <= kReach; ++y) {
      for (int x = -kReach; x <= kReach; ++x) {
        const std::uint32_t square = squareAt(middle + glm::ivec2(x, y));
        if (square == kNone || isBlocked_[square]) continue;
        const double distance = glm::length(middleOf(square) - glm::dvec2(place));
        if (distance >= least) continue;
        least = distance;
        best = square;
      }
    }
    return best;
  }

  const Level& level_;
  double spacing_ = kSpacing;
  glm::dvec2 origin_{0.0};
  glm::ivec2 size_{0};
  std::vector<bool> isBlocked_;
};

/// Each point becomes the mean of itself and its neighbours. @param reach  neighbours on each side
template <class Vector>
std::vector<Vector> smoothed(const std::vector<Vector>& points, std::size_t reach) {
  std::vector<Vector> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t span = std::min({reach, i, points.size() - 1 - i});
    Vector sum(0.0);
    for (std::size_t k = i - span; k <= i + span; ++k)
      sum += points[k];
    result.push_back(sum / static_cast<double>(2 * span + 1));
  }
  return result;
}

/// Looks along a level direction of the scene, y up.
glm::quat lookingAlong(const glm::dvec3& direction) {
  const double angle = std::atan2(-direction.x, -direction.z);
  return glm::quat(glm::angleAxis(static_cast<float>(angle), glm::vec3(0.0F, 1.0F, 0.0F)));
}

}  // namespace

std::optional<double> floorAt(const LevelPlan& plan, const glm::dvec2& place) {
  const glm::dvec3 point = sceneFromLevel(place, 0.0);
  for (const Room& room : plan.plan.rooms) {
    const auto [low, high] = extentOf(room);
    if (point.x < low.x || point.x > high.x || point.z < low.y || point.z > high.y) continue;
    if (isInside(room, {point.x, point.z})) return room.floor * kUnits;
  }
  return std::nullopt;
}

WalkPath walkThrough(const Level& level, const LevelPlan& plan) {
  constexpr std::uint32_t kPlayer = 1;
  constexpr std::size_t kAhead = 4;
  const auto start =
      std::find_if(level.things.begin(), level.things.end(), [](const Thing& thing) { return thing.type == kPlayer; });
  if (start == level.things.end() || level.lines.empty()) return {};
  const std::vector<glm::dvec2> way = smoothed(WalkGrid(level).wayFrom(start->place), 1);
  std::vector<glm::dvec3> eyes;
  for (const glm::dvec2& place : way) {
    const std::optional<double> floor = floorAt(plan, place);
    if (!floor) break;
    eyes.push_back(sceneFromLevel(place, *floor + kEyeHeight));
  }
  eyes = smoothed(eyes, 2);
  WalkPath path;
  double seconds = 0.0;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    if (i > 0) seconds += std::max(glm::length(eyes[i] - eyes[i - 1]) * kUnits / kSpeed, 1e-3);
    const std::size_t ahead = std::min(i + kAhead, eyes.size() - 1);
    const glm::dvec3 direction = ahead > i ? eyes[ahead] - eyes[i] : glm::dvec3(0.0);
    const bool moves = std::abs(direction.x) + std::abs(direction.z) > 1e-9;
    glm::quat rotation = moves                    ? lookingAlong(direction)
                         : path.rotations.empty() ? glm::quat(1.0F, 0.0F, 0.0F, 0.0F)
                                                  : path.rotations.back();
    if (!path.rotations.empty() && glm::dot(rotation, path.rotations.back()) < 0.0F) rotation = -rotation;
    path.times.push_back(static_cast<float>(seconds));
    path.positions.emplace_back(eyes[i]);
    path.rotations.push_back(rotation);
  }
  return path;
}

}  // namespace jalousie::wad
