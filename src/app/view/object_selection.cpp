// The selected object: read back from a picture of object ids.
#include "app/view/object_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/error.h"

namespace jalousie::app {
namespace {

/// Object drawn at a pixel of a renderer's last frame. @param at  pixels, origin at the upper left
std::optional<std::uint32_t> objectAt(render::FrameRenderer& renderer, const glm::vec2& at) {
  renderer.renderIds();
  const std::vector<std::uint32_t> ids = renderer.readIds();  // 0: background, else object + 1
  const auto x = std::min(static_cast<std::uint32_t>(at.x), renderer.width() - 1);
  const auto y = renderer.height() - 1 - std::min(static_cast<std::uint32_t>(at.y), renderer.height() - 1);
  const std::uint32_t id = ids[static_cast<std::size_t>(y) * renderer.width() + x];
  return id > 0 ? std::optional(id - 1) : std::nullopt;
}

/// Index of the object of an instance, nothing where it is hidden.
std::optional<std::uint32_t> objectOf(const scene::SceneData& scene, std::uint32_t instance) {
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].owner == instance) return i;
  return std::nullopt;
}

}  // namespace

ObjectSelection::ObjectSelection(ViewState& state, Documents& documents, Redraw& redraw, Messages& messages)
    : state_(state), documents_(documents), redraw_(redraw), messages_(messages) {}

void ObjectSelection::pick(const glm::vec2& at) {
  clear();
  redraw_.scenesChanged();  // the targets of the renderer hold ids now
  const std::optional<std::size_t> document = documents_.at(at);
  if (!document) return;
  const Region where = documents_.region(*document);
  const bool right = state_.showsDivider() && at.x - where.x >= where.dividerColumns(state_.divider);
  const int side = right ? 1 : state_.firstSide();
  Side* picked = documents_[*document].side(side);
  if (picked == nullptr) return;
  if (const auto object = objectAt(picked->renderer(), at - glm::vec2(where.x, where.y)))
    state_.selection = Selection{*document, side, *object, picked->scene().objects[*object].owner};
}

void ObjectSelection::select(std::size_t document, std::uint32_t instance) {
  Side* made = documents_[document].prepare(0, documents_.optionsFor(document, 0));
  if (made == nullptr) return;
  if (const auto object = objectOf(made->scene(), instance))
    state_.selection = Selection{document, 0, *object, instance};
  else
    messages_.fail({ErrorCode::kUsage, fmt::format("--select {}: there is no such object", instance),
                    documents_[document].file()});
  redraw_.scenesChanged();
}

void ObjectSelection::clear() {
  state_.selection.reset();
  state_.inspection.reset();
}

void ObjectSelection::leaveHiddenSide() {
  if (state_.selection && state_.selection->side >= state_.sides()) state_.selection->side = 0;
}

void ObjectSelection::inspect() {
  redraw_.inspectionDone();
  state_.inspection.reset();
  if (!state_.selection || state_.selection->document >= documents_.size()) return;
  Selection& selected = *state_.selection;
  Side* side = documents_[selected.document].side(selected.side);
  if (side == nullptr) return;
  const std::optional<std::uint32_t> object = objectOf(side->scene(), selected.instance);
  if (!object) return clear();
  selected.object = *object;
  const RenderOptions options = documents_.optionsFor(selected.document, selected.side);
  const std::optional<RenderCameras> cameras = documents_.camerasFor(selected.document, selected.side);
  if (!cameras) return;
  state_.inspection = inspectObject(selected.object, side->scene(), side->renderer(), options.frameOptions);
  side->renderer().render(options.frameOptions, cameras->cull, cameras->draw);
  redraw_.interfaceChanged();
}

}  // namespace jalousie::app
