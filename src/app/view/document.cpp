// One open file: loading, camera path, renderers.
#include "app/view/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <set>

#include "app/command_memory.h"
#include "app/path_camera.h"
#include "app/render_cameras.h"
#include "app/render_option_table.h"
#include "app/shown_objects.h"
#include "app/warnings.h"
#include "asset/image_io.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::app {
namespace {

/// The options that a renderer is made for, apart from its size. Renderers with equal texts are interchangeable.
std::string keyOf(const RenderOptions& options) {
  return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}", valueText(renderOption("--cells"), options),
                     rowOf(options.frameOptions.detail).patches, options.frameOptions.faceCulling != FaceCulling::kOff,
                     static_cast<unsigned>(options.rendererOptions.submission), options.coreOnly,
                     options.rendererOptions.capacity.value_or(0), options.importance.string(), options.hide,
                     options.only);
}

/// Runs a task; its failure becomes a value. @param file  named in a failure that is about a limit
std::optional<Error> failureOf(const std::function<void()>& task, const std::filesystem::path& file) {
  try {
    task();
    return std::nullopt;
  } catch (const Error& error) {
    return error.file().empty() && error.code() == ErrorCode::kLimit ? Error(error.code(), error.what(), file) : error;
  } catch (const std::bad_alloc&) {
    return Error(ErrorCode::kLimit, "out of memory", file);
  }
}

}  // namespace

Side::Side(const asset::SceneFile& file, const RenderOptions& options, const MemoryLimit& memory)
    : scene_(scene::buildScene(file, buildOptionsOf(file, options))),
      rendererOptions_(options.rendererOptions),
      madeFor_(keyOf(options)) {
  if (!options.importance.empty()) importance_.emplace(asset::loadImage(options.importance));
  rendererOptions_.importance = importance_ ? &*importance_ : nullptr;
  rendererOptions_.memory = memory;
  renderer_.emplace(scene_, options.width, options.height, rendererOptions_);
}

bool Side::fits(const RenderOptions& options) const {
  return madeFor_ == keyOf(options);
}

void Side::resize(std::uint32_t width, std::uint32_t height) {
  if (renderer_->width() != width || renderer_->height() != height) renderer_->resize(width, height);
}

CameraChoice CameraChoice::of(const RenderOptions& options) {
  CameraChoice choice;
  choice.path = options.path;
  choice.camera = options.camera;
  choice.time = options.time;
  choice.frame = options.frame;
  choice.sceneFrame = options.frame.value_or(0.0F);
  choice.freezeFrame = options.freezeFrame;
  if (options.eye && options.look) choice.pose = WorldPose{*options.eye, *options.look};
  if (options.freezeEye && options.freezeLook) choice.freezePose = WorldPose{*options.freezeEye, *options.freezeLook};
  return choice;
}

void CameraChoice::applyTo(RenderOptions& options) const {
  options.path = path;
  options.camera = pose ? std::string() : camera;
  options.time = time;
  options.frame = frame;
  options.frameOptions.seconds = scene::secondsAt(sceneFrame);
  options.freezeFrame = freezeFrame;
  options.eye = pose ? std::optional(pose->eye) : std::nullopt;
  options.look = pose ? std::optional(pose->look) : std::nullopt;
  options.freezeEye = freezePose ? std::optional(freezePose->eye) : std::nullopt;
  options.freezeLook = freezePose ? std::optional(freezePose->look) : std::nullopt;
}

Document::Document(std::filesystem::path file, const CameraChoice& choice, const MemoryLimit& memory)
    : camera(choice), file_(std::move(file)), memory_(memory), watch_(file_) {}

