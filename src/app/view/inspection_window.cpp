// The window of the selected object: facts, block and spectrum, measures, LODs.
#include "app/view/inspection_window.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/render_option_table.h"
#include "app/view/drawing.h"
#include "policy/table.h"
#include "visibility/lod_policy.h"

namespace jalousie::app {
namespace {

constexpr ImU32 kLine = IM_COL32(255, 255, 255, 40);
constexpr ImU32 kPositive = IM_COL32(90, 170, 255, 255);
constexpr ImU32 kNegative = IM_COL32(255, 120, 90, 255);

void row(const char* name, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name);
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", value.c_str());
}

/// Titles of a table's columns, as its next row.
void titles(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
  }
}

std::string rectText(const Inspection& i) {
  const gpu::ScreenBox& box = i.readout.box;
  if (!i.hasRect) return "none";
  return fmt::format("{:.1f}, {:.1f} to {:.1f}, {:.1f} px ({:.1f} x {:.1f} px)", box.minX, box.minY, box.maxX, box.maxY,
                     box.maxX - box.minX, box.maxY - box.minY);
}

std::string budgetText(const Inspection& i, const LodRuleRow& rule) {
  std::string text = rule.pricesTriangles
                         ? fmt::format("price of tau {:.3g} px", i.tau)
                         : fmt::format("{:.3g} px x {:.2f} = {:.3g} px", i.tau, i.relaxed, i.tau * i.relaxed);
  if (i.importance < 1.0F) text += fmt::format(" (importance {:.2f})", i.importance);
  return text;
}

void drawFacts(const Inspection& i, const RenderOptions& options) {
  if (!ImGui::BeginTable("facts", 2)) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  row("object", i.mesh.empty() || i.mesh == i.name ? i.name : fmt::format("{} (mesh {})", i.name, i.mesh));
  row("number", fmt::format("{} of the file, chain {}", i.instance, i.chain));
  row("verdict", i.verdict);
  row("AABR", rectText(i));
  row("LV", fmt::format("{:.4f} ({})", i.readout.state.lv, rowOf(options.frameOptions.lvMeasure).name));
  if (i.countedLv) row("pixels", fmt::format("{} visible at the last count", i.readout.pixels));
  row("budget", budgetText(i, rowOf(options.frameOptions.lodRule)));
  row("level", i.cuts > 0 ? fmt::format("patches of level {}, each edge divided into {}", i.chosen, i.cuts)
                          : fmt::format("{}", i.chosen));
  row("reason", i.why);
  ImGui::EndTable();
}

/// Draws texels as squares: white is covered, black is open, as in --view occlusion. Row 0 is at the bottom.
void drawBlock(const visibility::AnalysedBlock& block, float side) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float texel = std::floor(side / static_cast<float>(std::max(block.x.count, block.y.count)));
  const float width = texel * static_cast<float>(block.x.count);
  const float height = texel * static_cast<float>(block.y.count);
  for (std::uint32_t j = 0; j < block.y.count; ++j) {
    for (std::uint32_t i = 0; i < block.x.count; ++i) {
      const auto grey = static_cast<int>(std::lround(255.0F * block.opacity[j * block.x.count + i]));
      const float x = origin.x + texel * static_cast<float>(i);
      const float y = origin.y + height - texel * static_cast<float>(j + 1);
      list.AddRectFilled({x, y}, {x + texel, y + texel}, IM_COL32(grey, grey, grey, 255));
      list.AddRect({x, y}, {x + texel + 1.0F, y + texel + 1.0F}, kLine);
    }
  }
  list.AddRect(origin, {origin.x + width, origin.y + height}, kAccentColor);
  ImGui::Dummy({side, height});
}

struct Bar {
  std::uint32_t u, v;
  double value;
};

/// Coefficients with u + v <= 3, by u + v.
std::vector<Bar> lowFrequencies(const InspectedBlock& b) {
  std::vector<Bar> bars;
  for (std::uint32_t sum = 0; sum <= 3; ++sum)
    for (std::uint32_t v = 0; v <= sum; ++v)
      if (const std::uint32_t u = sum - v; u < b.block.x.count && v < b.block.y.count)
        bars.push_back({u, v, b.spectrum[v * b.block.x.count + u]});
  return bars;
}

/// Draws one bar per coefficient, upwards if it is positive. The length is proportional to the root of the value, so
/// that small coefficients can be seen beside F(0, 0).
void drawSpectrum(const std::vector<Bar>& bars, float width, float height) {
  double largest = 1e-6;
  for (const Bar& bar : bars)
    largest = std::max(largest, std::abs(bar.value));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float middle = origin.y + 0.5F * height;
  const float step = width / static_cast<float>(bars.size());
  list.AddLine({origin.x, middle}, {origin.x + width, middle}, kLine);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const float x = origin.x + step * static_cast<float>(i);
    const auto share = static_cast<float>(std::sqrt(std::abs(bars[i].value) / largest));
    const float length = std::copysign(share, static_cast<float>(bars[i].value)) * (0.5F * height - 1.1F * unit());
    list.AddRectFilled({x + 0.12F * step, std::min(middle, middle - length)},
                       {x + 0.88F * step, std::max(middle, middle - length) + 1.0F},
                       bars[i].value >= 0.0 ? kPositive : kNegative);
    const std::string name = fmt::format("{}{}", bars[i].u, bars[i].v);
    list.AddText({x + 0.5F * (step - ImGui::CalcTextSize(name.c_str()).x), origin.y + height - unit()},
                 ImGui::GetColorU32(ImGuiCol_TextDisabled), name.c_str());
  }
  ImGui::InvisibleButton("spectrum", {width, height});
  if (!ImGui::IsItemHovered()) return;
  const auto index = static_cast<std::size_t>((ImGui::GetIO().MousePos.x - origin.x) / step);
  if (index < bars.size()) ImGui::SetTooltip("F(%u,%u) = %.4f", bars[index].u, bars[index].v, bars[index].value);
}

