// `jalousie view`: opens the window and runs the viewer.
#include "app/view/view_command.h"

#include "app/gl_debug.h"
#include "app/view/icon.h"
#include "app/view/viewer.h"

namespace jalousie::app {
namespace {

platform::WindowOptions windowOptions(const ViewOptions& options) {
  platform::WindowOptions window{options.render.width, options.render.height};
  window.debug = options.debug;
  window.waitsForDisplay = !options.frames;
  if (options.sizeGiven || options.frames) return window;
  const ViewSettings settings = loadSettings(settingsFolder());
  window.width = settings.width;
  window.height = settings.height;
  return window;
}

}  // namespace

void runView(const ViewOptions& options) {
  platform::Window window(windowOptions(options));
  setWindowIcon(window.handle());
  const GlDebug debug(options.debug);
  {
    Viewer viewer(window, options);
    while (!viewer.done())
      viewer.step();
    viewer.finish();
  }
  debug.check();
}

}  // namespace jalousie::app
