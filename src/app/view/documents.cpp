// Open files side by side, and the options and cameras of their pictures.
#include "app/view/documents.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/view/clock.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

constexpr double kWatchSeconds = 0.25;
constexpr std::size_t kMostDocuments = 8;

/// Whether two scenes are so alike that one camera serves both: two bakes of one mesh, a scene before and after.
bool areAlike(const Aabb& a, const Aabb& b) {
  if (a.empty() || b.empty()) return false;
  const float larger = std::max(a.diagonal(), b.diagonal());
  return glm::length(a.center() - b.center()) <= 0.25F * larger &&
         std::min(a.diagonal(), b.diagonal()) >= 0.5F * larger;
}

}  // namespace

Documents::Documents(const ViewOptions& options, ViewState& state, Redraw& redraw, Messages& messages)
    : options_(options),
      state_(state),
      redraw_(redraw),
      messages_(messages),
      shaders_(options.shaders),
      shaderWatch_(options.shaders, /*recursive=*/true) {
  open(options.files);
  state_.current = 0;
}

std::optional<std::size_t> Documents::at(const glm::vec2& point) const {
  for (std::size_t i = 0; i < size(); ++i)
    if (region(i).holds(point)) return i;
  return std::nullopt;
}

std::size_t Documents::indexOf(const Document* document) const {
  const auto found = std::find_if(documents_.begin(), documents_.end(),
                                  [&](const auto& candidate) { return candidate.get() == document; });
  const bool isOpen = found != documents_.end();
  JAL_CHECK(isOpen);
  return static_cast<std::size_t>(found - documents_.begin());
}

void Documents::open(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : expandFolders(files))
    openOne(file);
}

void Documents::openOne(const std::filesystem::path& file) {
  if (size() == kMostDocuments)
    return messages_.fail({ErrorCode::kUsage,
                           fmt::format("not opened: at most {} files can be shown side by side", kMostDocuments),
                           file});
  documents_.push_back(std::make_unique<Document>(file, CameraChoice::of(options_.render), options_.render.memory));
  state_.current = size() - 1;
  redraw_.scenesChanged();
}

void Documents::closeCurrent() {
  if (current() == nullptr) return;
  documents_.erase(documents_.begin() + static_cast<std::ptrdiff_t>(state_.current));
  state_.current = empty() ? 0 : std::min(state_.current, size() - 1);
  state_.playing = state_.playing && !empty();
  redraw_.scenesChanged();
}

bool Documents::loading() const {
  return std::any_of(documents_.begin(), documents_.end(), [](const auto& document) { return !document->wasLoaded(); });
}

std::optional<std::size_t> Documents::loadNext() {
  for (std::size_t i = 0; i < size(); ++i) {
    if (documents_[i]->wasLoaded()) continue;
    documents_[i]->load();
    redraw_.scenesChanged();
    return i;
  }
  return std::nullopt;
}

void Documents::watch() {
  if (secondsNow() - lastWatch_ < kWatchSeconds) return;
  lastWatch_ = secondsNow();
  if (options_.watch) readChangedFiles();
  if (!options_.shaders.empty() && shaderWatch_.changed()) rebuildShaders();
}

void Documents::readChangedFiles() {
  for (const auto& document : documents_) {
    if (!document->wasLoaded() || !document->changedOnDisk()) continue;
    document->load();
    messages_.say(document->error().empty() ? fmt::format("{} was read again.", document->file().filename().string())
                                            : document->error());
    redraw_.scenesChanged();
  }
}

void Documents::rebuildShaders() {
  state_.shaderError.clear();
  for (std::size_t i = 0; i < size() && state_.shaderError.empty(); ++i)
    state_.shaderError = documents_[i]->rebuild({optionsFor(i, 0), optionsFor(i, 1)});
  if (state_.shaderError.empty()) messages_.say("The shaders were built again.");
  redraw_.scenesChanged();
}

void Documents::forgetHiddenFailures() {
  for (std::size_t side = static_cast<std::size_t>(state_.sides()); side < Document::kSides; ++side)
    for (const auto& document : documents_)
      document->forgetFailure(side);
}

void Documents::setSize(std::uint32_t width, std::uint32_t height) {
  width_ = width;
  height_ = height;
}

Region Documents::region(std::size_t index) const {
  const std::size_t count = std::max<std::size_t>(size(), 1);
  const std::size_t from = width_ * index / count;
  const std::size_t to = width_ * (index + 1) / count;
  return {static_cast<float>(from), 0.0F, static_cast<float>(to - from), static_cast<float>(height_)};
}

RenderOptions Documents::optionsFor(std::size_t index, int side) const {
  RenderOptions options = state_.configurations[static_cast<std::size_t>(side)].active;
  const CameraChoice& camera = documents_[index]->camera;
  camera.applyTo(options);
  // What `jalousie render` needs for the same pose: --frame names the time of the animations, too.
  if (documents_[index]->isAnimated() && !camera.frame) options.time = scene::secondsAt(camera.sceneFrame);
  options.scene = documents_[index]->file();
  options.width = std::max(static_cast<std::uint32_t>(region(index).width), 1U);
  options.height = std::max(height_, 1U);
  options.repeat = 1;
  options.rendererOptions.shaders = &shaders_;
  return options;
}

std::optional<RenderCameras> Documents::camerasFor(std::size_t index, int side) {
  Side* shown = documents_[index]->side(side);
  if (shown == nullptr) return std::nullopt;
  try {
    return renderCameras(optionsFor(index, side), shown->scene(), documents_[index]->path());
  } catch (const Error& error) {
    if (state_.message != error.what()) messages_.say(error.what());
    return std::nullopt;
  }
}

scene::Camera Documents::drawCamera(std::size_t index) {
  const std::optional<RenderCameras> cameras = camerasFor(index, 0);
  return cameras ? cameras->draw : scene::frameBox(documents_[index]->boundsWorld(), 1.0F);
}

std::vector<std::size_t> Documents::followers(std::size_t leader) const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < size(); ++i)
    if (i == leader || (state_.linked && areAlike(documents_[i]->boundsWorld(), documents_[leader]->boundsWorld())))
      indices.push_back(i);
  return indices;
}

void Documents::resetCameras() {
  if (current() == nullptr) return;
  state_.playing = false;
  for (const std::size_t i : followers(state_.current)) {
    documents_[i]->camera = CameraChoice::of(options_.render);
    documents_[i]->loadPath();
  }
  redraw_.scenesChanged();
}

}  // namespace jalousie::app
