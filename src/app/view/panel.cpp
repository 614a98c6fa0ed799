// The panel: one widget per row of the option table, then what only the viewer has.
#include "app/view/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace jalousie::app {
namespace {

/// visit with one callable per kind.
template <class... Calls>
struct Overloaded : Calls... {
  using Calls::operator()...;
};

void tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(28.0F * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool editText(const char* label, std::filesystem::path& path) {
  std::array<char, 1024> text{};
  std::snprintf(text.data(), text.size(), "%s", path.c_str());
  // Only with Enter: every letter would be another file.
  if (!ImGui::InputText(label, text.data(), text.size(), ImGuiInputTextFlags_EnterReturnsTrue)) return false;
  path = text.data();
  return true;
}

bool editChoice(const char* label, std::string& value, const std::vector<std::string>& names, bool automatic) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, value.empty() ? "automatic" : value.c_str())) return false;
  if (automatic && ImGui::Selectable("automatic", value.empty())) {
    value.clear();
    changed = true;
  }
  for (const std::string& name : names) {
    if (!ImGui::Selectable(name.c_str(), name == value)) continue;
    value = name;
    changed = true;
  }
  ImGui::EndCombo();
  return changed;
}

bool editNumber(const char* label, float& value, float least, float most) {
  const float speed = most <= 1.0F ? 0.005F : std::max(0.02F, 0.02F * value);
  float edited = value;
  if (!ImGui::DragFloat(label, &edited, speed, least, most, "%.3g") || !std::isfinite(edited)) return false;
  value = std::clamp(edited, least, most);
  return true;
}

/// A slider that no typed value gets out of its range.
bool editSlider(const char* label, float& value, float least, float most, const char* format,
                ImGuiSliderFlags flags = 0) {
  float edited = value;
  if (!ImGui::SliderFloat(label, &edited, least, most, format, flags | ImGuiSliderFlags_AlwaysClamp)) return false;
  if (!std::isfinite(edited)) return false;
  value = std::clamp(edited, least, most);
  return true;
}

bool editCount(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most) {
  if (!ImGui::DragScalar(label, ImGuiDataType_U32, &value, most <= 32 ? 0.08F : 1.0F, &least, &most)) return false;
  value = std::clamp(value, least, most);
  return true;
}

/// A check box for "say it", and the value once it is said.
template <class Value, class Edit>
bool editMaybe(const char* label, std::optional<Value>& value, Value start, Edit edit) {
  bool said = value.has_value();
  const bool toggled = ImGui::Checkbox(fmt::format("##said{}", label).c_str(), &said);
  if (toggled) value = said ? std::optional(start) : std::nullopt;
  ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemInnerSpacing.x);
  if (value) return edit(*value) || toggled;
  ImGui::BeginDisabled();
  std::array<char, 16> automatic = {"automatic"};
  ImGui::InputText(label, automatic.data(), automatic.size(), ImGuiInputTextFlags_ReadOnly);
  ImGui::EndDisabled();
  return toggled;
}

bool editValue(const RenderOption& option, RenderOptions& options) {
  const std::string label = fmt::format("{}##{}", option.label, option.name);
  return std::visit(
      Overloaded{
          [&](const ChoiceValue& v) {
            return editChoice(label.c_str(), v.of(options), v.names,
                              v.of(options).empty() || option.name == std::string("--lv"));
          },
          [&](const NumberValue& v) { return editNumber(label.c_str(), v.of(options), v.least, v.most); },
          [&](const MaybeNumberValue& v) {
            return editMaybe(option.label, v.of(options), std::max(v.least, 1.0F),
                             [&](float& value) { return editNumber(label.c_str(), value, v.least, v.most); });
          },
          [&](const CountValue& v) { return editCount(label.c_str(), v.of(options), v.least, v.most); },
          [&](const MaybeCountValue& v) {
            return editMaybe(option.label, v.of(options), std::max(v.least, 1000U),
                             [&](std::uint32_t& value) { return editCount(label.c_str(), value, v.least, v.most); });
          },
          [&](const FlagValue& v) { return ImGui::Checkbox(label.c_str(), &v.of(options)); },
          [&](const FileValue& v) { return editText(label.c_str(), v.of(options)); },
      },
      option.value);
}

void button(const char* label, Action action, PanelResult& result, const char* help) {
  if (ImGui::Button(label)) result.actions.push_back(action);
  tooltip(help);
}

