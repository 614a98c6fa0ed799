// Laws of all schedules of queries, answer by answer, against a software raster.
#include "culling/query_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "culling/loose_grid.h"
#include "culling/query_raster.h"
#include "culling/schedule_table.h"

namespace jalousie::culling {
namespace {

using test::RasterDevice;

constexpr QueryMethod kMethods[] = {QueryMethod::kWait,     QueryMethod::kBatch,        QueryMethod::kCoherentFlat,
                                    QueryMethod::kCoherent, QueryMethod::kCoherentPlus, QueryMethod::kSlabs,
                                    QueryMethod::kSiblings, QueryMethod::kDeferred};

/// Walls and small boxes behind and between them.
std::vector<Aabb> makeScene(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 center(random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-10, 10));
    const glm::vec3 half = i % 8 == 0 ? glm::vec3(3.0F, 3.0F, 0.05F) : glm::vec3(random.uniform(0.1F, 0.5F));
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

scene::Camera cameraAt(float turn) {
  const glm::vec3 eye(18.0F * std::sin(turn), 2.0F, 18.0F * std::cos(turn));
  return scene::lookAt(eye, {0.3F, 0.1F, 0.2F}, {glm::vec3(-10), glm::vec3(10)});
}

QueryView viewOf(const scene::Camera& camera) {
  const glm::uvec2 viewport(RasterDevice::kSide);
  return makeQueryView(scene::clipFromWorld(camera, 1.0F), glm::vec4(camera.positionWorld(), camera.zNear),
                       glm::vec4(camera.forwardWorld(), 0.0F), scene::focalPixels(camera, viewport), viewport);
}

/// A schedule with what it works on.
struct Machine {
  Machine(QueryMethod method, const std::vector<Aabb>& boxes, const QueryOptions& queryOptions = {},
          std::uint32_t capacity = 400)
      : options(queryOptions),
        grid(needsGrid(method) ? buildGrid(boxes, gridOptions(method)) : LooseGrid{}),
        tree(needsGrid(method) ? grid.tree : buildHierarchy(boxes)),
        device(needsGrid(method) ? grid.tree : tree, {}, queryOptions.threshold, capacity),
        schedule(makeSchedule(method, needsGrid(method) ? grid.tree : tree, &grid)) {}

  void frame(const scene::Camera& camera) {
    const QueryView view = viewOf(camera);
    device.begin(camera, view);
    schedule->run(view, options, device);
  }

