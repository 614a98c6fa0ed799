// The linear mapping of the thesis, the projected error and the price; plain CPU twin of shaders/lib/lod.glsl.
#include "visibility/lod_policy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "policy/traits.h"
#include "scene/patch_base.h"
#include "scene/scene_data.h"
#include "shared/limits.h"
#include "visibility/masking.h"
#include "visibility/price_control.h"

namespace jalousie::visibility {

float hiddenShare(float lv) {
  return (std::clamp(lv, -1.0F, 1.0F) + 1.0F) * 0.5F;
}

std::uint32_t tessellationLevel(float lv, std::uint32_t levels) {
  const float t = hiddenShare(lv);
  const auto finest = static_cast<float>(levels);
  return static_cast<std::uint32_t>(std::clamp(std::floor(finest * (1.0F - t) + t), 1.0F, finest));
}

std::uint32_t linearLod(float lv, std::uint32_t lodCount) {
  return lodCount - tessellationLevel(lv, lodCount);
}

float visibleShare(float lv) {
  return std::max(1.0F - hiddenShare(lv), gpu::kLeastShare);
}

float relaxedBudget(float lv, float relax) {
  const float share = visibleShare(lv);
  return std::min(1.0F / std::sqrt(std::sqrt(share)), 1.0F + relax);
}

float pixelsLv(float visible, float area) {
  return 1.0F - 2.0F * std::min((visible + gpu::kPixelGuard) / (gpu::kSilhouetteShare * area + gpu::kPixelGuard), 1.0F);
}

float visiblePixels(float lv, float area) {
  return std::max(visibleShare(lv) * (gpu::kSilhouetteShare * area + gpu::kPixelGuard) - gpu::kPixelGuard, 0.0F);
}

float smoothLv(float last, float measured) {
  const float start = std::clamp(last, -1.0F, 1.0F);
  return start +
         (measured < start ? gpu::kSmoothAppearing : gpu::kSmoothHiding) * (std::clamp(measured, -1.0F, 1.0F) - start);
}

float forgottenLv(float last) {
  const float start = std::clamp(last, -1.0F, 1.0F);
  return start + gpu::kSmoothHiding * (-1.0F - start);
}

float projectedScale(float scale, float focalPixels, float distance, float zNear) {
  return scale * focalPixels / std::max(distance, zNear);
}

std::uint32_t pixelErrorLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau) {
  for (std::size_t level = levels.size() - 1; level > 0; --level)
    if (levels[level].errorObject * pixelsPerUnit <= tau) return static_cast<std::uint32_t>(level);
  return 0;
}

float sphereCoverage(const glm::vec3& sizeObject, float pixelsPerUnit, float screenPixels) {
  const float diameter2 = glm::dot(sizeObject, sizeObject) * pixelsPerUnit * pixelsPerUnit;
  return gpu::kQuarterPi * diameter2 / screenPixels;
}

std::uint32_t coverageLod(std::span<const gpu::Lod> levels, float coverage) {
  for (std::size_t level = 0; level + 1 < levels.size(); ++level)
    if (!(coverage < levels[level].leastCoverage)) return static_cast<std::uint32_t>(level);
  return static_cast<std::uint32_t>(levels.size() - 1);
}

std::uint32_t relaxedLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau, float relaxed, float share) {
  std::uint32_t best = pixelErrorLod(levels, pixelsPerUnit, tau);
  const std::uint32_t coarsest = pixelErrorLod(levels, pixelsPerUnit, tau * relaxed);
  const auto triangles = static_cast<float>(std::max(levels[best].triangleCount, 1U));
  float leastCost = 0.0F;
  for (std::uint32_t level = best; level <= coarsest; ++level) {
    const float error = levels[level].errorObject * pixelsPerUnit / std::max(tau, gpu::kLeastShare);
    const float cost = share * error * error + static_cast<float>(levels[level].triangleCount) / triangles;
    if (leastCost == 0.0F || cost < leastCost) {
      leastCost = cost;
      best = level;
    }
  }
  return best;
}

namespace {

/// The larger the error, the more each visible pixel of the object costs, up to kErrorCap.
float costAt(const Price& price, float errorPixels, float triangles) {
  return (price.pixels + 1.0F) * (errorPixels < gpu::kErrorCap ? errorPixels : gpu::kErrorCap) +
         price.perTriangle * triangles;
}

}  // namespace

