// The command line of the picture in the window. Numbers are printed so that they are read back bit for bit.
#include "app/view/command_text.h"

#include <fmt/format.h>

#include "app/option_values.h"
#include "app/render_option_table.h"

namespace jalousie::app {
namespace {

/// The shortest text that reads back as the same number.
std::string number(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) == value ? fmt::format("{}", rounded) : fmt::format("{}", value);
}

std::string point(const char* name, const std::optional<glm::dvec3>& p) {
  return p ? fmt::format(" {}={},{},{}", name, number(p->x), number(p->y), number(p->z)) : std::string();
}

std::string frame(const char* name, const std::optional<float>& f) {
  return f ? fmt::format(" {} {}", name, *f) : std::string();
}

}  // namespace

std::string methodOptions(const RenderOptions& options) {
  std::string text;
  for (const RenderOption& option : renderOptionTable()) {
    const std::string value = valueText(option, options);
    if (value == valueText(option, RenderOptions{})) continue;
    text += text.empty() ? "" : " ";
    text += option.name;
    if (!std::holds_alternative<FlagValue>(option.value)) text += " " + shellQuoted(value);
  }
  return text;
}

std::string renderCommand(const RenderOptions& options, const std::string& output) {
  std::string text = "jalousie render " + shellQuoted(options.scene.string());
  if (!options.path.empty()) text += " --path " + shellQuoted(options.path.string());
  if (options.time) text += fmt::format(" --time {}", *options.time);
  if (!options.camera.empty()) text += " --camera " + shellQuoted(options.camera);
  text += frame("--frame", options.frame) + point("--eye", options.eye) + point("--look", options.look);
  text += frame("--freeze-frame", options.freezeFrame) + point("--freeze-eye", options.freezeEye) +
          point("--freeze-look", options.freezeLook);
  const std::string method = methodOptions(options);
  if (!method.empty()) text += " " + method;
  return text + fmt::format(" --size {}x{} -o {}", options.width, options.height, shellQuoted(output));
}

}  // namespace jalousie::app
