// The values of CHC++ against numbers computed by hand.
#include "culling/multiquery.h"

#include <gtest/gtest.h>

#include <vector>

namespace jalousie::culling {
namespace {

/// Sizes of the queries that a queue becomes.
std::vector<std::size_t> sizesOf(const std::vector<HiddenNode>& nodes, Multiquery kind) {
  std::vector<std::size_t> sizes;
  for (std::size_t first = 0; first < nodes.size(); first += sizes.back())
    sizes.push_back(multiquerySize(std::span(nodes).subspan(first), kind));
  return sizes;
}

/// Queries that are expected to be asked: those of the queue, and one a node where one of several is visible.
double expectedQueries(const std::vector<HiddenNode>& nodes, Multiquery kind) {
  double sum = 0.0;
  std::size_t next = 0;
  for (const std::size_t size : sizesOf(nodes, kind)) {
    double hidden = 1.0;
    for (std::size_t i = 0; i < size; ++i)
      hidden *= persistence(nodes[next++].framesHidden);
    sum += 1.0 + (size > 1 ? (1.0 - hidden) * static_cast<double>(size) : 0.0);
  }
  return sum;
}

TEST(Multiquery, PersistenceGrowsWithTheFramesHidden) {
  const double expected[] = {0.29, 0.73, 0.90, 0.96, 0.98, 0.985};
  for (std::uint32_t t = 0; t < 6; ++t)
    EXPECT_NEAR(persistence(t), expected[t], 0.006) << t;
}

TEST(Multiquery, OldNodesAskTogetherAndNewOnesAlone) {
  const std::vector<HiddenNode> old(50, {1000, 1});
  EXPECT_EQ(sizesOf(old, Multiquery::kNodes), (std::vector<std::size_t>{11, 11, 11, 11, 6}));
  EXPECT_NEAR(expectedQueries(old, Multiquery::kNodes), 10.0, 0.1);
  std::vector<HiddenNode> mixed(40, {1000, 1});
  mixed.insert(mixed.end(), 10, {0, 1});
  EXPECT_NEAR(expectedQueries(mixed, Multiquery::kNodes), 18.9, 0.2);
  const std::vector<HiddenNode> wrongWay(mixed.rbegin(), mixed.rend());
  EXPECT_GT(expectedQueries(wrongWay, Multiquery::kNodes), 45.0) << "the surest come first";
}

TEST(Multiquery, HasOneNodeWhereItIsOffAndNoneOfNone) {
  const std::vector<HiddenNode> old(3, {1000, 1});
  EXPECT_EQ(sizesOf(old, Multiquery::kOff), (std::vector<std::size_t>{1, 1, 1}));
  EXPECT_EQ(multiquerySize({}, Multiquery::kNodes), 0U);
  EXPECT_EQ(multiquerySize({}, Multiquery::kOff), 0U);
}

TEST(Multiquery, CountsObjectsWhereTheyAreTheValue) {
  const std::vector<HiddenNode> equal(40, {1000, 1});
  const std::size_t size = sizesOf(equal, Multiquery::kObjects).front();
  EXPECT_GT(size, 1U);
  std::vector<HiddenNode> heavyFirst = equal;
  heavyFirst[0].objects = 1000;
  EXPECT_EQ(sizesOf(heavyFirst, Multiquery::kObjects).front(), 1U) << "nothing is gained by one object more";
}

}  // namespace
}  // namespace jalousie::culling