std::uint32_t pricedLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, const Price& price) {
  std::uint32_t best = 0;
  float leastCost = costAt(price, 0.0F, static_cast<float>(levels.front().triangleCount));
  for (std::uint32_t level = 1; level < levels.size(); ++level) {
    const gpu::Lod& lod = levels[level];
    if (std::isinf(lod.meanErrorObject) || !(lod.errorObject * pixelsPerUnit <= price.maxError)) continue;
    const float cost = costAt(price, lod.meanErrorObject * pixelsPerUnit, static_cast<float>(lod.triangleCount));
    if (cost < leastCost) {
      leastCost = cost;
      best = level;
    }
  }
  return best;
}

std::uint32_t pricedTessellation(float errorPixels, float triangles, const Price& price, std::uint32_t maxLevel) {
  const auto trianglesAt = [&](std::uint32_t level) {
    return triangles * static_cast<float>(scene::tessellatedTriangles(level));
  };
  const auto errorAt = [&](std::uint32_t level) { return errorPixels / static_cast<float>(level * level); };
  std::uint32_t best = maxLevel;
  float leastCost = costAt(price, errorAt(maxLevel), trianglesAt(maxLevel));
  for (std::uint32_t level = maxLevel - 1; level > 0; --level) {
    if (!(errorAt(level) <= price.maxError)) break;
    const float cost = costAt(price, errorAt(level), trianglesAt(level));
    if (cost < leastCost) {
      leastCost = cost;
      best = level;
    }
  }
  return best;
}

std::uint32_t pixelErrorTessellation(float errorPixels, float tau, std::uint32_t maxLevel) {
  if (errorPixels <= tau) return 1;
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(std::sqrt(errorPixels / tau)), 1.0F, static_cast<float>(maxLevel)));
}

std::uint32_t fadeFrames(gpu::uint marks) {
  return (marks & gpu::kMarkFadeMask) >> gpu::kMarkFadeShift;
}

std::uint32_t fadingLod(std::uint32_t lod, gpu::uint marks) {
  return (marks & gpu::kMarkFromCoarser) != 0 ? lod + 1 : lod - 1;
}

std::uint32_t stepTowards(std::uint32_t last, std::uint32_t lowest, std::uint32_t highest) {
  return last < lowest ? last + 1 : last > highest ? last - 1 : last;
}

DetailInput detailInput(const scene::SceneData& scene, const gpu::Chain& chain, const gpu::ScreenBox& box, bool seen,
                        const gpu::ObjectState& last) {
  return {std::span(scene.lods).subspan(chain.firstLod, chain.lodCount),
          scene.lods[chain.patchLod],
          box.pixelsPerUnit,
          box.tau,
          (box.maxX - box.minX) * (box.maxY - box.minY),
          chain.surfaceObject,
          {},
          seen,
          last,
          box.cover,
          glm::vec3(chain.boundsMaxObject) - glm::vec3(chain.boundsMinObject)};
}

