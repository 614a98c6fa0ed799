// The windows of the interface: options, inspection, frame graph, help.
#pragma once

#include <string>
#include <vector>

#include "app/render_option_table.h"
#include "app/view/actions.h"
#include "app/view/view_state.h"

namespace jalousie::app {

/// What a frame of the interface asks for beside the state it changed itself.
struct PanelResult {
  bool configurationsChanged = false;  ///< some wanted configuration is another one
  bool camerasChanged = false;         ///< a document's cameras were set by hand
  bool layoutChanged = false;          ///< divider, flicker, split
  std::vector<Action> actions;         ///< buttons
  std::optional<glm::uvec2> resize;    ///< window size in pixels
  bool saveJson = false;
};

/// Facts the panel shows and cannot find in the state.
struct PanelFacts {
  std::string renderer;
  std::string command;  ///< of the current picture
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<const char*> documents;  ///< names
};

/// All options of `jalousie render`, with their units and effects as tooltips.
void drawPanel(ViewState& state, Document* document, const PanelFacts& facts, PanelResult& result);

/// One option of the table; greyed out with the reason where it does not apply. @return whether it changed
bool drawOption(const RenderOption& option, RenderOptions& options);

/// The selected object: where it is, what hides it, its spectrum, its levels and why one was chosen.
void drawInspection(const Inspection& inspection, const RenderOptions& options);

/// Time per pass, triangles, drawn and culled over the last seconds.
void drawFrameGraph(const FrameHistory& history);

/// Keys and pointer.
void drawHelp(bool* open);

}  // namespace jalousie::app
