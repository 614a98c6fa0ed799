// Pictures of all open documents under the configurations in use, composed for the window.
#pragma once

#include <cstdint>

#include "app/view/canvas.h"
#include "app/view/documents.h"
#include "app/view/redraw.h"
#include "app/view/view_state.h"
#include "core/image.h"
#include "gl/capabilities.h"

namespace jalousie::app {

/// Renders documents and copies their pictures side by side into a canvas of the window's size.
class Pictures {
 public:
  /// All arguments must outlive this. @param state  gets the history of frames and the side that flicker shows
  Pictures(const gl::Capabilities& capabilities, ViewState& state, Documents& documents, Redraw& redraw);

  /// Size of the window's framebuffer, in pixels, both > 0.
  void resize(std::uint32_t width, std::uint32_t height);
  /// Renders every document under every configuration in use and adds the frame to the history.
  void render();
  /// With flicker, chooses the configuration that is shown now.
  void flicker();
  /// Copies the pictures rendered last into the canvas.
  void compose();
  /// Renders every picture as from a fresh start and composes them, without the interface. Waits for the GPU.
  /// Errors: kUsage while the window is minimised, and as renderCameras.
  ImageRgba8 capture();
  /// The history starts anew with the next frame.
  void forgetHistory();
  const Canvas& canvas() const { return canvas_; }

 private:
  void renderDocument(std::size_t index);
  void composeDocument(std::size_t index);

  const gl::Capabilities& capabilities_;
  ViewState& state_;
  Documents& documents_;
  Redraw& redraw_;
  Canvas canvas_;
  const Document* historyOf_ = nullptr;  ///< the document that the history is of
};

}  // namespace jalousie::app
