// Frustum culling: classify.comp decides it alone.
#pragma once

#include "render/methods/cull_method.h"

namespace jalousie::render {

/// Draws every object whose box is not outside the frustum.
class FrustumMethod : public CullMethod {};

}  // namespace jalousie::render
