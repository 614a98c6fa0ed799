// State of the viewer: configurations, layout, selection, messages.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "app/render_options.h"
#include "app/view/document.h"
#include "app/view/frame_history.h"
#include "app/view/inspection.h"
#include "app/view/settings.h"

namespace jalousie::app {

/// One way to render. If the chosen options contradict each other, the last valid options stay active.
struct Configuration {
  RenderOptions wanted;  ///< as chosen; cameras, file and size come from the documents
  RenderOptions active;  ///< the last valid options, finished
  std::string refusal;   ///< why wanted is not active; empty if it is

  /// Resets options of wanted that no longer apply and makes the rest active. @return whether active changed
  bool update();
  /// Sets an option to its next value, in the order of the option table, that is valid with the other options.
  /// @param option  "--view", a choice   @param step  1 or -1   @return label and value, for a message
  std::string cycle(const char* option, int step);
};

/// An object of one document.
struct Selection {
  std::size_t document = 0;
  int side = 0;
  std::uint32_t object = 0;    ///< index into SceneData::objects
  std::uint32_t instance = 0;  ///< its number in the file, by which it is found again when the scene is built anew
};

/// Shared by all parts of the viewer. Plain data: whoever changes it tells Redraw.
struct ViewState {
  std::array<Configuration, Document::kSides> configurations;
  bool split = false;           ///< configuration B is shown right of the divider
  float divider = 0.5F;         ///< position of the divider, share of the width of each document
  bool flicker = false;         ///< A and B are shown in turn; takes precedence over split
  float flickerSeconds = 0.5F;  ///< how long each is shown
  int flickerSide = 0;          ///< configuration that is shown now with flicker
  bool help = false;            ///< the window of keys is open
  bool linked = true;           ///< documents with like scenes share a camera
  bool playing = false;         ///< camera paths are played
  bool recording = false;       ///< a camera path is recorded
  float freeLeft = 0.0F;        ///< right edge of the panel, pixels; 0 where it is closed or elsewhere
  float coveredRight = 0.0F;    ///< columns at the right edge of the window under the window of the object, pixels
  std::size_t current = 0;      ///< document that keys and panel act on
  std::optional<Selection> selection;
  std::optional<Inspection> inspection;  ///< of the selection, once the scenes have settled
  ViewSettings settings;
  FrameHistory history;           ///< of the current document under configuration A
  std::string message;            ///< shown for a few seconds
  double messageSeconds = 0.0;    ///< when the message was said, as secondsNow()
  std::string shaderError;        ///< empty if all shaders build
  std::filesystem::path outputs;  ///< folder of screenshots, figures and paths; empty: the current folder

  /// Number of configurations in use: A, or A and B.
  int sides() const { return split || flicker ? Document::kSides : 1; }
  /// Whether A is shown left and B right of a divider.
  bool showsDivider() const { return split && !flicker; }
  /// Configuration shown left of the divider, or everywhere.
  int firstSide() const { return flicker ? flickerSide : 0; }
};

}  // namespace jalousie::app
