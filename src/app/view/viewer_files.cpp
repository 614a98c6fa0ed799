// Files in and out: opening, watching, paths, screenshots, figures.
#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/record_command.h"
#include "app/view/viewer.h"
#include "asset/image_io.h"
#include "core/check.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::app {
namespace {

constexpr double kWatchSeconds = 0.25;
constexpr std::size_t kMostDocuments = 8;

}  // namespace

void Viewer::say(const std::string& message) {
  state_.message = message;
  state_.messageSeconds = now();
  wakeFrames_ = 3;
}

void Viewer::open(const std::filesystem::path& file) {
  if (documents_.size() == kMostDocuments) {
    failures_.emplace_back(ErrorCode::kUsage,
                           fmt::format("is not opened: {} files side by side are the most", kMostDocuments), file);
    return say(failures_.back().what());
  }
  const CameraChoice camera = CameraChoice::of(options_.render);
  documents_.push_back(std::make_unique<Document>(file, camera));
  starts_.push_back(camera);
  state_.current = documents_.size() - 1;
  touch();
}

bool Viewer::loading() const {
  return std::any_of(documents_.begin(), documents_.end(), [](const auto& document) { return !document->wasLoaded(); });
}

void Viewer::loadNext() {
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    if (documents_[i]->wasLoaded()) continue;
    documents_[i]->load();
    if (i == 0 && options_.select) select(0, 0, *std::exchange(options_.select, std::nullopt));
    return touch();
  }
}

void Viewer::closeCurrent() {
  if (current() == nullptr) return;
  if (state_.recording) stopRecording();
  const auto index = static_cast<std::ptrdiff_t>(state_.current);
  documents_.erase(documents_.begin() + index);
  starts_.erase(starts_.begin() + index);
  state_.current = documents_.empty() ? 0 : std::min(state_.current, documents_.size() - 1);
  state_.selection.reset();
  state_.inspection.reset();
  charted_ = nullptr;
  state_.history.clear();
  state_.playing = state_.playing && !documents_.empty();
  touch();
}

void Viewer::attempt(const std::function<void()>& task) {
  try {
    task();
  } catch (const std::exception& error) {
    say(error.what());
  }
}

void Viewer::watchFiles() {
  if (now() - lastWatch_ < kWatchSeconds) return;
  lastWatch_ = now();
  if (options_.watch) {
    for (const auto& document : documents_) {
      if (!document->wasLoaded() || !document->changedOnDisk()) continue;
      document->load();
      say(document->error().empty() ? fmt::format("{} was read again", document->file().filename().string())
                                    : document->error());
      touch();
    }
  }
  if (options_.shaders.empty() || !shaderWatch_.changed()) return;
  state_.shaderError.clear();
  for (std::size_t i = 0; i < documents_.size() && state_.shaderError.empty(); ++i)
    state_.shaderError = documents_[i]->rebuild({optionsFor(i, 0), optionsFor(i, 1)});
  if (state_.shaderError.empty()) say("shaders were built again");
  touch();
}

void Viewer::playPath(double seconds) {
  if (state_.flicker) {
    const int side =
        std::fmod(now(), 2.0 * static_cast<double>(state_.flickerSeconds)) < static_cast<double>(state_.flickerSeconds)
            ? 0
            : 1;
    if (side != state_.flickerSide) wakeFrames_ = 1;
    state_.flickerSide = side;
  }
  if (!state_.playing) return;
  if (!loading() && std::all_of(documents_.begin(), documents_.end(),
                                [](const auto& document) { return document->pathFrames() == 0; })) {
    state_.playing = false;
    failures_.emplace_back(ErrorCode::kUsage, "--play: no file has a camera path");
    return say(failures_.back().what());
  }
  // A script counts frames, people watch the clock.
  if (options_.frames)
    pathSeconds_ = pathStart_ + framesDone_ / static_cast<double>(scene::kPathRate);
  else
    pathSeconds_ += seconds;
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    const auto& document = documents_[i];
    const std::uint32_t frames = document->pathFrames();
    if (frames == 0 || (!options_.frames && !follows(i, state_.current))) continue;
    const double frame = std::floor(pathSeconds_ * static_cast<double>(scene::kPathRate) + 1e-6);
    document->camera.frame = static_cast<float>(std::fmod(frame, static_cast<double>(frames)));
    document->camera.pose.reset();
  }
  inspectSoon_ = state_.selection.has_value();
}