void drawConfigurations(ViewState& state, PanelResult& result) {
  static constexpr std::array<const char*, Document::kSides> kNames = {"Configuration A", "Configuration B"};
  if (!ImGui::BeginTabBar("configurations")) return;
  for (int side = 0; side < state.sides(); ++side) {
    if (!ImGui::BeginTabItem(kNames[static_cast<std::size_t>(side)])) continue;
    Configuration& configuration = state.configurations[static_cast<std::size_t>(side)];
    constexpr std::array kGroups = {std::pair(OptionGroup::kView, "View"), std::pair(OptionGroup::kCulling, "Culling"),
                                    std::pair(OptionGroup::kDetail, "Detail"),
                                    std::pair(OptionGroup::kDrawing, "Drawing")};
    for (const auto& [group, title] : kGroups) {
      const ImGuiTreeNodeFlags open = group == OptionGroup::kDrawing ? 0 : ImGuiTreeNodeFlags_DefaultOpen;
      if (!ImGui::CollapsingHeader(title, open)) continue;
      for (const RenderOption& option : renderOptionTable())
        if (option.group == group) result.configurationsChanged |= drawOption(option, configuration.wanted);
    }
    if (!configuration.refusal.empty()) {
      ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 150, 90, 255));
      ImGui::TextWrapped("%s; the picture keeps the last options that worked.", configuration.refusal.c_str());
      ImGui::PopStyleColor();
    }
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

bool editPose(const char* eye, const char* look, std::optional<Pose>& pose) {
  if (!pose) return false;
  Pose edited = *pose;
  bool changed = ImGui::DragFloat3(eye, &edited.eye.x, 0.01F, 0.0F, 0.0F, "%.4g");
  tooltip("Where the camera is; world units");
  changed |= ImGui::DragFloat3(look, &edited.look.x, 0.01F, 0.0F, 0.0F, "%.4g");
  tooltip("Point the camera looks at; world units");
  if (!changed || !isUsable(edited)) return false;
  pose = edited;
  return true;
}

void drawPathWidgets(ViewState& state, Document& document, PanelResult& result) {
  std::filesystem::path path = document.camera.path;
  if (editText("path##--path", path)) {
    document.keepFrozenCamera();
    document.camera.path = path;
    document.loadPath();
    result.camerasChanged = true;
  }
  tooltip("glTF whose camera path is followed; empty: the scene's own. Press Enter.");
  if (document.pathFrames() > 0) {
    float frame = document.camera.frame.value_or(0.0F);
    if (editSlider("frame##--frame", frame, 0.0F, static_cast<float>(document.pathFrames() - 1), "%.0f")) {
      document.camera.frame = std::round(frame);
      document.camera.pose.reset();
      result.camerasChanged = true;
    }
    tooltip("Frame of the camera path, 30 a second");
    button(state.playing ? "Halt" : "Play", Action::kPlay, result, "Play the path over and over (Space)");
    ImGui::SameLine();
  }
  button(state.recording ? "Stop recording" : "Record", Action::kRecord, result,
         "Record the camera as a glTF camera animation, 30 poses a second (Ctrl+R)");
}

void drawCamera(ViewState& state, Document* document, PanelResult& result) {
  if (document == nullptr || !ImGui::CollapsingHeader("Camera")) return;
  result.camerasChanged |= editPose("eye##--eye", "look##--look", document->camera.pose);
  drawPathWidgets(state, *document, result);
  button(document->camera.frozen() ? "Let the culling camera go" : "Freeze the culling camera", Action::kFreeze, result,
         "Culling and levels stay as this camera decides them; fly on to see what it left over (C)");
  result.camerasChanged |=
      editPose("frozen eye##--freeze-eye", "frozen look##--freeze-look", document->camera.freezePose);
  if (document->camera.freezeFrame)
    ImGui::Text("frozen at frame %.0f", static_cast<double>(*document->camera.freezeFrame));
  button("Reset", Action::kReset, result, "The camera of the start (R)");
  ImGui::SameLine();
  button("Frame", Action::kFrame, result, "The selected object, or the whole scene, fills the view (F)");
  editSlider("speed", state.settings.speed, kLeastSpeed, kMostSpeed, "%.2f", ImGuiSliderFlags_Logarithmic);
  tooltip("Of flying; 1: a tenth of the scene's diagonal a second");
  ImGui::Checkbox("move cameras of like scenes together", &state.linked);
  tooltip("Files side by side whose scenes are of one size and in one place follow each other's camera");
}

