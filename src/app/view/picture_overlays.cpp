// All overlays of one document's picture.
#include "app/view/picture_overlays.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <string>

#include "app/view/legend.h"
#include "app/view/overlay.h"

namespace jalousie::app {
namespace {

/// Name and error of a document. @return whether there is a picture below
bool drawNotices(const Documents& documents, std::size_t index, const ViewState& state) {
  const Document& document = documents[index];
  const Region where = documents.region(index);
  const std::string name = document.file().filename().string();
  if (documents.size() > 1) drawFileName(where, name, index == state.current);
  if (!document.wasLoaded())
    drawNotice(where, name, "The file is being read.");
  else if (!document.error().empty())
    drawNotice(where, name, document.error());
  return document.wasLoaded();
}

/// Distance from a camera behind which the whole scene is.
float reachOf(const scene::Camera& camera, const Aabb& sceneWorld) {
  return glm::length(camera.positionWorld() - sceneWorld.center()) + 0.5F * sceneWorld.diagonal();
}

/// Levels that a picture can have: those of the longest chain, or of patches.
std::uint32_t levelCount(Document& document, int side, const RenderOptions& options) {
  if (rowOf(options.frameOptions.detail).patches) return options.frameOptions.maxTessellation;
  std::uint32_t most = 1;
  if (Side* shown = document.side(side); shown != nullptr)
    for (const gpu::Chain& chain : shown->scene().chains)
      most = std::max(most, chain.lodCount);
  return most;
}

/// Legends of the shown configurations, and the divider between them.
void drawLegends(Documents& documents, std::size_t index, const ViewState& state, float scale) {
  const Region where = documents.region(index);
  const auto draw = [&](const Region& region, int side) {
    const RenderOptions options = documents.optionsFor(index, side);
    drawLegend(region, options, levelCount(documents[index], side, options));
  };
  if (!state.showsDivider()) return draw(where, state.firstSide());
  draw(where.leftOf(state.divider), state.firstSide());
  draw(where.rightOf(state.divider), 1);
  drawDivider(where.rightOf(state.divider), scale);
}

}  // namespace

void drawOverlays(Documents& documents, std::size_t index, const ViewState& state, float scale) {
  if (!drawNotices(documents, index, state)) return;
  const std::optional<RenderCameras> cameras = documents.camerasFor(index, 0);
  if (!cameras) return;
  const Document& document = documents[index];
  const Region where = documents.region(index);
  const bool frozen = document.camera.frozen();
  if (frozen) drawFrustum(where, cameras->cull, cameras->draw, reachOf(cameras->cull, document.boundsWorld()));
  if (state.inspection && state.selection && state.selection->document == index && !state.playing)
    drawSelection(where, *state.inspection, cameras->draw, frozen);
  drawLegends(documents, index, state, scale);
}

}  // namespace jalousie::app
