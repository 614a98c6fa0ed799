// Plays camera paths: in real time for people, frame by frame for scripts.
#include "app/view/path_player.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace jalousie::app {
namespace {

constexpr auto kPathRate = static_cast<double>(scene::kPathRate);

bool hasPath(const Documents& documents) {
  for (std::size_t i = 0; i < documents.size(); ++i)
    if (documents[i].pathFrames() > 0) return true;
  return false;
}

}  // namespace

PathPlayer::PathPlayer(const ViewOptions& options, ViewState& state, Documents& documents, Redraw& redraw,
                       Messages& messages)
    : options_(options),
      state_(state),
      documents_(documents),
      redraw_(redraw),
      messages_(messages),
      startSeconds_(static_cast<double>(options.render.frame.value_or(0.0F)) / kPathRate),
      pathSeconds_(startSeconds_) {}

void PathPlayer::toggle() {
  Document* document = documents_.current();
  if (document == nullptr) return;
  if (!state_.playing && document->pathFrames() == 0)
    return messages_.say("The file has no camera path and no animation. Record a path, or name one in the panel.");
  state_.playing = !state_.playing;
  if (state_.playing && document->hasMovingCamera()) document->camera.pose.reset();
  pathSeconds_ = static_cast<double>(document->camera.sceneFrame) / kPathRate;
  redraw_.scenesChanged();
}

void PathPlayer::goTo(double frame) {
  const Document* document = documents_.current();
  if (document == nullptr || document->pathFrames() == 0) return;
  state_.playing = false;
  const double last = document->pathFrames() - 1;
  for (const std::size_t i : documents_.followers(state_.current))
    show(i, std::clamp(std::round(frame), 0.0, last));
  redraw_.scenesChanged();
}

void PathPlayer::move(int frames) {
  const Document* document = documents_.current();
  if (document == nullptr) return;
  if (document->pathFrames() == 0) return messages_.say("The file has no camera path and no animation.");
  goTo(static_cast<double>(document->camera.sceneFrame) + frames);
}

void PathPlayer::step(double seconds, std::uint32_t framesDone) {
  if (!state_.playing) return;
  if (!documents_.loading() && !hasPath(documents_)) {
    state_.playing = false;
    return messages_.fail({ErrorCode::kUsage, "--play: no file has a camera path or an animation"});
  }
  const bool isScript = options_.frames.has_value();
  pathSeconds_ = isScript ? startSeconds_ + framesDone / kPathRate : pathSeconds_ + seconds;
  const double frame = std::floor(pathSeconds_ * kPathRate + 1e-6);
  if (isScript) {
    for (std::size_t i = 0; i < documents_.size(); ++i)
      show(i, frame);
  } else if (documents_.current() != nullptr) {
    for (const std::size_t i : documents_.followers(state_.current))
      show(i, frame);
  }
  redraw_.inspectionOutdated();
}

void PathPlayer::show(std::size_t index, double frame) {
  Document& document = documents_[index];
  if (document.pathFrames() == 0) return;
  document.showFrame(static_cast<float>(std::fmod(frame, static_cast<double>(document.pathFrames()))));
}

}  // namespace jalousie::app
