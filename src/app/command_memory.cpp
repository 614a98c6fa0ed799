// The peaks of the commands: which parts exist at the same time.
#include "app/command_memory.h"

#include "compare/butteraugli.h"
#include "core/error.h"
#include "policy/detail.h"
#include "render/memory_needs.h"
#include "scene/scene_memory.h"

namespace jalousie::app {
namespace {

/// What every command has: the process, and with a renderer its programs.
MemoryEstimate base() {
  MemoryEstimate needs;
  needs.add(1, render::kProgramBytes, "programs and shaders");
  return needs;
}

MemoryEstimate sum(std::initializer_list<MemoryEstimate> parts) {
  MemoryEstimate needs;
  for (const MemoryEstimate& part : parts)
    needs.add(part);
  return needs;
}

MemoryEstimate larger(const MemoryEstimate& a, const MemoryEstimate& b) {
  return a.bytes() >= b.bytes() ? a : b;
}

bool hasPatches(const RenderOptions& options) {
  return rowOf(options.frameOptions.detail).patches;
}

/// With the cells and groups of the options, which have no effect on patches.
asset::SceneSize dividedSize(const asset::SceneSize& whole, const RenderOptions& options) {
  if (hasPatches(options)) return whole;
  return scene::withFaces(scene::withCells(whole, options.cells),
                          options.frameOptions.faceCulling != FaceCulling::kOff);
}

/// Everything that one renderer allocates.
MemoryEstimate rendererNeeds(const asset::SceneSize& size, const RenderOptions& options) {
  return sum({render::bufferNeeds(size, hasPatches(options), options.rendererOptions),
              render::targetNeeds(options.width, options.height), render::pictureNeeds(options.width, options.height)});
}

}  // namespace

asset::SceneFile readWithin(const std::filesystem::path& file, const MemoryLimit& limit, const Needs& needs,
                            const SceneRequest& request) {
  return asset::readSceneFile(file, {}, request.observer,
                              {.check = [&](const asset::SceneSize& size) { needs(size).require(limit, file); },
                               .seconds = request.seconds,
                               .plays = request.plays});
}

MemoryEstimate maskNeeds(const std::filesystem::path& file) {
  MemoryEstimate needs;
  if (file.empty()) return needs;
  const asset::ImageSize size = asset::imageFileSize(file);
  needs.add(std::uint64_t{size.width} * size.height, 4 + 1 + 2, "the mask of --importance");
  return needs;
}

MemoryEstimate readingNeeds(const asset::SceneSize& size) {
  return sum({scene::fileNeeds(size), scene::imageNeeds(size)});
}

MemoryEstimate flatNeeds(const asset::SceneSize& size) {
  return sum({scene::fileNeeds(size), scene::imageNeeds(size), scene::sceneNeeds(size, false)});
}

MemoryEstimate renderNeeds(const asset::SceneSize& whole, const RenderOptions& options) {
  const asset::SceneSize size = dividedSize(whole, options);
  return sum({base(), maskNeeds(options.importance), scene::imageNeeds(size),
              scene::sceneNeeds(size, hasPatches(options)),
              larger(scene::fileNeeds(size), rendererNeeds(size, options))});
}

MemoryEstimate viewNeeds(const asset::SceneSize& whole, const RenderOptions& options) {
  const asset::SceneSize size = dividedSize(whole, options);
  return sum({base(), maskNeeds(options.importance), scene::imageNeeds(size), scene::fileNeeds(size),
              scene::sceneNeeds(size, hasPatches(options)), rendererNeeds(size, options)});
}

MemoryEstimate compareNeeds(const asset::SceneSize& size, const ComparisonSize& comparison) {
  // Two reference pictures with their prepared FLIP images, what preparing one takes, an error map with the
  // object numbers of two pictures, and a picture of each configuration.
  const std::uint64_t pictureBytes = 2 * (4 + 20) + 44 + 16 + 12 + 4 * comparison.configurations;
  MemoryEstimate needs = sum({base(), scene::imageNeeds(size), scene::fileNeeds(size), scene::sceneNeeds(size, false)});
  MemoryEstimate each;
  for (const scene::BuildOptions& build : comparison.builds) {
    const asset::SceneSize built = scene::withFaces(scene::withCells(size, build.cells), build.faces);
    if (build != scene::BuildOptions{}) needs.add(scene::sceneNeeds(built, build.patches));
    each = larger(each, sum({render::bufferNeeds(built, build.patches, {}),
                             render::targetNeeds(comparison.width, comparison.height)}));
  }
  needs.add(comparison.renderers, each.bytes(), each.largestItem());
  if (comparison.pictures)
    needs.add(std::uint64_t{comparison.width} * comparison.height, pictureBytes, "pictures and their errors");
  if (comparison.butteraugli)
    needs.add(1, compare::butteraugliBytes(comparison.width, comparison.height), "Butteraugli of a tile");
  return needs;
}

}  // namespace jalousie::app
