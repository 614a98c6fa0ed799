// Loading and its failures.
#include "app/view/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>
#include <set>

#include "asset/image_io.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::app {
namespace {

/// What a renderer is made for, as a text that differs when another one is needed.
std::string keyOf(const RenderOptions& options) {
  return fmt::format("{}|{}|{}|{}|{}x{}|{}", options.detail == "tessellation", options.draws, options.coreOnly,
                     options.rendererOptions.capacity.value_or(0), options.width, options.height,
                     options.importance.string());
}

}  // namespace

Side::Side(const asset::SceneFile& file, const RenderOptions& options)
    : scene_(scene::buildScene(file, {.patches = options.detail == "tessellation"})),
      rendererOptions_(options.rendererOptions),
      mask_(options.importance),
      patches_(options.detail == "tessellation") {
  if (!mask_.empty()) importance_.emplace(asset::loadImage(mask_));
  rendererOptions_.importance = importance_ ? &*importance_ : nullptr;
  renderer_.emplace(scene_, options.width, options.height, rendererOptions_);
}

bool Side::fits(const RenderOptions& options) const {
  return patches_ == (options.detail == "tessellation") && mask_ == options.importance &&
         rendererOptions_.submission == options.rendererOptions.submission &&
         rendererOptions_.fastPaths == options.rendererOptions.fastPaths &&
         rendererOptions_.capacity == options.rendererOptions.capacity;
}

void Side::resize(std::uint32_t width, std::uint32_t height) {
  if (renderer_->width() != width || renderer_->height() != height) renderer_->resize(width, height);
}

CameraChoice CameraChoice::of(const RenderOptions& options) {
  CameraChoice choice;
  choice.path = options.path;
  choice.frame = options.frame;
  choice.freezeFrame = options.freezeFrame;
  if (options.eye && options.look) choice.pose = Pose{*options.eye, *options.look};
  if (options.freezeEye && options.freezeLook) choice.freezePose = Pose{*options.freezeEye, *options.freezeLook};
  return choice;
}

void CameraChoice::applyTo(RenderOptions& options) const {
  options.path = path;
  options.frame = frame;
  options.freezeFrame = freezeFrame;
  options.eye = pose ? std::optional(pose->eye) : std::nullopt;
  options.look = pose ? std::optional(pose->look) : std::nullopt;
  options.freezeEye = freezePose ? std::optional(freezePose->eye) : std::nullopt;
  options.freezeLook = freezePose ? std::optional(freezePose->look) : std::nullopt;
}

Document::Document(std::filesystem::path file, const CameraChoice& choice)
    : camera(choice), file_(std::move(file)), watch_(file_) {}

void Document::read() {
  std::set<std::filesystem::path> files = {file_};
  const auto watchThem = [&] { watch_.watch({files.begin(), files.end()}); };
  try {
    asset::SceneFile read = asset::readSceneFile(
        file_, {}, [&](const std::string& name, const auto&) { files.insert(folderOf(file_) / name); });
    watchThem();
    const scene::SceneData flat = scene::buildScene(read);
    boundsWorld_ = flat.boundsWorld;
    scene_ = std::move(read);
  } catch (...) {
    watchThem();
    throw;
  }
  for (std::unique_ptr<Side>& side : sides_)
    side.reset();
}

void Document::load() {
  wasLoaded_ = true;
  error_.clear();
  failedFor_ = {};
  try {
    read();
  } catch (const Error& error) {
    fail(error);
  } catch (const std::bad_alloc&) {
    fail(Error(ErrorCode::kLimit, "out of memory", file_));
  }
  loadPath();
}

void Document::loadPath() {
  if (!scene_) return;
  try {
    path_ = camera.path.empty() ? scene_->cameras : asset::readSceneFile(camera.path).cameras;
    if (path_.empty() && !camera.path.empty()) throw Error(ErrorCode::kUsage, "holds no camera", camera.path);
  } catch (const Error& error) {
    fail(error);
    camera.path.clear();
    path_ = scene_->cameras;
  }
  if (path_.empty() && (camera.frame || camera.freezeFrame))
    fail(Error(ErrorCode::kUsage, "the scene has no camera path, so it has no frames: the whole scene is in view",
               file_));
  const float last = pathFrames() > 0 ? static_cast<float>(pathFrames() - 1) : 0.0F;
  for (std::optional<float>* frame : {&camera.frame, &camera.freezeFrame}) {
    if (path_.empty()) frame->reset();
    if (*frame) *frame = std::min(**frame, last);
  }
}

Side* Document::prepare(int index, const RenderOptions& options) {
  std::unique_ptr<Side>& side = sides_[static_cast<std::size_t>(index)];
  if (!scene_) return nullptr;
  std::string& failedFor = failedFor_[static_cast<std::size_t>(index)];
  const std::string key = keyOf(options);
  if (failedFor == key) return side.get();
  const auto failed = [&](const Error& error) {
    fail(error);
    failedFor = key;
    if (side != nullptr && side->fits(options)) side.reset();  // half resized
    return side.get();
  };
  try {
    if (side == nullptr || !side->fits(options)) side = std::make_unique<Side>(*scene_, options);
    side->resize(options.width, options.height);
    forgetFailures(static_cast<std::size_t>(index));
  } catch (const Error& error) {
    return failed(error);
  } catch (const std::bad_alloc&) {
    return failed(Error(ErrorCode::kLimit, "out of memory", file_));
  }
  return side.get();
}

void Document::forgetFailures(std::size_t side) {
  if (failedFor_[side].empty()) return;
  failedFor_[side].clear();
  if (std::all_of(failedFor_.begin(), failedFor_.end(), [](const std::string& key) { return key.empty(); }))
    error_.clear();
}

std::string Document::rebuild(const RenderOptions (&options)[kSides]) {
  for (std::size_t i = 0; i < kSides; ++i)
    forgetFailures(i);
  try {
    std::array<std::unique_ptr<Side>, kSides> fresh;
    for (std::size_t i = 0; i < kSides; ++i)
      if (sides_[i] != nullptr && scene_) fresh[i] = std::make_unique<Side>(*scene_, options[i]);
    for (std::size_t i = 0; i < kSides; ++i)
      if (fresh[i] != nullptr) sides_[i] = std::move(fresh[i]);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace jalousie::app