namespace {

/// What an object may deviate by on the screen, and what its triangles cost.
struct Budget {
  float tau;       ///< pixels, for a fully visible object
  float relaxed;   ///< factor for this one
  float share;     ///< visible share
  float pixels;    ///< visible pixels
  float maxError;  ///< limit of the largest deviation, pixels
  float masking;   ///< factor by which errors count less behind small holes
};

/// Whether an object fills little of its rectangle. A body in full sight covers a quarter of its surface on average
/// over all directions (Cauchy), and less where parts of it hide others.
bool isThin(const DetailInput& object, float area) {
  const float surfacePixels = object.surfaceObject * object.pixelsPerUnit * object.pixelsPerUnit;
  return 0.25F * surfacePixels < gpu::kThinShare * area;
}

/// Area that stays when an object turns, or comes into view at the border of the screen: that of its rectangle or, if
/// larger, the mean silhouette of its box (a quarter of the surface), at most the screen.
float steadyArea(const gpu::CullView& view, const DetailInput& object) {
  const glm::vec3 size = object.sizeObject * object.pixelsPerUnit;
  const float silhouette = 0.5F * (size.x * size.y + size.y * size.z + size.z * size.x);
  const float screen = static_cast<float>(view.viewportWidth) * static_cast<float>(view.viewportHeight);
  return std::max(object.area, std::min(silhouette, screen));
}

/// @param calm  the level follows the budget with hysteresis   @param counted  the object's pixels have been counted
Budget budgetOf(const gpu::CullView& view, const DetailInput& object, float lv, bool calm, bool counted) {
  const float relaxed = has(view.traits, gpu::kTraitFollowsLv) ? relaxedBudget(lv, view.relax) : 1.0F;
  const float area = calm ? steadyArea(view, object) : object.area;
  Budget budget{object.tau,       relaxed,
                visibleShare(lv), visiblePixels(lv, area),
                view.maxError,    maskingInUse(object.cover, view.traits)};
  if (isThin(object, area)) budget.maxError = std::min(budget.maxError, object.tau * budget.masking);
  if (calm) {
    budget.relaxed = std::min(budget.relaxed, gpu::kMostCalmRelaxed / budget.masking);
    budget.share = std::max(budget.share, gpu::kLeastCalmShare);
    budget.pixels = std::max(budget.pixels, gpu::kLeastCalmVisible * gpu::kSilhouetteShare * area);
  } else if (counted && !object.seen) {
    budget.maxError = std::numeric_limits<float>::infinity();  // no pixel shows it
  }
  return budget;
}

/// Triangles cost more by the masking, which chooses the same level as errors that count less by it.
/// A price above that of tau relaxes the limit of the largest deviation as a larger tau would: the budget precedes it.
/// @param margin  scales tau; below 1 also the limit of the largest deviation   @param factor  of kTrianglePrice
Price priceOf(const Budget& budget, float margin, float factor) {
  const float tau = budget.tau * margin;
  return {budget.pixels, gpu::kTrianglePrice * tau * tau * factor * budget.masking,
          budget.maxError * std::min(margin, 1.0F) * std::max(std::sqrt(factor), 1.0F)};
}

/// Level of the chain at the prices in use.
std::uint32_t budgetPricedLod(const gpu::CullView& view, const DetailInput& object, const Budget& budget,
                              float margin) {
  const std::uint32_t level =
      pricedLod(object.levels, object.pixelsPerUnit, priceOf(budget, margin, priceFactor(object.price, view, margin)));
  if (!pricesSmallSteps(object.price, view)) return level;
  const Price price = priceOf(budget, margin, std::exp(object.price.logCoarse));
  std::uint32_t finer = std::min(pricedLod(object.levels, object.pixelsPerUnit, price), level);
  while (!isSmallStep(object.levels[level].triangleCount, object.levels[finer].triangleCount, view))
    ++finer;
  return finer;
}

/// Level of the chain that the budget allows at tau * margin.
std::uint32_t budgetLod(const gpu::CullView& view, const DetailInput& object, const Budget& budget, float margin) {
  if (has(view.traits, gpu::kTraitPrice)) return budgetPricedLod(view, object, budget, margin);
  const float tau = budget.tau * margin * budget.masking;
  if (has(view.traits, gpu::kTraitCoverage)) {
    const float screenPixels = static_cast<float>(view.viewportWidth) * static_cast<float>(view.viewportHeight);
    return coverageLod(object.levels,
                       sphereCoverage(object.sizeObject, object.pixelsPerUnit, screenPixels) / (tau * tau));
  }
  return relaxedLod(object.levels, object.pixelsPerUnit, tau, budget.relaxed, budget.share);
}

/// The same for the patches.
std::uint32_t budgetTessellation(const gpu::CullView& view, const DetailInput& object, const Budget& budget,
                                 float margin) {
  const float errorPixels = object.patches.errorObject * object.pixelsPerUnit;
  if (has(view.traits, gpu::kTraitPrice))
    return pricedTessellation(errorPixels, static_cast<float>(object.patches.triangleCount),
                              priceOf(budget, margin, priceFactor(object.price, view, margin)), view.maxTessellation);
  const float tau = budget.tau * margin * budget.masking;
  return pixelErrorTessellation(errorPixels, tau * budget.relaxed, view.maxTessellation);
}

/// Levels that follow the budget with hysteresis: the last level stays while it fits within the margin, else it changes
/// by one and is cross-faded. An object of which no pixel was visible switches at once to the nearest level that fits.
void followBudget(const gpu::CullView& view, const DetailInput& object, const Budget& budget, gpu::ObjectState& state,
                  gpu::uint& marks) {
  const float margin = view.hysteresis;
  state.tessellation = stepTowards(object.last.tessellation, budgetTessellation(view, object, budget, margin),
                                   budgetTessellation(view, object, budget, 1.0F / margin));
  state.lod = object.last.lod;
  const gpu::uint left = std::min(fadeFrames(marks), view.fadeFrames + 1);  // the fade may have begun with more frames
  if (object.seen && left > 1) {
    marks = (marks & gpu::kMarkFromCoarser) | (marks & ~gpu::kMarkFadeMask) | (left - 1) << gpu::kMarkFadeShift;
    return;
  }
  marks &= ~gpu::kMarkFadeMask;
  const std::uint32_t finest = budgetLod(view, object, budget, 1.0F / margin);
  const std::uint32_t coarsest = std::max(finest, budgetLod(view, object, budget, margin));
  state.lod =
      object.seen ? stepTowards(object.last.lod, finest, coarsest) : std::clamp(object.last.lod, finest, coarsest);
  if (object.seen && state.lod != object.last.lod && !has(view.traits, gpu::kTraitPatches) && view.fadeFrames > 0)
    marks |= (view.fadeFrames << gpu::kMarkFadeShift) | (object.last.lod > state.lod ? gpu::kMarkFromCoarser : 0);
}

}  // namespace

