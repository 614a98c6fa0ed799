// What methods are made of.
#pragma once

#include "core/memory_estimate.h"
#include "core/memory_limit.h"
#include "gl/capabilities.h"
#include "gl/shader_source.h"
#include "scene/scene_data.h"

namespace jalousie::render {

/// What a method may be made of. Borrows everything; only scene and needs may be kept.
struct MethodInputs {
  const scene::SceneData& scene;
  const gl::Capabilities& capabilities;
  const gl::ShaderLibrary& shaders;
  MemoryLimit memory;
  const MemoryEstimate& needs;  ///< of the renderer without what methods allocate for themselves
};

}  // namespace jalousie::render
