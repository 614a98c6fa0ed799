// The rule of the ghost view.
#include "visibility/ghost_reference.h"

#include <gtest/gtest.h>

namespace jalousie::visibility {
namespace {

gpu::Chain chainOf(gpu::uint lodCount) {
  gpu::Chain chain{};
  chain.lodCount = lodCount;
  return chain;
}

TEST(GhostReference, OnlyWhatTheFrameDidNotDrawIsAGhost) {
  const gpu::Chain chain = chainOf(4);
  const gpu::ObjectState state{gpu::kVerdictOccluded, 2, 7, 0.25F};
  EXPECT_EQ(ghostOf(chain, state, 0, false).marks, gpu::kMarkLate);
  EXPECT_EQ(ghostOf(chain, state, gpu::kMarkLate, false).marks, 0U);
  EXPECT_EQ(ghostOf(chain, state, gpu::kMarkLate, true).marks, 0U);
}

TEST(GhostReference, TheEarlyPhaseDrawsIntoTheFrameOnlyWithTwoPhases) {
  EXPECT_EQ(ghostOf(chainOf(1), {}, gpu::kMarkEarly, true).marks, 0U);
  EXPECT_EQ(ghostOf(chainOf(1), {}, gpu::kMarkEarly, false).marks, gpu::kMarkLate);
}

TEST(GhostReference, IsDrawnAtTheCoarsestLevelWithTheFramesVerdict) {
  const gpu::ObjectState state{gpu::kVerdictSmall, 2, 7, 0.25F};
  const Ghost ghost = ghostOf(chainOf(4), state, gpu::kMarkMirrored | gpu::kMarkTested | gpu::kMarkFadeMask, true);
  EXPECT_EQ(ghost.state.verdict, gpu::kVerdictSmall);
  EXPECT_EQ(ghost.state.lod, 3U);
  EXPECT_EQ(ghost.state.tessellation, 1U);
  EXPECT_EQ(ghost.state.lv, 1.0F);
  EXPECT_EQ(ghost.marks, gpu::kMarkLate | gpu::kMarkMirrored) << "no cross-fade, no history";
}

}  // namespace
}  // namespace jalousie::visibility