void drawLayout(ViewState& state, PanelResult& result) {
  if (!ImGui::CollapsingHeader("Compare")) return;
  result.layoutChanged |= ImGui::Checkbox("split screen", &state.split);
  tooltip("Configuration A left of the divider, B right of it; drag the divider (B)");
  result.layoutChanged |= editSlider("divider", state.divider, 0.0F, 1.0F, "%.2f");
  tooltip("Where the divider is, share of the width");
  result.layoutChanged |= ImGui::Checkbox("flicker", &state.flicker);
  tooltip("A and B in turn over the whole picture: what differs jumps (X)");
  result.layoutChanged |= editSlider("period", state.flickerSeconds, 0.1F, 3.0F, "%.1f s");
  tooltip("How long each configuration is shown; seconds");
}

void drawOutput(ViewState& state, const PanelFacts& facts, PanelResult& result) {
  if (!ImGui::CollapsingHeader("Picture and figures", ImGuiTreeNodeFlags_DefaultOpen)) return;
  std::array<int, 2> size = {static_cast<int>(facts.width), static_cast<int>(facts.height)};
  if (ImGui::InputInt2("size##--size", size.data(), ImGuiInputTextFlags_EnterReturnsTrue))
    result.resize = glm::uvec2(std::clamp(size[0], 16, 16384), std::clamp(size[1], 16, 16384));
  tooltip("Of the window and the picture; pixels. Press Enter.");
  RenderOptions& first = state.configurations[0].wanted;
  result.configurationsChanged |= editText("figures##--json", first.json);
  tooltip("File for the figures of the last seconds as JSON. Press Enter.");
  editText("folder##-o", state.outputs);
  tooltip("Folder for screenshots and recorded paths; empty: the current one. Press Enter.");
  button("Screenshot", Action::kScreenshot, result, "The picture alone, as jalousie render writes it (F12)");
  ImGui::SameLine();
  button("with interface", Action::kScreenshotInterface, result, "The window as it is (Shift+F12)");
  ImGui::SameLine();
  if (ImGui::Button("Figures")) result.saveJson = true;
  tooltip("Write the figures of the last seconds as JSON");
  button("Copy command line", Action::kCopyCommand, result,
         "The jalousie render command that gives this picture (Ctrl+C)");
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("%s", facts.command.c_str());
  ImGui::PopTextWrapPos();
}

void drawDocuments(ViewState& state, const PanelFacts& facts) {
  if (facts.documents.size() < 2) {
    ImGui::TextUnformatted(facts.documents.empty() ? "No file: drop one here" : facts.documents.front());
    return;
  }
  auto current = static_cast<int>(state.current);
  if (ImGui::Combo("file", &current, facts.documents.data(), static_cast<int>(facts.documents.size())))
    state.current = static_cast<std::size_t>(current);
}

}  // namespace

bool drawOption(const RenderOption& option, RenderOptions& options) {
  const bool works = applies(option, options);
  ImGui::BeginDisabled(!works);
  ImGui::BeginGroup();
  const bool changed = editValue(option, options);
  ImGui::EndGroup();
  ImGui::EndDisabled();
  std::string text = fmt::format("{}\n\n{}", option.name, option.help);
  if (*option.unit != '\0') text += fmt::format("\nUnit: {}", option.unit);
  if (!works) text += fmt::format("\n\nNeeds {}.", option.needs);
  tooltip(text);
  return changed;
}

void drawPanel(ViewState& state, Document* document, const PanelFacts& facts, PanelResult& result) {
  const float unit = ImGui::GetFontSize();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.6F * unit, 0.6F * unit}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({23.0F * unit, display.y - 1.2F * unit}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("jalousie", &state.settings.panel)) {
    ImGui::PushItemWidth(11.5F * unit);
    drawDocuments(state, facts);
    drawConfigurations(state, result);
    drawLayout(state, result);
    drawCamera(state, document, result);
    drawOutput(state, facts, result);
    ImGui::Separator();
    ImGui::TextDisabled("%s", facts.renderer.c_str());
    ImGui::TextDisabled("F1: keys");
    ImGui::PopItemWidth();
  }
  ImGui::End();
}

}  // namespace jalousie::app
