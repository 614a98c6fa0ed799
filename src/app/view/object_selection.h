// The selected object: picked by a click or named by an option, and inspected when the scenes have settled.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "app/view/documents.h"
#include "app/view/messages.h"
#include "app/view/redraw.h"
#include "app/view/view_state.h"

namespace jalousie::app {

/// Sets ViewState::selection and ViewState::inspection.
class ObjectSelection {
 public:
  /// All arguments must outlive this.
  ObjectSelection(ViewState& state, Documents& documents, Redraw& redraw, Messages& messages);

  /// Selects the object drawn at a pixel, nothing where there is none. Waits for the GPU. @param at  window, pixels
  void pick(const glm::vec2& at);
  /// Selects an instance of a document under configuration A, counted in the file's order. Fails with a message where
  /// there is no such object.
  void select(std::size_t document, std::uint32_t instance);
  void clear();
  /// Inspects the selected object in the frame rendered last, and renders this frame again. Waits for the GPU.
  void inspect();
  /// Moves the selection to configuration A while B is not shown.
  void leaveHiddenSide();

 private:
  ViewState& state_;
  Documents& documents_;
  Redraw& redraw_;
  Messages& messages_;
};

}  // namespace jalousie::app
