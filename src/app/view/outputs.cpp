// What the viewer gives away: files and the clipboard.
#include "app/view/outputs.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise includes the system's OpenGL header.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "app/view/command_text.h"
#include "app/view/output_files.h"
#include "asset/image_io.h"
#include "core/output_files.h"

namespace jalousie::app {

Outputs::Outputs(platform::Window& window, ViewState& state, Documents& documents, Pictures& pictures,
                 Messages& messages)
    : window_(window), state_(state), documents_(documents), pictures_(pictures), messages_(messages) {}

std::string Outputs::command(int side, const std::string& output, bool absolute) const {
  if (state_.current >= documents_.size()) return {};
  RenderOptions options = documents_.optionsFor(state_.current, side);
  for (std::filesystem::path* path : {&options.scene, &options.path, &options.importance}) {
    std::error_code failed;
    if (absolute && !path->empty()) *path = std::filesystem::absolute(*path, failed);
  }
  return renderCommand(options, output);
}

void Outputs::copyCommand() {
  if (documents_.current() == nullptr) return;
  const std::string text = command(0, "frame.png", /*absolute=*/true);
  glfwSetClipboardString(window_.handle(), text.c_str());
  messages_.say("Copied: " + text);
}

void Outputs::savePicture(const ImageRgba8& picture) {
  const std::filesystem::path file = freshOutput(state_.outputs, "jalousie", ".png");
  asset::savePng(picture, file);
  messages_.say("Wrote " + file.string());
}

void Outputs::screenshot() {
  messages_.attempt([&] { savePicture(pictures_.capture()); });
}

void Outputs::windowDrawn() {
  if (!wantsWindow_) return;
  wantsWindow_ = false;
  messages_.attempt([&] { savePicture(window()); });
}

void Outputs::saveFigures() {
  messages_.attempt([&] {
    const std::filesystem::path& chosen = state_.configurations[0].wanted.json;
    const std::filesystem::path file =
        chosen.empty() ? freshOutput(state_.outputs, "jalousie-figures", ".json") : chosen;
    writeFigures(file);
    messages_.say("Wrote " + file.string());
  });
}

void Outputs::saveFrames() {
  messages_.attempt([&] {
    const std::filesystem::path file = freshOutput(state_.outputs, "jalousie-frames", ".csv");
    writeText(file, state_.history.csv());
    messages_.say("Wrote " + file.string());
  });
}

void Outputs::writeFigures(const std::filesystem::path& file) const {
  const gl::Capabilities& capabilities = window_.capabilities();
  Document* document = documents_.current();
  Side* side = document != nullptr ? document->side(0) : nullptr;
  const asset::ContentCounts ignored = side != nullptr ? side->scene().ignored : asset::ContentCounts{};
  writeText(file, state_.history.json(capabilities.renderer, !capabilities.softwareRenderer, ignored));
}

}  // namespace jalousie::app
