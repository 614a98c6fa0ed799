// Reads back what the kernels wrote about one object, and computes the rest with the references of src/visibility.
#include "app/view/inspection.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/check.h"
#include "policy/traits.h"
#include "render/frame_renderer.h"
#include "visibility/hiddenness.h"
#include "visibility/lod_policy.h"
#include "visibility/masking.h"
#include "visibility/object_decision.h"
#include "visibility/occlusion_map_pass.h"

namespace jalousie::app {
namespace {

using visibility::Cover;

std::string verdictText(gpu::uint verdict) {
  switch (verdict) {
    case gpu::kVerdictOutside:
      return "outside the frustum: not drawn";
    case gpu::kVerdictOccluded:
      return "occluded: not drawn";
    case gpu::kVerdictOccluder:
      return "occluder: nearer than --occluder-distance";
    case gpu::kVerdictNear:
      return "visible: the bounding box crosses the near plane, so it has no finite AABR";
    case gpu::kVerdictOpen:
      return "visible: nothing is in front of its bounding box";
    case gpu::kVerdictPartial:
      return "partly occluded";
    case gpu::kVerdictPending:
      return "in the frustum; this mode does not test occlusion";
    case gpu::kVerdictSmall:
      return "smaller than --min-pixels: not drawn";
    default:
      return "occluded, but drawn in phase 1 because it was visible in the last frame";
  }
}

/// The rectangle that the kernel analyses: with depth beside a map it grows by the screen-space error of the occluders.
gpu::ScreenBox guarded(const gpu::ScreenBox& box, const visibility::MapLayout& layout, const gpu::CullView& view) {
  if (!has(view.traits, gpu::kTraitUsesMap) || !has(view.traits, gpu::kTraitUsesDepth)) return box;
  return visibility::grown(box, layout, std::ceil(view.occluderTau));
}

InspectedBlock measureBlock(const Cover& cover, const gpu::ScreenBox& box) {
  InspectedBlock result;
  const float extent = std::max(box.maxX - box.minX, box.maxY - box.minY);
  result.lom = std::min(visibility::levelForExtent(extent), cover.layout().levels - 1);
  result.block = visibility::analysedBlock(cover, box);
  const auto texelPixels = static_cast<float>(1U << result.block.level);
  const std::uint32_t width = result.block.x.count;
  const std::uint32_t height = result.block.y.count;
  std::vector<float> shifted;
  std::vector<float> open;
  for (const float opacity : result.block.opacity) {
    shifted.push_back(opacity - 0.5F);
    open.push_back(1.0F - opacity);
  }
  result.spectrum = visibility::dct2d({width, height, shifted});
  result.openShare = visibility::openShare({width, height, open});
  result.fineness = visibility::spectralFineness({width, height, open});
  result.chordPixels = visibility::meanOpenChord({width, height, open}) * texelPixels;
  for (const LvMeasureRow& measure : lvMeasureTable())
    result.lv[static_cast<std::size_t>(measure.id)] =
        visibility::blockLv(measure.trait, {width, height, result.block.opacity}, texelPixels);
  return result;
}

/// Draws the occluders again, reads back the map or pyramid, and measures the object's block on it.
std::optional<InspectedBlock> inspectBlock(const gpu::ScreenBox& box, render::FrameRenderer& renderer) {
  const gpu::CullView& view = renderer.cullView();
  const bool usesMap = has(view.traits, gpu::kTraitUsesMap);
  const bool usesDepth = has(view.traits, gpu::kTraitUsesDepth);
  if (!has(view.traits, gpu::kTraitTestsOcclusion)) return std::nullopt;
  renderer.renderCover();
  std::optional<visibility::OcclusionMapReference> map;
  std::optional<visibility::DepthPyramidReference> pyramid;
  if (usesMap) map.emplace(renderer.map().layout(), renderer.map().readOpenPixels());
  if (usesDepth) pyramid.emplace(renderer.map().layout(), renderer.readDepth(), usesMap);
  const Cover cover{map ? &*map : nullptr, pyramid ? &*pyramid : nullptr};
  return measureBlock(cover, guarded(box, cover.layout(), view));
}

std::string calmReason(const gpu::CullView& view) {
  return view.calm == 0 ? "" : " With --calm, the level changes by one step at a time and only beyond a margin.";
}

std::string maskingReason(const Inspection& i) {
  return i.masking > 1.0F ? fmt::format("Errors count {:.3g} times less behind small holes. ", i.masking) : "";
}

/// The level as the budget decides it.
std::string budgetReason(const Inspection& i, const gpu::CullView& view) {
  std::string text = maskingReason(i) + fmt::format("Budget {:.3g} px: level {}.", i.tau, i.finest);
  if (i.relaxed > 1.0F)
    text += fmt::format(" Visible share {:.3g} %: budget {:.3g} px: level {}.",
                        100.0F * visibility::visibleShare(i.readout.state.lv), i.tau * i.relaxed, i.coarsest);
  if (i.finest != i.coarsest)
    text += fmt::format(" From level {} to {}, level {} has the lowest cost of triangles and error.", i.finest,
                        i.coarsest, i.chosen);
  text += calmReason(view);
  const bool unmeasured = std::any_of(i.levels.begin(), i.levels.end(),
                                      [](const InspectedLevel& level) { return std::isinf(level.errorObject); });
  if (unmeasured) text += " Levels without an error in the file are not used.";
  return text;
}

/// The level as the share of the screen decides it, --lod coverage.
std::string coverageReason(const Inspection& i, const gpu::CullView& view) {
  return maskingReason(i) +
         fmt::format(
             "Level {} is the finest one whose MSFT_screencoverage the bounding sphere reaches, taken {:.3g} "
             "times smaller. Where none is reached, it is the coarsest.",
             i.chosen, i.tau) +
         calmReason(view);
}

/// The level as its price decides it, --lod price.
std::string priceReason(const Inspection& i, const gpu::CullView& view) {
  std::string text = maskingReason(i);
  text += fmt::format(
      "Visible share {:.3g} %. Level {} has the lowest sum of visible pixels times mean error and of triangles times "
      "their price.",
      100.0F * visibility::visibleShare(i.readout.state.lv), i.chosen);
  if (std::isfinite(view.maxError)) text += fmt::format(" No level deviates by more than {:.3g} px.", view.maxError);
  return text + calmReason(view);
}

/// The division of patches as the budget decides it.
std::string patchReason(const Inspection& i) {
  return fmt::format(
      "Flat patches of level {} have an error of {:.3g} px. With each edge divided into {}, the error is within the "
      "budget of {:.3g} px.",
      i.chosen, i.levels[i.chosen].errorPixels, i.cuts, i.tau * i.relaxed);
}

/// The level as LV decides it, --lod linear.
std::string linearReason(const Inspection& i) {
  const float lv = i.readout.state.lv;
  if (i.cuts > 0) return fmt::format("LV {:.3f}: each edge of the patches is divided into {}.", lv, i.cuts);
  if (i.readout.state.verdict == gpu::kVerdictOccluder) return "Occluders are drawn at level 0.";
  return fmt::format(
      "LV {:.3f}: occluded share {:.1f} %. The level is at the same share of the way from finest to coarsest.", lv,
      100.0F * visibility::hiddenShare(lv));
}

std::string whyText(const Inspection& i, const gpu::CullView& view) {
  if (!visibility::isDrawn(i.readout.state))
    return "The object is not drawn. The level is the one it would be drawn at.";
  const bool followsError = has(view.traits, gpu::kTraitFollowsError);
  if (!followsError && has(view.traits, gpu::kTraitFollowsLv)) return linearReason(i);
  if (!followsError) return "--lod finest draws every object at level 0.";
  if (has(view.traits, gpu::kTraitPrice)) return priceReason(i, view);
  if (has(view.traits, gpu::kTraitCoverage) && i.cuts == 0) return coverageReason(i, view);
  return i.cuts > 0 ? patchReason(i) : budgetReason(i, view);
}

void inspectLevels(Inspection& i, const scene::SceneData& scene, const gpu::CullView& view) {
  const gpu::Chain& chain = scene.chains[scene.objects[i.object].chain];
  const std::span<const gpu::Lod> lods = std::span(scene.lods).subspan(chain.firstLod, chain.lodCount);
  const float pixelsPerUnit = i.readout.box.pixelsPerUnit;
  for (const gpu::Lod& lod : lods)
    i.levels.push_back({lod.triangleCount, lod.errorObject, lod.errorObject * pixelsPerUnit});
  const float unmasked = i.readout.box.tau;
  i.importance = unmasked > 0.0F ? view.tau / unmasked : 1.0F;
  i.masking = visibility::maskingInUse(i.readout.box.cover, view.traits);
  i.tau = unmasked * i.masking;
  if (has(view.traits, gpu::kTraitFollowsError) && has(view.traits, gpu::kTraitFollowsLv) &&
      !has(view.traits, gpu::kTraitPrice)) {
    i.relaxed = visibility::relaxedBudget(i.readout.state.lv, view.relax);
    if (view.calm != 0) i.relaxed = std::min(i.relaxed, gpu::kMostCalmRelaxed / i.masking);
  }
  i.finest = visibility::pixelErrorLod(lods, pixelsPerUnit, i.tau);
  i.coarsest = visibility::pixelErrorLod(lods, pixelsPerUnit, i.tau * i.relaxed);
  const bool patches = has(view.traits, gpu::kTraitPatches);
  i.chosen = patches ? chain.patchLod : i.readout.state.lod;
  i.cuts = patches ? i.readout.state.tessellation : 0;
}

}  // namespace

Inspection inspectObject(std::uint32_t object, const scene::SceneData& scene, render::FrameRenderer& renderer,
                         const render::FrameOptions& options) {
  JAL_CHECK(object < scene.objects.size());
  const gpu::CullView view = renderer.cullView();
  Inspection result;
  result.object = object;
  result.instance = scene.objects[object].owner;
  result.name = scene::shownName(scene.names, result.instance, scene.objects[object].chain);
  result.mesh = scene.names.meshName(scene.objects[object].chain).substr(0, scene::kLongestShownName);
  result.chain = fmt::format("{}", scene.objects[object].chain);
  result.boundsWorld = renderer.readBounds(object);
  result.readout = renderer.readObject(object);
  const gpu::ScreenBox& box = result.readout.box;
  result.hasRect = box.maxX > box.minX && box.maxY > box.minY;
  if (rowOf(options.lvMeasure).countsPixels && (result.readout.marks & gpu::kMarkCounted) != 0 && result.hasRect)
    result.countedLv =
        visibility::pixelsLv(static_cast<float>(result.readout.pixels), (box.maxX - box.minX) * (box.maxY - box.minY));
  inspectLevels(result, scene, view);
  if (result.hasRect) result.block = inspectBlock(box, renderer);
  result.verdict = verdictText(result.readout.state.verdict);
  result.why = whyText(result, view);
  return result;
}

}  // namespace jalousie::app
