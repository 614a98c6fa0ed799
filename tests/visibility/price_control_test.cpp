// Simulated frames: the price of a triangle follows a budget.
#include "visibility/price_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/random.h"
#include "shared/limits.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {
namespace {

/// Objects of many sizes with one chain, as one camera sees them.
struct Crowd {
  explicit Crowd(std::size_t count) {
    for (gpu::uint k = 0; k < 10; ++k) {
      gpu::Lod lod{};
      lod.triangleCount = 50000U >> k;
      lod.errorObject = lod.meanErrorObject = k == 0 ? 0.0F : 0.01F * static_cast<float>(1U << (k - 1));
      chain.push_back(lod);
    }
    Random random(5);
    for (std::size_t i = 0; i < count; ++i) {
      pixels.push_back(std::exp(random.uniform(1.6F, 9.9F)));
      pixelsPerUnit.push_back(std::exp(random.uniform(-3.0F, 2.0F)));
    }
  }

  /// Triangles as chooseDetail chooses them. @param zoom  of the camera
  std::uint64_t triangles(float zoom, const gpu::PriceState& price) const {
    const auto at = [&](std::size_t i, float factor) {
      return pricedLod(chain, pixelsPerUnit[i] * zoom, {pixels[i] * zoom * zoom, gpu::kTrianglePrice * factor, 1e9F});
    };
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const gpu::uint usual = at(i, priceFactor(price, view));
      gpu::uint finer = pricesSmallSteps(price, view) ? at(i, std::exp(price.logCoarse)) : usual;
      while (!isSmallStep(chain[usual].triangleCount, chain[finer].triangleCount, view))
        ++finer;
      sum += chain[finer].triangleCount;
    }
    return sum;
  }

  gpu::CullView view{};

  std::vector<gpu::Lod> chain;
  std::vector<float> pixels;
  std::vector<float> pixelsPerUnit;
};

/// Triangles over the budget, frame by frame.
std::vector<double> simulate(Crowd crowd, gpu::uint budget, const std::function<float(int)>& zoomOf) {
  crowd.view.triangleBudget = budget;
  gpu::PriceState price = firstPrice();
  std::vector<double> shares;
  for (int frame = 0; frame < 100; ++frame) {
    const std::uint64_t triangles = crowd.triangles(zoomOf(frame), price);
    shares.push_back(static_cast<double>(triangles) / budget);
    price = adjustPrice(price, static_cast<float>(triangles), crowd.view);
  }
  return shares;
}

TEST(PriceControl, AStillViewStaysWithinTwoPercent) {
  const Crowd crowd(300);
  for (const gpu::uint budget : {100000U, 300000U, 1000000U, 3000000U}) {
    const std::vector<double> shares = simulate(crowd, budget, [](int) { return 1.0F; });
    EXPECT_GT(std::abs(shares.front() - 1.0), 0.1) << "the price of tau is another one";
    for (std::size_t i = 20; i < shares.size(); ++i)
      ASSERT_NEAR(shares[i], 1.0, 0.02) << budget << " frame " << i;
  }
}

TEST(PriceControl, AMovingViewStaysBelowTenPercentMore) {
  const Crowd crowd(300);
  const std::function<float(int)> motions[] = {
      [](int frame) { return 1.0F + 0.01F * static_cast<float>(frame); },
      [](int frame) { return 2.0F - 0.01F * static_cast<float>(frame); },
      [](int frame) { return 1.0F + 0.3F * std::sin(0.1F * static_cast<float>(frame)); }};
  for (const auto& motion : motions) {
    const std::vector<double> shares = simulate(crowd, 300000, motion);
    EXPECT_LT(*std::max_element(shares.begin() + 20, shares.end()), 1.1);
    EXPECT_GT(*std::min_element(shares.begin() + 20, shares.end()), 0.85);
  }
}

TEST(PriceControl, ACutIsFollowedWithinTenFrames) {
  const Crowd crowd(300);
  const std::vector<double> shares = simulate(crowd, 300000, [](int frame) { return frame < 50 ? 1.0F : 2.0F; });
  EXPECT_GT(shares[50], 1.5);
  for (std::size_t i = 60; i < shares.size(); ++i)
    EXPECT_NEAR(shares[i], 1.0, 0.03);
}

