// How pointer and keys move the camera and the divider: drags, wheel, flying.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "app/view/cameras.h"
#include "app/view/documents.h"
#include "app/view/input.h"
#include "app/view/interface.h"
#include "app/view/messages.h"
#include "app/view/view_state.h"

namespace jalousie::app {

/// Follows the pointer from event to event. The caller keeps events from it that belong to the interface.
class Navigation {
 public:
  /// All arguments must outlive this. @param interface  its scale applies to distances of the pointer
  Navigation(ViewState& state, Documents& documents, Cameras& cameras, Messages& messages, const Interface& interface);

  /// A button went down: makes the document below the pointer current and begins a drag.
  void press(const InputEvent& event);
  /// A button went up: ends the drag. @return the pointer if it was a click with the left button
  std::optional<glm::vec2> release(const InputEvent& event);
  void moveTo(const glm::vec2& pointer);
  void endDrag() { drag_ = Drag::kNone; }
  /// Zooms, or changes the speed while flying. @param steps  of the wheel, positive away from the user
  void wheel(float steps, const Input& input);
  /// Flies while W A S D Q E are held. @param seconds  since the last call
  void fly(double seconds, const Input& input);

 private:
  enum class Drag { kNone, kTurn, kPan, kLook, kDivider };
  Drag dragFor(const InputEvent& event) const;
  void dragCamera(const glm::vec2& pixels);

  ViewState& state_;
  Documents& documents_;
  Cameras& cameras_;
  Messages& messages_;
  const Interface& interface_;
  Drag drag_ = Drag::kNone;
  glm::vec2 dragFrom_{0.0F};
  glm::vec2 pointer_{0.0F};
  bool dragged_ = false;  ///< the pointer moved too far for a click
};

}  // namespace jalousie::app
