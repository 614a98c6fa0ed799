// Construction of a renderer's parts, and what they compute for a frame.
#include "render/frame_parts.h"

#include <algorithm>
#include <utility>

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
  const std::uint32_t capacity = std::min(options.capacity.value_or(most), most);
  return {options.submission, capacity, scene.maxPatchTriangles > 0,
          visibility::faceRanges(scene.faces.mostGroups, capacity)};
}

std::optional<FaceParts> makeFaces(const scene::SceneData& scene, const visibility::DrawList& early,
                                   const visibility::DrawList& late, const gl::ShaderLibrary& shaders) {
  if (scene.faces.nodes.empty()) return std::nullopt;
  return std::optional<FaceParts>(std::in_place, scene.faces, early, late, shaders);
}

/// The sum of two words: bits 0-9, and the bits above.
std::uint64_t faceFigure(const visibility::FrameRecord& record, gpu::uint figure, bool drawsEarly) {
  const auto of = [&](const auto& words) { return words[figure] + (std::uint64_t{words[figure + 1]} << 10U); };
  return of(record.lateFaces) + (drawsEarly ? of(record.earlyFaces) : 0);
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
      faces(makeFaces(scene, early, late, shaders)),
      statistics(shaders),
      draw({capabilities, buffers.textureClasses(), scene.usesFullMaterials, !scene.loose.vertices.empty()}, shaders),
      methods({scene, capabilities, shaders, memory, needs}),
      context{cullView,     drawView,
              counting,     timer,
              buffers,      visibility,
              budget,       lists,
              early,        late,
              draw,         targets,
              map,          pyramid,
              queryOptions, occluderOptions,
              queryFigures, faces ? &*faces : nullptr,
              faceCulling,  cullMode},
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
  faceCulling = options.faceCulling;
  queryOptions = options.queries;
  occluderOptions = options.occluders;
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
  const bool slices = result.sliceDraws > 0;  // of the late list only the blended surfaces are drawn
  result.facesTested = faceFigure(*record, gpu::kFaceFigureTested, drawsEarly);
  result.facesCulled = faceFigure(*record, gpu::kFaceFigureCulled, drawsEarly);
  if (faceCulling != FaceCulling::kOff)  // blended surfaces, which no kernel of groups sees, included
    result.facesWhole = result.triangles - std::min(result.triangles, result.facesTested);
  const std::uint32_t first = has(view.traits, gpu::kTraitPatches) ? gpu::kListsPerDetail : 0;
  for (std::uint32_t list = first; list < first + gpu::kListsPerDetail; ++list) {
    if (slices && list % gpu::kListsPerDetail != gpu::kListBlend) continue;
    result.draws += record->late[list] + (drawsEarly ? record->early[list] : 0);
  }
  result.draws += result.sliceDraws;
  return result;
}

}  // namespace jalousie::render
