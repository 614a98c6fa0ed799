// The viewer: files in a window, frame by frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/view/canvas.h"
#include "app/view/input.h"
#include "app/view/interface.h"
#include "app/view/panel.h"
#include "app/view/region.h"
#include "app/view/view_options.h"
#include "app/view/view_state.h"
#include "asset/scene_file.h"
#include "core/error.h"
#include "platform/window.h"

namespace jalousie::app {

/// Shows files in a window until it is closed. Scenes are rendered when something changed, and until their visible set
/// and levels have settled; then the window waits for events.
class Viewer {
 public:
  /// Opens the files; what fails to open says so in the window. @param options  finished
  /// Errors: kShader if the programs of the interface do not build.
  Viewer(platform::Window& window, const ViewOptions& options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Events, scenes, interface, once. Waits for events, at most a tenth of a second, where nothing is to be done.
  void step();
  /// The window is closed, or the frames asked for are done.
  bool done() const;
  /// Nothing moves, everything is loaded and has settled.
  bool idle() const { return dirtyFrames_ == 0 && !state_.playing && !state_.recording && !inspectSoon_ && !loading(); }

  const ViewState& state() const { return state_; }
  std::size_t documentCount() const { return documents_.size(); }
  Document& document(std::size_t index) { return *documents_[index]; }
  /// Where a document's picture is in the window.
  Region region(std::size_t document) const;
  /// `jalousie render ...` for the picture of one configuration of the current document.
  /// @param absolute  paths that hold in any folder
  std::string command(int side, const std::string& output = "frame.png", bool absolute = false) const;
  /// Renders every picture as from a fresh start and puts them together, without interface. Waits for the GPU.
  ImageRgba8 capture();
  /// The window as it was last shown. Waits for the GPU.
  ImageRgba8 captureWithInterface() const { return canvas_.read(); }
  /// Writes what the options ask for at the end, and the settings. Errors: kWriteFailed.
  void finish();

 private:
  // viewer.cpp
  void layOut();
  void renderScenes();
  void renderDocument(std::size_t index);
  void compose();
  void inspect();
  void drawInterface();
  void drawOverlays(std::size_t index);
  void applyPanel(const PanelResult& result);
  void showTitle();
  /// Cameras of a picture; nothing, and why in the message, where none can stand.
  std::optional<RenderCameras> camerasFor(std::size_t document, int side);
  RenderOptions optionsFor(std::size_t document, int side) const;
  double now() const;
  Document* current() { return state_.current < documents_.size() ? documents_[state_.current].get() : nullptr; }

  // viewer_input.cpp
  void handleEvents();
  void handleKey(const InputEvent& event);
  void handleButton(const InputEvent& event);
  void handleMove(const InputEvent& event);
  void handleWheel(const InputEvent& event);
  void flyByKeys(double seconds);
  void act(Action action);
  void pick(const glm::vec2& at);
  void select(std::size_t document, int side, std::uint32_t object);
  void movePose(const Pose& pose);
  /// Whether a document's camera is that of another.
  bool follows(std::size_t document, std::size_t leader) const;
  Pose currentPose();
  scene::Camera cameraOf(std::size_t document);
  void useBookmark(std::size_t number, bool set);
  void cycle(const char* option, int step);
  void freezeOrThaw();

  // viewer_files.cpp
  void open(const std::filesystem::path& file);
  bool loading() const;
  /// Reads one file that was opened and not read yet.
  void loadNext();
  void closeCurrent();
  void watchFiles();
  void playPath(double seconds);
  void recordPose();
  std::size_t recordedIndex() const;
  void stopRecording();
  void saveRecording();
  void keepSettings();
  /// Does something that may fail; then it says why, and the window lives on.
  void attempt(const std::function<void()>& task);
  void screenshot(bool withInterface);
  void writeJson(const std::filesystem::path& file) const;
  std::filesystem::path freshOutput(const char* stem, const char* extension) const;
  void say(const std::string& message);

  /// Something that changes pictures happened: render until they have settled again.
  void touch();

  platform::Window& window_;
  ViewOptions options_;
  ViewState state_;
  Input input_;
  Interface interface_;
  Canvas canvas_;
  std::vector<std::unique_ptr<Document>> documents_;
  std::vector<CameraChoice> starts_;  ///< cameras of the start, by document
  FileWatch shaderWatch_;
  std::filesystem::path settingsFolder_;
  std::string title_;
  const Document* charted_ = nullptr;  ///< whose frames the history holds

  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint32_t framesDone_ = 0;
  std::uint32_t dirtyFrames_ = 0;  ///< frames still to be rendered
  std::uint32_t wakeFrames_ = 3;   ///< frames of the interface still to be drawn without waiting
  bool inspectSoon_ = false;       ///< when everything has settled
  bool screenshotSoon_ = false;    ///< with the interface, when it is drawn
  bool quit_ = false;
  double lastStep_ = 0.0;
  double lastWatch_ = 0.0;
  double pathSeconds_ = 0.0;
  double pathStart_ = 0.0;
  double recordStart_ = 0.0;
  asset::CameraTrack recorded_;
  const Document* recordsFrom_ = nullptr;  ///< whose camera is recorded
  std::vector<Error> failures_;            ///< what a script asked for and did not get

  enum class Drag { kNone, kTurn, kPan, kLook, kDivider };
  Drag drag_ = Drag::kNone;
  glm::vec2 dragFrom_{0.0F};
  glm::vec2 pointer_{0.0F};
  bool dragged_ = false;  ///< far enough not to be a click
};

}  // namespace jalousie::app