TEST(PriceControl, WhereTheLevelsAllowNothingCloserAStillViewRestsBelow) {
  for (const std::size_t objects : {1U, 3U}) {
    const std::vector<double> shares = simulate(Crowd(objects), 20000, [](int) { return 1.0F; });
    for (std::size_t i = 80; i < shares.size(); ++i) {
      EXPECT_EQ(shares[i], shares.back()) << objects << " frame " << i;
      EXPECT_LT(shares[i], 1.02);
      EXPECT_GT(shares[i], 0.4);
    }
  }
}

/// A budget in the middle of the largest step that the triangles take when the price moves.
gpu::uint budgetInLargestStep(const Crowd& crowd) {
  std::uint64_t fewer = 0;
  std::uint64_t largest = 0;
  Crowd free = crowd;
  free.view.triangleBudget = std::numeric_limits<gpu::uint>::max();
  const auto at = [](float logPrice) {
    gpu::PriceState price = firstPrice();
    price.logFine = price.logCoarse = logPrice;
    return price;
  };
  std::uint64_t last = free.triangles(1.0F, at(12.0F));
  for (float logPrice = 12.0F; logPrice > -12.0F; logPrice -= 0.01F) {
    const std::uint64_t next = free.triangles(1.0F, at(logPrice));
    if (next - last > largest) {
      largest = next - last;
      fewer = last;
    }
    last = next;
  }
  return static_cast<gpu::uint>(fewer + largest / 2);
}

TEST(PriceControl, StepsOfOneLargeObjectDoNotKeepAStillViewBelowItsBudget) {
  Crowd crowd(200);
  // One object at hand; all others are small.
  for (float& pixels : crowd.pixels)
    pixels *= 0.01F;
  crowd.pixels[0] = 1e5F;
  crowd.pixelsPerUnit[0] = 40.0F;
  const gpu::uint budget = budgetInLargestStep(crowd);
  const std::vector<double> shares = simulate(crowd, budget, [](int) { return 1.0F; });
  for (std::size_t i = 60; i < shares.size(); ++i)
    EXPECT_NEAR(shares[i], 1.0, 0.02) << budget << " frame " << i;
}

TEST(PriceControl, AnObjectOfHalfTheTrianglesDoesNotFlicker) {
  // Terrain: its finer level is taken below a price; the rest of the scene follows the price. With it, a frame is a
  // little above the budget.
  for (const float switchesAt : {0.3F, 1.0F, 2.7F, 9.0F}) {
    for (const float over : {1.03F, 1.11F, 1.2F}) {
      gpu::CullView view{};
      view.triangleBudget = 10000;
      gpu::PriceState price = firstPrice();
      std::vector<double> shares;
      for (int frame = 0; frame < 200; ++frame) {
        const float factor = priceFactor(price, view);
        const float others = 4500.0F * std::pow(factor / switchesAt, -0.1F);
        const float triangles = others + (factor < switchesAt ? over * 10000.0F - 4500.0F : 500.0F);
        shares.push_back(static_cast<double>(triangles) / 10000.0);
        price = adjustPrice(price, triangles, view);
      }
      for (std::size_t i = 100; i < shares.size(); ++i) {
        ASSERT_NEAR(shares[i], shares[i - 1], 0.02) << switchesAt << ", " << over << " frame " << i;
        ASSERT_LT(shares[i], 1.02) << switchesAt << ", " << over << " frame " << i;
      }
    }
  }
}

TEST(PriceControl, ABudgetOutOfReachNeitherOverflowsNorStays) {
  Crowd crowd(10);
  gpu::CullView& view = crowd.view;
  gpu::PriceState price = firstPrice();
  for (const gpu::uint budget : {1U, 0xffffffffU}) {
    view.triangleBudget = budget;
    for (int frame = 0; frame < 200; ++frame) {
      const std::uint64_t triangles = crowd.triangles(1.0F, price);
      price = adjustPrice(price, static_cast<float>(triangles), view);
    }
    EXPECT_EQ(std::abs(price.logFine), gpu::kMostLogFactor);
    EXPECT_EQ(price.logCoarse, price.logFine);
    EXPECT_EQ(crowd.triangles(1.0F, price), 10U * crowd.chain[budget == 1 ? 9 : 0].triangleCount);
  }
  view.triangleBudget = 0;
  EXPECT_EQ(priceFactor(price, view), 1.0F) << "without a budget the price is that of tau";
}

}  // namespace
}  // namespace jalousie::visibility
