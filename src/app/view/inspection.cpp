// Read-backs, then the references of src/visibility.
#include "app/view/inspection.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/check.h"
#include "visibility/hiddenness.h"
#include "visibility/lod_policy.h"

namespace jalousie::app {
namespace {

using visibility::Cover;

std::string verdictText(gpu::uint verdict) {
  switch (verdict) {
    case gpu::kVerdictOutside:
      return "outside the frustum: not drawn";
    case gpu::kVerdictOccluded:
      return "hidden: not drawn";
    case gpu::kVerdictOccluder:
      return "occluder: near enough to be drawn into the map";
    case gpu::kVerdictNear:
      return "crosses the near plane: has no finite rectangle, counts as visible";
    case gpu::kVerdictOpen:
      return "open: nothing lies in front of it";
    case gpu::kVerdictPartial:
      return "partly covered";
    case gpu::kVerdictPending:
      return "in view; this mode does not test what covers it";
    case gpu::kVerdictSmall:
      return "smaller than the contribution threshold: not drawn";
    default:
      return "hidden now, drawn because it was visible in the last frame";
  }
}

/// The box that the analysis looked at: with hom-depth it grows by the occluders' own error.
gpu::ScreenBox guarded(gpu::ScreenBox box, const gpu::CullView& view) {
  if (view.cullMode != gpu::kCullHomDepth) return box;
  const float guard = std::ceil(view.occluderTau);
  box.minX = std::max(box.minX - guard, 0.0F);
  box.minY = std::max(box.minY - guard, 0.0F);
  box.maxX = std::min(box.maxX + guard, static_cast<float>(view.viewportWidth));
  box.maxY = std::min(box.maxY + guard, static_cast<float>(view.viewportHeight));
  return box;
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
  for (gpu::uint measure = 0; measure < gpu::kLvCount; ++measure)
    result.lv[measure] = visibility::blockLv(measure, {width, height, result.block.opacity}, texelPixels);
  return result;
}

/// Draws what hid once more, reads it back, and measures the object's block on it.
std::optional<InspectedBlock> inspectBlock(const gpu::ScreenBox& box, render::FrameRenderer& renderer) {
  const gpu::CullView& view = renderer.cullView();
  const bool usesMap = view.cullMode == gpu::kCullHom || view.cullMode == gpu::kCullHomDepth;
  if (!usesMap && view.cullMode != gpu::kCullHiz) return std::nullopt;
  renderer.renderCover();
  std::optional<visibility::OcclusionMapReference> map;
  std::optional<visibility::DepthPyramidReference> pyramid;
  if (usesMap) map.emplace(renderer.map().layout(), renderer.map().readOpenPixels());
  if (view.cullMode != gpu::kCullHom) pyramid.emplace(renderer.map().layout(), renderer.readDepth(), usesMap);
  const Cover cover{map ? &*map : nullptr, pyramid ? &*pyramid : nullptr};
  return measureBlock(cover, guarded(box, view));
}

std::string whyByError(const Inspection& i, const gpu::CullView& view) {
  const bool relaxes = view.lodRule == gpu::kLodLvError;
  if (i.cuts > 0)
    return fmt::format(
        "Patches over level {} err by {:.3g} px where they are flat; cut into {} they keep within {:.3g} px.", i.chosen,
        i.levels[i.chosen].errorPixels, i.cuts, i.tau * i.relaxed);
  std::string text = fmt::format("{:.3g} px of error may show, and level {} keeps within it", i.tau, i.finest);
  if (relaxes && i.relaxed > 1.0F)
    text += fmt::format(". {:.3g} % of it can be seen, so up to {:.3g} px would do, level {}",
                        100.0F * visibility::visibleShare(i.readout.state.lv), i.tau * i.relaxed, i.coarsest);
  if (i.finest != i.coarsest)
    text += fmt::format(
        ". Among these, level {} costs least: a coarser one must save more triangles than its error is "
        "worth",
        i.chosen);
  if (view.calm != 0) text += ". Calm: it may lag behind by the margin, one level at a time";
  const bool unmeasured = std::any_of(i.levels.begin(), i.levels.end(),
                                      [](const InspectedLevel& level) { return std::isinf(level.errorObject); });
  if (unmeasured) text += ". Levels whose error the file does not say are never chosen";
  return text + ".";
}

std::string whyText(const Inspection& i, const gpu::CullView& view) {
  const gpu::uint verdict = i.readout.state.verdict;
  if (verdict == gpu::kVerdictOutside || verdict == gpu::kVerdictSmall || verdict == gpu::kVerdictOccluded)
    return "It is not drawn; the level is the one it would have.";
  if (view.lodRule == gpu::kLodFinest) return "The rule draws every object at level 0.";
  if (view.lodRule == gpu::kLodLinear) {
    if (i.cuts > 0) return fmt::format("LV {:.3f} cuts the edges of the patches into {}.", i.readout.state.lv, i.cuts);
    if (verdict == gpu::kVerdictOccluder) return "Occluders are drawn at level 0.";
    return fmt::format(
        "LV {:.3f} is {:.1f} % of the way from open to covered, and so is the level from finest to "
        "coarsest.",
        i.readout.state.lv, 100.0F * visibility::hiddenShare(i.readout.state.lv));
  }
  return whyByError(i, view);
}

void inspectLevels(Inspection& i, const scene::SceneData& scene, const gpu::CullView& view) {
  const gpu::Chain& chain = scene.chains[scene.objects[i.object].chain];
  const std::span<const gpu::Lod> lods = std::span(scene.lods).subspan(chain.firstLod, chain.lodCount);
  const float pixelsPerUnit = i.readout.box.pixelsPerUnit;
  for (const gpu::Lod& lod : lods)
    i.levels.push_back({lod.triangleCount, lod.errorObject, lod.errorObject * pixelsPerUnit});
  i.tau = i.readout.box.tau;
  i.importance = i.tau > 0.0F ? view.tau / i.tau : 1.0F;
  if (view.lodRule == gpu::kLodLvError) i.relaxed = visibility::relaxedBudget(i.readout.state.lv, view.relax);
  if (view.lodRule == gpu::kLodLvError && view.calm != 0) i.relaxed = std::min(i.relaxed, gpu::kMostCalmRelaxed);
  i.finest = visibility::pixelErrorLod(lods, pixelsPerUnit, i.tau);
  i.coarsest = visibility::pixelErrorLod(lods, pixelsPerUnit, i.tau * i.relaxed);
  const bool patches = view.detail == gpu::kDetailTessellation;
  i.chosen = patches ? chain.patchLod : i.readout.state.lod;
  i.cuts = patches ? i.readout.state.tessellation : 0;
}

}  // namespace

Inspection inspectObject(std::uint32_t object, const scene::SceneData& scene, render::FrameRenderer& renderer,
                         const render::FrameOptions& options) {
  JAL_CHECK(object < scene.objects.size());
  const gpu::CullView view = renderer.cullView();
  const gpu::Chain& chain = scene.chains[scene.objects[object].chain];
  Inspection result;
  result.object = object;
  result.instance = scene.objects[object].owner;
  result.chain = fmt::format("{}", scene.objects[object].chain);
  result.boundsWorld = transformed(scene::worldFromObject(scene.transforms[scene.objects[object].transform]),
                                   {glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)});
  result.readout = renderer.readObject(object);
  const gpu::ScreenBox& box = result.readout.box;
  result.hasRect = box.maxX > box.minX && box.maxY > box.minY;
  if (options.lvMeasure == gpu::kLvPixels && (result.readout.marks & gpu::kMarkCounted) != 0 && result.hasRect)
    result.countedLv =
        visibility::pixelsLv(static_cast<float>(result.readout.pixels), (box.maxX - box.minX) * (box.maxY - box.minY));
  inspectLevels(result, scene, view);
  if (result.hasRect) result.block = inspectBlock(box, renderer);
  result.verdict = verdictText(result.readout.state.verdict);
  result.why = whyText(result, view);
  return result;
}

}  // namespace jalousie::app