/// Every measure of occlusion with its LV, and the factor of tau that would follow from it with --lod lv-error.
void drawMeasures(const Inspection& i, const RenderOptions& options) {
  if (!ImGui::BeginTable("measures", 4, ImGuiTableFlags_SizingStretchSame)) return;
  titles({"measure", "LV", "occluded", "factor, lv-error"});
  for (const LvMeasureRow& measure : lvMeasureTable().subspan(1)) {  // the first one measures nothing
    const bool known = !measure.countsPixels || i.countedLv.has_value();
    const float lv =
        measure.countsPixels ? i.countedLv.value_or(0.0F) : i.block->lv[static_cast<std::size_t>(measure.id)];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::Text("%s%s", measure.name, options.frameOptions.lvMeasure == measure.id ? "  (in use)" : "");
    ImGui::TableNextColumn();
    known ? ImGui::Text("%.4f", static_cast<double>(lv)) : ImGui::TextDisabled("not counted");
    ImGui::TableNextColumn();
    if (known) ImGui::Text("%.1f %%", static_cast<double>(100.0F * visibility::hiddenShare(lv)));
    ImGui::TableNextColumn();
    if (known) ImGui::Text("%.2f", static_cast<double>(visibility::relaxedBudget(lv, options.frameOptions.relax)));
  }
  ImGui::EndTable();
}

void drawBlockSection(const Inspection& i, const RenderOptions& options) {
  if (!i.block) {
    const std::string modes = policy::namesWith(cullModeTable(), &CullModeRow::testsOcclusion);
    i.hasRect ? ImGui::TextWrapped("This mode has no map and no pyramid to measure. Use --mode %s.", modes.c_str())
              : ImGui::TextWrapped("The object has no finite AABR on the screen, so there is no block.");
    return;
  }
  const InspectedBlock& b = *i.block;
  ImGui::Text("Block of %u x %u texels at level %u (LOM %u)", b.block.x.count, b.block.y.count, b.block.level, b.lom);
  drawBlock(b.block, 11.0F * unit());
  ImGui::SameLine();
  ImGui::BeginGroup();
  ImGui::TextDisabled("DCT F(u,v), root scale");
  drawSpectrum(lowFrequencies(b), 15.0F * unit(), 9.5F * unit());
  ImGui::EndGroup();
  drawMeasures(i, options);
  const std::string chord =
      std::isinf(b.chordPixels) ? "mean opening unbounded" : fmt::format("mean opening {:.3g} px", b.chordPixels);
  ImGui::TextDisabled("open %.1f %%   fineness %.3f   %s", static_cast<double>(100.0F * b.openShare),
                      static_cast<double>(b.fineness), chord.c_str());
}

void drawLevels(const Inspection& i) {
  if (!ImGui::BeginTable("levels", 4, ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_RowBg)) return;
  titles({"level", "triangles", "error, object", "error, px"});
  for (std::size_t level = 0; level < i.levels.size(); ++level) {
    ImGui::TableNextRow();
    if (level == i.chosen) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, IM_COL32(60, 110, 180, 140));
    ImGui::TableNextColumn();
    ImGui::Text("%zu%s", level, level == i.chosen ? "  chosen" : "");
    ImGui::TableNextColumn();
    ImGui::Text("%u", i.levels[level].triangles);
    ImGui::TableNextColumn();
    ImGui::Text("%.3g", static_cast<double>(i.levels[level].errorObject));
    ImGui::TableNextColumn();
    ImGui::Text("%.3g", static_cast<double>(i.levels[level].errorPixels));
  }
  ImGui::EndTable();
}

}  // namespace

float drawInspection(const Inspection& inspection, const RenderOptions& options) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x - 0.6F * unit(), 0.6F * unit()}, ImGuiCond_FirstUseEver, {1.0F, 0.0F});
  ImGui::SetNextWindowSize({29.0F * unit(), std::min(53.0F * unit(), display.y - 1.2F * unit())},
                           ImGuiCond_FirstUseEver);
  float covered = 0.0F;
  if (ImGui::Begin("Object")) {
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth();
    if (right > display.x - 2.0F * unit()) covered = display.x - ImGui::GetWindowPos().x;
    drawFacts(inspection, options);
    ImGui::Separator();
    drawBlockSection(inspection, options);
    ImGui::Separator();
    drawLevels(inspection);
  }
  ImGui::End();
  return covered;
}

}  // namespace jalousie::app
