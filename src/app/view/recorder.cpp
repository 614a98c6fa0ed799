// Records the camera of a document as a glTF camera path.
#include "app/view/recorder.h"

#include <fmt/format.h>

#include "app/record_command.h"
#include "app/view/clock.h"
#include "app/view/output_files.h"

namespace jalousie::app {

Recorder::Recorder(ViewState& state, Documents& documents, Redraw& redraw, Messages& messages)
    : state_(state), documents_(documents), redraw_(redraw), messages_(messages) {}

void Recorder::toggle() {
  if (state_.recording) return stop();
  if (documents_.current() == nullptr) return;
  state_.recording = true;
  document_ = documents_.current();
  startSeconds_ = secondsNow();
  track_ = {};
  messages_.say("Recording the camera. Ctrl+R stops and saves the path.");
}

void Recorder::step() {
  if (!state_.recording) return;
  const auto frame = static_cast<std::uint32_t>((secondsNow() - startSeconds_) * static_cast<double>(scene::kPathRate));
  const bool isFirst = track_.translationTimes.empty();
  if (!isFirst && static_cast<float>(frame) / scene::kPathRate <= track_.translationTimes.back()) return;
  addPose(track_, isFirst ? 0 : frame, documents_.drawCamera(documents_.indexOf(document_)));
}

void Recorder::stop() {
  if (!state_.recording) return;
  state_.recording = false;
  messages_.attempt([&] { save(); });
  redraw_.scenesChanged();
}

void Recorder::save() {
  if (track_.translationTimes.empty()) return messages_.say("Nothing was recorded.");
  const std::filesystem::path file = freshOutput(state_.outputs, "jalousie-path", ".glb");
  const std::size_t recorded = documents_.indexOf(document_);
  const float fovY = documents_.drawCamera(recorded).fovY;
  const std::uint32_t frames =
      savePath(track_, fovY, documents_[recorded].boundsWorld(), documents_[recorded].originWorld(), file);
  for (const std::size_t i : documents_.followers(recorded)) {
    documents_[i].keepFrozenCamera();
    documents_[i].camera.path = file;
    documents_[i].loadPath();
  }
  messages_.say(fmt::format("Wrote {} ({} frames). Space plays the path.", file.string(), frames));
}

}  // namespace jalousie::app
