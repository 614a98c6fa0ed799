// Overlays over the picture of a scene: frozen frustum, selected object, divider, file name, notices.
#pragma once

#include <string>

#include "app/view/inspection.h"
#include "app/view/region.h"
#include "scene/camera.h"

namespace jalousie::app {

/// Draws the frustum of a frozen culling camera: edges, and faces that are almost transparent.
/// @param reachWorld  distance of its far plane where the camera has none, world units
void drawFrustum(const Region& region, const scene::Camera& cull, const scene::Camera& draw, float reachWorld);

/// Draws the bounding box of the selected object, and its AABR with the texels of its block.
/// @param frozen  the AABR belongs to the screen of a frozen culling camera and is left out
void drawSelection(const Region& region, const Inspection& inspection, const scene::Camera& draw, bool frozen);

/// Draws the divider at the left edge of a region, with the names of both configurations.
/// @param scale  of the interface
void drawDivider(const Region& right, float scale);

/// Draws the name of a file at the top of its region, and the border to the region left of it.
void drawFileName(const Region& region, const std::string& name, bool isCurrent);

/// Draws a title and a wrapped text in the middle of a region, in front of the windows.
void drawNotice(const Region& region, const std::string& title, const std::string& text);

/// Draws a message of one line at the lower edge of a region.
void drawMessage(const Region& region, const std::string& message);

}  // namespace jalousie::app
