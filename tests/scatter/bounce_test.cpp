// Paths of moving objects against a simulation in small steps.
#include "scatter/bounce.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jalousie::scatter {
namespace {

glm::vec3 at(const BouncePath& path, double time) {
  std::size_t k = 1;
  while (k + 1 < path.times.size() && static_cast<double>(path.times[k]) < time)
    ++k;
  const double from = path.times[k - 1];
  const double share = (time - from) / (static_cast<double>(path.times[k]) - from);
  return glm::mix(path.positions[k - 1], path.positions[k], static_cast<float>(share));
}

TEST(ScatterBounce, FollowsTheLineThatTheSidesReflect) {
  const double half = 5.0;
  glm::dvec3 position(1.0, -4.0, 0.0);
  glm::dvec3 velocity(2.0, -0.7, 0.0);
  const BouncePath path = bouncePath(position, velocity, half, 60.0);
  EXPECT_EQ(path.times.front(), 0.0F);
  EXPECT_EQ(path.times.back(), 60.0F);
  constexpr double kStep = 1.0 / 1024.0;
  for (int step = 0; step < 60 * 1024; ++step) {
    if (step % 512 == 0) {
      const glm::vec3 found = at(path, step * kStep);
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(found[axis], position[axis], 1e-4) << step;
    }
    position += velocity * kStep;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(position[axis]) <= half) continue;
      position[axis] = std::copysign(2.0 * half, position[axis]) - position[axis];
      velocity[axis] = -velocity[axis];
    }
  }
  for (std::size_t k = 1; k < path.times.size(); ++k)
    EXPECT_GT(path.times[k], path.times[k - 1]);
}

TEST(ScatterBounce, AnObjectInACornerAndOneAtRestHaveAPath) {
  const BouncePath corner = bouncePath(glm::dvec3(3.0), glm::dvec3(1.0), 3.0, 10.0);
  for (const glm::vec3& p : corner.positions)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LE(std::abs(p[axis]), 3.0F);
  EXPECT_EQ(bouncePath(glm::dvec3(1.0), glm::dvec3(0.0), 3.0, 10.0).times, (std::vector<float>{0.0F, 10.0F}));
}

Layout moving(std::uint32_t count, float share, Shape shape = Shape::kCube) {
  Layout layout;
  layout.count = count;
  layout.moving = share;
  layout.shape = shape;
  return layout;
}

TEST(ScatterBounce, TheShareMovesAndTheMiddleStays) {
  EXPECT_TRUE(chooseMovers(moving(1000, 0.0F), 10.0F).empty());
  EXPECT_EQ(chooseMovers(moving(1000, 1.0F), 10.0F).size(), 999U);
  const std::vector<Mover> some = chooseMovers(moving(4000, 0.25F), 10.0F);
  EXPECT_NEAR(static_cast<double>(some.size()), 1000.0, 100.0);
  for (const Mover& mover : some) {
    EXPECT_GT(mover.object, 0U);
    EXPECT_GE(glm::length(mover.velocity), 10.0 / 20.0 - 1e-6);
    EXPECT_LE(glm::length(mover.velocity), 10.0 / 5.0 + 1e-6);
  }
}

TEST(ScatterBounce, OnTheGroundNothingLeavesIt) {
  const std::vector<Mover> all = chooseMovers(moving(100, 1.0F, Shape::kGround), 10.0F);
  ASSERT_EQ(all.size(), 99U);
  for (const Mover& mover : all) {
    EXPECT_EQ(mover.velocity.y, 0.0);
    EXPECT_GE(glm::length(mover.velocity), 10.0 / 20.0 - 1e-6);
  }
}

}  // namespace
}  // namespace jalousie::scatter
