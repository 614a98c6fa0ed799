// Estimated memory of a scene on the host.
#pragma once

#include <cstdint>
#include <string>

#include "asset/scene_size.h"
#include "core/memory_estimate.h"
#include "scene/cell_options.h"

namespace jalousie::scene {

using asset::SceneSize;
struct SceneData;

/// Numbers of elements of a scene that is built already. Images keep their own sizes.
SceneSize sizeOf(const SceneData& scene);

/// The size with an upper bound of the cells that buildScene may divide such a scene into.
SceneSize withCells(SceneSize size, const CellOptions& options);
/// Adds the groups of back faces that a scene is built with: those of the file, and one for each level of a cell or
/// chain that has none. @param size  withCells()
SceneSize withFaces(SceneSize size, bool faces);

/// A document and the asset::SceneFile that is read from it, but for its images.
MemoryEstimate fileNeeds(const SceneSize& size);

/// The decoded images, which all copies of a scene share, and one that is being decoded.
MemoryEstimate imageNeeds(const SceneSize& size);

/// The SceneData that is built from it. @param patches  as BuildOptions::patches
MemoryEstimate sceneNeeds(const SceneSize& size, bool patches);

/// "16777216 instances".
std::string counted(std::uint64_t count, const char* noun);

}  // namespace jalousie::scene
