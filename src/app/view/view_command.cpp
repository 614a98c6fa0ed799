// Window, viewer, loop.
#include "app/view/view_command.h"

#include <fmt/format.h>

#include <optional>

#include "app/view/viewer.h"
#include "core/error.h"
#include "gl/debug_log.h"

namespace jalousie::app {
namespace {

std::string titleOf(const ViewOptions& options) {
  return options.files.empty() ? "jalousie" : "jalousie - " + options.files.front().filename().string();
}

}  // namespace

void runView(const ViewOptions& options) {
  platform::Window window({options.render.width, options.render.height, titleOf(options), true, options.debug});
  std::optional<gl::DebugLog> log;
  if (options.debug) log.emplace();
  {
    Viewer viewer(window, options);
    while (!viewer.done())
      viewer.step();
    viewer.finish();
  }
  if (log && !log->problems().empty())
    throw Error(ErrorCode::kInternal,
                fmt::format("OpenGL complained {} times, first: {}", log->problems().size(), log->problems().front()));
}

}  // namespace jalousie::app
