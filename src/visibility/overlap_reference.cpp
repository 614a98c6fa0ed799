// Overlap test with at most two descents, then a measure of one block (thesis Algorithm 3.1).
#include "visibility/overlap_reference.h"

#include <algorithm>

#include "policy/traits.h"
#include "scene/scene_data.h"
#include "shared/limits.h"
#include "visibility/lod_policy.h"
#include "visibility/masking.h"

namespace jalousie::visibility {
namespace {

struct Range {
  float lowest = 1.0F;
  float highest = 0.0F;
};

Range opacityRange(const Cover& cover, const TexelRange& pixels, std::uint32_t level, float nearestDepth) {
  const TexelRange texels = pixels.atLevel(level);
  Range range;
  for (std::uint32_t y = texels.firstY; y <= texels.lastY; ++y) {
    for (std::uint32_t x = texels.firstX; x <= texels.lastX; ++x) {
      const float value = cover.opacity(x, y, level, nearestDepth);
      range.lowest = std::min(range.lowest, value);
      range.highest = std::max(range.highest, value);
    }
  }
  return range;
}

glm::vec4 rectOf(const gpu::ScreenBox& box) {
  return {box.minX, box.minY, box.maxX, box.maxY};
}

std::uint32_t lomOf(const MapLayout& layout, const glm::vec4& rect) {
  return std::min(levelForExtent(std::max(rect.z - rect.x, rect.w - rect.y)), layout.levels - 1);
}

}  // namespace

gpu::ScreenBox grown(gpu::ScreenBox box, const MapLayout& layout, float guardPixels) {
  const auto width = static_cast<float>(layout.screenWidth);
  const auto height = static_cast<float>(layout.screenHeight);
  box.minX = std::clamp(box.minX - guardPixels, 0.0F, width);
  box.minY = std::clamp(box.minY - guardPixels, 0.0F, height);
  box.maxX = std::clamp(box.maxX + guardPixels, 0.0F, width);
  box.maxY = std::clamp(box.maxY + guardPixels, 0.0F, height);
  return box;
}

float Cover::opacity(std::uint32_t x, std::uint32_t y, std::uint32_t level, float nearestDepth) const {
  if (pyramid != nullptr && !(pyramid->farthest(x, y, level) > nearestDepth)) return 0.0F;
  return map != nullptr ? map->opacity(x, y, level) : 1.0F;
}

AnalysedBlock analysedBlock(const Cover& cover, const gpu::ScreenBox& box) {
  const glm::vec4 rect = rectOf(box);
  const TexelRange pixels = touchedPixels(rect, cover.layout().screenWidth, cover.layout().screenHeight);
  const std::uint32_t lom = lomOf(cover.layout(), rect);
  AnalysedBlock block;
  block.level = lom > gpu::kBlockLevels ? lom - gpu::kBlockLevels : 0;
  block.x = blockSpan(pixels.firstX, pixels.lastX, rect.x, rect.z, block.level);
  block.y = blockSpan(pixels.firstY, pixels.lastY, rect.y, rect.w, block.level);
  for (std::uint32_t j = 0; j < block.y.count; ++j)
    for (std::uint32_t i = 0; i < block.x.count; ++i)
      block.opacity.push_back(cover.opacity(block.x.first + i, block.y.first + j, block.level, box.nearestDepth));
  return block;
}

gpu::uint measuredCover(const Cover& cover, const gpu::ScreenBox& box, float guardPixels) {
  const AnalysedBlock block = analysedBlock(cover, grown(box, cover.layout(), guardPixels));
  return packedCover({block.x.count, block.y.count, block.opacity}, static_cast<float>(1U << block.level));
}

OverlapResult testOverlap(const Cover& cover, const gpu::ScreenBox& given, float cullThreshold, float guardPixels,
                          std::optional<gpu::uint> lvTraits) {
  const gpu::ScreenBox box = grown(given, cover.layout(), guardPixels);
  const glm::vec4 rect = rectOf(box);
  const TexelRange pixels = touchedPixels(rect, cover.layout().screenWidth, cover.layout().screenHeight);
  const std::uint32_t lom = lomOf(cover.layout(), rect);
  const std::uint32_t lowest = lom > gpu::kMaxDescent ? lom - gpu::kMaxDescent : 0;
  Range range = opacityRange(cover, pixels, lom, box.nearestDepth);
  for (std::uint32_t level = lom; range.lowest < cullThreshold && level > lowest;) {
    if (!cover.depthAware() && range.highest <= 0.0F) break;  // open here, so open below: opacities add up
    range = opacityRange(cover, pixels, --level, box.nearestDepth);
  }
  if (range.lowest >= cullThreshold) return {gpu::kVerdictOccluded, 1.0F};
  if (range.highest <= 0.0F && (!cover.depthAware() || !lvTraits)) return {gpu::kVerdictOpen, -1.0F};
  if (!lvTraits) return {gpu::kVerdictPartial, -1.0F};
  const AnalysedBlock block = analysedBlock(cover, box);
  if (*std::max_element(block.opacity.begin(), block.opacity.end()) <= 0.0F) return {gpu::kVerdictOpen, -1.0F};
  return {gpu::kVerdictPartial,
          blockLv(*lvTraits, {block.x.count, block.y.count, block.opacity}, static_cast<float>(1U << block.level))};
}

void applyOverlap(const OverlapResult& result, const scene::SceneData& scene, const gpu::CullView& view,
                  const gpu::Chain& chain, ObjectDecision& object) {
  const gpu::ObjectState last = object.state;
  const bool early = (object.marks & gpu::kMarkEarly) != 0;
  const bool occluded = result.verdict == gpu::kVerdictOccluded;
  const bool counted = (object.marks & gpu::kMarkCounted) != 0;
  const bool waitsForCount = has(view.traits, gpu::kTraitLvPixels) && !occluded;
  if (!counted) {
    const bool remembered = (object.marks & gpu::kMarkRemembered) != 0;
    object.state.lv = remembered ? smoothLv(last.lv, waitsForCount ? last.lv : result.lv) : result.lv;
  }
  object.state.verdict = occluded && early ? gpu::kVerdictStale : result.verdict;
  if (occluded) {
    object.marks &= ~gpu::kMarkVisible;
    return;
  }
  object.marks |= early ? gpu::kMarkVisible : gpu::kMarkVisible | gpu::kMarkLate;
  if (early || counted || !has(view.traits, gpu::kTraitFollowsLv | gpu::kTraitMasksError)) return;
  const bool known = (object.marks & gpu::kMarkKnown) != 0;
  chooseDetail(view, detailInput(scene, chain, object.box, known, last), object.state, object.marks);
}

}  // namespace jalousie::visibility
