// The viewer: files in a window, frame by frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/view/panel.h"
#include "app/view/view_options.h"
#include "app/view/viewer_parts.h"
#include "platform/window.h"

namespace jalousie::app {

/// Shows files in a window until it is closed. Scenes are rendered after a change until their visible sets and LODs
/// have settled; then the viewer waits for events.
class Viewer {
 public:
  /// Opens the files; a file that cannot be opened is reported in the window. @param options  finished
  /// Errors: kShader if the programs of the interface do not build.
  Viewer(platform::Window& window, const ViewOptions& options);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Handles events, renders, and draws the interface, once. Waits for events, at most 0.1 s, if nothing is to be done.
  void step();
  /// Whether the window is closed, or a script has shown its number of frames.
  bool done() const;
  /// Whether nothing moves and everything is loaded and has settled.
  bool idle() const;

  const ViewState& state() const { return parts_.state; }
  const ObjectTable& objects() const { return parts_.objects.table(); }
  /// The rows of the window of objects.
  const ObjectRows& objectRows() const { return objectRows_; }
  std::size_t documentCount() const { return parts_.documents.size(); }
  Document& document(std::size_t index) { return parts_.documents[index]; }
  /// Where a document's picture is in the window.
  Region region(std::size_t document) const { return parts_.documents.region(document); }
  /// `jalousie render ...` for the picture of one configuration of the current document.
  std::string command(int side, const std::string& output = "frame.png") const {
    return parts_.outputs.command(side, output, /*absolute=*/false);
  }
  /// Renders every picture as from a fresh start and composes them, without the interface. Waits for the GPU.
  ImageRgba8 capture() { return parts_.pictures.capture(); }
  /// The window as it was last shown. Waits for the GPU.
  ImageRgba8 captureWithInterface() const { return parts_.outputs.window(); }
  /// Writes what the options ask for at the end, and the settings.
  /// Errors: kWriteFailed; in a script also the first thing that was asked for and failed.
  void finish();

 private:
  void handleEvents();
  void handleEvent(const InputEvent& event);
  void handleKey(const InputEvent& event);
  void renderScenes();
  void inspect();
  void drawInterface();
  void drawPictureOverlays();
  PanelResult drawWindows();
  void applyPanel(const PanelResult& result);
  void applyObjects(const ObjectWindowResult& result);
  void showTitle();
  void loadNext();
  void keepSettings();
  bool isScript() const { return options_.frames.has_value(); }

  const ViewOptions options_;
  ViewerParts parts_;
  std::optional<std::uint32_t> select_;  ///< --select, until the first document is loaded
  ObjectRows objectRows_;
  bool framesSelection_ = false;  ///< fit the view to the selected object once it has been inspected
  std::string title_;
  std::uint32_t width_ = 0;  ///< framebuffer, pixels
  std::uint32_t height_ = 0;
  std::uint32_t framesDone_ = 0;
  double lastStep_ = 0.0;  ///< seconds
};

}  // namespace jalousie::app
