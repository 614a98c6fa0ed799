// What the viewer gives away: screenshots, figures, and the command line of the picture.
#pragma once

#include <filesystem>
#include <string>

#include "app/view/documents.h"
#include "app/view/messages.h"
#include "app/view/pictures.h"
#include "app/view/view_state.h"
#include "core/image.h"
#include "platform/window.h"

namespace jalousie::app {

/// Files go to ViewState::outputs. Failures become messages, except where a function has errors.
class Outputs {
 public:
  /// All arguments must outlive this.
  Outputs(platform::Window& window, ViewState& state, Documents& documents, Pictures& pictures, Messages& messages);

  /// `jalousie render ...` for the picture of one configuration of the current document; empty if none is open.
  /// @param absolute  writes absolute paths, so that the command works in any folder
  std::string command(int side, const std::string& output, bool absolute) const;
  /// Copies the command of configuration A to the clipboard.
  void copyCommand();

  /// Writes the picture as `jalousie render` does. Waits for the GPU.
  void screenshot();
  /// Asks for a screenshot with the interface, which windowDrawn() writes.
  void requestWindowScreenshot() { wantsWindow_ = true; }
  /// The interface of this frame is drawn.
  void windowDrawn();
  /// The window as it was last shown. Waits for the GPU.
  ImageRgba8 window() const { return pictures_.canvas().read(); }

  /// Writes the history of frames as JSON to the file of --json, else to a new file.
  void saveFigures();
  /// Writes the history of frames as CSV to a new file.
  void saveFrames();
  /// @param file  "-": standard output   Errors: kWriteFailed
  void writeFigures(const std::filesystem::path& file) const;

 private:
  void savePicture(const ImageRgba8& picture);

  platform::Window& window_;
  ViewState& state_;
  Documents& documents_;
  Pictures& pictures_;
  Messages& messages_;
  bool wantsWindow_ = false;
};

}  // namespace jalousie::app
