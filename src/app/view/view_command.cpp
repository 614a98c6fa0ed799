// `jalousie view`: opens the window and runs the viewer.
#include "app/view/view_command.h"

#include <optional>
#include <vector>

#include "app/gl_debug.h"
#include "app/view/icon.h"
#include "app/view/viewer.h"
#include "core/interruption.h"
#include "core/output_files.h"

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

/// Files that the viewer writes at its end and those that it reads.
void checkFiles(const ViewOptions& options) {
  std::vector<std::filesystem::path> inputs = options.files;
  inputs.insert(inputs.end(), {options.render.path, options.render.importance});
  checkOutputs(std::vector<NamedFile>{{"--screenshot", options.screenshot, OutputKind::kPicture},
                                      {"--json", options.json, OutputKind::kReport, true}},
               inputs, options.render.replace);
}

}  // namespace

int runView(const ViewOptions& options) {
  checkFiles(options);
  // A script is ended at once: it has nothing to save before its last frame.
  std::optional<DeferredInterruptions> deferred;
  if (!options.frames) deferred.emplace();
  platform::Window window(windowOptions(options));
  setWindowIcon(window.handle());
  const GlDebug debug(options.debug);
  {
    Viewer viewer(window, options);
    while (!viewer.done() && !interrupted())
      viewer.step();
    viewer.finish();
  }
  debug.check();
  return interrupted() ? interruptionExitCode() : 0;
}

}  // namespace jalousie::app
