// Construction of the parts, and the state at the start.
#include "app/view/viewer_parts.h"

namespace jalousie::app {
namespace {

/// State that the options ask for. A script ignores the settings, so that it depends on its options alone.
ViewState startState(const ViewOptions& options) {
  ViewState state;
  if (!options.frames) state.settings = loadSettings(settingsFolder());
  state.settings.objects = state.settings.objects || options.list;
  state.outputs = options.outputs;
  state.divider = options.divider;
  state.playing = options.play;
  state.split = options.split.has_value();
  for (Configuration& configuration : state.configurations)
    configuration.wanted = options.render;
  if (options.split) state.configurations[1].wanted = viewOptionsOf(*options.split);
  for (Configuration& configuration : state.configurations)
    configuration.update();
  return state;
}

}  // namespace

ViewerParts::ViewerParts(platform::Window& openWindow, const ViewOptions& options)
    : window(openWindow),
      state(startState(options)),
      input(window.handle()),
      interface(window.handle(), options.scale, state.settings.layout),
      redraw(state),
      messages(state, redraw),
      documents(options, state, redraw, messages),
      pictures(window.capabilities(), state, documents, redraw),
      selection(state, documents, redraw, messages),
      objects(state, documents, redraw, messages),
      cameras(state, documents, redraw, messages),
      navigation(state, documents, cameras, messages, interface),
      player(options, state, documents, redraw, messages),
      recorder(state, documents, redraw, messages),
      outputs(window, state, documents, pictures, messages) {}

}  // namespace jalousie::app
