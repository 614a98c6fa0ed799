// Construction of a renderer's parts, and what they compute for a frame.
#include "render/frame_parts.h"

#include <algorithm>

#include "policy/traits.h"
#include "render/memory_needs.h"
#include "render/tessellation_limit.h"
#include "scene/scene_memory.h"

namespace jalousie::render {
namespace {

gl::Capabilities capabilitiesFor(const RendererOptions& options) {
  const gl::Capabilities capabilities = gl::queryCapabilities();
  return options.fastPaths ? capabilities : capabilities.withoutFastPaths();
}

visibility::DrawListOptions listOptions(const scene::SceneData& scene, const RendererOptions& options) {
  const auto objects = static_cast<std::uint32_t>(scene.drawn().objects.size());
  const std::uint32_t most = 2 * objects;  // a cross-faded object is on the list twice
  return {options.submission, std::min(options.capacity.value_or(most), most), scene.maxPatchTriangles > 0};
}

/// What the scene's buffers and the targets need, after it was found to be within the limit. Errors: kLimit.
MemoryEstimate needsWithinLimit(const scene::SceneData& scene, std::uint32_t width, std::uint32_t height,
                                const RendererOptions& options) {
  MemoryEstimate needs = bufferNeeds(scene::sizeOf(scene), scene.maxPatchTriangles > 0, options);
  needs.add(targetNeeds(width, height));
  needs.require(options.memory);
  return needs;
}

}  // namespace

FrameParts::FrameParts(const scene::SceneData& sceneData, std::uint32_t width, std::uint32_t height,
                       const RendererOptions& options, const gl::ShaderLibrary& shaders)
    : needs(needsWithinLimit(sceneData, width, height, options)),
      scene(sceneData),
      memory(options.memory),
      capabilities(capabilitiesFor(options)),
      tessellationLimit(render::tessellationLimit(capabilities, scene.maxPatchTriangles)),
      finestTriangles(countFinestTriangles(scene)),
      buffers(scene),
      targets(width, height),
      map(visibility::mapLayout(width, height), &targets.depth, shaders),
      pyramid(visibility::mapLayout(width, height), capabilities, shaders),
      objects(buffers.objectCount(), buffers.cellCount()),
      visibility(objects, options.importance, shaders),
      budget(objects, shaders),
      lists(scene, shaders),
      early(scene, gpu::kMarkEarly, listOptions(scene, options)),
      late(scene, gpu::kMarkLate, listOptions(scene, options)),
      statistics(shaders),
      draw({capabilities, buffers.textureClasses(), scene.usesFullMaterials, !scene.loose.vertices.empty()}, shaders),
      methods({scene, capabilities, shaders, memory, needs}),
      context{cullView, drawView, counting, timer,   buffers, visibility, budget,       lists,
              early,    late,     draw,     targets, map,     pyramid,    queryOptions, queryFigures},
      drawing(context, scene, shaders) {
  methods.resize(width, height);
  if (!scene.motion.empty()) motion.emplace(scene.motion, shaders);
}

void FrameParts::setViews(const FrameOptions& options, const scene::Camera& cullCamera,
                          const scene::Camera& drawCamera) {
  const ViewSetting setting{.width = targets.width,
                            .height = targets.height,
                            .objectCount = buffers.objectCount(),
                            .cellCount = buffers.cellCount(),
                            .mapLevels = map.layout().levels,
                            .tessellationLimit = tessellationLimit,
                            .sceneWorld = scene.boundsWorld};
  cullMode = options.cullMode;
  queryOptions = options.queries;
  queryFigures = {};
  cullView = makeCullView(options, cullCamera, setting);
  drawView = makeDrawView(options, drawCamera, setting, cullView);
  counting = countsNow(options);
  visibility.setView(cullView);
}

bool FrameParts::countsNow(const FrameOptions& options) {
  const bool wanted = countsPixels(options);
  const bool now = wanted && countAge + 1 >= kCountInterval;
  countAge = now ? 0 : wanted ? countAge + 1 : kCountInterval;
  return now;
}

std::optional<FrameStatistics> FrameParts::statisticsOf(const std::optional<visibility::FrameRecord>& record) const {
  if (!record) return std::nullopt;
  const gpu::CullView& view = record->view;
  const bool drawsEarly = has(view.traits, gpu::kTraitTwoPhases);
  FrameStatistics result = makeStatistics(record->counters, view, finestTriangles);
  result.frame = record->frame;
  const QueryRecord& queries = queryRecords[record->frame % queryRecords.size()];
  if (queries.frame == record->frame) static_cast<culling::QueryFigures&>(result) = queries.figures;
  const std::uint32_t first = has(view.traits, gpu::kTraitPatches) ? gpu::kListsPerDetail : 0;
  const bool slices = result.sliceDraws > 0;  // of the late list only the blended surfaces are drawn
  for (std::uint32_t list = first; list < first + gpu::kListsPerDetail; ++list) {
    if (slices && list % gpu::kListsPerDetail != gpu::kListBlend) continue;
    result.draws += record->late[list] + (drawsEarly ? record->early[list] : 0);
  }
  result.draws += result.sliceDraws;
  return result;
}

}  // namespace jalousie::render
