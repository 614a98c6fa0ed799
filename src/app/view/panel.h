// The panel: every option of the picture, and the tools of the viewer.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/render_option_table.h"
#include "app/view/actions.h"
#include "app/view/object_window.h"
#include "app/view/path_window.h"
#include "app/view/view_state.h"

namespace jalousie::app {

/// What the user asked for in this frame of the panel, beside the state that the panel changed itself.
struct PanelResult {
  bool configurationsChanged = false;  ///< Configuration::wanted of some configuration changed
  bool camerasChanged = false;         ///< cameras of the document changed
  bool layoutChanged = false;          ///< divider, flicker or split changed
  std::vector<Action> actions;         ///< buttons that were pressed
  std::optional<glm::uvec2> resize;    ///< new window size in pixels
  bool saveFigures = false;            ///< write the history of frames
  std::filesystem::path open;          ///< a file or folder to open; empty: none
  PathWindowResult path;               ///< of the frame slider
  ObjectWindowResult objects;          ///< of the list of objects
};

/// What the panel shows and the state does not hold.
struct PanelFacts {
  std::string renderer;  ///< name that OpenGL gives
  std::string command;   ///< `jalousie render` command of the current picture
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::string> documents;  ///< names of the files
};

/// Draws all options of `jalousie render`, with units and effects as tooltips, and the viewer's own widgets.
/// @param document  the current one; null if none is open
void drawPanel(ViewState& state, Document* document, const PanelFacts& facts, PanelResult& result);

/// Draws one option of the table; disabled, with the reason in the tooltip, where it does not apply.
/// @return whether its value changed
bool drawOption(const RenderOption& option, RenderOptions& options);

}  // namespace jalousie::app
