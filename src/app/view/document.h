// One open file: its scene on the GPU under one or two configurations, and what went wrong with it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/capture.h"
#include "app/view/file_watch.h"
#include "app/view/pose.h"
#include "asset/scene_file.h"
#include "core/error.h"
#include "gl/capabilities.h"

namespace jalousie::app {

/// The scene under one configuration. Not movable: the renderer refers to the scene.
class Side {
 public:
  /// Errors: as FrameRenderer and loadImage.
  Side(const asset::SceneFile& file, const RenderOptions& options);
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;

  /// Whether a renderer made for these options would be the same, its size aside.
  bool fits(const RenderOptions& options) const;
  const scene::SceneData& scene() const { return scene_; }
  render::FrameRenderer& renderer() { return *renderer_; }
  /// Size in pixels; does nothing if it is that already.
  void resize(std::uint32_t width, std::uint32_t height);

 private:
  scene::SceneData scene_;
  std::optional<visibility::ImportanceMask> importance_;
  render::RendererOptions rendererOptions_;
  std::string madeFor_;
  std::optional<render::FrameRenderer> renderer_;
};

/// Cameras as the options of `jalousie render` say them.
struct CameraChoice {
  std::filesystem::path path;
  std::optional<float> frame;
  std::optional<Pose> pose;
  std::optional<float> freezeFrame;
  std::optional<Pose> freezePose;

  bool frozen() const { return freezeFrame || freezePose; }
  static CameraChoice of(const RenderOptions& options);
  void applyTo(RenderOptions& options) const;
};

/// A file in the window. Every failure becomes a message, and what worked before goes on.
class Document {
 public:
  static constexpr int kSides = 2;

  /// Reads nothing yet.
  Document(std::filesystem::path file, const CameraChoice& camera);

  const std::filesystem::path& file() const { return file_; }
  /// Reads the file. On failure the scene that was there stays.
  void load();
  /// Whether load() was called.
  bool wasLoaded() const { return wasLoaded_; }
  /// As FileWatch::changed of the file and of what it names.
  bool changedOnDisk() { return watch_.changed(); }
  /// A culling camera that is frozen at a frame stays where it is when the path becomes another one.
  void keepFrozenCamera();
  /// Reads the camera path of camera.path, or the scene's own; frames beyond it become its last.
  /// @param refusesFrames  such a frame is an error, as it was asked for
  void loadPath(bool refusesFrames = false);

  /// One configuration, made if it is not there. Null if that failed; the reason is in error().
  /// @param options  finished, with the size of this picture
  Side* prepare(int side, const RenderOptions& options);
  /// What prepare() returned last; null where there is nothing.
  Side* side(int side) { return sides_[static_cast<std::size_t>(side)].get(); }
  /// Builds all programs anew, for changed shaders. On failure the last good ones go on. @return the error, or empty
  std::string rebuild(const RenderOptions (&options)[kSides]);

  /// What is wrong: with the file, its path, a configuration; empty: all is well.
  const std::string& error() const { return failures_[worst()].text; }
  ErrorCode errorCode() const { return failures_[worst()].code; }
  /// A configuration that is not shown has nothing to complain of, and is tried again when it is.
  void forgetFailure(std::size_t side);
  const std::vector<asset::Camera>& path() const { return path_; }
  /// Bounds of the scene, also before a renderer exists.
  Aabb boundsWorld() const { return boundsWorld_; }
  std::uint32_t pathFrames() const { return path_.empty() ? 0 : scene::frameCount(path_.front()); }

  CameraChoice camera;

 private:
  struct Failure {
    std::string text;
    ErrorCode code = ErrorCode::kInternal;
  };
  static constexpr std::size_t kFile = 0;
  static constexpr std::size_t kPath = 1;
  static constexpr std::size_t kSide = 2;  ///< the first of two
  void fail(std::size_t what, const Error& error) { failures_[what] = {error.what(), error.code()}; }
  std::size_t worst() const;
  void read();

  std::filesystem::path file_;
  FileWatch watch_;
  bool wasLoaded_ = false;
  std::optional<asset::SceneFile> scene_;
  Aabb boundsWorld_;
  std::vector<asset::Camera> path_;
  std::array<std::unique_ptr<Side>, kSides> sides_;
  std::array<Failure, kSide + kSides> failures_;
  std::array<std::string, kSides> failedFor_;  ///< what prepare() failed for: not tried again in every frame
};

}  // namespace jalousie::app