  QueryOptions options;
  LooseGrid grid;
  SpatialHierarchy tree;
  RasterDevice device;
  std::unique_ptr<QuerySchedule> schedule;
};

/// The picture of all objects. @return  objects with a pixel
std::size_t expectSamePicture(Machine& machine, const scene::Camera& camera, const std::string& what) {
  const SpatialHierarchy& tree = machine.grid.tree.nodes.empty() ? machine.tree : machine.grid.tree;
  RasterDevice all(tree, camera, 0, 0);
  const QueryView view = viewOf(camera);
  all.begin(camera, view);
  all.drawAll();
  EXPECT_EQ(machine.device.ids(), all.ids()) << what;
  EXPECT_EQ(machine.device.depths(), all.depths()) << what;
  EXPECT_FALSE(machine.device.drewTwice()) << what;
  std::vector<std::uint32_t> seen = all.ids();
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  return seen.size() - (seen.back() == RasterDevice::kNothing ? 1 : 0);
}

std::string nameOf(QueryMethod method, int frame) {
  return "method " + std::to_string(static_cast<int>(method)) + ", frame " + std::to_string(frame);
}

TEST(QuerySchedule, ThePictureIsThatOfAllObjects) {
  for (const QueryMethod method : kMethods) {
    for (const std::uint64_t seed : {1U, 2U}) {
      Machine machine(method, makeScene(250, seed));
      std::uint64_t drawn = 0;
      for (int frame = 0; frame < 14; ++frame) {
        const float turn = 0.03F * static_cast<float>(frame) + (frame >= 8 ? 2.0F : 0.0F);  // a cut
        machine.frame(cameraAt(turn));
        const std::size_t visible = expectSamePicture(machine, cameraAt(turn), nameOf(method, frame));
        EXPECT_GE(machine.device.drawn(), visible);
        drawn += machine.device.drawn();
      }
      EXPECT_LT(drawn, 14U * 200U) << nameOf(method, 0) << ": something is culled";
    }
  }
}

TEST(QuerySchedule, BatchesAndBoundsAndIntervalsChangeCountsAndNeverThePicture) {
  const std::vector<Aabb> boxes = makeScene(200, 5);
  Random random(8);
  for (const QueryMethod method : kMethods) {
    for (int trial = 0; trial < 10; ++trial) {
      QueryOptions options;
      options.batch = 1 + random.below(80);
      options.multiquery = static_cast<Multiquery>(random.below(3));
      options.tightBounds = random.below(2) == 0 ? 0.0F : random.uniform(1.0F, 3.0F);
      options.requery = random.below(10);
      options.planeDepth = random.below(6);
      options.unitsTogether = random.below(2) == 0;
      Machine machine(method, boxes, options, 16 + random.below(100));
      for (int frame = 0; frame < 5; ++frame) {
        const float turn = 0.02F * static_cast<float>(frame + trial);
        machine.frame(cameraAt(turn));
        expectSamePicture(machine, cameraAt(turn), nameOf(method, frame));
      }
      EXPECT_LE(machine.device.mostUnanswered(), machine.device.capacity()) << nameOf(method, trial);
    }
  }
}

TEST(QuerySchedule, AnEyeInsideABoxAndAmongThemSeesEverything) {
  std::vector<Aabb> boxes = makeScene(100, 3);
  for (const QueryMethod method : kMethods) {
    Machine machine(method, boxes);
    Random random(4);
    for (int frame = 0; frame < 8; ++frame) {
      const Aabb& box = boxes[random.below(100)];
      const scene::Camera camera = scene::lookAt(box.center(), {0.01F, 0.02F, 0.03F}, {glm::vec3(-10), glm::vec3(10)});
      machine.frame(camera);
      expectSamePicture(machine, camera, nameOf(method, frame));
    }
  }
}

TEST(QuerySchedule, TwoRunsDoTheSame) {
  for (const QueryMethod method : kMethods) {
    std::vector<std::uint64_t> figures[2];
    for (std::vector<std::uint64_t>& run : figures) {
      Machine machine(method, makeScene(200, 6));
      for (int frame = 0; frame < 6; ++frame) {
        machine.frame(cameraAt(0.02F * static_cast<float>(frame)));
        const QueryFigures& f = machine.device.figures();
        run.insert(run.end(), {f.queries, f.queryBoxes, f.queryWaits, f.queryRoundTrips, f.querySwitches, f.slices,
                               f.nodesVisited});
      }
    }
    EXPECT_EQ(figures[0], figures[1]);
  }
}

TEST(QuerySchedule, EmptyScenesAndSingleObjectsWork) {
  for (const QueryMethod method : kMethods) {
    Machine none(method, {});
    none.frame(cameraAt(0));
    EXPECT_EQ(none.device.figures().queries, 0U);
    Machine one(method, {{glm::vec3(-1), glm::vec3(1)}});
    one.frame(cameraAt(0));
    EXPECT_EQ(one.device.drawn(), 1U);
    Machine piled(method, std::vector<Aabb>(40, {glm::vec3(-1), glm::vec3(1)}));
    piled.frame(cameraAt(0));
    expectSamePicture(piled, cameraAt(0), nameOf(method, 0));
  }
}

QueryFigures settledFigures(QueryMethod method, const QueryOptions& options = {}) {
  Machine machine(method, makeScene(600, 11), options);
  for (int frame = 0; frame < 20; ++frame)
    machine.frame(cameraAt(0.005F * static_cast<float>(frame)));
  const QueryFigures before = machine.device.figures();
  machine.frame(cameraAt(0.1F));
  QueryFigures last = machine.device.figures();
  last.queries -= before.queries;
  last.queryRoundTrips -= before.queryRoundTrips;
  last.queryWaits -= before.queryWaits;
  last.querySwitches -= before.querySwitches;
  return last;
}

TEST(QuerySchedule, EachRungOfTheLadderSavesWhatItsPaperSays) {
  const QueryFigures wait = settledFigures(QueryMethod::kWait);
  const QueryFigures batch = settledFigures(QueryMethod::kBatch);
  const QueryFigures chc = settledFigures(QueryMethod::kCoherent);
  const QueryFigures plus = settledFigures(QueryMethod::kCoherentPlus);
  EXPECT_EQ(wait.queryRoundTrips, wait.queries) << "nothing goes on while an answer is out";
  EXPECT_EQ(batch.queries, wait.queries);
  EXPECT_LT(10 * batch.queryWaits, wait.queryWaits);
  EXPECT_LT(10 * batch.querySwitches, wait.querySwitches);
  EXPECT_LT(chc.queries, batch.queries);
  EXPECT_LT(plus.queries, chc.queries);
  EXPECT_LT(4 * plus.querySwitches, chc.querySwitches);
  EXPECT_EQ(settledFigures(QueryMethod::kDeferred).queryWaits, 0U);
  QueryOptions alone;
  alone.unitsTogether = false;
  EXPECT_LT(2 * settledFigures(QueryMethod::kSlabs).queryWaits, settledFigures(QueryMethod::kSlabs).queries);
  EXPECT_LT(2 * settledFigures(QueryMethod::kSiblings).queryWaits,
            settledFigures(QueryMethod::kSiblings, alone).queryWaits);
}

TEST(QuerySchedule, AThresholdLosesAtMostItsSamplesANode) {
  for (const QueryMethod method : kMethods) {
    QueryOptions options;
    options.threshold = 6;
    Machine tolerant(method, makeScene(250, 1), options);
    Machine exact(method, makeScene(250, 1));
    std::uint64_t less = 0;
    for (int frame = 0; frame < 4; ++frame) {
      const float turn = 0.03F * static_cast<float>(frame);
      tolerant.frame(cameraAt(turn));
      exact.frame(cameraAt(turn));
      less += exact.device.drawn() - std::min(exact.device.drawn(), tolerant.device.drawn());
    }
    EXPECT_GT(less, 0U) << nameOf(method, 0);
  }
}

TEST(QuerySchedule, ForgettingTakesBackEveryQuery) {
  for (const QueryMethod method : kMethods) {
    QueryOptions options;
    options.requery = 0;
    Machine machine(method, makeScene(250, 2), options);
    for (int frame = 0; frame < 4; ++frame)
      machine.frame(cameraAt(0.0F));
    EXPECT_EQ(machine.device.unanswered() > 0, method == QueryMethod::kCoherentPlus);
    machine.schedule->forget(machine.device);
    EXPECT_EQ(machine.device.unanswered(), 0U);
    machine.frame(cameraAt(1.0F));
    expectSamePicture(machine, cameraAt(1.0F), nameOf(method, 0));
  }
}

TEST(QuerySchedule, FollowsObjectsThatMove) {
  for (const QueryMethod method : kMethods) {
    if (needsGrid(method)) continue;  // it is built anew
    std::vector<Aabb> boxes = makeScene(200, 7);
    Machine machine(method, boxes);
    Random random(1);
    for (int frame = 0; frame < 8; ++frame) {
      for (Aabb& box : boxes) {
        const glm::vec3 step(random.uniform(-0.5F, 0.5F), random.uniform(-0.5F, 0.5F), random.uniform(-0.5F, 0.5F));
        box = {box.min + step, box.max + step};
      }
      refit(machine.tree, boxes);
      machine.frame(cameraAt(0.05F * static_cast<float>(frame)));
      expectSamePicture(machine, cameraAt(0.05F * static_cast<float>(frame)), nameOf(method, frame));
    }
  }
}

}  // namespace
}  // namespace jalousie::culling
