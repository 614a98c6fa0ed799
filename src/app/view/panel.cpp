// The panel: one widget per row of the option table, then layout, camera and output.
#include "app/view/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/view/drawing.h"
#include "core/overloaded.h"

namespace jalousie::app {
namespace {

void tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(28.0F * unit());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool editText(const char* label, std::filesystem::path& path) {
  // Longer than what is there, so that a long list is not cut off.
  std::vector<char> text(path.native().size() + 4096);
  path.native().copy(text.data(), path.native().size());
  // A value is taken on Enter only, because the text is no file name while it is typed.
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

struct Slider {
  float least, most;
  const char* format;
  ImGuiSliderFlags flags = 0;
};

/// A slider; typed values are clamped to its range too.
bool editSlider(const char* label, float& value, const Slider& slider) {
  float edited = value;
  if (!ImGui::SliderFloat(label, &edited, slider.least, slider.most, slider.format,
                          slider.flags | ImGuiSliderFlags_AlwaysClamp))
    return false;
  if (!std::isfinite(edited)) return false;
  value = std::clamp(edited, slider.least, slider.most);
  return true;
}

bool editCount(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most) {
  if (!ImGui::DragScalar(label, ImGuiDataType_U32, &value, most <= 32 ? 0.08F : 1.0F, &least, &most)) return false;
  value = std::clamp(value, least, most);
  return true;
}

/// A check box that tells whether there is a value, and the widget of the value if there is one.
/// @param start  value when the box is checked
template <class Value, class Edit>
bool editMaybe(const char* label, std::optional<Value>& value, Value start, Edit edit) {
  bool has = value.has_value();
  const bool toggled = ImGui::Checkbox(fmt::format("##has{}", label).c_str(), &has);
  if (toggled) value = has ? std::optional(start) : std::nullopt;
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
            std::string name = v.get(options);
            const bool changed =
                editChoice(label.c_str(), name, v.names, name.empty() || option.name == std::string("--lv"));
            if (changed) v.set(options, name);
            return changed;
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
          [&](const TextValue& v) {
            std::filesystem::path text = v.of(options);
            const bool changed = editText(label.c_str(), text);
            if (changed) v.of(options) = text.string();
            return changed;
          },
          [&](const FileValue& v) { return editText(label.c_str(), v.of(options)); },
      },
      option.value);
}

void button(const char* label, Action action, PanelResult& result) {
  if (ImGui::Button(label)) result.actions.push_back(action);
  tooltip(helpText(action));
}

/// All options of a configuration, by group.
void drawOptions(Configuration& configuration, PanelResult& result) {
  constexpr std::array kGroups = {std::pair(OptionGroup::kView, "View"), std::pair(OptionGroup::kCulling, "Culling"),
                                  std::pair(OptionGroup::kDetail, "Detail"),
                                  std::pair(OptionGroup::kDrawing, "Drawing")};
  for (const auto& [group, title] : kGroups) {
    const ImGuiTreeNodeFlags open = group == OptionGroup::kDrawing ? 0 : ImGuiTreeNodeFlags_DefaultOpen;
    if (!ImGui::CollapsingHeader(title, open)) continue;
    for (const RenderOption& option : renderOptionTable())
      if (option.group == group) result.configurationsChanged |= drawOption(option, configuration.wanted);
  }
  if (configuration.refusal.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 150, 90, 255));
  ImGui::TextWrapped("%s. The picture shows the last valid options.", configuration.refusal.c_str());
  ImGui::PopStyleColor();
}