gpu::ObjectState coarserState(const gpu::CullView& view, const DetailInput& object, gpu::uint marks, float scale) {
  Budget budget =
      budgetOf(view, object, object.last.lv, (marks & gpu::kMarkRemembered) != 0, (marks & gpu::kMarkCounted) != 0);
  budget.tau *= scale;
  budget.maxError *= scale;
  gpu::ObjectState state = object.last;
  state.lod = std::max(state.lod, budgetLod(view, object, budget, 1.0F));
  state.tessellation = std::min(state.tessellation, budgetTessellation(view, object, budget, 1.0F));
  return state;
}

float allowedDeviation(const gpu::CullView& view, const DetailInput& object, const gpu::ObjectState& state,
                       gpu::uint marks) {
  if (!has(view.traits, gpu::kTraitFollowsError)) return std::numeric_limits<float>::infinity();
  const Budget budget =
      budgetOf(view, object, state.lv, (marks & gpu::kMarkRemembered) != 0, (marks & gpu::kMarkCounted) != 0);
  if (has(view.traits, gpu::kTraitPrice)) return priceOf(budget, 1.0F, priceFactor(object.price, view)).maxError;
  return budget.tau * budget.masking * budget.relaxed;
}

void chooseDetail(const gpu::CullView& view, const DetailInput& object, gpu::ObjectState& state, gpu::uint& marks) {
  const bool followsError = has(view.traits, gpu::kTraitFollowsError);
  const bool followsLv = has(view.traits, gpu::kTraitFollowsLv);
  const bool calm = followsError && (marks & gpu::kMarkRemembered) != 0;
  if (!calm) marks &= ~gpu::kMarkFadeMask;  // a fade that began in calm frames ends with them
  if (followsLv && !followsError) {
    state.lod = linearLod(state.lv, static_cast<std::uint32_t>(object.levels.size()));
    state.tessellation = tessellationLevel(state.lv, view.maxTessellation);
  } else if (followsError) {
    const Budget budget = budgetOf(view, object, state.lv, calm, (marks & gpu::kMarkCounted) != 0);
    if (calm) {
      followBudget(view, object, budget, state, marks);
    } else {
      state.lod = budgetLod(view, object, budget, 1.0F);
      state.tessellation = budgetTessellation(view, object, budget, 1.0F);
    }
  }
  const bool same = has(view.traits, gpu::kTraitPatches) ? state.tessellation == object.last.tessellation
                                                         : state.lod == object.last.lod;
  if ((marks & gpu::kMarkKnown) != 0 && !same) marks |= gpu::kMarkSwitched;
}

}  // namespace jalousie::visibility
