// Cameras of the current document.
#include "app/view/cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace jalousie::app {
namespace {

/// Width around the middle of a region that no panel covers, because the target stays in the middle. At least a third:
/// a panel that covers more is taken for closed soon.
float freeWidth(const Region& where, const ViewState& state) {
  const float middle = where.x + 0.5F * where.width;
  const float right = where.x + where.width - state.coveredRight;
  const float half = std::min(middle - std::max(where.x, state.freeLeft), right - middle);
  return std::max({2.0F * std::min(half, 0.5F * where.width), where.width / 3.0F, 1.0F});
}

}  // namespace

Cameras::Cameras(ViewState& state, Documents& documents, Redraw& redraw, Messages& messages)
    : state_(state), documents_(documents), redraw_(redraw), messages_(messages) {}

Pose Cameras::pose() {
  const Document& document = *documents_.current();
  if (document.camera.pose) return relativeTo(document.originWorld(), *document.camera.pose);
  const scene::Camera camera = documents_.drawCamera(state_.current);
  return poseOf(camera, targetDistance(camera, document.boundsWorld()));
}

void Cameras::move(const Pose& pose) {
  if (!isUsable(pose)) return;
  const std::vector<std::size_t> followers = documents_.followers(state_.current);
  // Animations go on while the camera leaves its path.
  state_.playing = state_.playing && std::any_of(followers.begin(), followers.end(),
                                                 [&](std::size_t i) { return documents_[i].isAnimated(); });
  for (const std::size_t i : followers) {
    documents_[i].camera.pose = inWorld(pose, documents_[i].originWorld());
    documents_[i].camera.frame.reset();
  }
  redraw_.scenesChanged();
}

void Cameras::frame() {
  const Document* document = documents_.current();
  if (document == nullptr) return;
  const Region where = documents_.region(state_.current);
  const Aabb box = state_.inspection ? state_.inspection->boundsWorld : document->boundsWorld();
  const float fovY = documents_.drawCamera(state_.current).fovY;
  move(framed(pose(), box, fovY, freeWidth(where, state_) / where.height));
}

void Cameras::freezeOrThaw() {
  Document* document = documents_.current();
  if (document == nullptr) return;
  CameraChoice& camera = document->camera;
  if (camera.frozen()) {
    camera.freezeFrame.reset();
    camera.freezePose.reset();
    messages_.say("The culling camera follows the drawing camera again.");
  } else {
    if (camera.frame || (!camera.pose && document->pathFrames() > 0))
      camera.freezeFrame = camera.frame.value_or(0.0F);
    else
      camera.freezePose = inWorld(pose(), document->originWorld());
    messages_.say("The culling camera is frozen here; the drawing camera can move on.");
  }
  redraw_.scenesChanged();
}

Bookmarks& Cameras::bookmarks() {
  std::error_code failed;
  return state_.settings.bookmarks[std::filesystem::absolute(documents_.current()->file(), failed).string()];
}

bool Cameras::setBookmark(std::size_t number) {
  if (documents_.current() == nullptr) return false;
  const Pose here = pose();
  if (!isUsable(here)) return false;
  bookmarks()[number] = inWorld(here, documents_.current()->originWorld());
  messages_.say(fmt::format("Bookmark {} is set.", number + 1));
  return true;
}

void Cameras::goToBookmark(std::size_t number) {
  if (documents_.current() == nullptr) return;
  const std::optional<WorldPose> marked = bookmarks()[number];
  if (!marked) return messages_.say(fmt::format("There is no bookmark {0}. Ctrl+{0} sets it.", number + 1));
  move(relativeTo(documents_.current()->originWorld(), *marked));
}

}  // namespace jalousie::app
