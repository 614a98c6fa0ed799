// What the window shows and how: configurations, layout, selection, messages.
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

/// One way to render. What the user asks for may contradict itself; then the last one that did not goes on.
struct Configuration {
  RenderOptions wanted;  ///< as said; cameras, file and size are the documents'
  RenderOptions active;  ///< finished
  std::string refusal;   ///< why wanted is not active; empty: it is

  /// Drops what no longer applies and resolves the rest. @return whether active changed
  bool update();
};

/// An object of one document.
struct Selection {
  std::size_t document = 0;
  int side = 0;
  std::uint32_t object = 0;
};

struct ViewState {
  std::array<Configuration, Document::kSides> configurations;
  bool split = false;
  float divider = 0.5F;  ///< share of the width
  bool flicker = false;
  float flickerSeconds = 0.5F;
  int flickerSide = 0;  ///< shown while flickering
  /// Configurations in use: the first, or both.
  int sides() const { return split || flicker ? Document::kSides : 1; }
  bool help = false;
  bool linked = true;  ///< cameras of several documents move together
  bool playing = false;
  bool recording = false;
  std::size_t current = 0;  ///< document that keys and panel act on
  std::optional<Selection> selection;
  std::optional<Inspection> inspection;
  ViewSettings settings;
  FrameHistory history;         ///< of the current document's first configuration
  std::string message;          ///< what happened last, for a few seconds
  double messageSeconds = 0.0;  ///< when it came
  std::string shaderError;      ///< empty: all shaders build
  std::filesystem::path outputs;
};

}  // namespace jalousie::app