std::size_t Viewer::recordedIndex() const {
  const auto found = std::find_if(documents_.begin(), documents_.end(),
                                  [&](const auto& document) { return document.get() == recordsFrom_; });
  const bool isOpen = found != documents_.end();
  JAL_CHECK(isOpen);
  return static_cast<std::size_t>(found - documents_.begin());
}

void Viewer::recordPose() {
  if (!state_.recording) return;
  const auto frame = static_cast<std::uint32_t>((now() - recordStart_) * static_cast<double>(scene::kPathRate));
  const bool isNew = recorded_.translationTimes.empty() ||
                     static_cast<float>(frame) / scene::kPathRate > recorded_.translationTimes.back();
  if (isNew) addPose(recorded_, recorded_.translationTimes.empty() ? 0 : frame, cameraOf(recordedIndex()));
}

void Viewer::stopRecording() {
  state_.recording = false;
  attempt([&] { saveRecording(); });
  touch();
}

void Viewer::saveRecording() {
  if (recorded_.translationTimes.empty()) return say("nothing was recorded");
  const std::filesystem::path file = freshOutput("jalousie-path", ".glb");
  const std::size_t recorded = recordedIndex();
  const std::uint32_t frames = savePath(recorded_, cameraOf(recorded).fovY, documents_[recorded]->boundsWorld(), file);
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    if (!follows(i, recorded)) continue;
    documents_[i]->keepFrozenCamera();
    documents_[i]->camera.path = file;
    documents_[i]->loadPath();
  }
  say(fmt::format("{}: {} frames; Space plays it", file.string(), frames));
}

void Viewer::keepSettings() {
  if (options_.frames) return;  // a script leaves no traces
  state_.settings.layout = interface_.layout();
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window_.handle(), &width, &height);
  if (width > 0 && height > 0) {
    state_.settings.width = static_cast<std::uint32_t>(width);
    state_.settings.height = static_cast<std::uint32_t>(height);
  }
  // Another viewer may have set some meanwhile.
  for (const auto& [file, marks] : loadSettings(settingsFolder_).bookmarks)
    for (std::size_t i = 0; i < kBookmarks; ++i)
      if (std::optional<Pose>& ours = state_.settings.bookmarks[file][i]; !ours) ours = marks[i];
  saveSettings(state_.settings, settingsFolder_);
}

void Viewer::screenshot(bool withInterface) {
  screenshotSoon_ = false;
  attempt([&] {
    const std::filesystem::path file = freshOutput("jalousie", ".png");
    asset::savePng(withInterface ? captureWithInterface() : capture(), file);
    say(file.string());
  });
  if (!withInterface) touch();
}

std::filesystem::path Viewer::freshOutput(const char* stem, const char* extension) const {
  for (int number = 1;; ++number) {
    std::filesystem::path file = state_.outputs / fmt::format("{}-{:04}{}", stem, number, extension);
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) return file;
  }
}

void Viewer::writeJson(const std::filesystem::path& file) const {
  const std::string text =
      state_.history.json(window_.capabilities().renderer, !window_.capabilities().softwareRenderer);
  file == "-" ? fmt::print("{}", text) : writeFileAtomic(file, text);
}

void Viewer::finish() {
  if (options_.frames)
    for (const auto& document : documents_)
      if (!document->error().empty()) failures_.emplace_back(document->errorCode(), document->error());
  const bool inVain = options_.frames && !failures_.empty();
  // Each as if the others had not failed; the first failure is told.
  const auto attemptStep = [&](bool wanted, const std::function<void()>& task) {
    try {
      if (wanted) task();
    } catch (const Error& error) {
      failures_.push_back(error);
    }
  };
  if (!options_.frames) failures_.clear();  // people have read them
  attemptStep(true, [&] { keepSettings(); });
  attemptStep(state_.recording, [&] { saveRecording(); });
  attemptStep(!options_.screenshot.empty() && !inVain, [&] {
    asset::savePng(options_.withInterface ? captureWithInterface() : capture(), options_.screenshot);
  });
  attemptStep(!options_.json.empty() && !inVain, [&] { writeJson(options_.json); });
  if (!failures_.empty()) throw Error(failures_.front());
}

}  // namespace jalousie::app
