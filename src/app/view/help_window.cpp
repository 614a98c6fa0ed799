// The window of keys: the tables of actions.h.
#include "app/view/help_window.h"

#include <imgui.h>

#include "app/view/actions.h"

namespace jalousie::app {

void drawHelp(bool* open) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * display.x, 0.5F * display.y}, ImGuiCond_Appearing, {0.5F, 0.5F});
  if (ImGui::Begin("Keys", open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings) &&
      ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    const auto line = [](const char* keys, const char* what) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(keys);
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", what);
    };
    for (const PointerHelp& help : pointerHelp())
      line(help.how, help.what);
    for (const Binding& binding : bindings())
      line(binding.keys, binding.what);
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace jalousie::app
