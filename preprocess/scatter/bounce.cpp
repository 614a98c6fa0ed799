// Only sums, products and square roots, which all machines round alike.
#include "scatter/bounce.h"

#include <algorithm>
#include <cmath>

namespace jalousie::scatter {
namespace {

/// Reflects a coordinate into [-half, half].
double reflected(double x, double half) {
  const double period = 4.0 * half;
  double place = std::fmod(x + half, period);
  if (place < 0.0) place += period;
  return (place <= 2.0 * half ? place : period - place) - half;
}

/// Adds the times at which one axis meets a side.
void addReflections(double start, double velocity, double half, double seconds, std::vector<double>& times) {
  if (velocity == 0.0) return;
  const double first = ((velocity > 0.0 ? half : -half) - start) / velocity;
  const double step = 2.0 * half / std::abs(velocity);
  for (double time = first; time < seconds; time += step)
    times.push_back(time);
}

}  // namespace

BouncePath bouncePath(const glm::dvec3& start, const glm::dvec3& velocity, double halfSide, double seconds) {
  std::vector<double> times = {0.0, seconds};
  for (int axis = 0; axis < 3; ++axis)
    addReflections(start[axis], velocity[axis], halfSide, seconds, times);
  std::sort(times.begin(), times.end());
  BouncePath path;
  for (const double time : times) {
    const auto key = static_cast<float>(time);
    if (!path.times.empty() && !(key > path.times.back())) continue;  // keys ascend
    glm::vec3 position(0.0F);
    for (int axis = 0; axis < 3; ++axis)
      position[axis] = static_cast<float>(reflected(start[axis] + velocity[axis] * time, halfSide));
    path.times.push_back(key);
    path.positions.push_back(position);
  }
  return path;
}

std::vector<Mover> chooseMovers(const Layout& layout, float side) {
  constexpr double kSlowest = 20.0;  // seconds through the cube
  constexpr double kFastest = 5.0;
  Random random(layout.seed ^ 0x6d6f76696e67ULL);
  std::vector<Mover> movers;
  for (std::uint32_t object = 1; object < layout.count; ++object) {
    const bool moves = random.uniform() < layout.moving;
    glm::dvec3 direction(0.0);
    do {
      for (int axis = 0; axis < 3; ++axis)
        direction[axis] = double{random.uniform(-1.0F, 1.0F)};
      if (layout.isOnGround()) direction.y = 0.0;
    } while (!(glm::dot(direction, direction) > 1e-4 && glm::dot(direction, direction) <= 1.0));
    const double seconds = kFastest + (kSlowest - kFastest) * double{random.uniform()};
    if (moves) movers.push_back({object, direction / std::sqrt(glm::dot(direction, direction)) * (side / seconds)});
  }
  return movers;
}

}  // namespace jalousie::scatter
