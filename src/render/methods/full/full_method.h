// No culling: classify.comp leaves every object to be drawn.
#pragma once

#include "render/methods/cull_method.h"

namespace jalousie::render {

/// Draws every object.
class FullMethod : public CullMethod {};

}  // namespace jalousie::render
