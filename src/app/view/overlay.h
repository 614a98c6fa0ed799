// Lines and scales over the picture of a scene: the frozen frustum, the selected object, what colours mean.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "app/render_options.h"
#include "app/view/inspection.h"
#include "scene/camera.h"

namespace jalousie::app {

/// Where a scene's picture is in the window, pixels, origin at the upper left.
struct Region {
  float x = 0.0F;
  float y = 0.0F;
  float width = 0.0F;
  float height = 0.0F;

  bool holds(const glm::vec2& p) const { return p.x >= x && p.x < x + width && p.y >= y && p.y < y + height; }
};

/// The frustum of a frozen culling camera, as lines and faint faces.
/// @param reachWorld  how far it is drawn
void drawFrustum(const Region& region, const scene::Camera& cull, const scene::Camera& draw, float reachWorld);

/// The box of the selected object and, unless the culling camera is frozen, its AABR and the texels of its block.
void drawSelection(const Region& region, const Inspection& inspection, const scene::Camera& draw, bool frozen);

/// What the colours of a view mean, in the lower right corner of a region. Nothing for the shaded view.
void drawLegend(const Region& region, const RenderOptions& options);

/// The name of a file at the top of its region, and the border to the one left of it.
void drawFileName(const Region& region, const std::string& name, bool isCurrent);

/// A text in a box over the middle of a region, several lines wide; over the windows too, as it must be read.
void drawNotice(const Region& region, const std::string& title, const std::string& text);

/// sRGB bytes of the heat scale of the views. @param t  in [0, 1]
std::uint32_t heatBytes(float t);

}  // namespace jalousie::app