void Document::read() {
  std::set<std::filesystem::path> files = {file_};
  const auto watchThem = [&] { watch_.watch({files.begin(), files.end()}); };
  try {
    asset::SceneFile read =
        readWithin(file_, memory_, [](const asset::SceneSize& size) { return viewNeeds(size, RenderOptions{}); },
                   {.observer = [&](const std::string& name, const auto&) { files.insert(folderOf(file_) / name); },
                    .seconds = camera.time,
                    .plays = !camera.time});
    watchThem();
    warnIgnored(file_, read.ignored);
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

std::size_t Document::worst() const {
  for (std::size_t i = 0; i < failures_.size(); ++i)
    if (!failures_[i].text.empty()) return i;
  return kFile;
}

void Document::load() {
  const bool first = !wasLoaded_;
  wasLoaded_ = true;
  failures_ = {};
  failedFor_ = {};
  if (const auto failure = failureOf([&] { read(); }, file_)) fail(kFile, *failure);
  loadPath(first);
}

void Document::keepFrozenCamera() {
  if (!camera.freezeFrame || path_.empty()) return;
  const scene::Camera frozen = scene::cameraAtFrame(path_.front(), *camera.freezeFrame);
  const Pose pose = poseOf(frozen, targetDistance(frozen, boundsWorld_));
  if (!isUsable(pose)) return;
  camera.freezePose = inWorld(pose, originWorld());
  camera.freezeFrame.reset();
}

void Document::loadPath(bool refusesFrames) {
  if (!scene_) return;
  failures_[kPath] = {};
  try {
    path_ = camera.path.empty() ? scene_->cameras : pathFromFile(camera.path, memory_, scene_->originWorld);
    path_ = chosenFirst(std::move(path_), camera.camera, camera.path.empty() ? file_ : camera.path);
  } catch (const Error& error) {
    fail(kPath, error);
    camera.path.clear();
    camera.camera.clear();
    path_ = scene_->cameras;
  }
  if (pathFrames() == 0 && (camera.frame || camera.freezeFrame))
    fail(kPath,
         Error(ErrorCode::kUsage,
               "the scene has no camera path, so no frame of it can be shown; the whole scene is in view", file_));
  const float last = pathFrames() > 0 ? static_cast<float>(pathFrames() - 1) : 0.0F;
  for (std::optional<float>* frame : {&camera.frame, &camera.freezeFrame}) {
    if (pathFrames() == 0) frame->reset();
    if (!*frame || **frame <= last) continue;
    if (refusesFrames)
      fail(kPath,
           Error(ErrorCode::kUsage, fmt::format("frame {} is beyond the camera path (0..{})", **frame, last), file_));
    *frame = last;
  }
  camera.sceneFrame = std::min(camera.frame.value_or(camera.sceneFrame), last);
}

std::uint32_t Document::pathFrames() const {
  if (path_.empty() && !isAnimated()) return 0;
  return app::pathFrames(path_, scene_ ? scene_->motion.lastKey : 0.0F);
}

void Document::showFrame(float frame) {
  camera.sceneFrame = frame;
  if (camera.pose && isAnimated()) return;
  camera.frame = frame;
  camera.pose.reset();
}

Side* Document::prepare(int index, const RenderOptions& options) {
  const auto i = static_cast<std::size_t>(index);
  std::unique_ptr<Side>& side = sides_[i];
  if (!scene_) return nullptr;
  const std::string key = fmt::format("{}x{}|{}", options.width, options.height, keyOf(options));
  const auto ready = [&]() -> Side* {
    if (side == nullptr) return nullptr;
    const std::optional<Error> failure = failureOf([&] { side->renderer().prepare(options.frameOptions); }, file_);
    if (failure) fail(kSide + i, *failure);
    return failure ? nullptr : side.get();
  };
  if (failedFor_[i] == key) return ready();
  const auto attempt = [&](const std::function<void()>& task) {
    const std::optional<Error> failure = failureOf(task, file_);
    if (!failure) return true;
    fail(kSide + i, *failure);
    failedFor_[i] = key;
    return false;
  };
  const bool made = (side != nullptr && side->fits(options)) ||
                    attempt([&] { side = std::make_unique<Side>(*scene_, options, memory_); });
  // An older renderer stays in use and is resized too. If that fails, it is in an undefined state and is removed.
  if (side != nullptr && !attempt([&] { side->resize(options.width, options.height); }))
    side.reset();
  else if (made)
    forgetFailure(i);
  return ready();
}

void Document::forgetFailure(std::size_t side) {
  failedFor_[side].clear();
  failures_[kSide + side] = {};
}

std::string Document::rebuild(const RenderOptions (&options)[kSides]) {
  for (std::size_t i = 0; i < kSides; ++i)
    forgetFailure(i);
  std::array<std::unique_ptr<Side>, kSides> fresh;
  const auto build = [&] {
    for (std::size_t i = 0; i < kSides; ++i)
      if (sides_[i] != nullptr && scene_ && sides_[i]->fits(options[i]))
        fresh[i] = std::make_unique<Side>(*scene_, options[i], memory_);
  };
  if (const auto failure = failureOf(build, file_)) return failure->what();
  for (std::size_t i = 0; i < kSides; ++i)
    if (fresh[i] != nullptr) sides_[i] = std::move(fresh[i]);
  return {};
}

}  // namespace jalousie::app
