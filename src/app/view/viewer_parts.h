// The parts of the viewer, in the order in which they depend on each other.
#pragma once

#include "app/view/cameras.h"
#include "app/view/documents.h"
#include "app/view/input.h"
#include "app/view/interface.h"
#include "app/view/messages.h"
#include "app/view/navigation.h"
#include "app/view/object_list.h"
#include "app/view/object_selection.h"
#include "app/view/outputs.h"
#include "app/view/path_player.h"
#include "app/view/pictures.h"
#include "app/view/recorder.h"
#include "app/view/redraw.h"
#include "app/view/view_options.h"
#include "app/view/view_state.h"
#include "platform/window.h"

namespace jalousie::app {

/// Owns the parts and gives each the earlier parts that it needs. Only the viewer and its actions see all of them.
struct ViewerParts {
  /// @param window, options  must outlive this   Errors: kShader if the programs of the interface do not build
  ViewerParts(platform::Window& window, const ViewOptions& options);
  ViewerParts(const ViewerParts&) = delete;
  ViewerParts& operator=(const ViewerParts&) = delete;

  platform::Window& window;
  ViewState state;
  Input input;  ///< before the interface, whose callbacks call those of the input
  Interface interface;
  Redraw redraw;
  Messages messages;
  Documents documents;
  Pictures pictures;
  ObjectSelection selection;
  ObjectList objects;
  Cameras cameras;
  Navigation navigation;
  PathPlayer player;
  Recorder recorder;
  Outputs outputs;
};

}  // namespace jalousie::app
