// `jalousie view`: opens the window and runs the viewer.
#include "app/view/view_command.h"

#include <fmt/format.h>

#include <optional>

#include "app/view/icon.h"
#include "app/view/viewer.h"
#include "core/error.h"
#include "gl/debug_log.h"

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
  std::optional<gl::DebugLog> log;
  if (options.debug) log.emplace();
  {
    Viewer viewer(window, options);
    while (!viewer.done())
      viewer.step();
    viewer.finish();
  }
  if (log && !log->problems().empty())
    throw Error(ErrorCode::kInternal, fmt::format("{} warnings and errors of OpenGL; the first: {}",
                                                  log->problems().size(), log->problems().front()));
}

}  // namespace jalousie::app
