// A window of Dear ImGui without a title.
#include "app/view/path_window.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "app/view/actions.h"
#include "app/view/drawing.h"

namespace jalousie::app {

PathWindowResult drawPath(const Document& document, bool playing) {
  PathWindowResult result;
  if (document.pathFrames() < 2) return result;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({24.4F * unit(), 0.6F * unit()}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({std::clamp(display.x - 25.0F * unit(), 12.0F * unit(), 31.0F * unit()), 0.0F},
                           ImGuiCond_FirstUseEver);
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoScrollbar;
  if (ImGui::Begin("Path", nullptr, kFlags)) {
    result.toggle = ImGui::Button(playing ? "Pause" : "Play");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", helpText(Action::kPlay).c_str());
    ImGui::SameLine();
    const auto last = static_cast<int>(document.pathFrames() - 1);
    int frame = static_cast<int>(document.camera.sceneFrame);
    const bool isFree = document.camera.pose.has_value();
    const std::string format = isFree && !document.isAnimated()
                                   ? "free camera"
                                   : fmt::format("frame %d of {}{}", last, isFree ? ", free camera" : "");
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::SliderInt("##frame", &frame, 0, last, format.c_str(), ImGuiSliderFlags_AlwaysClamp))
      result.frame = frame;
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip(
          "Frame of the camera path and of the animations, 30 per second; Left and Right show the neighbours");
  }
  ImGui::End();
  return result;
}

}  // namespace jalousie::app
