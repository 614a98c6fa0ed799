// A table of Dear ImGui: sorted and filtered when something changes, drawn as far as it is visible.
#include "app/view/object_window.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "app/view/drawing.h"
#include "app/view/object_list.h"
#include "app/view/view_state.h"

namespace jalousie::app {
namespace {

enum Column : ImGuiID { kShown, kName, kMesh, kLevel, kTriangles, kPixels };
static_assert(kTriangles == kTrianglesColumn);

std::string lowered(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool matches(const ObjectTable& table, const ListedObject& object, const std::string& search) {
  if (search.empty() || std::to_string(object.instance) == search) return true;
  const auto holds = [&](std::string_view name) { return lowered(name).find(search) != std::string::npos; };
  return holds(scene::shownName(table.names, object.instance, object.chain)) ||
         holds(table.names.meshName(object.chain));
}

/// What a column of numbers is sorted by. Objects that are not drawn have less than all others.
std::int64_t valueOf(const ListedObject& object, ImGuiID column) {
  switch (column) {
    case kShown:
      return object.hidden ? 0 : 1;
    case kLevel:
      return object.drawn ? static_cast<std::int64_t>(object.level) : -1;
    case kPixels:
      return object.pixels;
    default:
      return static_cast<std::int64_t>(object.triangles);
  }
}

bool isBefore(const ObjectTable& table, const ListedObject& a, const ListedObject& b, ImGuiID column) {
  if (column == kName)
    return scene::shownName(table.names, a.instance, a.chain) < scene::shownName(table.names, b.instance, b.chain);
  if (column == kMesh) return table.names.meshName(a.chain) < table.names.meshName(b.chain);
  return valueOf(a, column) < valueOf(b, column);
}

void arrange(const ObjectTable& table, ObjectRows& rows) {
  rows.version = table.version;
  rows.order.clear();
  const std::string search = lowered(rows.search);
  for (std::uint32_t i = 0; i < table.objects.size(); ++i)
    if (matches(table, table.objects[i], search)) rows.order.push_back(i);
  std::stable_sort(rows.order.begin(), rows.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return rows.descending ? isBefore(table, table.objects[b], table.objects[a], rows.column)
                           : isBefore(table, table.objects[a], table.objects[b], rows.column);
  });
}

/// @return whether the rows must be arranged again
bool drawSearch(ObjectRows& rows) {
  std::array<char, 256> text{};
  rows.search.copy(text.data(), text.size() - 1);
  ImGui::SetNextItemWidth(-1.0F);
  if (!ImGui::InputTextWithHint("##search", "search: name, mesh or number", text.data(), text.size())) return false;
  rows.search = text.data();
  return true;
}

void drawButtons(ObjectWindowResult& result) {
  const auto button = [&](const char* label, Action action) {
    if (ImGui::Button(label)) result.actions.push_back(action);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", helpText(action).c_str());
  };
  button("Hide", Action::kHide);
  ImGui::SameLine();
  button("Isolate", Action::kIsolate);
  ImGui::SameLine();
  button("Show all", Action::kShowAll);
}

void drawMenu(const ListedObject& object, ObjectWindowResult& result) {
  if (!ImGui::BeginPopupContextItem()) return;
  if (ImGui::MenuItem(object.hidden ? "Show" : "Hide")) result.toggle = object.instance;
  if (ImGui::MenuItem("Isolate")) result.isolate = object.instance;
  ImGui::EndPopup();
}

void drawNumber(std::uint64_t value, bool known) {
  if (!known) return ImGui::TextDisabled("-");
  const std::string text = fmt::format("{}", value);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                       std::max(ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x, 0.0F));
  ImGui::TextUnformatted(text.c_str());
}

void drawRow(const ObjectTable& table, const ListedObject& object, bool selected, ObjectWindowResult& result) {
  ImGui::TableNextRow();
  ImGui::PushID(static_cast<int>(object.instance));
  ImGui::TableSetColumnIndex(kShown);
  bool shown = !object.hidden;
  if (ImGui::Checkbox("##shown", &shown)) result.toggle = object.instance;
  ImGui::TableSetColumnIndex(kName);
  const std::string name = scene::shownName(table.names, object.instance, object.chain) + "##name";
  if (ImGui::Selectable(name.c_str(), selected, ImGuiSelectableFlags_AllowDoubleClick) && !object.hidden) {
    result.select = object.instance;
    result.frame = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  }
  drawMenu(object, result);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("number %u of the file, chain %u", object.instance, object.chain);
  ImGui::TableSetColumnIndex(kMesh);
  const std::string mesh(table.names.meshName(object.chain).substr(0, scene::kLongestShownName));
  ImGui::TextDisabled("%s", mesh.c_str());
  ImGui::TableSetColumnIndex(kLevel);
  drawNumber(object.level, object.drawn);
  ImGui::TableSetColumnIndex(kTriangles);
  drawNumber(object.triangles, object.drawn);
  ImGui::TableSetColumnIndex(kPixels);
  drawNumber(object.pixels, object.drawn && table.countsPixels);
  ImGui::PopID();
}

void setUpColumns() {
  const float number = 4.2F * unit();
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 1.6F * unit(), kShown);
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 2.0F, kName);
  ImGui::TableSetupColumn("mesh", ImGuiTableColumnFlags_WidthStretch, 1.2F, kMesh);
  constexpr ImGuiTableColumnFlags kNumber =
      ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_PreferSortDescending;
  ImGui::TableSetupColumn("level", kNumber, 0.8F * number, kLevel);
  ImGui::TableSetupColumn("triangles", kNumber | ImGuiTableColumnFlags_DefaultSort, 1.15F * number, kTriangles);
  ImGui::TableSetupColumn("pixels", kNumber, number, kPixels);
  ImGui::TableHeadersRow();
}

void drawTable(const ObjectTable& table, const std::optional<Selection>& selection, ObjectRows& rows,
               ObjectWindowResult& result) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                     ImGuiTableFlags_Resizable | ImGuiTableFlags_BordersInnerV;
  if (!ImGui::BeginTable("objects", 6, kFlags)) return;
  setUpColumns();
  ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (specs != nullptr && specs->SpecsDirty && specs->SpecsCount > 0) {
    rows.column = specs->Specs[0].ColumnUserID;
    rows.descending = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    specs->SpecsDirty = false;
    arrange(table, rows);
  }
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.order.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const ListedObject& object = table.objects[rows.order[static_cast<std::size_t>(i)]];
      drawRow(table, object, selection && selection->instance == object.instance, result);
    }
  }
  ImGui::EndTable();
}

}  // namespace

ObjectWindowResult drawObjects(const ObjectTable& table, const std::optional<Selection>& selection, ObjectRows& rows,
                               bool* open) {
  ObjectWindowResult result;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({24.4F * unit(), 3.4F * unit()}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({31.0F * unit(), std::min(26.0F * unit(), display.y - 4.0F * unit())},
                           ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Objects", open)) {
    if (drawSearch(rows) || rows.version != table.version) arrange(table, rows);
    drawButtons(result);
    ImGui::SameLine();
    const auto hidden = std::count_if(table.objects.begin(), table.objects.end(),
                                      [](const ListedObject& object) { return object.hidden; });
    ImGui::TextDisabled("%zu of %zu listed, %zu hidden", rows.order.size(), table.objects.size(),
                        static_cast<std::size_t>(hidden));
    drawTable(table, selection, rows, result);
  }
  ImGui::End();
  return result;
}

}  // namespace jalousie::app
