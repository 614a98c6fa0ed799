// One open file: its scene on the GPU under one or two configurations, and its failures.
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
#include "render/frame_renderer.h"
#include "visibility/importance_mask.h"

namespace jalousie::app {

/// A scene with the renderer of one configuration. Not movable: the renderer refers to the scene.
class Side {
 public:
  /// Errors: as FrameRenderer and loadImage.
  /// @param memory  limit on the renderer
  Side(const asset::SceneFile& file, const RenderOptions& options, const MemoryLimit& memory);
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;

  /// Whether these options need no other renderer, apart from its size.
  bool fits(const RenderOptions& options) const;
  const scene::SceneData& scene() const { return scene_; }
  render::FrameRenderer& renderer() { return *renderer_; }
  /// Changes the size of the picture, pixels; does nothing if it has that size.
  void resize(std::uint32_t width, std::uint32_t height);

 private:
  scene::SceneData scene_;
  std::optional<visibility::ImportanceMask> importance_;
  render::RendererOptions rendererOptions_;
  std::string madeFor_;
  std::optional<render::FrameRenderer> renderer_;
};

/// Cameras of a document, as the options of `jalousie render` name them.
struct CameraChoice {
  std::filesystem::path path;
  std::string camera;          ///< name or number; empty: the first one
  std::optional<double> time;  ///< of the scene's animations, seconds
  std::optional<float> frame;
  float sceneFrame = 0.0F;  ///< time of the animations, frames of the path; `frame`, where that is set
  std::optional<WorldPose> pose;
  std::optional<float> freezeFrame;
  std::optional<WorldPose> freezePose;

  bool frozen() const { return freezeFrame || freezePose; }
  static CameraChoice of(const RenderOptions& options);
  void applyTo(RenderOptions& options) const;
};

/// An open file. Failures are stored, not thrown; what was loaded before stays in use.
class Document {
 public:
  static constexpr int kSides = 2;

  /// Reads nothing yet: see load().
  /// @param memory  limit on the file with one configuration
  Document(std::filesystem::path file, const CameraChoice& camera, const MemoryLimit& memory);

  const std::filesystem::path& file() const { return file_; }
  /// Reads the file. After a failure, the scene loaded before stays.
  void load();
  /// Whether load() was called.
  bool wasLoaded() const { return wasLoaded_; }
  /// FileWatch::changed() of the file and of all files that it names.
  bool changedOnDisk() { return watch_.changed(); }
  /// Turns a culling camera frozen at a frame of the path into one frozen at its pose, because the path will change.
  void keepFrozenCamera();
  /// Reads the camera path of camera.path, else that of the scene. Frames beyond the path become its last frame.
  /// @param refusesFrames  records such a frame as a failure, because the user asked for it
  void loadPath(bool refusesFrames = false);

  /// Makes the renderer of one configuration if there is none that fits. A combination that failed is not tried again
  /// until options or file change. @return null if there is no renderer, not even an older one; see error()
  /// @param options  finished, with the size of the picture
  Side* prepare(int side, const RenderOptions& options);
  /// What prepare() returned last; null before.
  Side* side(int side) { return sides_[static_cast<std::size_t>(side)].get(); }
  /// Builds all programs again after a change of the shaders. After a failure, the last working programs stay in use.
  /// @return the failure; empty if there was none
  std::string rebuild(const RenderOptions (&options)[kSides]);

  /// First failure of the file, its path, or a configuration; empty if there is none.
  const std::string& error() const { return failures_[worst()].text; }
  ErrorCode errorCode() const { return failures_[worst()].code; }
  /// Forgets the failure of a configuration, so that prepare() tries it again.
  void forgetFailure(std::size_t side);
  const std::vector<asset::Camera>& path() const { return path_; }
  /// Bounds of the scene; known as soon as the file is loaded.
  Aabb boundsWorld() const { return boundsWorld_; }
  /// Point of the file's world that boxes and cameras are relative to; poses are not.
  glm::dvec3 originWorld() const { return scene_ ? scene_->originWorld : glm::dvec3(0.0); }
  /// The file as it was read; null before, and while it cannot be read.
  const asset::SceneFile* sceneFile() const { return scene_ ? &*scene_ : nullptr; }
  /// Whether the scene has animations that play.
  bool isAnimated() const { return scene_ && !scene_->motion.empty(); }
  /// Whether the camera of the path moves.
  bool hasMovingCamera() const { return !path_.empty() && scene::frameCount(path_.front()) > 1; }
  /// Frames of the first camera path and of the animations; 0 if there is neither.
  std::uint32_t pathFrames() const;
  /// Shows a frame of both. The camera stays where the user has put it if animations play.
  void showFrame(float frame);

  CameraChoice camera;

 private:
  struct Failure {
    std::string text;
    ErrorCode code = ErrorCode::kInternal;
  };
  static constexpr std::size_t kFile = 0;
  static constexpr std::size_t kPath = 1;
  static constexpr std::size_t kSide = 2;  ///< first of kSides entries, one per configuration
  void fail(std::size_t what, const Error& error) { failures_[what] = {error.what(), error.code()}; }
  std::size_t worst() const;
  void read();

  std::filesystem::path file_;
  MemoryLimit memory_;
  FileWatch watch_;
  bool wasLoaded_ = false;
  std::optional<asset::SceneFile> scene_;
  Aabb boundsWorld_;
  std::vector<asset::Camera> path_;
  std::array<std::unique_ptr<Side>, kSides> sides_;
  std::array<Failure, kSide + kSides> failures_;
  std::array<std::string, kSides> failedFor_;  ///< options and size for which prepare() failed
};

}  // namespace jalousie::app