void drawConfigurations(ViewState& state, PanelResult& result) {
  static constexpr std::array<const char*, Document::kSides> kNames = {"Configuration A", "Configuration B"};
  if (!ImGui::BeginTabBar("configurations")) return;
  for (std::size_t side = 0; side < static_cast<std::size_t>(state.sides()); ++side) {
    if (!ImGui::BeginTabItem(kNames[side])) continue;
    drawOptions(state.configurations[side], result);
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

bool dragPoint(const char* label, glm::dvec3& point) {
  return ImGui::DragScalarN(label, ImGuiDataType_Double, &point.x, 3, 0.01F, nullptr, nullptr, "%.7g");
}

bool editPose(const char* eye, const char* look, std::optional<WorldPose>& pose) {
  if (!pose) return false;
  WorldPose edited = *pose;
  bool changed = dragPoint(eye, edited.eye);
  tooltip("Position of the camera, world units");
  changed |= dragPoint(look, edited.look);
  tooltip("Point that the camera looks at, world units");
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
  tooltip("glTF file whose camera path is used; empty: the path of the scene. Press Enter to apply.");
  if (document.pathFrames() > 0) {
    float frame = document.camera.sceneFrame;
    if (editSlider("frame##--frame", frame, {0.0F, static_cast<float>(document.pathFrames() - 1), "%.0f"})) {
      document.showFrame(std::round(frame));
      result.camerasChanged = true;
    }
    tooltip("Frame of the camera path and of the animations, 30 per second");
    button(state.playing ? "Pause" : "Play", Action::kPlay, result);
    ImGui::SameLine();
  }
  button(state.recording ? "Stop recording" : "Record", Action::kRecord, result);
}

void drawCamera(ViewState& state, Document* document, PanelResult& result) {
  if (document == nullptr || !ImGui::CollapsingHeader("Camera")) return;
  result.camerasChanged |= editPose("eye##--eye", "look##--look", document->camera.pose);
  drawPathWidgets(state, *document, result);
  button(document->camera.frozen() ? "Unfreeze the culling camera" : "Freeze the culling camera", Action::kFreeze,
         result);
  result.camerasChanged |=
      editPose("frozen eye##--freeze-eye", "frozen look##--freeze-look", document->camera.freezePose);
  if (document->camera.freezeFrame)
    ImGui::Text("frozen at frame %.0f", static_cast<double>(*document->camera.freezeFrame));
  button("Reset", Action::kReset, result);
  ImGui::SameLine();
  button("Frame", Action::kFrame, result);
  editSlider("speed", state.settings.speed, {kLeastSpeed, kMostSpeed, "%.2f", ImGuiSliderFlags_Logarithmic});
  tooltip("Speed of flying; 1: 10 % of the scene's diagonal per second");
  ImGui::Checkbox("link cameras of similar scenes", &state.linked);
  tooltip("Files side by side share a camera if their scenes have a similar size and place");
}

void drawLayout(ViewState& state, PanelResult& result) {
  if (!ImGui::CollapsingHeader("Compare")) return;
  result.layoutChanged |= ImGui::Checkbox("split screen", &state.split);
  tooltip(helpText(Action::kSplit) + ". The divider can be dragged.");
  result.layoutChanged |= editSlider("divider", state.divider, {0.0F, 1.0F, "%.2f"});
  tooltip("Position of the divider, share of the width");
  result.layoutChanged |= ImGui::Checkbox("flicker", &state.flicker);
  tooltip(helpText(Action::kFlicker) + ". Differences show as movement.");
  result.layoutChanged |= editSlider("period", state.flickerSeconds, {0.1F, 3.0F, "%.1f s"});
  tooltip("Time for which each configuration is shown, seconds");
}

void drawOutput(ViewState& state, const PanelFacts& facts, PanelResult& result) {
  if (!ImGui::CollapsingHeader("Picture and figures", ImGuiTreeNodeFlags_DefaultOpen)) return;
  std::array<int, 2> size = {static_cast<int>(facts.width), static_cast<int>(facts.height)};
  if (ImGui::InputInt2("size##--size", size.data(), ImGuiInputTextFlags_EnterReturnsTrue))
    result.resize = glm::uvec2(std::clamp(size[0], 16, 16384), std::clamp(size[1], 16, 16384));
  tooltip("Size of the window and the picture, pixels. Press Enter to apply.");
  RenderOptions& first = state.configurations[0].wanted;
  result.configurationsChanged |= editText("figures##--json", first.json);
  tooltip("JSON file that the button Figures writes; empty: a new file in the folder below. Press Enter to apply.");
  editText("folder##-o", state.outputs);
  tooltip("Folder of screenshots, figures and recorded paths; empty: the current folder. Press Enter to apply.");
  button("Screenshot", Action::kScreenshot, result);
  ImGui::SameLine();
  button("with interface", Action::kScreenshotInterface, result);
  ImGui::SameLine();
  if (ImGui::Button("Figures")) result.saveFigures = true;
  tooltip("Write the figures of the last 10 s as JSON");
  button("Copy command line", Action::kCopyCommand, result);
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("%s", facts.command.c_str());
  ImGui::PopTextWrapPos();
}

/// A button with a menu: a field for a path, and the files opened last.
void drawOpen(const ViewState& state, PanelResult& result) {
  if (ImGui::Button("Open...")) ImGui::OpenPopup("open");
  tooltip("Open a glTF or GLB file, or a folder of them, beside the others");
  if (!ImGui::BeginPopup("open")) return;
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  std::filesystem::path typed;
  ImGui::SetNextItemWidth(26.0F * unit());
  if (editText("path", typed) && !typed.empty()) result.open = typed;
  if (!state.settings.recent.empty()) ImGui::TextDisabled("recent");
  for (const std::string& file : state.settings.recent)
    if (ImGui::Selectable(file.c_str())) result.open = file;
  if (!result.open.empty()) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void drawDocuments(ViewState& state, const PanelFacts& facts) {
  if (facts.documents.size() < 2) {
    ImGui::TextUnformatted(facts.documents.empty() ? "No file: drop one here" : facts.documents.front().c_str());
    return;
  }
  if (!ImGui::BeginCombo("file", facts.documents[state.current].c_str())) return;
  for (std::size_t i = 0; i < facts.documents.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));  // two files may have the same name
    if (ImGui::Selectable(facts.documents[i].c_str(), i == state.current)) state.current = i;
    ImGui::PopID();
  }
  ImGui::EndCombo();
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
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.6F * unit(), 0.6F * unit()}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({23.0F * unit(), display.y - 1.2F * unit()}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("jalousie", &state.settings.panel)) {
    const bool atTheEdge = ImGui::GetWindowPos().x < 2.0F * unit();
    state.freeLeft = atTheEdge ? ImGui::GetWindowPos().x + ImGui::GetWindowWidth() : 0.0F;
    ImGui::PushItemWidth(11.5F * unit());
    drawDocuments(state, facts);
    drawOpen(state, result);
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
